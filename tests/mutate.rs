//! Mutants of the shipped laws: how many does `wearlaw check` with the law's expected.csv find?
//!
//! A mutant is the source of a law, or of the helper under it, with one small mistake: a sign, an exponent, an index, a
//! dropped term, swapped arguments, a state that is not written, a wrong stride. It is built as an author would build it.
//!
//!     cargo test --test mutate -- --nocapture             # a seeded part of each file, some minutes
//!     WEARLAW_MUTANTS=all cargo test --release --test mutate -- --nocapture
//!
//! At least 95 % have to be found. What is not found has to be in `tests/mutate/survivors.csv`, with the reason.
#![cfg(target_os = "linux")]

#[path = "mutate/make.rs"]
mod make;
#[path = "mutate/operators.rs"]
mod operators;
#[path = "mutate/subjects.rs"]
mod subjects;
#[path = "mutate/tokens.rs"]
mod tokens;

use std::collections::BTreeMap;
use std::path::Path;

use make::{Fate, Workshop};
use operators::{Mutant, mutants};
use subjects::{Subject, subjects};

/// Mutants of one file unless all are wanted.
const PART: usize = 12;
/// Part of the mutants that has to be found.
const BAR: f64 = 0.95;

/// A mutant that was not found although it can be built.
type Known = BTreeMap<(String, String), String>;

/// The survivors that are known, by file and change, with the reason.
fn known() -> Known {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/mutate/survivors.csv");
    let mut table = csv::Reader::from_path(path).expect("the list of survivors");
    let rows = table.records().map(|row| row.expect("file, change, reason"));
    rows.map(|row| ((row[0].to_owned(), row[1].to_owned()), row[2].to_owned())).collect()
}

/// A seeded part of a file's mutants, spread over it; or all.
fn chosen(subject: &Subject, all: Vec<Mutant>) -> Vec<Mutant> {
    let most = match std::env::var("WEARLAW_MUTANTS").as_deref() {
        Ok("all") => usize::MAX,
        Ok(number) => number.parse().expect("WEARLAW_MUTANTS is `all` or a number"),
        Err(_) => PART,
    };
    let only = std::env::var("WEARLAW_MUTATE").unwrap_or_default();
    if !subject.name().contains(&only) {
        return Vec::new();
    }
    if all.len() <= most {
        return all;
    }
    // One of every stretch, by the last bits of where it stands.
    let count = all.len();
    let mut picked: Vec<usize> = (0..most).map(|k| (k * count + (k * 7919) % count) / most).collect();
    picked.dedup();
    picked.into_iter().map(|at| all[at].clone()).collect()
}

#[test]
fn mutants_of_the_shipped_laws_are_found() {
    let known = known();
    let (mut found, mut made, mut unknown) = (0, 0, Vec::new());
    println!("{:46} {:>7} {:>6} {:>6} {:>9}", "file", "mutants", "built", "found", "excused");
    for subject in subjects() {
        let workshop = Workshop::new(&subject);
        workshop.assert_sound();
        let mutants = chosen(&subject, mutants(&subject));
        let fates = workshop.try_all(&mutants);
        let (mut built, mut here, mut excused) = (0, 0, 0);
        for (mutant, fate) in mutants.iter().zip(&fates) {
            match fate {
                Fate::DoesNotCompile => continue,
                Fate::Found => here += 1,
                Fate::Survived => {
                    let key = (subject.name(), mutant.change());
                    match known.get(&key) {
                        Some(reason) => {
                            excused += 1;
                            println!("    survives: {}: {reason}", mutant.change());
                        }
                        None => {
                            println!("  ! survives: {} in line {}", mutant.change(), mutant.line);
                            unknown.push(format!("{}: {}", key.0, key.1));
                        }
                    }
                }
            }
            built += 1;
        }
        println!("{:46} {:>7} {built:>6} {here:>6} {excused:>9}", subject.name(), mutants.len());
        (found, made) = (found + here, made + built);
    }
    let part = f64::from(found) / f64::from(made.max(1));
    println!("{found} of {made} mutants are found ({:.1} %)", 100.0 * part);
    assert!(made > 0, "no mutant was built");
    assert!(part >= BAR, "{found} of {made} found, expected {BAR} of them");
    assert!(unknown.is_empty(), "survivors without a reason in survivors.csv:\n{}", unknown.join("\n"));
}
