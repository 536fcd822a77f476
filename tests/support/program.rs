//! The program as a test sees it: commands, how they end, and a law in C to try them on.
#![allow(dead_code)] // reason: each test file uses a part of it.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

#[path = "started.rs"]
mod started;

pub use started::{Ended, ended};

/// The program in a folder.
pub fn wearlaw(folder: &Path, words: &[&str]) -> Command {
    let mut command = started::program(words);
    command.current_dir(folder);
    command
}

/// Runs a command to its end.
pub fn run(folder: &Path, words: &[&str]) -> Ended {
    ended(wearlaw(folder, words).output().expect("the program starts"), words)
}

/// Runs a command that has to fail: nothing on standard output, and the same error as one JSON document with `--json`.
pub fn fails(folder: &Path, words: &[&str], code: i32, kind: &str) -> String {
    let ended = run(folder, words);
    assert_eq!(ended.code, code, "{words:?}: {}", ended.stderr);
    assert_eq!(ended.stdout, "", "{words:?}");
    assert!(ended.stderr.contains("error: "), "{words:?}: {}", ended.stderr);
    assert!(!ended.stderr.contains('\u{1b}'), "colors only on a terminal: {words:?}");
    assert!(!ended.stderr.contains("panicked"), "{words:?}: {}", ended.stderr);
    let with_json = run(folder, &[words, &["--json"]].concat());
    assert_eq!(with_json.code, code, "{words:?}");
    let document = json(&with_json.stdout);
    assert_eq!(document["exit_code"], code, "{words:?}");
    assert_eq!(document["error"]["kind"], kind, "{words:?}");
    let message = document["error"]["message"].as_str().expect("a message").to_owned();
    assert!(!message.is_empty() && !with_json.stderr.contains("error: "), "{words:?}: {}", with_json.stderr);
    message
}

/// The one document of a text that holds nothing else.
pub fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text:?}"))
}

/// Writes a file into a folder.
pub fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("the folder can be written");
}

/// An empty folder that goes with the value.
pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// A law in C: half of Archard's, with one constant.
pub const LAW: &str = r#"
#define LAW_NAME "half"
#define LAW_VERSION "2.1"
#define LAW_SUMMARY "half a law"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")
#include "wearlaw_point.h"
WL_POINT {
    out->increment = 0.5 * c->k * in->pressure * in->slip;
    return WL_OK;
}
"#;

/// A law whose entry gives up.
pub const REFUSING: &str = "#include \"wearlaw.h\"\n\
    WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law) {\n\
    (void)index; (void)host; (void)law; return WL_FAILED; }\n";
