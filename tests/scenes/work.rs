//! What each scene costs in counted work: it may not grow unseen. `cargo bench -p wearlaw --bench scenes` prints times.
//!
//! `WEARLAW_REGENERATE=1 cargo test --test scenes` notes the work anew in `tests/scenes/work.csv`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::scene_runs::{Ran, read};

/// The counters that are bounded, as the report and the table name them.
const COUNTERS: [&str; 5] = ["steps", "law_calls", "points_evaluated", "contact_iterations", "fft_pairs"];
/// A run may do so much more than is noted: instruction sets round otherwise, and an iteration is soon one more.
const MARGIN: f64 = 1.25;
/// And so many more of a small number.
const FEW: f64 = 5.0;

/// The counted work of scenes, by their names.
pub type Work = BTreeMap<String, Vec<u64>>;

fn path() -> PathBuf {
    super::native::root().join("tests/scenes/work.csv")
}

/// The work of a finished run.
pub fn of(ran: &Ran) -> Vec<u64> {
    COUNTERS.map(|counter| ran.number(&format!("/cost/{counter}")) as u64).to_vec()
}

fn noted() -> Work {
    let text = read(&path());
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(format!("scene,{}", COUNTERS.join(",")).as_str()), "the head of the table of work");
    let row = |line: &str| {
        let (name, counts) = line.split_once(',').unwrap_or_else(|| panic!("{line}: no counts"));
        let count = |cell: &str| cell.parse().unwrap_or_else(|error| panic!("{line}: {cell}: {error}"));
        let counts: Vec<u64> = counts.split(',').map(count).collect();
        assert_eq!(counts.len(), COUNTERS.len(), "{line}");
        (name.to_owned(), counts)
    };
    lines.map(row).collect()
}

/// Holds what scenes did to what is noted, or notes it anew; `left_out` could not run here.
pub fn hold(done: &Work, left_out: &[String]) {
    if std::env::var_os("WEARLAW_REGENERATE").is_some() {
        assert!(left_out.is_empty(), "{left_out:?} did not run: their work is not known");
        let row = |(name, counts): (&String, &Vec<u64>)| {
            let counts: Vec<String> = counts.iter().map(u64::to_string).collect();
            format!("{name},{}\n", counts.join(","))
        };
        let text = format!("scene,{}\n{}", COUNTERS.join(","), done.iter().map(row).collect::<String>());
        std::fs::write(path(), text).expect("the repository can be written");
        return;
    }
    let noted = noted();
    let mut wrong = Vec::new();
    for (name, counts) in done {
        let Some(known) = noted.get(name) else {
            wrong.push(format!("{name}: not in the table"));
            continue;
        };
        for ((counter, count), known) in COUNTERS.iter().zip(counts).zip(known) {
            if *count as f64 > MARGIN * *known as f64 + FEW {
                wrong.push(format!("{name}: {counter} {count}, noted {known}"));
            }
        }
    }
    let gone = noted.keys().filter(|name| !done.contains_key(*name) && !left_out.contains(name));
    wrong.extend(gone.map(|name| format!("{name}: in the table, and no scene")));
    let remedy = "if that is meant, WEARLAW_REGENERATE=1 cargo test --test scenes";
    assert!(wrong.is_empty(), "more work than is noted in tests/scenes/work.csv ({remedy}):\n{}", wrong.join("\n"));
}
