//! The tester against the faulty laws: each fails its own check, by itself and in a run of all, and no other check.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

use super::fixtures::{Faulty, faulty, library, side_by_side, sound, suspicious};
use super::random::Random;

/// Laws that meet the whole tester when not all of them do.
const PART: usize = 10;

/// Each check and its outcome.
type Outcomes = BTreeMap<String, String>;

/// Runs the tester in a folder, which takes its replay files; its exit code and its report.
fn report(folder: &Path, library: &Path, more: &[&str]) -> (i32, Value) {
    let output = Command::new(env!("CARGO_BIN_EXE_wearlaw"))
        .current_dir(folder)
        .arg("check")
        .arg(library)
        .args(["--json", "-q", "--threads", "1"])
        .args(more)
        .stdin(Stdio::null())
        .output()
        .expect("the program starts");
    let (code, text) = (output.status.code(), String::from_utf8_lossy(&output.stdout));
    let document: Value =
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}: {text} {output:?}", library.display()));
    (code.expect("no signal ends the tester"), document)
}

/// Runs the tester in a folder of its own; its exit code, and the outcome of each check.
fn check(library: &Path, more: &[&str]) -> (i32, Outcomes) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (code, document) = report(folder.path(), library, more);
    let rows = document["checks"].as_array().unwrap_or_else(|| panic!("{}: {document}", library.display()));
    let word = |row: &Value, key: &str| row[key].as_str().expect("a word").to_owned();
    let outcomes = rows.iter().map(|row| (word(row, "check"), word(row, "outcome"))).collect();
    (code, outcomes)
}

/// The checks that found something.
fn failed(outcomes: &Outcomes) -> Vec<String> {
    let found = |outcome: &str| ["fail", "crashed", "timed-out"].contains(&outcome);
    outcomes.iter().filter(|(_, outcome)| found(outcome)).map(|(check, _)| check.clone()).collect()
}

pub fn all_wanted() -> bool {
    std::env::var("WEARLAW_FAULTY").as_deref() == Ok("all")
}

/// A part of the laws by a seed, which may be given; all of them if asked for.
pub fn part() -> Vec<Faulty> {
    let mut laws = faulty();
    if all_wanted() {
        return laws;
    }
    let seed = std::env::var("WEARLAW_FAULTY_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(1);
    let mut random = Random(seed);
    let mut chosen = Vec::new();
    while chosen.len() < PART {
        chosen.push(laws.swap_remove(random.below(laws.len())));
    }
    chosen
}

#[test]
fn every_faulty_law_fails_its_own_check_by_itself() {
    let laws = faulty();
    let found = side_by_side(&laws, |law| check(&library("faulty", &law.file), &["--only", &law.check]));
    let missed = laws.iter().zip(&found).filter(|(law, (code, outcomes))| {
        let alone = outcomes.len() == 1;
        *code != 1 || !alone || failed(outcomes) != [law.check.clone()]
    });
    let missed: Vec<String> = missed.map(|(law, found)| format!("{} {}: {found:?}", law.file, law.check)).collect();
    assert!(missed.is_empty(), "{} of {} are missed:\n{}", missed.len(), laws.len(), missed.join("\n"));
}

#[test]
fn a_faulty_law_fails_no_check_but_its_own() {
    let laws = part();
    let found = side_by_side(&laws, |law| check(&library("faulty", &law.file), &[]));
    let mut table = String::new();
    let mut wrong = 0;
    for (law, (code, outcomes)) in laws.iter().zip(&found) {
        let failed = failed(outcomes);
        let good = *code == 1 && failed == [law.told_by()];
        wrong += usize::from(!good);
        let count = |name: &str| outcomes.values().filter(|outcome| *outcome == name).count();
        let others = format!(
            "pass {:2}  warn {}  skipped {:2}  blocked {:2}",
            count("pass"),
            count("warn"),
            count("skipped"),
            count("blocked")
        );
        let mark = if good { "  " } else { "! " };
        table += &format!("{mark}{:34} {:28} {others}  fails {}\n", law.file, law.check, failed.join(", "));
    }
    // Straight to the stream: what a test prints is kept back when it passes.
    let _ = writeln!(std::io::stdout(), "{table}{} of {} on the diagonal", laws.len() - wrong, laws.len());
    assert_eq!(wrong, 0, "laws that are not found by their own check alone:\n{table}");
}

#[test]
fn sound_and_suspicious_laws_pass() {
    let laws = [sound(), suspicious()].concat();
    let more: &[&str] = if all_wanted() { &[] } else { &["--quick"] };
    let found = side_by_side(&laws, |law| check(law, more));
    let wrong = laws.iter().zip(&found).filter(|(_, (code, outcomes))| *code != 0 || !failed(outcomes).is_empty());
    let wrong: Vec<String> = wrong.map(|(law, (_, found))| format!("{}: {:?}", law.display(), failed(found))).collect();
    assert!(wrong.is_empty(), "good laws that are failed:\n{}", wrong.join("\n"));
}

#[test]
fn a_crash_at_one_input_in_a_million_comes_back_at_the_first_try() {
    let law = library("faulty", "crashes_once_in_a_million.c");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let crash = |more: &[&str]| {
        let (code, document) = report(folder.path(), &law, more);
        let rows = document["checks"].as_array().cloned().unwrap_or_default();
        let crash = rows.into_iter().find(|row| row["outcome"] == "crashed").unwrap_or_else(|| panic!("{document:#}"));
        assert_eq!(code, 1, "{document:#}");
        crash
    };
    let first = crash(&["--only", "faults/signal"]);
    assert!(first["what"].as_str().is_some_and(|what| what.contains("one point of them is enough")), "{first:#}");
    let replay = first["replay"].as_str().expect("a file that brings it back");
    let again = crash(&["--replay", replay]);
    assert_eq!((&again["check"], &again["input"]), (&first["check"], &first["input"]));
}
