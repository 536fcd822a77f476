//! Mutants of the shipped laws: how many does `wearlaw check` with the law's expected.csv find?
//!
//! A mutant is the source of a law, or of the helper under it, with one small mistake: a sign, an exponent, an index, a
//! dropped term, swapped arguments, a state that is not written, a wrong stride. It is built as an author would build it.
//!
//!     cargo test --test mutate                                                # two of each law that builds fast
//!     WEARLAW_MUTANTS=12 cargo test --release --test mutate -- --nocapture     # so many of each file, some minutes
//!     WEARLAW_MUTANTS=all cargo test --release --test mutate -- --nocapture    # every one, hours
//!
//! `WEARLAW_MUTATE=NAME` takes the files with that in their name, `WEARLAW_MUTATE_SEED=N` other ones of each file.
//!
//! At least 95 % have to be found. What is not found has to be in `tests/mutate/survivors.csv`, with the reason. Where
//! that is `equivalent`, the mutant answers every question as the law does, and counts neither as found nor as missed.
//! A line of the list whose mutant is found, or cannot be made any more, has to go.
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

/// Mutants of one law in the short part.
const SHORT: usize = 2;
/// Part of the mutants that has to be found.
const BAR: f64 = 0.95;

/// Why a mutant is not found, by file and change.
type Known = BTreeMap<(String, String), Reason>;

/// A row of the list of survivors.
#[derive(Clone, Debug)]
struct Reason {
    /// Nobody could tell the mutant from the law; otherwise the tester misses it.
    equivalent: bool,
    text: String,
}

/// The survivors that are known, with the reason.
fn known() -> Known {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/mutate/survivors.csv");
    let mut table = csv::Reader::from_path(path).expect("the list of survivors");
    let rows = table.records().map(|row| row.expect("file, change, kind, reason"));
    rows.map(|row| {
        assert!(["equivalent", "missed"].contains(&&row[2]), "{row:?}");
        let reason = Reason { equivalent: &row[2] == "equivalent", text: row[3].to_owned() };
        ((row[0].to_owned(), row[1].to_owned()), reason)
    })
    .collect()
}

fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok()
}

/// A seeded part of a file's mutants, spread over it; or all.
fn chosen(subject: &Subject, all: Vec<Mutant>) -> Vec<Mutant> {
    let most = match variable("WEARLAW_MUTANTS").as_deref() {
        Some("all") => usize::MAX,
        Some(number) => number.parse().expect("WEARLAW_MUTANTS is `all` or a number"),
        None if subject.is_quickly_built() => SHORT,
        None => 0,
    };
    if !subject.name().contains(&variable("WEARLAW_MUTATE").unwrap_or_default()) {
        return Vec::new();
    }
    if all.len() <= most {
        return all;
    }
    let seed: usize = variable("WEARLAW_MUTATE_SEED").map_or(1, |text| text.parse().expect("a number"));
    // One of every stretch.
    let count = all.len();
    let mut picked: Vec<usize> = (0..most).map(|k| (k * count + (k * 7919 * seed) % count) / most).collect();
    picked.dedup();
    picked.into_iter().map(|at| all[at].clone()).collect()
}

/// Lines of the list for mutants that cannot be made of these files, each with its reason.
fn stale(known: &Known, subjects: &[Subject]) -> Vec<String> {
    let mut left: Known = known.clone();
    for subject in subjects {
        for mutant in mutants(subject) {
            left.remove(&(subject.name(), mutant.change()));
        }
    }
    // Fortran is left out where there is no compiler.
    let here = |file: &str| subjects.iter().any(|subject| subject.name() == file) || !subjects::is_fortran(file);
    left.into_keys().filter(|(file, _)| here(file)).map(|(file, change)| format!("{file}: {change}")).collect()
}

#[test]
fn every_line_of_the_list_is_a_mutant_that_can_be_made() {
    let stale = stale(&known(), &subjects());
    assert!(stale.is_empty(), "no such mutant, take it out of survivors.csv:\n{}", stale.join("\n"));
}

#[test]
fn mutants_of_the_shipped_laws_are_found() {
    let known = known();
    let (mut found, mut made, mut equal) = (0, 0, 0);
    let (mut unknown, mut outlived) = (Vec::new(), Vec::new());
    println!("{:46} {:>7} {:>6} {:>6} {:>9}", "file", "mutants", "built", "found", "equal");
    for subject in subjects() {
        let workshop = Workshop::new(&subject);
        let mutants = chosen(&subject, mutants(&subject));
        if mutants.is_empty() {
            continue;
        }
        if variable("WEARLAW_MUTANTS").is_some() {
            workshop.assert_sound();
        }
        let fates = workshop.try_all(&mutants);
        let (mut built, mut here, mut excused) = (0, 0, 0);
        for (mutant, fate) in mutants.iter().zip(&fates) {
            let key = (subject.name(), mutant.change());
            match fate {
                Fate::DoesNotCompile => continue,
                Fate::Found => {
                    here += 1;
                    if known.contains_key(&key) {
                        println!("  ! is found, and in the list: {}", mutant.change());
                        outlived.push(format!("{}: {}", key.0, key.1));
                    }
                }
                Fate::Survived => match known.get(&key) {
                    Some(reason) => {
                        println!("    survives: {}: {}", mutant.change(), reason.text);
                        if reason.equivalent {
                            excused += 1;
                            continue;
                        }
                    }
                    None => {
                        println!("  ! survives: {} in line {}", mutant.change(), mutant.line);
                        unknown.push(format!("{}: {}", key.0, key.1));
                    }
                },
            }
            built += 1;
        }
        println!("{:46} {:>7} {built:>6} {here:>6} {excused:>9}", subject.name(), mutants.len());
        (found, made, equal) = (found + here, made + built, equal + excused);
    }
    let part = f64::from(found) / f64::from(made.max(1));
    println!("{found} of {made} mutants are found ({:.1} %), and {equal} are equivalent", 100.0 * part);
    assert!(made > 0, "no mutant was built");
    // A few mutants are no sample: there only the reasons count.
    assert!(part >= BAR || variable("WEARLAW_MUTANTS").is_none(), "{found} of {made} found, expected {BAR} of them");
    assert!(outlived.is_empty(), "found, take it out of survivors.csv:\n{}", outlived.join("\n"));
    assert!(unknown.is_empty(), "survivors without a reason in survivors.csv:\n{}", unknown.join("\n"));
}
