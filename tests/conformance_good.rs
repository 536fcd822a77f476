//! `wearlaw check` finds nothing in laws that keep the contract, and its page says what it tests.
#![cfg(target_os = "linux")]

#[path = "support/program.rs"]
mod program;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use program::{Ended, folder, json, run, write};
use serde_json::Value;
use wearlaw::conformance::{Check, report};
use wearlaw::law::build::{BuildRequest, build};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the repository is there")
}

/// Whether there is a Fortran compiler; says so if there is none.
fn fortran(test: &str) -> bool {
    let compiler = std::env::var("FC").unwrap_or_else(|_| "gfortran".to_owned());
    let found = Command::new(&compiler).arg("--version").output().is_ok();
    if !found {
        assert!(std::env::var("WEARLAW_NEED_FORTRAN").as_deref() != Ok("1"), "{compiler} is needed, not found");
        let _ = writeln!(std::io::stderr(), "NOT RUN: {test} fortran: {compiler} not found");
    }
    found
}

/// Holds a report to have nothing but passes, warnings that are allowed, and checks that do not apply.
fn nothing_found(name: &str, ended: &Ended, warnings: &[&str]) -> Value {
    let document = json(&ended.stdout);
    let checks = document["checks"].as_array().unwrap_or_else(|| panic!("{name}: {document}"));
    for check in checks {
        let (outcome, of) = (check["outcome"].as_str().unwrap_or(""), check["check"].as_str().unwrap_or(""));
        let fine = matches!(outcome, "pass" | "skipped") || outcome == "warn" && warnings.contains(&of);
        assert!(fine, "{name}: {check:#}");
    }
    assert_eq!((ended.code, &document["passes"]), (0, &true.into()), "{name}: {}", ended.stderr);
    document
}

/// Names of the checks that were not run.
fn skipped(document: &Value) -> Vec<&str> {
    let checks = document["checks"].as_array().into_iter().flatten();
    checks.filter(|check| check["outcome"] == "skipped").filter_map(|check| check["check"].as_str()).collect()
}

/// Timing on a busy machine says nothing.
const TIMED: &[&str] = &["cost/subnormals"];

#[test]
fn the_shipped_laws_pass_every_check_that_applies() {
    let here = folder();
    let crate_of = |name: &str| (root().join("plugins").join(name), name.to_owned());
    let mut laws = vec![crate_of("archard"), crate_of("example-c"), crate_of("example-cpp"), crate_of("example-rust")];
    if fortran("the_shipped_laws_pass_every_check_that_applies") {
        laws.push(crate_of("example-fortran"));
    }
    for (folder, name) in laws {
        let sources: Vec<PathBuf> = match folder.join("Cargo.toml").exists() {
            true => vec![folder.clone()],
            false => std::fs::read_dir(&folder)
                .expect("a folder of a law")
                .map(|entry| entry.expect("an entry").path())
                .filter(|path| path.extension().is_some_and(|e| ["c", "cpp", "f90"].iter().any(|end| e == *end)))
                .collect(),
        };
        let extra = if folder.join("Cargo.toml").exists() { vec!["--offline".into()] } else { Vec::new() };
        let library = here.path().join(format!("{name}.so"));
        let request = BuildRequest { sources, output: Some(library), extra_flags: extra, ..BuildRequest::default() };
        let built = build(&request).unwrap_or_else(|error| panic!("{name}: {error}"));
        let expected = folder.join("expected.csv").display().to_string();
        let words = ["check", &built.library.display().to_string(), "--expected", &expected, "--json"];
        let document = nothing_found(&name, &run(here.path(), &words), TIMED);
        assert!(!skipped(&document).contains(&"values/expected"), "{name}");
        let left_out = skipped(&document).len();
        assert!(left_out <= 19, "{name} skips {left_out} checks");
    }
    assert!(!here.path().join("archard.check").exists(), "a law without a fault leaves no file");
}

#[test]
fn the_laws_of_the_readme_and_of_the_templates_pass() {
    let here = folder();
    let text = std::fs::read_to_string(root().join("include/README.md")).expect("the page is there");
    let block = |language: &str| {
        let rest = text.split(&format!("```{language}\n")).nth(1).expect("there is a law");
        rest.split("```").next().expect("a block ends").to_owned()
    };
    let mut sources = vec![("law.c", block("c")), ("law.cpp", block("cpp"))];
    let languages = if fortran("the_laws_of_the_readme_and_of_the_templates_pass") {
        sources.push(("law.f90", block("fortran")));
        vec!["c", "cpp", "fortran"]
    } else {
        vec!["c", "cpp"]
    };
    for (name, source) in sources {
        write(here.path(), name, &source);
        nothing_found(name, &run(here.path(), &["check", name, "--quick", "--json"]), TIMED);
    }
    for language in languages {
        let name = format!("my-{language}");
        assert_eq!(run(here.path(), &["new", &name, "--lang", language]).code, 0);
        let made = std::fs::read_dir(here.path().join(&name)).expect("the folder was made");
        let files = made.map(|entry| entry.expect("an entry").path());
        let is_law = |path: &PathBuf| path.extension().is_some_and(|e| ["c", "cpp", "f90"].iter().any(|end| e == *end));
        let law = files.into_iter().find(is_law).expect("there is a law").display().to_string();
        let document = nothing_found(&name, &run(here.path(), &["check", &law, "--quick", "--json"]), TIMED);
        assert!(!skipped(&document).contains(&"values/expected"), "{name}: its expected.csv lies beside it");
    }
}

#[test]
fn the_law_of_this_program_passes_what_needs_no_library() {
    let here = folder();
    let start = Instant::now();
    let document =
        nothing_found("archard", &run(here.path(), &["check", "embedded:archard", "--quick", "--json"]), TIMED);
    assert!(skipped(&document).contains(&"load/threads"));
    assert!(start.elapsed().as_secs() < 60, "no check waits for its deadline");
}

/// The part of the page that is made from the checks.
fn generated(text: &str) -> (&str, &str, &str) {
    let begin = text.find("--test conformance_good` -->\n").expect("the mark is there");
    let begin = begin + text[begin..].find('\n').expect("a line ends") + 1;
    let end = text.find("<!-- end -->").expect("the mark is there");
    (&text[..begin], &text[begin..end], &text[end..])
}

#[test]
fn the_page_lists_every_check_and_has_every_section_that_they_name() {
    let path = root().join("include/README.md");
    let text = std::fs::read_to_string(&path).expect("the page is there");
    let (before, table, behind) = generated(&text);
    let wanted = format!("\n{}\n", report::page());
    if std::env::var_os("WEARLAW_REGENERATE").is_some() {
        std::fs::write(&path, format!("{before}{wanted}{behind}")).expect("the page can be written");
        return;
    }
    assert!(
        table == wanted,
        "the table of checks is out of step; run WEARLAW_REGENERATE=1 cargo test --test conformance_good"
    );
    for check in Check::ALL {
        let heading = format!("# {}\n", check.facts().section);
        assert!(
            text.contains(&format!("\n#{heading}")) || text.contains(&format!("\n##{heading}")),
            "{}: no section {heading}",
            check.name()
        );
    }
}
