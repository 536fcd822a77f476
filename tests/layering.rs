//! Modules of the program use each other in one direction, so that each can be read without those above it.

#[path = "support/sources.rs"]
mod sources;

use std::path::Path;

/// Each module of the program's own crate and the others that it may name; the crates below it are modules to it.
const MAY_USE: [(&str, &[&str]); 16] = [
    ("apdl", &["scene"]),
    ("reference", &[]),
    ("record", &[]),
    ("bench", &["law", "conformance"]),
    ("integrator", &["law", "contact"]),
    ("stability", &["law", "contact"]),
    ("plan", &["scene", "apdl", "law", "contact", "integrator", "reference"]),
    ("solve", &["plan", "record", "scene", "apdl", "law", "contact", "integrator", "stability", "reference"]),
    ("output", &["record"]),
    ("sweep", &["scene", "record", "output"]),
    ("study", &["scene", "law", "integrator", "plan", "solve", "record", "reference"]),
    // Its tests read the scene that it writes.
    ("templates", &["scene", "law"]),
    ("shim", &["law"]),
    ("fit", &["scene", "law", "plan", "solve", "record"]),
    ("error", ALL_BUT_CLI),
    ("exit_code", ALL_BUT_CLI),
];

/// The module that may name all others.
const TOP: &str = "cli";

/// The crates below the program's own, as it names them.
const CRATES: [&str; 4] = ["conformance", "contact", "law", "scene"];

/// Each crate of `host` but the program's own, and the crates of this repository that it may need.
const MAY_NEED: [(&str, &[&str]); 5] = [
    ("transforms", &[]),
    ("contact", &["transforms"]),
    ("law", &["plugin-api", "archard"]),
    ("scene", &[]),
    // The contact models have the random numbers that it draws.
    ("conformance", &["plugin-api", "law", "contact"]),
];

const ALL_BUT_CLI: &[&str] = &[
    "apdl",
    "bench",
    "conformance",
    "contact",
    "error",
    "exit_code",
    "fit",
    "integrator",
    "law",
    "output",
    "plan",
    "record",
    "reference",
    "scene",
    "shim",
    "solve",
    "stability",
    "study",
    "sweep",
    "templates",
];

/// Every module that the program's own crate names.
fn modules() -> impl Iterator<Item = &'static str> {
    MAY_USE.iter().map(|(module, _)| *module).chain([TOP]).chain(CRATES)
}

/// The crate's own modules in a line of code that starts at its root, and in braces behind it.
fn named(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, word) in code.match_indices("crate::") {
        // `$crate::` and `other_crate::` are other roots.
        if code[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_' || before == '$') {
            continue;
        }
        let behind = &code[at + word.len()..];
        match behind.strip_prefix('{') {
            Some(group) => found.extend(heads(group)),
            None => found.extend(first_word(behind)),
        }
    }
    found
}

/// The first word of each path in a group, up to its closing brace.
fn heads(group: &str) -> Vec<String> {
    let (mut depth, mut part, mut parts) = (0, String::new(), Vec::new());
    for character in group.chars() {
        match character {
            '}' if depth == 0 => break,
            ',' if depth == 0 => parts.push(std::mem::take(&mut part)),
            _ => {
                depth += i32::from(character == '{') - i32::from(character == '}');
                part.push(character);
            }
        }
    }
    parts.push(part);
    parts.iter().filter_map(|part| first_word(part.trim())).collect()
}

fn first_word(text: &str) -> Option<String> {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    (end > 0).then(|| text[..end].to_owned())
}

/// A file's code on one line, its comments gone; and how often `super` climbs at most in one path.
fn code_of(text: &str) -> String {
    let mut code = String::new();
    for line in text.lines() {
        // A `//` in a string cuts its line short, which hides no import.
        code.push_str(line.split("//").next().unwrap_or_default());
        code.push(' ');
    }
    code
}

/// The modules that a file names by climbing out of its own with `super`, given how deep its module lies.
fn climbed(code: &str, depth: usize) -> Vec<String> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(at) = rest.find("super::") {
        let mut behind = &rest[at..];
        let mut climbs = 0;
        while let Some(next) = behind.strip_prefix("super::") {
            (climbs, behind) = (climbs + 1, next);
        }
        if climbs == depth {
            match behind.strip_prefix('{') {
                Some(group) => found.extend(heads(group)),
                None => found.extend(first_word(behind)),
            }
        }
        rest = behind;
    }
    found
}

/// What a file of `host/src` uses that it may not; its path is relative to that folder.
fn violations(path: &Path, text: &str) -> Vec<String> {
    let mut parts: Vec<String> = path.iter().map(|part| part.to_string_lossy().replace(".rs", "")).collect();
    parts.retain(|part| part != "mod");
    let own = parts[0].clone();
    if own == "lib" || own == "main" || own == TOP {
        return Vec::new();
    }
    let Some((_, allowed)) = MAY_USE.iter().find(|(module, _)| *module == own) else {
        return vec![format!("{}: module `{own}` has no place in the order of tests/layering.rs", path.display())];
    };
    let code = code_of(text);
    let known = |word: &String| modules().any(|module| module == word);
    // The types that the crate's root re-exports stand for their modules.
    let module = |word: String| match word.as_str() {
        "Error" => "error".to_owned(),
        "ExitCode" => "exit_code".to_owned(),
        _ => word,
    };
    let mut used = named(&code);
    used.extend(climbed(&code, parts.len()));
    let used = used.into_iter().map(module).filter(known).filter(|word| *word != own);
    used.filter(|word| !allowed.contains(&word.as_str()))
        .map(|word| format!("{}: `{own}` uses `{word}`", path.display()))
        .collect()
}

#[test]
fn modules_use_only_those_below_them() {
    let files = sources::below("host/src");
    assert!(files.len() > 100, "the sources are where this test looks: {}", files.len());
    let mut wrong = Vec::new();
    for file in files.iter().filter(|file| file.extension().is_some_and(|ending| ending == "rs")) {
        let inside = file.strip_prefix("host/src").expect("it is below host/src");
        wrong.extend(violations(inside, &sources::text(file).expect("sources are UTF-8")));
    }
    assert!(wrong.is_empty(), "imports against the order:\n{}", wrong.join("\n"));
}

#[test]
fn every_module_has_a_place_in_the_order() {
    let lib = sources::text(Path::new("host/src/lib.rs")).expect("sources are UTF-8");
    let mut declared: Vec<&str> = lib
        .lines()
        .filter_map(|line| {
            let line = line.strip_prefix("pub ").unwrap_or(line);
            let name = line
                .strip_prefix("mod ")
                .or_else(|| line.strip_prefix("use wearlaw_")?.split_once(" as ").map(|(_, name)| name))?;
            name.strip_suffix(';')
        })
        .collect();
    let mut known: Vec<&str> = modules().collect();
    declared.sort_unstable();
    known.sort_unstable();
    assert_eq!(declared, known);
}

#[test]
fn an_import_against_the_order_is_seen_however_it_is_written() {
    let wrong = |path: &str, text: &str| violations(Path::new(path), text);
    for text in [
        "use crate::cli::Console;",
        "use crate::{\n    scene::Scene,\n    cli::{a, b},\n};",
        "fn f() -> crate::cli::Console {}",
        "pub(super) use super::super::cli::Console;",
    ] {
        assert_eq!(wrong("plan/needs.rs", text), ["plan/needs.rs: `plan` uses `cli`"], "{text}");
    }
    assert_eq!(wrong("output/html/page.rs", "use super::super::super::solve::run;").len(), 1);
    assert_eq!(wrong("record/mod.rs", "use super::{plan, record};").len(), 1);
    assert_eq!(wrong("plan/needs.rs", "use crate::Error;").len(), 1);
    assert_eq!(wrong("new_one/mod.rs", "").len(), 1);
    for text in ["use crate::scene::Scene;", "// use crate::cli::Console;", "use other_crate::cli;", "use super::cli;"]
    {
        assert!(wrong("plan/needs.rs", text).is_empty(), "{text}");
    }
}

/// The crates of this repository that a manifest needs to be compiled.
fn needed(manifest: &str) -> Vec<&str> {
    let sections = manifest.split("\n[").filter_map(|section| section.strip_prefix("dependencies]\n"));
    let lines = sections.flat_map(str::lines);
    lines.filter_map(|line| line.strip_prefix("wearlaw-")?.split(['.', ' ']).next()).collect()
}

#[test]
fn crates_need_only_those_below_them() {
    let mut found: Vec<String> = std::fs::read_dir(sources::root().join("host"))
        .expect("the sources are where this test looks")
        .map(|entry| entry.expect("it can be listed").path())
        .filter(|path| path.join("Cargo.toml").is_file())
        .map(|path| path.file_name().expect("it has a name").to_string_lossy().into_owned())
        // The library for C is above the program's own crate.
        .filter(|name| name != "c")
        .collect();
    found.sort_unstable();
    let mut known: Vec<&str> = MAY_NEED.iter().map(|(name, _)| *name).collect();
    known.sort_unstable();
    assert_eq!(found, known);
    for (name, allowed) in MAY_NEED {
        let manifest = sources::text(&Path::new("host").join(name).join("Cargo.toml")).expect("manifests are UTF-8");
        assert_eq!(needed(&manifest), allowed, "{name}");
    }
}
