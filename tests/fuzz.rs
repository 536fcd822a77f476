//! Fuzzing: any bytes as scenes, decks, histories, library files and checkpoints, and laws called in any legal order.
//!
//!     cargo test --test fuzz                                                    # a short seeded part
//!     WEARLAW_FUZZ_SECONDS=600 WEARLAW_FUZZ_SEED=42 cargo test --release --test fuzz
//!
//! An input that brings a target down, takes over 5 s or makes the program hold over 1 GiB is named with its seed and
//! kept in the target folder. `tests/run-fuzz` gives the same targets to cargo-fuzz, which looks for new paths.

#[path = "fuzz/mutator.rs"]
mod mutator;
#[path = "support/random.rs"]
mod random;
#[cfg(target_os = "linux")]
#[path = "fuzz/stateful.rs"]
mod stateful;
#[path = "fuzz/targets.rs"]
mod targets;
#[path = "fuzz/watch.rs"]
mod watch;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mutator::mutated;
use random::Random;
use targets::{TARGETS, seeds};
use watch::Watch;

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

/// Keeps an input before it is tried: what ends the process leaves it behind.
fn keep(target: &str, bytes: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
    std::fs::create_dir_all(&folder).expect("the target folder can be written");
    let path = folder.join(format!("{target}.input"));
    std::fs::write(&path, bytes).expect("the target folder can be written");
    path
}

/// Tries one input; says which it was if the target goes down. Answers whether the target accepts it.
fn attempt((name, run): targets::Target, bytes: &[u8], which: &str) -> bool {
    catch_unwind(AssertUnwindSafe(|| run(bytes))).unwrap_or_else(|_| {
        let path = keep(name, bytes);
        panic!("target {name} went down with {which}: {} ({})", path.display(), bytes.escape_ascii());
    })
}

/// Tries the seeds as they are, then inputs made from them; answers how many of the seeds and of the others are accepted.
fn fuzz(target: targets::Target) -> (usize, usize) {
    let (name, _) = target;
    let known = seeds(name, &root());
    assert!(!known.is_empty(), "{name} has no seeds");
    let watch = Watch::new(name);
    let mut good = 0;
    for (at, bytes) in known.iter().enumerate() {
        good += usize::from(watch.over(|| attempt(target, bytes, &format!("seed input {at}"))));
    }
    let mut random = Random(seed());
    let end = time().map(|time| Instant::now() + time);
    let (mut count, mut accepted) = (0, 0);
    while end.map_or(count < SHORT, |end| Instant::now() < end) {
        let bytes = mutated(&known, &mut random);
        if end.is_some() {
            keep(name, &bytes);
        }
        let which = || format!("input {count} of seed {}", seed());
        accepted += usize::from(watch.over(|| attempt(target, &bytes, &which())));
        count += 1;
    }
    println!("{name}: {good} of {} seeds and {accepted} of {count} inputs are accepted; {watch}", known.len());
    (good, accepted)
}

/// Fuzzes the target of this name; it has to get past the first refusal, or it looks at nothing.
fn holds(name: &str) {
    let target = TARGETS.into_iter().find(|(known, _)| *known == name).expect("a target of this name");
    let (good, accepted) = fuzz(target);
    assert!(good > 0 && accepted > 0, "{good} seeds and {accepted} other inputs are accepted");
}

#[test]
fn fuzz_scene() {
    holds("scene");
}

#[test]
fn fuzz_deck() {
    holds("deck");
}

#[test]
fn fuzz_history() {
    holds("history");
}

#[test]
fn fuzz_library() {
    holds("library");
}

#[test]
fn fuzz_checkpoint() {
    holds("checkpoint");
}

#[cfg(target_os = "linux")]
#[test]
fn laws_answer_the_same_in_any_legal_order_of_calls() {
    let watch = Watch::new("abi");
    let rounds = stateful::fuzz(seed(), time(), &watch);
    println!("abi: {rounds} rounds; {watch}");
    assert!(rounds > 0);
}
