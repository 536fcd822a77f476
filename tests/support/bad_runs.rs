//! Runs the built program on bad input and holds its answer to the house rules for errors.

#![allow(dead_code)] // every test target takes its own part of this file

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

#[path = "started.rs"]
mod started;

pub use started::{Ended, ended};

/// A scene of the Archard law over [`HISTORY`].
pub const SCENE: &str = r#"title = "two points"
[law]
use = "archard"
constants = { K = 1.0e-4, H = 1.0e3, m = 1.0, n = 1.0 }
[contact]
model = "prescribed"
history = "history.csv"
"#;

/// Two points, numbered 7 and 8, from time 0 to 1.
pub const HISTORY: &str = "time,point,pressure,velocity\n0,7,1,0.2\n0,8,2,0.2\n1,7,3,0.2\n1,8,4,0.2\n";

/// A folder with a scene and its history; gone with this value.
pub struct Room(tempfile::TempDir);

impl Room {
    /// With [`SCENE`] as `scene.toml` and [`HISTORY`] as `history.csv`.
    pub fn new() -> Self {
        let room = Self(tempfile::tempdir().expect("a temporary folder"));
        room.write("scene.toml", SCENE);
        room.write("history.csv", HISTORY);
        room
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file in it.
    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.file(name), text).expect("the folder can be written");
    }

    /// The program in this folder; what the code of a law notes goes to the file `notes`.
    pub fn command(&self, words: &[&str]) -> Command {
        let mut command = started::program(words);
        command.current_dir(self.0.path()).env("WEARLAW_TEST_NOTES", self.file("notes"));
        command
    }

    /// Runs the program in this folder.
    pub fn run(&self, words: &[&str]) -> Ended {
        ended(self.command(words).output().expect("the program starts"), words)
    }

    /// Runs a command that has to be refused with exit code 2 and these words, in plain text and as JSON.
    pub fn refused(&self, words: &[&str], telling: &[&str]) -> String {
        self.fails(words, (2, "input"), telling)
    }

    /// Runs a command that has to end with this code before it writes anything; gives what it says.
    pub fn fails(&self, words: &[&str], (code, kind): (i32, &str), telling: &[&str]) -> String {
        let before = self.entries();
        let ended = self.run(words);
        assert_eq!(ended.code, code, "{words:?}: {}", ended.stderr);
        assert_eq!(ended.stdout, "", "{words:?}");
        one_sentence(&ended.stderr);
        for word in telling {
            assert!(ended.stderr.contains(word), "{words:?} does not say `{word}`: {}", ended.stderr);
        }
        let document = self.json(&[words, &["--json"]].concat(), code);
        assert_eq!(document["error"]["kind"], kind, "{words:?}");
        let message = document["error"]["message"].as_str().unwrap_or_default();
        // The name of a folder written aside is another one every time.
        let message = message.split(".partial-").next().unwrap_or_default();
        assert!(!message.is_empty() && ended.stderr.contains(message), "{words:?}: {message}\n{}", ended.stderr);
        assert_eq!(self.entries(), before, "{words:?} left something behind");
        ended.stderr
    }

    /// Runs a command that has to end with this code and one JSON document on standard output.
    pub fn json(&self, words: &[&str], code: i32) -> Value {
        let ended = self.run(words);
        assert_eq!(ended.code, code, "{words:?}: {} {}", ended.stdout, ended.stderr);
        let document: Value = serde_json::from_str(&ended.stdout)
            .unwrap_or_else(|error| panic!("{words:?}: {error} in {:?}", ended.stdout));
        assert_eq!(document["exit_code"], code, "{words:?}");
        assert!(!ended.stderr.contains("error: "), "{words:?}: said twice: {}", ended.stderr);
        document
    }

    /// Runs a command that has to go well with one JSON document on standard output.
    pub fn json_of(&self, words: &[&str]) -> Value {
        let ended = self.run(words);
        assert_eq!(ended.code, 0, "{words:?}: {}", ended.stderr);
        serde_json::from_str(&ended.stdout).expect("one document")
    }

    /// Every file and folder in it but the notes of laws, by its path from here.
    pub fn entries(&self) -> BTreeSet<PathBuf> {
        let mut found = BTreeSet::new();
        walk(self.0.path(), self.0.path(), &mut found);
        found.remove(Path::new("notes"));
        found
    }
}

fn walk(base: &Path, folder: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder that can be read") {
        let path = entry.expect("an entry").path();
        found.insert(path.strip_prefix(base).expect("it is below").to_owned());
        if path.is_dir() {
            walk(base, &path, found);
        }
    }
}

/// An error is one sentence in one line; what may follow is the underlined source.
fn one_sentence(stderr: &str) {
    let mut lines = stderr.lines();
    let first = lines.next().unwrap_or_default();
    assert!(first.starts_with("error: "), "{stderr}");
    let words = first.trim_start_matches("error: ");
    assert!((20..500).contains(&words.len()), "{} characters: {stderr}", words.len());
    assert!(!stderr.contains("panicked") && !stderr.contains("a fault of wearlaw"), "{stderr}");
    for line in lines {
        let mark = line.trim_start();
        let source = mark.starts_with("-->") || mark.starts_with('|') || mark.starts_with("...");
        let numbered = mark.split(' ').next().is_some_and(|word| word.parse::<u32>().is_ok());
        assert!(source || numbered || mark.is_empty(), "more than one sentence: {stderr}");
    }
}
