//! `wearlaw check` many times over laws that hang, crash, exit, fork or hide: nothing is left of any of them.
//!
//! `WEARLAW_SOAK=1000` says how many checks; without it a few are made. They run in a process of their own, which counts
//! its children, threads, descriptors and memory; the test looks for what may have got away from it.
#![cfg(target_os = "linux")]

#[path = "check_soak/laws.rs"]
mod laws;
#[path = "check_soak/left.rs"]
mod left;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use laws::{BAD, Bad};
use left::{Own, of_worker};
use wearlaw::conformance::{Check, CheckOptions, run};
use wearlaw::law::Source;

/// Checks of the ordinary tests: every bad law once.
const FEW: usize = BAD.len();
/// How the inner test is told what to do.
const ROUNDS: &str = "WEARLAW_SOAK_ROUNDS";
const FOLDER: &str = "WEARLAW_SOAK_FOLDER";
/// How much more memory the process may have at the end, KiB: far less than a page for every check of a thousand.
const GROWTH: i64 = 2048;

#[test]
fn nothing_is_left_of_many_checks_of_laws_that_break_out() {
    let rounds = std::env::var("WEARLAW_SOAK").ok().and_then(|text| text.parse().ok()).unwrap_or(FEW);
    let (folder, temporary) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    for bad in BAD {
        laws::build(folder.path(), bad);
    }
    let mut inner = Command::new(std::env::current_exe().expect("this test"));
    inner.args(["--exact", "rounds", "--nocapture"]);
    inner.env(ROUNDS, rounds.to_string()).env(FOLDER, folder.path()).env("TMPDIR", temporary.path());
    let mut inner = inner.spawn().expect("this test starts once more");
    let status = inner.wait().expect("it ends");
    assert!(status.success(), "the checks: {status}");
    let escaped = left::patiently_none(|| left::escaped(inner.id(), folder.path(), &laws::long()));
    assert!(escaped.is_empty(), "processes that got away: {escaped:?}");
    let files: Vec<_> = std::fs::read_dir(temporary.path()).expect("the folder is there").flatten().collect();
    assert!(files.is_empty(), "temporary files: {files:?}");
}

/// Does nothing by itself: the other test runs it in a process of its own.
#[test]
fn rounds() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<usize>().ok());
    let (rounds, folder) = match (number(ROUNDS), std::env::var_os(FOLDER)) {
        (Some(rounds), Some(folder)) => (rounds, PathBuf::from(folder)),
        _ => {
            assert!(std::env::var_os(ROUNDS).is_none(), "the folder of the laws is not said");
            return;
        }
    };
    let counts: Mutex<BTreeMap<String, usize>> = Mutex::new(BTreeMap::new());
    let check = |index: usize| {
        let bad = &BAD[index % BAD.len()];
        let outcome = checked(&folder, bad);
        let wanted = bad.outcomes.contains(&outcome.as_str());
        assert!(wanted, "{}: {outcome}, not {:?}", bad.name, bad.outcomes);
        *counts.lock().expect("no check panics").entry(outcome).or_default() += 1;
    };
    // What is made once and kept, such as the thread that starts workers, is there before anything is counted.
    (0..BAD.len().min(rounds)).for_each(check);
    let before = Own::count();
    let next = AtomicUsize::new(BAD.len());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(index) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|index| *index < rounds) {
                    check(index);
                }
            });
        }
    });
    let after = Own::count();
    let _ = writeln!(
        std::io::stdout(),
        "{rounds} checks, ended {:?}\nbefore {before:?}\nafter  {after:?}",
        counts.lock().expect("no check panics")
    );
    assert_eq!(after.children, 0, "children are left");
    assert_eq!((after.threads, after.descriptors, after.shared), (before.threads, before.descriptors, before.shared));
    assert!(after.memory - before.memory < GROWTH, "{} KiB, then {}", before.memory, after.memory);
    let mine = of_worker(std::process::id());
    assert!(mine.is_empty(), "marked processes are left: {mine:?}");
}

/// The worst outcome of one check of a bad law.
fn checked(folder: &std::path::Path, bad: &Bad) -> String {
    let options = CheckOptions {
        selected: vec![Check::FaultsHang],
        quick: true,
        timeout: Duration::from_millis(bad.timeout),
        program: Some(PathBuf::from(env!("CARGO_BIN_EXE_wearlaw"))),
        ..CheckOptions::new(Source::File(laws::library(folder, bad)))
    };
    let report = run(&options, &mut |_| {}, &AtomicBool::new(false)).unwrap_or_else(|e| panic!("{}: {e}", bad.name));
    let names = report.results.iter().map(|result| result.outcome.name());
    names
        .max_by_key(|name| ["pass", "blocked", "fail", "crashed", "timed-out"].iter().position(|n| n == name))
        .expect("something was checked")
        .to_owned()
}
