//! The built program from outside, and what a run of it leaves behind.

#![allow(dead_code)] // every test target takes its own part of this file

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde_json::Value;

#[path = "started.rs"]
mod started;

pub use started::Ended;

/// Calls the program.
pub fn wearlaw<W: AsRef<OsStr> + std::fmt::Debug>(words: &[W]) -> Ended {
    started::ended(started::program(words).output().expect("the program starts"), words)
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
