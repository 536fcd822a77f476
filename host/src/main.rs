//! Skeleton.

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some((command, rest)) = arguments.split_first()
        && command == wearlaw::law::isolate::WORKER_COMMAND
    {
        std::process::exit(wearlaw::law::isolate::worker_main(rest, &|_| None));
    }
}
