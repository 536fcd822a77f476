//! House rules that no compiler checks, over every source of the repository.

#[path = "support/sources.rs"]
mod sources;

use std::path::{Path, PathBuf};

/// Folders with sources, from the root.
const FOLDERS: [&str; 5] = ["host", "plugin-api", "plugins", "tests", "include"];
/// Endings of files that people write and read as code.
const CODE: [&str; 10] = ["rs", "c", "h", "cpp", "hpp", "f90", "inc", "py", "toml", "sh"];
/// Most lines of a file.
const MOST_LINES: usize = 450;
/// Files that a program writes.
const GENERATED: [&str; 2] = ["include/wearlaw.h", "include/wearlaw_host.h"];
/// Names that say nothing of what is in a file.
const VAGUE: [&str; 8] = ["utils", "util", "helpers", "helper", "common", "imp", "misc", "stuff"];

/// The sources with these endings.
fn files(endings: &[&str]) -> Vec<(PathBuf, String)> {
    let all = FOLDERS.iter().flat_map(|folder| sources::below(folder));
    let wanted = all.filter(|path| path.extension().is_some_and(|e| endings.iter().any(|ending| e == *ending)));
    wanted.filter_map(|path| sources::text(&path).map(|text| (path, text))).collect()
}

/// What one rule finds in all sources with these endings.
fn holds(rule: &str, endings: &[&str], check: impl Fn(&Path, &str) -> Vec<String>) {
    let files = files(endings);
    assert!(files.len() > 10, "the sources are where this test looks: {}", files.len());
    let wrong: Vec<String> = files.iter().flat_map(|(path, text)| check(path, text)).collect();
    assert!(wrong.is_empty(), "{rule}:\n{}", wrong.join("\n"));
}

/// Every line that `wrong` finds fault with, with its place.
fn lines(path: &Path, text: &str, wrong: impl Fn(&str) -> bool) -> Vec<String> {
    let numbered = text.lines().enumerate().filter(|(_, line)| wrong(line));
    numbered.map(|(index, line)| format!("{}:{}: {}", path.display(), index + 1, line.trim())).collect()
}

/// A line's code, without the comment behind it.
fn code(line: &str) -> &str {
    line.split("//").next().unwrap_or_default()
}

fn too_long(path: &Path, text: &str) -> Vec<String> {
    let (count, generated) = (text.lines().count(), GENERATED.iter().any(|name| path == Path::new(name)));
    if count <= MOST_LINES || generated { Vec::new() } else { vec![format!("{}: {count} lines", path.display())] }
}

fn vague_name(path: &Path, _: &str) -> Vec<String> {
    let stem = |part: &std::ffi::OsStr| Path::new(part).file_stem().unwrap_or(part).to_string_lossy().into_owned();
    let vague = path.iter().map(stem).any(|name| VAGUE.contains(&name.as_str()));
    if vague { vec![path.display().to_string()] } else { Vec::new() }
}

/// Unsafe blocks and implementations without a note on why they are sound, and files that open the door unsaid.
fn unexplained_unsafe(path: &Path, text: &str) -> Vec<String> {
    let all: Vec<&str> = text.lines().collect();
    let mut wrong = Vec::new();
    for (index, line) in all.iter().enumerate() {
        let bare = without_strings(code(line));
        let opens = ["unsafe {", "unsafe{", "unsafe impl"].iter().any(|word| bare.contains(word));
        let noted = |line: &&str| line.contains("SAFETY:");
        // A note may be longer than three lines; what counts is that it ends right above.
        let mut above = all[..index].iter().rev().take_while(|line| line.trim_start().starts_with("//"));
        if opens && !noted(line) && !all[index.saturating_sub(3)..index].iter().any(noted) && !above.any(noted) {
            wrong.push(format!("{}:{}: {}", path.display(), index + 1, line.trim()));
        }
    }
    wrong
}

/// The code of a line with the insides of its strings gone.
fn without_strings(code: &str) -> String {
    code.split('"').step_by(2).collect::<Vec<_>>().join("\"\"")
}

#[test]
fn files_are_short() {
    holds(&format!("files over {MOST_LINES} lines"), &CODE, too_long);
}

#[test]
fn file_names_say_what_is_inside() {
    holds("vague file names", &CODE, vague_name);
}

#[test]
fn every_unsafe_block_says_why_it_is_sound() {
    holds("unsafe without a SAFETY note", &["rs"], unexplained_unsafe);
    holds("allow(unsafe_code) without a reason", &["rs"], |path, text| {
        lines(path, text, |line| {
            line.contains("![allow(unsafe_code") && !line.contains("reason") && !line.contains("//")
        })
    });
}

#[test]
fn nothing_is_left_for_later() {
    // Put together here, so that this file does not find itself.
    let words = ["to_do!", "unimple_mented!", "TO_DO", "FIX_ME", "XX_X"].map(|word| word.replace('_', ""));
    holds("unfinished business", &CODE, |path, text| {
        lines(path, text, |line| words.iter().any(|word| line.contains(word.as_str())))
    });
    let skipped = ["#[ign", "ore"].concat();
    holds("tests that do not run", &["rs"], |path, text| lines(path, text, |line| line.contains(&skipped)));
}

#[test]
fn no_path_belongs_to_one_machine() {
    let homes =
        ["/ho me/", "/ro ot/", "/wo rk/", "/Us ers/", "C:\\Us ers", "/t mp/w/"].map(|path| path.replace(' ', ""));
    let mut endings = CODE.to_vec();
    endings.extend(["md", "yml", "yaml", "csv"]);
    holds("paths of one machine", &endings, |path, text| {
        lines(path, text, |line| homes.iter().any(|home| line.contains(home.as_str())))
    });
}

#[test]
fn every_module_says_what_is_in_it() {
    holds("files that do not say what is in them", &["rs"], |path, text| {
        // Attributes may stand above it; tests and laws that tests compile need none.
        let inner = !path.starts_with("tests") && path.iter().any(|part| part == "tests" || part == "tests.rs");
        let told = inner || path.starts_with("tests/data") || text.lines().take(5).any(|line| line.starts_with("//!"));
        if told { Vec::new() } else { vec![path.display().to_string()] }
    });
}

#[test]
fn the_engine_prints_nothing() {
    holds("prints outside of the program's own console", &["rs"], |path, text| {
        let engine = path.starts_with("host/src") && !path.starts_with("host/src/cli") || path.starts_with("plugins");
        let tests = path.iter().any(|part| part.to_string_lossy().starts_with("tests") || part == "benches");
        if !engine || tests {
            return Vec::new();
        }
        // Templates hold programs of their own, in strings.
        let own = text.split("#[cfg(test)]").next().unwrap_or_default();
        let words = ["println!(", "print!(", "eprintln!(", "eprint!(", "dbg!("];
        lines(path, own, |line| words.iter().any(|word| without_strings(code(line)).contains(word)))
    });
}

#[test]
fn the_rules_find_what_breaks_them() {
    let path = Path::new("host/src/law/utils.rs");
    assert_eq!(too_long(path, &"x\n".repeat(MOST_LINES + 1)).len(), 1);
    assert!(too_long(path, &"x\n".repeat(MOST_LINES)).is_empty());
    assert_eq!(vague_name(path, "").len(), 1);
    assert_eq!(vague_name(Path::new("host/src/common/x.rs"), "").len(), 1);
    assert!(vague_name(Path::new("host/src/law/commons.rs"), "").is_empty());
    let block = ["    uns", "afe { call() }"].concat();
    assert_eq!(unexplained_unsafe(path, &block).len(), 1);
    assert!(unexplained_unsafe(path, &format!("// SAFETY: the caller keeps it.\n{block}")).is_empty());
    assert_eq!(unexplained_unsafe(path, &format!("// SAFETY: of another.\n\n\n\n{block}")).len(), 1);
    assert!(unexplained_unsafe(path, &format!("let text = \"{block}\";")).is_empty());
}
