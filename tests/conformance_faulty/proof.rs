//! Each faulty law is bad, and the sound ones are not, by a host in plain C that knows nothing but `include/`.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use super::fixtures::{Faulty, c_host, faulty, library, side_by_side, sound};

/// What the plain host says of one fault: its exit code (1: found, 0: not found) and words.
fn probe(library: &Path, check: &str) -> (Option<i32>, String) {
    let output = Command::new(c_host()).arg(library).arg(check).output().expect("the host starts");
    let words = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8_lossy(&words).trim().to_owned())
}

/// Every check that has a faulty law.
fn checks() -> BTreeSet<String> {
    faulty().into_iter().map(|law| law.check).collect()
}

#[test]
fn every_faulty_law_is_bad() {
    let laws = faulty();
    assert!(laws.len() > 100, "{} laws", laws.len());
    c_host();
    let found = side_by_side(&laws, |law: &Faulty| probe(&library("faulty", &law.file), &law.check));
    let good = laws.iter().zip(&found).filter(|(_, (code, _))| *code != Some(1));
    let good: Vec<String> = good.map(|(law, (code, words))| format!("{}: {code:?} {words}", law.file)).collect();
    assert!(good.is_empty(), "laws that the plain host does not find bad:\n{}", good.join("\n"));
}

#[test]
fn the_sound_laws_have_none_of_the_faults() {
    let (laws, checks) = (sound(), checks());
    // A row of expected.csv is no question to a law without one.
    let asked = checks.iter().filter(|check| *check != "values/expected");
    let pairs: Vec<_> = asked.flat_map(|check| laws.iter().map(move |law| (law, check))).collect();
    c_host();
    let found = side_by_side(&pairs, |(law, check)| probe(law, check));
    let bad = pairs.iter().zip(&found).filter(|(_, (code, _))| *code != Some(0));
    let bad: Vec<String> = bad.map(|((law, check), found)| format!("{}: {check}: {found:?}", law.display())).collect();
    assert!(bad.is_empty(), "the plain host finds faults where there are none:\n{}", bad.join("\n"));
}

#[test]
fn every_law_of_the_folder_is_in_the_manifest_once() {
    let laws = faulty();
    let names: BTreeSet<String> = laws.iter().map(Faulty::name).collect();
    assert_eq!(names.len(), laws.len(), "two laws of one name");
    let folder = super::fixtures::root().join("plugins/faulty");
    for file in ["", "expected_off", "rust/examples"].map(|part| folder.join(part)) {
        for entry in std::fs::read_dir(file).expect("a folder of laws") {
            let path = entry.expect("an entry").path();
            let is_law = path.extension().is_some_and(|e| ["c", "cpp", "rs"].iter().any(|ending| e == *ending));
            let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
            let text = if is_law { std::fs::read_to_string(&path).expect("a source") } else { continue };
            let begins = text.chars().take(400).collect::<String>();
            assert_eq!(names.contains(&stem), begins.contains("Rule broken: "), "{}", path.display());
            assert!(stem.starts_with("sound") || names.contains(&stem), "{} is in no list", path.display());
        }
    }
}
