//! A C program that has only `include/` loads a law with dlopen and gets its increments.

#[path = "support/native.rs"]
mod native;

use std::path::Path;
use std::process::{Command, Output};

/// Builds the program of `data/embed.c` in a folder; only the headers of `include/` are on its path.
fn embed(folder: &Path) -> std::path::PathBuf {
    let program = folder.join("embed");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
    let built = Command::new(compiler)
        .args(["-std=c99", "-Wall", "-pedantic", "-Werror", "-I"])
        .arg(native::include())
        .arg(native::root().join("tests/data/embed.c"))
        .args(["-ldl", "-o"])
        .arg(&program)
        .output()
        .expect("the compiler starts");
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    program
}

fn run(program: &Path, law: &Path, constants: &[&str]) -> Output {
    Command::new(program).arg(law).args(constants).output().expect("the program starts")
}

fn increments(output: &Output) -> Vec<f64> {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.lines().map(|line| line.parse().expect("a number")).collect()
}

#[test]
fn a_c_program_evaluates_a_loaded_law() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = embed(folder.path());
    let law = folder.path().join("threshold.so");
    let source = native::root().join("plugins/example-c/threshold.c");
    native::try_compile(&source, &native::include(), &law, &[]).expect("it compiles");
    let found = increments(&run(&program, &law, &["K=1e-4", "H=2e9", "p0=1.5e6"]));
    let right = [1e6, 2e6, 5e7].map(|p: f64| 1e-4 / 2e9 * 1e-3 * (p - 1.5e6).max(0.0));
    assert_eq!(found, right);
}

/// The Archard law as cargo has built it, beside this test's own binary.
fn archard() -> std::path::PathBuf {
    let program = std::env::current_exe().expect("a test knows its own path");
    let folder = program.parent().expect("a program lies in a folder");
    let library =
        folder.join(format!("{}wearlaw_archard{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX));
    assert!(library.exists(), "cargo builds {} with this test", library.display());
    library
}

#[test]
fn a_c_program_evaluates_archard_and_agrees() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = embed(folder.path());
    let found = increments(&run(&program, &archard(), &["K=1e-4", "H=2e9"]));
    for (found, p) in found.iter().zip([1e6, 2e6, 5e7]) {
        let right = 1e-4 / 2e9 * p * 0.1 * 0.01;
        assert!((found - right).abs() <= 4.0 * f64::EPSILON * right, "{found:e} for {right:e}");
    }
    assert_eq!(found.len(), 3);
}

#[test]
fn a_c_program_is_told_what_a_law_refuses() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = embed(folder.path());
    let law = folder.path().join("threshold.so");
    let source = native::root().join("plugins/example-c/threshold.c");
    native::try_compile(&source, &native::include(), &law, &[]).expect("it compiles");
    let refused = run(&program, &law, &["H=2e9"]); // K has no default
    assert_eq!(refused.status.code(), Some(3));
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(said.contains("archard-threshold: status 3 no finite wear at pressure"), "{said}");
    let nothing = run(&program, &folder.path().join("none.so"), &[]);
    assert_eq!(nothing.status.code(), Some(2));
}

#[test]
fn the_program_stays_short() {
    let text = std::fs::read_to_string(native::root().join("tests/data/embed.c")).expect("it is there");
    let lines = text.lines().map(str::trim).filter(|l| !l.is_empty() && !l.starts_with("/*") && !l.starts_with('*'));
    assert!(lines.count() <= 65);
}
