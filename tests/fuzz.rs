//! Fuzzing: any bytes as scenes, decks, histories and library files, and laws called in any legal order.
//!
//!     cargo test --test fuzz                                                    # a short seeded part
//!     WEARLAW_FUZZ_SECONDS=600 WEARLAW_FUZZ_SEED=42 cargo test --release --test fuzz
//!
//! An input that brings a target down is named with its seed and kept in the target folder. Where cargo-fuzz is
//! installed, `cargo fuzz run scene --fuzz-dir tests/fuzz/coverage -s none` looks for new paths with the same targets.

#[path = "fuzz/mutator.rs"]
mod mutator;
#[cfg(target_os = "linux")]
#[path = "fuzz/stateful.rs"]
mod stateful;
#[path = "fuzz/targets.rs"]
mod targets;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mutator::{Random, mutated};
use targets::{TARGETS, seeds};

/// Inputs of one target in the short part.
const SHORT: usize = 1500;

/// Seed of the random inputs.
fn seed() -> u64 {
    std::env::var("WEARLAW_FUZZ_SEED").ok().map_or(1, |text| text.parse().expect("WEARLAW_FUZZ_SEED is a number"))
}

/// How long to go on, if not for the short part only.
fn time() -> Option<Duration> {
    let text = std::env::var("WEARLAW_FUZZ_SECONDS").ok()?;
    Some(Duration::from_secs(text.parse().expect("WEARLAW_FUZZ_SECONDS is a number")))
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the repository is there")
}

/// Seeds that stand in no file: small archives and a library that exists wherever these tests run.
fn made(target: &str) -> Vec<Vec<u8>> {
    match target {
        "history_npz" => [zip::CompressionMethod::Stored, zip::CompressionMethod::Deflated].map(archive).to_vec(),
        "library" => {
            let own = std::env::current_exe().expect("a test knows its own path");
            let bytes = std::fs::read(own).expect("it can be read");
            // Its headers at the beginning, and the tables behind them as far as they fit.
            vec![bytes[..bytes.len().min(1 << 14)].to_vec(), small_library(), b"\x7fELF\x02\x01\x01".to_vec()]
        }
        _ => Vec::new(),
    }
}

/// A grid of two times and three points.
fn archive(method: zip::CompressionMethod) -> Vec<u8> {
    use std::io::Write;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default().compression_method(method).with_alignment(64);
    for (name, shape, values) in [
        ("time", "(2,)", vec![0.0, 1.0]),
        ("pressure", "(2, 3)", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        ("velocity", "(2,)", vec![0.1, 0.2_f64]),
    ] {
        let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        header.push_str(&" ".repeat(63 - (10 + header.len()) % 64));
        header.push('\n');
        let mut array = b"\x93NUMPY\x01\x00".to_vec();
        array.extend((header.len() as u16).to_le_bytes());
        array.extend(header.bytes());
        array.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        zip.start_file(format!("{name}.npy"), options).expect("memory takes it");
        zip.write_all(&array).expect("memory takes it");
    }
    zip.finish().expect("memory takes it").into_inner()
}

/// A library with an entry, compiled here; nothing if there is no compiler.
fn small_library() -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("law.c");
    std::fs::write(&source, "int wearlaw_entry_1(void) { return -1; }\n").expect("a temporary folder");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let out = folder.path().join("law.so");
    let _ = std::process::Command::new(compiler).args(["-shared", "-fPIC", "-o"]).arg(&out).arg(source).status();
    std::fs::read(out).unwrap_or_default()
}

/// Keeps an input before it is tried: what ends the process leaves it behind.
fn keep(target: &str, bytes: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    std::fs::create_dir_all(&folder).expect("the target folder can be written");
    let path = folder.join(format!("{target}.input"));
    std::fs::write(&path, bytes).expect("the target folder can be written");
    path
}

/// Tries one input; says which it was if the target goes down.
fn attempt((name, run): targets::Target, bytes: &[u8], which: &str) {
    if catch_unwind(AssertUnwindSafe(|| run(bytes))).is_err() {
        let path = keep(name, bytes);
        panic!("target {name} went down with {which}: {} ({})", path.display(), bytes.escape_ascii());
    }
}

/// Tries the seeds as they are, then inputs made from them; answers how many.
fn fuzz(target: targets::Target) -> usize {
    let (name, _) = target;
    let mut known = seeds(name, &root());
    known.extend(made(name));
    known.retain(|bytes| !bytes.is_empty());
    assert!(!known.is_empty(), "{name} has no seeds");
    for (at, bytes) in known.iter().enumerate() {
        attempt(target, bytes, &format!("seed input {at}"));
    }
    let mut random = Random::new(seed());
    let end = time().map(|time| Instant::now() + time);
    let mut count = 0;
    while end.map_or(count < SHORT, |end| Instant::now() < end) {
        let bytes = mutated(&known, &mut random);
        if end.is_some() && count % 64 == 0 {
            keep(name, &bytes);
        }
        attempt(target, &bytes, &format!("input {count} of seed {}", seed()));
        count += 1;
    }
    println!("{name}: {count} inputs");
    count
}

#[test]
fn scenes_are_read_or_refused() {
    assert!(fuzz(TARGETS[0]) > 0);
}

#[test]
fn overrides_are_taken_or_refused() {
    assert!(fuzz(TARGETS[1]) > 0);
}

#[test]
fn decks_are_read_or_refused() {
    assert!(fuzz(TARGETS[2]) > 0);
}

#[test]
fn histories_in_csv_are_read_or_refused() {
    assert!(fuzz(TARGETS[3]) > 0);
}

#[test]
fn histories_in_npz_are_read_or_refused() {
    assert!(fuzz(TARGETS[4]) > 0);
}

#[test]
fn library_files_are_described_or_refused() {
    assert!(fuzz(TARGETS[5]) > 0);
}

#[cfg(target_os = "linux")]
#[test]
fn laws_answer_the_same_in_any_legal_order_of_calls() {
    let rounds = stateful::fuzz(seed(), time());
    println!("stateful: {rounds} rounds");
    assert!(rounds > 0);
}
