//! Crashes, exits and hangs of an isolated law: exit code 3, the call, the point and its inputs named, results kept, and
//! no process left behind.

use std::time::{Duration, Instant};

use super::behaviour::{caught, misbehaving};
use super::c_laws::CLaw;
use super::program::Room;

/// Processes of the program that were started for a law and still run.
fn workers(law: &CLaw) -> Vec<String> {
    let path = law.path().display().to_string();
    let processes = std::fs::read_dir("/proc").expect("the processes");
    let maps = processes.filter_map(|entry| {
        let folder = entry.ok()?.path();
        folder.file_name()?.to_str()?.parse::<u32>().ok()?;
        let mapped = std::fs::read_to_string(folder.join("maps")).ok()?;
        mapped.contains(&path).then(|| folder.display().to_string())
    });
    maps.collect()
}

#[test]
fn a_lost_worker_is_told_with_call_point_and_inputs() {
    let law = misbehaving();
    let place = ["law `small`", "in call ", "at point 8 (pressure = ", "slip = ", "K = "];
    for (misdeed, telling) in [
        (20, &["crashed (signal 11, SIGSEGV"] as &[&str]),
        (21, &["crashed (signal 6, SIGABRT"]),
        (22, &["ended its worker process with exit code 0"]),
    ] {
        caught(&law, misdeed, &["--isolate"], &[telling, &place].concat());
        assert_eq!(workers(&law), [""; 0], "a worker is left behind");
    }
}

#[test]
fn a_hang_ends_at_the_deadline() {
    let law = misbehaving();
    let start = Instant::now();
    caught(
        &law,
        23,
        &["--isolate", "--deadline", "0.4"],
        &["law `small`", "0.4", "in call ", "at point 8 (pressure = "],
    );
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    assert_eq!(workers(&law), [""; 0], "a worker is left behind");
}

#[test]
fn a_law_that_is_well_leaves_no_worker_either() {
    let (room, law) = (Room::new(), misbehaving());
    let path = law.path();
    let words = ["run", "scene.toml", "--isolate", "--set", "law.constants=[0]", "--law"];
    let ended = room.run(&[&words[..], &[path.to_str().expect("a plain name")]].concat());
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert_eq!(workers(&law), [""; 0], "a worker is left behind");
}
