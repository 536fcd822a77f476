//! Ctrl-C in the middle of a long run: exit code 130, and results so far written whole.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::program::{Ended, Room, ended};

/// A run that takes minutes, its results going to `kept`.
fn long_run(room: &Room, more: &[&str]) -> Child {
    let words = ["run", "scene.toml", "--out", "kept", "--set", "cycle=[{count=100000000,step=[{duration=1}]}]"];
    let fields = ["--set", "output.fields=[\"wear\"]"];
    let mut command = room.command(&[&words[..], &fields, more].concat());
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
}

/// Waits until the run writes aside, lets it work, and interrupts it.
fn interrupted(room: &Room, child: Child) -> Ended {
    let begin = Instant::now();
    while !room.entries().iter().any(|path| path.to_string_lossy().contains(".partial-")) {
        assert!(begin.elapsed() < Duration::from_secs(30), "the run did not start");
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(400));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(sent.success(), "the run ended by itself");
    let asked = Instant::now();
    let ended = ended(child.wait_with_output().expect("it ends"), &["a long run"]);
    assert!(asked.elapsed() < Duration::from_secs(20), "it took {:?} to end", asked.elapsed());
    ended
}

fn results_are_whole(room: &Room) {
    let text = std::fs::read_to_string(room.file("kept/report.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("a whole document");
    assert_eq!(report["ended"], "interrupted");
    let last = report["result"]["time"].as_f64().expect("a time");
    let history = std::fs::read_to_string(room.file("kept/history.csv")).expect("a history");
    assert!(history.ends_with('\n'));
    let rows: Vec<&str> = history.lines().filter(|line| !line.starts_with('#')).skip(1).collect();
    let time = |row: &str| row.split(',').next().and_then(|time| time.parse::<f64>().ok()).expect("a time");
    assert!(rows.len() > 2 && last > 0.0 && last < 1e8);
    assert_eq!(time(rows[rows.len() - 1]), last, "the last row is the state that was reached");
    let entries = room.entries();
    assert!(entries.iter().any(|path| path.starts_with("kept/fields") && path.extension().is_some()), "{entries:?}");
    assert!(!entries.iter().any(|path| path.to_string_lossy().contains(".partial-")), "{entries:?}");
}

#[test]
fn an_interrupted_run_writes_what_it_has() {
    let room = Room::new();
    let child = long_run(&room, &[]);
    let ended = interrupted(&room, child);
    assert_eq!(ended.code, 130, "{} {}", ended.stdout, ended.stderr);
    assert!(ended.stdout.contains("interrupted") && ended.stdout.contains("kept"), "{}", ended.stdout);
    results_are_whole(&room);
}

#[test]
fn an_interrupted_isolated_run_does_so_too_and_says_it_as_json() {
    let room = Room::new();
    let child = long_run(&room, &["--isolate", "--json"]);
    let ended = interrupted(&room, child);
    assert_eq!(ended.code, 130, "{} {}", ended.stdout, ended.stderr);
    let document: serde_json::Value = serde_json::from_str(&ended.stdout).expect("one document");
    assert_eq!(document["ended"], "interrupted");
    results_are_whole(&room);
}
