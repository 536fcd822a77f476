//! User subroutines of other solvers, both ways: an unmodified one becomes a law, and a law is called by one that the program
//! writes. Drivers call them as those solvers do, over thousands of points and increments, with retries.

#[path = "support/native.rs"]
mod native;
#[path = "support/program.rs"]
mod program;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use native::{fortran, root};
use program::{fails, folder, run};

fn data(name: &str) -> PathBuf {
    root().join("tests/data/shims").join(name).canonicalize().expect("it is there")
}

/// Where cargo builds libraries beside the tests.
fn deps() -> PathBuf {
    let program = std::env::current_exe().expect("a test knows its own path");
    program.parent().expect("a program lies in a folder").to_owned()
}

/// Compiles and links Fortran sources in a folder.
fn linked(here: &Path, sources: &[PathBuf], name: &str) -> PathBuf {
    let compiler = std::env::var("FC").unwrap_or_else(|_| "gfortran".into());
    let program = here.join(name);
    let mut command = Command::new(compiler);
    command.args(["-O2", "-Wall", "-ffp-contract=off"]).args(sources);
    command.arg("-L").arg(deps()).args(["-lwearlaw_host", "-o"]).arg(&program);
    command.arg(format!("-Wl,-rpath,{}", deps().display()));
    let output = command.current_dir(here).output().expect("the compiler starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    program
}

fn ran(program: &Path, words: &[&str]) -> Output {
    let here = program.parent().expect("a program lies in a folder");
    Command::new(program).args(words).current_dir(here).output().expect("the program starts")
}

fn said(program: &Path, words: &[&str]) -> String {
    let output = ran(program, words);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{words:?}: {said}{}", String::from_utf8_lossy(&output.stderr));
    said
}

/// Runs the program; it has to end well.
fn wearlaw(here: &Path, words: &[&str]) -> String {
    let ended = run(here, words);
    assert_eq!(ended.code, 0, "{words:?}: {}{}", ended.stdout, ended.stderr);
    ended.stdout
}

#[test]
fn a_subroutine_and_the_shim_of_its_law_answer_the_same_bits() {
    if !fortran("a user subroutine, its law and the law's shim") {
        return;
    }
    let room = folder();
    let here = room.path();
    let source = data("wear.f").display().to_string();
    wearlaw(
        here,
        &["build", "--adapt", "uwearindex", &source, "--params", "K,H:pascal,a:per-kelvin", "-o", "libwear.so"],
    );
    let described = wearlaw(here, &["inspect", "./libwear.so", "--json"]);
    assert!(described.contains("\"linear_in_dt\"") && described.contains("\"temperature\""), "{described}");
    wearlaw(here, &["shim", "uwearindex", "./libwear.so"]);
    let driver = data("drive_uwearindex.f90");
    let direct = linked(here, &[data("wear.f"), driver.clone()], "direct");
    let through = linked(here, &[here.join("uwearindex.f90"), driver], "through");
    // 60 increments, 3000 nodes: 180 000 calls and the retries.
    for even in ["0", "1"] {
        let words = ["60", "3000", "1", even, "2e-13", "2e9", "1e-3"];
        let (direct, through) = (said(&direct, &words), said(&through, &words));
        assert_eq!(direct.lines().count(), 3000);
        assert!(direct.lines().any(|line| !line.contains(" 0000000000000000 ")), "something wears");
        let differing = direct.lines().zip(through.lines()).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "of 3000 nodes: {:.200}\n{:.200}", direct, through);
    }
}

#[test]
fn a_law_with_a_memory_forgets_a_try_that_was_cut_back() {
    if !fortran("a shim of a law with a state") {
        return;
    }
    let room = folder();
    let here = room.path();
    let source = root().join("plugins/example-cpp/running_in.cpp").display().to_string();
    wearlaw(here, &["build", &source, "-o", "running_in.so"]);
    let law = wearlaw(here, &["inspect", "./running_in.so", "--json"]);
    assert!(law.contains("\"state\""), "{law}");
    wearlaw(here, &["shim", "uwearindex", "./running_in.so", "-o", "shim.f90"]);
    let program = linked(here, &[here.join("shim.f90"), data("drive_uwearindex.f90")], "through");
    let constants = ["1e-4", "1e-5", "1e-3", "1e9"];
    let words = |retries: &'static str| [&["40", "2000", retries, "0"], &constants[..]].concat();
    let (without, with) = (said(&program, &words("0")), said(&program, &words("1")));
    assert_eq!(without.lines().count(), 2000);
    assert_eq!(without, with, "tries that are not taken leave nothing behind");
    // The memory is there: the rate of the first increments is not that of the last.
    let early = said(&program, &[&["1", "2000", "0", "0"], &constants[..]].concat());
    let worn = |text: &str| text.lines().nth(1).and_then(|line| line.split_whitespace().nth(3)?.parse::<f64>().ok());
    assert!(worn(&without) < worn(&early).map(|first| 39.0 * first), "{without:.100} {early:.100}");
}

#[test]
fn a_mesh_moves_by_the_wear_of_the_increment_in_every_sweep() {
    if !fortran("a shim for mesh motion") {
        return;
    }
    let room = folder();
    let here = room.path();
    wearlaw(here, &["shim", "umeshmotion", "archard", "--constants", "K=1e-4,H=2e9"]);
    let program = linked(here, &[here.join("umeshmotion.f90"), data("drive_umeshmotion.f90")], "mesh");
    for retries in ["0", "1"] {
        let text = said(&program, &["50", "400", retries]);
        assert_eq!(text.lines().count(), 400);
        let mut some = 0;
        for line in text.lines() {
            let numbers: Vec<f64> = line.split_whitespace().map(|word| word.parse().expect("a number")).collect();
            let (moved, wanted) = (numbers[1], numbers[2]);
            // The velocity is added to one of 0.5, beside which it loses digits.
            assert!((moved - wanted).abs() <= 1e-15 + 1e-5 * wanted.abs(), "retries {retries}: {line}");
            some += usize::from(wanted < -1e-12);
        }
        assert!(some >= 300, "{some} nodes moved");
    }
}

#[test]
fn a_refusal_of_the_law_ends_the_analysis_with_its_text() {
    if !fortran("a shim whose law refuses") {
        return;
    }
    let room = folder();
    let here = room.path();
    wearlaw(here, &["shim", "uwearindex", "archard", "-o", "shim.f90"]);
    let program = linked(here, &[here.join("shim.f90"), data("drive_uwearindex.f90")], "through");
    let output = ran(&program, &["1", "3", "0", "0", "1e-4", "-2e9", "1", "1"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(7), "{text}");
    assert!(text.contains("wearlaw: ") && text.contains("`H`") && text.contains("quit 9999"), "{text}");
}

#[test]
fn a_law_that_asks_for_shorter_steps_gets_them() {
    if !fortran("a shim whose law cuts steps") {
        return;
    }
    let room = folder();
    let here = room.path();
    let law = "#define LAW_NAME \"cuts\"\n#define LAW_VERSION \"1.0.0\"\n#define LAW_SUMMARY \"no step beyond 1 ms\"\n\
        #define LAW_READS(F) F(slip)\n#define LAW_CONSTANTS(C) C(k, WL_NUMBER, WL_ANY, WL_REQUIRED, \"factor\")\n\
        #include \"wearlaw_point.h\"\nWL_POINT {\n    out->increment = c->k * in->slip;\n    out->dt_factor = 0.4;\n\
        \x20   return in->dt > 1e-3 ? WL_CUT_STEP : WL_OK;\n}\n";
    program::write(here, "cuts.c", law);
    wearlaw(here, &["build", "cuts.c", "-o", "cuts.so"]);
    wearlaw(here, &["shim", "uwearindex", "./cuts.so", "-o", "shim.f90"]);
    let program = linked(here, &[here.join("shim.f90"), data("drive_uwearindex.f90")], "through");
    let text = said(&program, &["10", "2", "1", "0", "1"]);
    let worn: f64 =
        text.lines().next().and_then(|line| line.split_whitespace().nth(3)?.parse().ok()).expect("a number");
    let time: f64 = (1..=10).map(|inc| 0.01 * f64::from(1 + inc % 7) / 3.0).sum();
    let expected = time * 0.05 * (1.0 + 0.2 * 0.01_f64.cos());
    assert!((worn / expected - 1.0).abs() < 1e-12, "{worn} for {expected}");
}

#[test]
fn bad_input_is_said() {
    let room = folder();
    let here = room.path();
    for (words, expected) in [
        (&["shim", "uwearindex", "nowhere.so"][..], "nowhere.so"),
        (&["shim", "umeshmotion", "archard"], "constant `K` of law `archard` has no value"),
        (&["shim", "umeshmotion", "archard", "--constants", "K"], "expected NAME=NUMBER"),
        (&["shim", "umeshmotion", "archard", "--constants", "K=nan,H=1"], "expected NAME=NUMBER"),
        (&["build", "--adapt", "uwearindex", "wear.f", "--params", "K,2"], "--params: found name `2`"),
    ] {
        let message = fails(here, words, 2, "input");
        assert!(message.contains(expected), "{words:?}: {message}");
    }
    program::write(here, "empty.f", "      end\n");
    let message = fails(here, &["build", "--adapt", "uwearindex", "empty.f"], 2, "input");
    assert!(message.contains("empty.f") && message.contains("found no `subroutine uwearindex(..)`"), "{message}");
    program::write(here, "law.c", "int x;\n");
    let message = fails(here, &["build", "--adapt", "uwearindex", "law.c"], 2, "input");
    assert!(message.contains("found C by its ending, expected Fortran"), "{message}");
    assert!(!here.join("uwearindex.f90").exists() && !here.join("umeshmotion.f90").exists());
}
