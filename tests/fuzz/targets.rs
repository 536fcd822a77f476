//! What is fuzzed: each target takes any bytes, and panics if the program does with them what it must not.
//!
//! Used by the driver in `tests/fuzz.rs` and by the targets of cargo-fuzz beside this file. A target may refuse its
//! input, in words; it must not panic, hang, or take memory without bounds, and what it accepts has to be sound.

#![allow(dead_code)] // reason: each user takes its own part of this file

use std::path::{Path, PathBuf};

use wearlaw::apdl::{Deck, to_toml};
use wearlaw::contact::prescribed::{Column, Header, History, Needs};
use wearlaw::law::file_facts::FileFacts;
use wearlaw::scene::{Override, Scene};

/// A target: its name and what it does with some bytes.
pub type Target = (&'static str, fn(&[u8]));

/// Every target.
pub const TARGETS: [Target; 6] = [
    ("scene", scene),
    ("override", set),
    ("deck", deck),
    ("history_csv", history_csv),
    ("history_npz", history_npz),
    ("library", library),
];

/// A scene is refused with words that can be shown, or can be written and read again as the same.
pub fn scene(bytes: &[u8]) {
    one_scene(&String::from_utf8_lossy(bytes), &[]);
}

/// The first line is set in the scene of the other lines.
pub fn set(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let (first, rest) = text.split_once('\n').unwrap_or((&text, "[law]\nuse = \"archard\"\n"));
    one_scene(rest, &[Override(first.to_owned())]);
}

fn one_scene(text: &str, overrides: &[Override]) {
    match Scene::parse(text, "scene.toml", overrides) {
        Ok(scene) => {
            let again = Scene::parse(&scene.toml(), "scene.toml", &[]);
            assert_eq!(again.as_ref(), Ok(&scene), "{}", scene.toml());
        }
        Err(error) => {
            for color in [false, true] {
                assert!(error.render(color).contains("error"), "{error}");
            }
            assert!(!error.to_string().trim().is_empty());
        }
    }
}

/// A deck is refused with words, or each of its materials becomes a document, or says why not.
pub fn deck(bytes: &[u8]) {
    match Deck::parse(&String::from_utf8_lossy(bytes), "deck.inp") {
        Ok(deck) => {
            for material in &deck.materials {
                if let Ok(text) = to_toml(material) {
                    let read: Result<toml::Table, _> = toml::from_str(&text);
                    assert!(read.is_ok(), "{read:?}\n{text}");
                }
            }
        }
        Err(error) => assert!(!error.to_string().trim().is_empty()),
    }
}

/// A history in CSV.
pub fn history_csv(bytes: &[u8]) {
    history(bytes, "history.csv");
}

/// A history in NPZ.
pub fn history_npz(bytes: &[u8]) {
    history(bytes, "history.npz");
}

/// Times are finite and do not go back, every needed column has a finite value for every time and point.
fn history(bytes: &[u8], name: &str) {
    let file = TemporaryFile::new(name, bytes);
    let _ = Header::read(&file.path);
    let _ = History::read(&file.path, &Needs::none());
    let mut needs = Needs::of(&[Column::Pressure, Column::Velocity]);
    if bytes.len().is_multiple_of(2) {
        needs = Needs::of(&[Column::Pressure, Column::Slip, Column::Area]);
        Column::NORMAL.iter().for_each(|column| needs.add(*column));
    }
    match History::read(&file.path, &needs) {
        Ok(history) => {
            let times = history.times();
            assert!(times.iter().all(|time| time.is_finite()) && times.is_sorted(), "{times:?}");
            assert!(history.points() > 0);
            assert!(history.column(Column::Pressure).is_some(), "the pressure was needed");
        }
        Err(error) => assert!(!error.to_string().trim().is_empty()),
    }
}

/// A library file is described or refused; nothing of it is run.
pub fn library(bytes: &[u8]) {
    let file = TemporaryFile::new("law.so", bytes);
    for facts in [FileFacts::examine(&file.path), FileFacts::read(&file.path)] {
        match facts {
            Ok(facts) => {
                assert_eq!(facts.size, bytes.len() as u64);
                assert_eq!(facts.sha256.len(), 64);
            }
            Err(error) => assert!(!error.to_string().trim().is_empty()),
        }
    }
}

/// A file of a folder that lasts as long as the thread, since millions are written.
struct TemporaryFile {
    path: PathBuf,
}

thread_local! {
    static FOLDER: tempfile::TempDir = tempfile::tempdir().expect("a temporary folder");
}

impl TemporaryFile {
    fn new(name: &str, bytes: &[u8]) -> Self {
        let path = FOLDER.with(|folder| folder.path().join(name));
        // A file that was mapped before keeps its bytes: this is another one.
        let _ = std::fs::remove_file(&path);
        std::fs::write(&path, bytes).expect("a temporary folder");
        Self { path }
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Inputs to begin with, from the repository at `root`: the shipped scenes, decks, histories and what `corpus` holds.
pub fn seeds(target: &str, root: &Path) -> Vec<Vec<u8>> {
    let ending = match target {
        "scene" | "override" => "toml",
        "deck" => "inp",
        "history_csv" => "csv",
        _ => "",
    };
    let mut found = Vec::new();
    let corpus = root.join("tests/fuzz/corpus");
    for (folder, all) in [(corpus.join(target), true), (root.join("host/scenes"), false)] {
        let mut paths: Vec<PathBuf> = match std::fs::read_dir(folder) {
            Ok(entries) => entries.filter_map(|entry| Some(entry.ok()?.path())).collect(),
            Err(_) => continue,
        };
        paths.sort();
        paths.retain(|path| path.is_file() && (all || path.extension().is_some_and(|e| e == ending)));
        found.extend(paths.iter().filter_map(|path| std::fs::read(path).ok()));
    }
    // A long history is no better a seed than its beginning.
    found.iter_mut().for_each(|bytes| bytes.truncate(4000));
    if target == "override" {
        found.iter_mut().for_each(|bytes| bytes.splice(0..0, *b"law.constants=[1]\n").for_each(drop));
    }
    found
}
