//! Every scene that comes with the program, run by the program: wall time and counted work.
//!
//! `cargo bench -p wearlaw --bench scenes`; without `--bench` only one small scene runs. Further words pick scenes by
//! what their names begin with: `-- rough`. The work is held to `tests/scenes/work.csv` by `tests/scenes.rs`.

mod support;

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use support::timing::is_measured;

/// The counters beside the times.
const COUNTERS: [&str; 4] = ["steps", "points_evaluated", "contact_iterations", "fft_pairs"];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of scenes");
    let mut scenes: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    scenes.sort();
    println!(
        "{:24} {:>8} {:>8} {:>17} {:>19} {:>10}",
        "scene", "wall, s", COUNTERS[0], COUNTERS[1], COUNTERS[2], COUNTERS[3]
    );
    for scene in scenes {
        let name = scene.file_stem().expect("a name").to_string_lossy().into_owned();
        let asked = words.is_empty() || words.iter().any(|word| name.starts_with(word));
        if asked && (is_measured() || name == "pin_on_disc") {
            row(&name, &scene);
        }
    }
}

/// Runs a scene and prints its line.
fn row(name: &str, scene: &Path) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("out");
    let mut program = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
    let output = program.arg("run").arg(scene).arg("-q").arg("--out").arg(&out).output().expect("the program starts");
    if !output.status.success() {
        // A scene with a law in Fortran, where no compiler is.
        println!("{name:24} NOT RUN: {}", String::from_utf8_lossy(&output.stderr).lines().next().unwrap_or_default());
        return;
    }
    let text = std::fs::read_to_string(out.join("report.json")).expect("a report");
    let report: Value = serde_json::from_str(&text).expect("a JSON document");
    let cost = &report["cost"];
    let [steps, points, iterations, pairs] = COUNTERS.map(|counter| cost[counter].as_u64().expect("a count"));
    let time = cost["run_time_s"].as_f64().expect("a time");
    println!("{name:24} {time:>8.3} {steps:>8} {points:>17} {iterations:>19} {pairs:>10}");
}
