//! Runs of faulty laws in worker processes: whatever a law does, the run ends by itself, says so in one sentence, keeps
//! what it had, and leaves no process behind. `WEARLAW_FAULTY=all`: every law; otherwise a seeded part.

use std::path::Path;

use super::diagonal::{all_wanted, part};
use super::fixtures::{library, side_by_side};
use super::hardening::{error, run_at};

/// Pressure and velocity at one of two points from half of the time on.
const INPUTS: [(&str, &str); 4] = [("1e300", "0.1"), ("1e300", "1e150"), ("0", "0.1"), ("1e7", "0")];

/// Processes that work in a folder.
fn at_work_in(folder: &Path) -> Vec<String> {
    let folder = folder.canonicalize().expect("the folder is there");
    let processes = std::fs::read_dir("/proc").expect("this is Linux").flatten();
    let inside = processes.filter(|entry| std::fs::read_link(entry.path().join("cwd")).is_ok_and(|cwd| cwd == folder));
    inside.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

/// What is wrong with one run of a law, in words.
fn wrong(file: &str, pressure: &str, velocity: &str) -> Result<i32, String> {
    let (room, ended) = run_at(&library("faulty", file), pressure, velocity, &["--isolate"]);
    let what = |wrong: &str| Err(format!("{file} {pressure} {velocity}: {wrong}: {} {}", ended.code, ended.stderr));
    if ![0, 2, 3, 4].contains(&ended.code) {
        return what("no code of a law's failure");
    }
    if !at_work_in(&room.file(".")).is_empty() {
        return what("a process is left");
    }
    if ended.code < 3 {
        return Ok(ended.code);
    }
    let said = error(&ended);
    let lost = ["crashed", "ended its worker", "did not answer"].iter().any(|word| said.contains(word));
    let opened = !said.contains("while it was opened") && !said.contains("is malformed");
    if lost && opened && !["in call ", "at point ", "pressure = ", "slip = "].iter().all(|word| said.contains(word)) {
        return what("not the call, the point and its inputs");
    }
    let kept = ["report.json", "history.csv", "checkpoint"].iter().all(|name| room.file("kept").join(name).is_file());
    if opened && room.file("kept").exists() && !kept { what("not all results") } else { Ok(ended.code) }
}

#[test]
fn no_law_takes_an_isolated_run_down_or_leaves_anything_behind() {
    let mut laws = part();
    // Two million substeps without an answer: some minutes in a program for tests.
    laws.retain(|law| all_wanted() || law.file != "runs_in.c");
    // Each is built once, before two runs can ask for it at the same time.
    side_by_side(&laws, |law| library("faulty", &law.file));
    let runs: Vec<_> = laws.iter().flat_map(|law| INPUTS.map(|(p, v)| (law.file.as_str(), p, v))).collect();
    let ended = side_by_side(&runs, |(file, pressure, velocity)| wrong(file, pressure, velocity));
    let bad: Vec<&String> = ended.iter().filter_map(|run| run.as_ref().err()).collect();
    assert!(bad.is_empty(), "{} of {} runs:\n{bad:#?}", bad.len(), runs.len());
    let count = |code| ended.iter().filter(|run| **run == Ok(code)).count();
    println!(
        "{} runs: {} went well, {} codes 2, {} codes 3, {} codes 4",
        runs.len(),
        count(0),
        count(2),
        count(3),
        count(4)
    );
    assert!(count(3) > 0, "no law of the part fails");
}

#[test]
fn what_a_law_starts_is_ended_with_its_worker() {
    // Whether a worker ends by itself or is ended is a race: some tries of each.
    for file in ["forks_a_child.c", "forks_a_session.c"] {
        for _ in 0..4 {
            assert_eq!(wrong(file, "1e7", "0.1"), Ok(0), "{file}");
        }
    }
}
