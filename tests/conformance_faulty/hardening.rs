//! Runs of laws that misbehave in evaluation: with `--isolate` each ends with exit code 3, one message that names the
//! call, the point and its inputs, and the results so far; without it, what can be caught is.

use std::path::Path;

use super::fixtures::{library, side_by_side, sound};
use super::program::{Ended, Room};

/// From half of the time on, point 8 has another pressure and velocity.
fn history(pressure: &str, velocity: &str) -> String {
    let rows = [("0", "1e7", "0.1"), ("0.5", "1e7", "0.1"), ("0.5", pressure, velocity), ("1", pressure, velocity)];
    let row = |(time, pressure, velocity): &(&str, &str, &str)| {
        format!("{time},7,1e7,0.1,0,0,1\n{time},8,{pressure},{velocity},0,0,1\n")
    };
    let head = "time,point,pressure,velocity,nx,ny,nz\n";
    head.to_owned() + &rows.iter().map(row).collect::<String>()
}

const SCENE: &str = r#"title = "two points, one of them with another pressure from half of the time on"
[law]
use = "LAW"
[contact]
model = "prescribed"
history = "history.csv"
"#;

/// Runs a law, pressed beyond all sense; its results are in the folder `kept`.
fn run(library: &Path, velocity: &str, more: &[&str]) -> (Room, Ended) {
    run_at(library, "1e300", velocity, more)
}

/// Runs a law; its results are in the folder `kept`.
pub fn run_at(library: &Path, pressure: &str, velocity: &str, more: &[&str]) -> (Room, Ended) {
    let room = Room::new();
    let path = library.to_str().expect("a path of the target folder is text");
    room.write("scene.toml", &SCENE.replace("LAW", path));
    room.write("history.csv", &history(pressure, velocity));
    let deadline: &[&str] = if more.contains(&"--isolate") { &["--deadline", "3"] } else { &[] };
    let ended = room.run(&[&["run", "scene.toml", "--out", "kept"], more, deadline].concat());
    (room, ended)
}

/// The one line of an error; what else was said are notes and warnings.
pub fn error(ended: &Ended) -> String {
    let lines: Vec<&str> = ended.stderr.lines().filter(|line| line.starts_with("error: ")).collect();
    assert_eq!(lines.len(), 1, "{}", ended.stderr);
    lines[0].to_owned()
}

/// The results up to half of the time are there, and whole.
fn results_are_kept(room: &Room) {
    let text = std::fs::read_to_string(room.file("kept/report.json")).expect("a report of the part that was done");
    let report: serde_json::Value = serde_json::from_str(&text).expect("a whole document");
    assert!(report["ended"].is_string(), "{report}");
    let history = std::fs::read_to_string(room.file("kept/history.csv")).expect("a history");
    let rows: Vec<&str> = history.lines().filter(|line| !line.starts_with('#')).skip(1).collect();
    let last = rows.last().and_then(|row| row.split(',').next()?.parse::<f64>().ok()).expect("a row with a time");
    assert!((0.4..=0.5).contains(&last), "{history}");
    assert!(room.file("kept/checkpoint").is_file(), "no checkpoint to go on from");
}

/// Laws that do not come back from the pressed point, with what is said of each; `true`: only if it also slips fast.
const LOST: [(&str, bool, &str); 11] = [
    ("aborts_on_high_pressure.c", false, "crashed (signal 6, SIGABRT"),
    ("loops_on_high_pressure.c", false, "did not answer within 3 s"),
    ("recurses_without_end.c", false, "crashed (signal 11, SIGSEGV"),
    ("raises_once.c", false, "crashed (signal 11, SIGSEGV"),
    ("crashes_on_large_slip.c", true, "crashed (signal 11, SIGSEGV"),
    ("exits_on_overflow.c", true, "ended its worker process with exit code 3"),
    ("throws.cpp", false, "crashed (signal 6, SIGABRT"),
    ("stops.f90", false, "ended its worker process with exit code 4"),
    ("rust/examples/panics.rs", false, "crashed (signal 6, SIGABRT"),
    ("rust/examples/ends_the_process.rs", true, "ended its worker process with exit code 7"),
    ("rust/examples/recurses_deeply.rs", false, "crashed (signal 11, SIGSEGV"),
];

#[test]
fn a_law_that_does_not_come_back_ends_an_isolated_run_and_nothing_else() {
    let known: Vec<String> = super::fixtures::faulty().into_iter().map(|law| law.file).collect();
    let laws: Vec<_> = LOST.iter().filter(|(file, ..)| known.iter().any(|name| name == file)).collect();
    assert!(laws.len() >= 10, "{} laws", laws.len());
    side_by_side(&laws, |(file, fast, telling)| {
        let velocity = if *fast { "1e150" } else { "0.1" };
        let (room, ended) = run(&library("faulty", file), velocity, &["--isolate"]);
        assert_eq!(ended.code, 3, "{file}: {} {}", ended.stdout, ended.stderr);
        let said = error(&ended);
        for word in [telling, "in call ", "at point 8 (pressure = 1e300", "slip = ", "K = 1e-4", "H = 2e9"] {
            assert!(said.contains(word), "{file} does not say `{word}`: {said}");
        }
        results_are_kept(&room);
    });
}

#[test]
fn a_law_that_does_not_come_back_from_create_ends_an_isolated_run_before_it_begins() {
    for (file, telling) in [
        ("exits_in_create.c", "exit code 0 while it was opened"),
        ("aborts_at_load.c", "SIGABRT, it aborted) while it was opened"),
        ("hangs_at_load.c", "did not answer within 3 s"),
    ] {
        let (room, ended) = run(&library("faulty", file), "0.1", &["--isolate"]);
        assert_eq!(ended.code, 3, "{file}: {}", ended.stderr);
        assert!(error(&ended).contains(telling), "{file}: {}", ended.stderr);
        assert!(!room.file("kept").exists(), "{file} left results of nothing");
    }
}

/// The bits of a number scrambled as `plugins/faulty/scrambled.h` does it.
fn scrambled(x: f64) -> u64 {
    let bits = x.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (bits ^ bits >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9)
}

/// The first of many numbers from `start` on whose bits are like this.
fn first_with(start: f64, is_it: impl Fn(f64) -> bool) -> String {
    let found = (0..1 << 26).map(|k| start * (1.0 + f64::from(k) * 1e-8)).find(|x| is_it(*x));
    found.expect("one in a million").to_string()
}

#[test]
fn a_crash_at_one_pressure_in_a_million_names_that_pressure() {
    let pressure = first_with(2e7, |p| scrambled(p) >> 44 == 0xabcde);
    let (room, ended) = run_at(&library("faulty", "crashes_once_in_a_million.c"), &pressure, "0.1", &["--isolate"]);
    assert_eq!(ended.code, 3, "{}", ended.stderr);
    let said = error(&ended);
    for word in ["SIGSEGV", "in call ", "at point 8 (pressure = ", "slip = "] {
        assert!(said.contains(word), "no `{word}`: {said}");
    }
    results_are_kept(&room);
}

#[test]
fn a_law_that_crashes_at_every_point_is_told_with_its_first_point() {
    for file in ["reads_undeclared_field.c", "needs_what_it_uses.c", "writes_unwanted_slope.c"] {
        let (_, ended) = run(&library("faulty", file), "0.1", &["--isolate"]);
        assert_eq!(ended.code, 3, "{file}: {}", ended.stderr);
        let said = error(&ended);
        for word in ["SIGSEGV", "in call 1", "at point 7 (pressure = 1e7", "slip = ", "K = 1e-4"] {
            assert!(said.contains(word), "{file} does not say `{word}`: {said}");
        }
    }
}

#[test]
fn answers_that_cannot_be_are_caught_in_the_same_process_and_in_another() {
    let no_number = first_with(2e7, |p| scrambled(p) >> 56 == 0xab);
    // A substep is 1/64 long.
    let negative = first_with(0.1, |v| scrambled(v / 64.0) % 8 == 3);
    let zero = ["--set", "law.constants={ K = 0.0 }"];
    let none: &[&str] = &[];
    for (file, pressure, velocity, set, telling) in [
        ("silent_infinity.c", "1e300", "1e150", none, "increment = inf at point 8"),
        ("direction_too_short.c", "1e300", "0.1", none, "direction of length 0.99"),
        ("direction_outward.c", "1e300", "0.1", none, "wear direction"),
        ("wrong_intent.f90", "1e300", "0.1", none, "direction of length 0"),
        ("nan_at_zero_slip.c", "1e7", "0", none, "increment = NaN at point 8"),
        ("nan_at_subnormal.c", "3e-310", "0.1", none, "increment = NaN at point 8"),
        ("nan_at_bound.c", "1e7", "0.1", &zero, "increment = NaN at point 7"),
        ("nan_in_bounds.c", &no_number, "0.1", none, "increment = NaN at point 8"),
        ("negative_wear.c", "1e7", &negative, none, "increment = -"),
    ] {
        if !super::fixtures::faulty().iter().any(|law| law.file == file) {
            continue;
        }
        for more in [&[] as &[&str], &["--isolate"]] {
            let (_, ended) = run_at(&library("faulty", file), pressure, velocity, &[set, more].concat());
            assert_eq!(ended.code, 3, "{file} {more:?}: {}", ended.stderr);
            assert!(error(&ended).contains(telling), "{file} {more:?}: {}", ended.stderr);
        }
    }
}

#[test]
fn statuses_of_the_sound_laws_end_a_run_and_an_ordinary_one_goes_well() {
    for law in sound() {
        let (room, ended) = run(&law, "1e150", &[]);
        assert_eq!(ended.code, 3, "{}: {}", law.display(), ended.stderr);
        assert!(error(&ended).contains("cannot answer at point 8 (pressure = 1e300"), "{}", ended.stderr);
        results_are_kept(&room);
        let (_, ended) = run(&law, "0.1", &[]);
        assert_eq!(ended.code, 0, "{}: {}", law.display(), ended.stderr);
    }
}

#[test]
fn changed_floating_point_settings_are_put_back_and_told_and_change_no_bit() {
    let wear = |ended: &Ended, room: &Room| {
        assert_eq!(ended.code, 0, "{}", ended.stderr);
        std::fs::read_to_string(room.file("kept/history.csv")).expect("a history")
    };
    let (room, ended) = run(&library("faulty", "sound.c"), "0.1", &[]);
    let right = wear(&ended, &room);
    for (file, telling) in [
        ("flushes_at_load.c", "flush-to-zero from off to on"),
        ("rounds_upward_in_create.c", "rounding from to nearest to upward"),
        ("unmasks_division.c", "division-by-zero exception from quiet to trapping"),
    ] {
        for more in [&[] as &[&str], &["--isolate"]] {
            let (room, ended) = run(&library("faulty", file), "0.1", more);
            assert_eq!(wear(&ended, &room), right, "{file} {more:?}");
            let stem = file.trim_end_matches(".c");
            assert!(ended.stderr.contains(telling) && ended.stderr.contains(stem), "{file}: {}", ended.stderr);
        }
    }
}
