//! What is fuzzed: each target takes any bytes, and panics if the program does with them what it must not.
//!
//! Used by the driver in `tests/fuzz.rs` and by the targets of cargo-fuzz beside this file. A target may refuse its
//! input, in words; it must not panic, hang, or take memory without bounds, and what it accepts has to be sound. Where a
//! format has a checksum, the target makes it right, since no search gets past one.

#![allow(dead_code)] // reason: each user takes its own part of this file

use std::fs;
use std::io::{BufWriter, Cursor, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wearlaw::apdl::{Deck, to_toml};
use wearlaw::contact::prescribed::{Column, Header, History, Needs};
use wearlaw::law::file_facts::FileFacts;
use wearlaw::output::{Stored, read_checkpoint, write_checkpoint};
use wearlaw::scene::{Override, Scene};
use zip::write::SimpleFileOptions;

/// A target: its name and what it does with some bytes. It answers whether it accepted them.
pub type Target = (&'static str, fn(&[u8]) -> bool);

/// Every target of bytes; laws in any order of calls are driven by numbers instead.
pub const TARGETS: [Target; 5] =
    [("scene", scene), ("deck", deck), ("history", history), ("library", library), ("checkpoint", checkpoint)];

/// How the first line begins that is set in the scene of the other lines.
pub const SET: &str = "--set ";

/// A scene is refused with words that can be shown, or can be written and read again as the same.
pub fn scene(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let (overrides, text) = match text.strip_prefix(SET).map(|rest| rest.split_once('\n').unwrap_or((rest, ""))) {
        Some((first, rest)) => (vec![Override(first.to_owned())], rest),
        None => (Vec::new(), &*text),
    };
    match Scene::parse(text, "scene.toml", &overrides) {
        Ok(scene) => {
            let again = Scene::parse(&scene.toml(), "scene.toml", &[]);
            assert_eq!(again.as_ref(), Ok(&scene), "{}", scene.toml());
            true
        }
        Err(error) => {
            for color in [false, true] {
                assert!(error.render(color).contains("error"), "{error}");
            }
            assert!(!error.to_string().trim().is_empty());
            false
        }
    }
}

/// A deck is refused with words, or each of its materials becomes a document, or says why not.
pub fn deck(bytes: &[u8]) -> bool {
    match Deck::parse(&String::from_utf8_lossy(bytes), "deck.inp") {
        Ok(deck) => {
            for material in &deck.materials {
                if let Ok(text) = to_toml(material) {
                    let read: Result<toml::Table, _> = toml::from_str(&text);
                    assert!(read.is_ok(), "{read:?}\n{text}");
                }
            }
            !deck.materials.is_empty()
        }
        Err(error) => {
            assert!(!error.to_string().trim().is_empty());
            false
        }
    }
}

/// How an array of NumPy begins.
pub const ARRAY: &[u8] = b"\x93NUMPY";

/// Names of the arrays in an archive that is made here, in the order in which they stand.
const ARRAYS: [&str; 8] = ["time", "pressure", "velocity", "slip", "area", "nx", "ny", "nz"];

/// A history: an archive, arrays that an archive is made of here, or text.
pub fn history(bytes: &[u8]) -> bool {
    let even = bytes.len().is_multiple_of(2);
    if bytes.starts_with(b"PK") {
        one_history(bytes, "history.npz", even)
    } else if bytes.starts_with(ARRAY) {
        let method = if even { zip::CompressionMethod::Stored } else { zip::CompressionMethod::Deflated };
        one_history(&archive(bytes, method), "history.npz", starts(bytes).len() == ARRAYS.len())
    } else {
        one_history(bytes, "history.csv", even)
    }
}

/// Where arrays begin, as far as there are names for them.
fn starts(arrays: &[u8]) -> Vec<usize> {
    (0..arrays.len()).filter(|at| arrays[*at..].starts_with(ARRAY)).take(ARRAYS.len()).collect()
}

/// An archive of arrays that stand one behind the other.
pub fn archive(arrays: &[u8], method: zip::CompressionMethod) -> Vec<u8> {
    let mut starts = starts(arrays);
    starts.push(arrays.len());
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(method).with_alignment(64);
    for (name, ends) in ARRAYS.iter().zip(starts.windows(2)) {
        zip.start_file(format!("{name}.npy"), options).expect("memory takes it");
        zip.write_all(&arrays[ends[0]..ends[1]]).expect("memory takes it");
    }
    zip.finish().expect("memory takes it").into_inner()
}

/// Times are finite and do not go back, every needed column has a finite value for every time and point.
fn one_history(bytes: &[u8], name: &str, by_slip: bool) -> bool {
    let file = TemporaryFile::new(name, bytes);
    let _ = Header::read(&file.path);
    let _ = History::read(&file.path, &Needs::none());
    let mut needs = Needs::of(&[Column::Pressure, Column::Velocity]);
    if by_slip {
        needs = Needs::of(&[Column::Pressure, Column::Slip, Column::Area]);
        Column::NORMAL.iter().for_each(|column| needs.add(*column));
    }
    match History::read(&file.path, &needs) {
        Ok(history) => {
            let times = history.times();
            assert!(times.iter().all(|time| time.is_finite()) && times.is_sorted(), "{times:?}");
            assert!(history.points() > 0);
            assert!(history.column(Column::Pressure).is_some(), "the pressure was needed");
            true
        }
        Err(error) => {
            assert!(!error.to_string().trim().is_empty());
            false
        }
    }
}

/// A library file is described or refused; nothing of it is run.
pub fn library(bytes: &[u8]) -> bool {
    let file = TemporaryFile::new("law.so", bytes);
    let mut accepted = false;
    for facts in [FileFacts::examine(&file.path), FileFacts::read(&file.path)] {
        match facts {
            Ok(facts) => {
                assert_eq!(facts.size, bytes.len() as u64);
                assert_eq!(facts.sha256.len(), 64);
                accepted = true;
            }
            Err(error) => assert!(!error.to_string().trim().is_empty()),
        }
    }
    accepted
}

/// Bytes of the hash at the end of a checkpoint, and where its header begins, whose length stands before it.
const HASH: usize = 32;
const HEADER: usize = 32;

/// A checkpoint is refused with words, or what is read is written and read again as the same. Any bytes have to be
/// refused or read as they stand, and so do they with the right hash and the right length of the header.
pub fn checkpoint(bytes: &[u8]) -> bool {
    let as_it_stands = one_checkpoint(bytes);
    let sealed = bytes.len() > HASH && one_checkpoint(&seal(bytes[..bytes.len() - HASH].to_vec()));
    let mut content = bytes[..bytes.len().saturating_sub(HASH)].to_vec();
    let length = content.get(HEADER..).map(|header| {
        let mut documents = serde_json::Deserializer::from_slice(header).into_iter::<serde_json::Value>();
        let _ = documents.next();
        documents.byte_offset() as u64
    });
    let measured = length.is_some_and(|length| {
        content[HEADER - 8..HEADER].copy_from_slice(&length.to_le_bytes());
        one_checkpoint(&seal(content))
    });
    as_it_stands || sealed || measured
}

/// Bytes with their hash.
fn seal(mut content: Vec<u8>) -> Vec<u8> {
    let hash = Sha256::digest(&content);
    content.extend_from_slice(&hash);
    content
}

fn one_checkpoint(bytes: &[u8]) -> bool {
    let file = TemporaryFile::new("checkpoint", bytes);
    match read_checkpoint(&file.path) {
        Ok(stored) => {
            let again = TemporaryFile::new("again", b"");
            let once = written(&stored, &again.path);
            let back = read_checkpoint(&again.path).expect("what was written here");
            assert_eq!(once, written(&back, &again.path), "{stored:?}");
            // It may be of any other run.
            if let Err(difference) = stored.identity.follows(&back.identity, stored.checkpoint.time) {
                panic!("a run of the same scene does not follow itself: {difference}");
            }
            true
        }
        Err(error) => {
            assert!(!error.to_string().trim().is_empty());
            false
        }
    }
}

/// The bytes of a checkpoint, as they stand in a file.
fn written(stored: &Stored, path: &Path) -> Vec<u8> {
    let mut to = BufWriter::new(fs::File::create(path).expect("a temporary folder"));
    write_checkpoint(&mut to, &stored.identity, &stored.fields, stored.ended, &stored.checkpoint).expect("it fits");
    to.flush().expect("it fits");
    fs::read(path).expect("it was written here")
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
        let _ = fs::remove_file(&path);
        fs::write(&path, bytes).expect("a temporary folder");
        Self { path }
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// Inputs to begin with, from the repository at `root`: the shipped scenes, decks, histories and what `corpus` holds.
pub fn seeds(target: &str, root: &Path) -> Vec<Vec<u8>> {
    let ending = match target {
        "scene" => "toml",
        "deck" => "inp",
        "history" => "csv",
        _ => "",
    };
    let mut found = Vec::new();
    let corpus = root.join("tests/fuzz/corpus");
    for (folder, all) in [(corpus.join(target), true), (root.join("host/scenes"), false)] {
        let mut paths: Vec<PathBuf> = match fs::read_dir(folder) {
            Ok(entries) => entries.filter_map(|entry| Some(entry.ok()?.path())).collect(),
            Err(_) => continue,
        };
        paths.sort();
        paths.retain(|path| path.is_file() && (all || path.extension().is_some_and(|e| e == ending)));
        for mut bytes in paths.iter().filter_map(|path| fs::read(path).ok()) {
            // A long history is no better a seed than its beginning.
            if !all && ending == "csv" {
                let end = bytes.iter().take(4000).rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
                bytes.truncate(end);
            }
            found.push(bytes);
        }
    }
    found
}
