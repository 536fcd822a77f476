//! The program `wearlaw`; all of it is in the library's `cli`.

fn main() -> std::process::ExitCode {
    wearlaw::cli::main(std::env::args_os()).into()
}
