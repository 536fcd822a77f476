//! The built program from outside, and what a run of it leaves behind.

#![allow(dead_code)] // every test target takes its own part of this file

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// How a call of the program ended.
pub struct Ended {
    /// Exit code.
    pub code: i32,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// Calls the program.
pub fn wearlaw<W: AsRef<OsStr>>(words: &[W]) -> Ended {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
    command.args(words).stdin(std::process::Stdio::null()).env_remove("RUST_BACKTRACE");
    let output = command.output().expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    let code = output.status.code().expect("no signal ended the program");
    Ended { code, stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// A finished run.
pub struct Ran {
    /// `report.json`.
    pub report: Value,
    /// The folder of the results.
    pub folder: PathBuf,
}

impl Ran {
    /// `history.csv` as it is.
    pub fn history(&self) -> String {
        read(&self.folder.join("history.csv"))
    }

    /// A number of the report by its path, `/result/max_wear_depth`.
    pub fn number(&self, path: &str) -> f64 {
        let found = self.report.pointer(path).unwrap_or_else(|| panic!("no {path} in {}", self.report));
        found.as_f64().unwrap_or_else(|| panic!("{path} is {found}"))
    }
}

/// Runs a scene that has to succeed, with its results in `folder`.
pub fn run(scene: &Path, folder: &Path, more: &[&str]) -> Ran {
    let mut words: Vec<&OsStr> = vec!["run".as_ref(), scene.as_ref(), "-q".as_ref(), "--out".as_ref(), folder.as_ref()];
    words.extend(more.iter().map(|word| OsStr::new(*word)));
    let ended = wearlaw(&words);
    assert_eq!(ended.code, 0, "{}: {}", scene.display(), ended.stderr);
    let report = serde_json::from_str(&read(&folder.join("report.json"))).expect("a JSON document");
    Ran { report, folder: folder.to_owned() }
}

/// The text of a file.
pub fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The scenes that come with the program.
pub fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}
