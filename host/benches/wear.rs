//! Whole runs: their time, the law's share of it, points a second, and memory against what the plan lists.
//!
//! `cargo bench -p wearlaw --bench wear`; without `--bench` each scene runs once, and the large one is small.

mod support;

use std::path::{Path, PathBuf};
use std::time::Instant;

use support::timing::is_measured;
use support::{laws, scenes};
use wearlaw::law::{Evaluator, LawInstance};
use wearlaw::plan::Plan;
use wearlaw::record::{End, Nobody};
use wearlaw::scene::Scene;
use wearlaw::solve::Run;

const FRETTING: &str = r#"
[law]
use = "archard"
constants = { K = 1e-4, H = 3e9 }
[contact]
model = "prescribed"
history = "fretting_history.csv"
[integrator]
tolerance = 1e-6
"#;

fn main() {
    let archard = laws::load(&laws::archard());
    let folder = tempfile::tempdir().expect("a temporary folder");
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    println!(
        "{:>26} {:>9} {:>7} {:>10} {:>10} {:>10} {:>6} {:>12} {:>10} {:>10} {:>6}",
        "scene",
        "points",
        "threads",
        "read, ms",
        "run, ms",
        "law, ms",
        "law",
        "points/s",
        "plan, MB",
        "rise, MB",
        "ratio"
    );
    let points = if is_measured() { 10_000_000 } else { 10_000 };
    // First, so that nothing else has raised the peak yet.
    let history = scenes::one_time_history(folder.path(), points);
    let plan = scenes::one_time_plan(&history, 1, archard.descriptor());
    for threads in [1, 2] {
        row("one time, one substep", &plan, &archard, threads, 1);
    }
    let plan = scenes::one_time_plan(&history, 20, archard.descriptor());
    row("one time, 20 substeps", &plan, &archard, 2, 1);
    let times = if is_measured() { 21 } else { 1 };
    row("pin on disc", &plan_of(&shipped.join("pin_on_disc.toml"), &archard), &archard, 1, times);
    let scene = folder.path().join("fretting.toml");
    let history = shipped.join("fretting_history.csv");
    std::fs::copy(history, folder.path().join("fretting_history.csv")).expect("a temporary folder can be written");
    std::fs::write(&scene, FRETTING).expect("a temporary folder can be written");
    row("fretting history", &plan_of(&scene, &archard), &archard, 1, times);
}

fn plan_of(scene: &PathBuf, law: &LawInstance) -> Plan {
    let scene = Scene::read(scene, &[]).unwrap_or_else(|error| panic!("{error}"));
    Plan::new(&scene, law.descriptor()).unwrap_or_else(|error| panic!("{error}"))
}

/// The best of some runs.
fn row(name: &str, plan: &Plan, law: &LawInstance, threads: usize, times: usize) {
    let before = resident();
    reset_peak();
    let (mut least, mut reading) = (f64::INFINITY, f64::INFINITY);
    let mut best = None;
    for _ in 0..times {
        let begin = Instant::now();
        let run = Run::prepare(plan, law).unwrap_or_else(|error| panic!("{error}"));
        reading = begin.elapsed().as_secs_f64().min(reading);
        let record = run.go(threads, &mut Nobody);
        assert!(matches!(record.end, End::Done), "{name} ended early");
        if record.cost.run_time_s < least {
            least = record.cost.run_time_s;
            best = Some(record);
        }
    }
    let record = best.expect("it ran");
    // What the run has added to the process, its history included; the program itself is not in the plan's list.
    let rise = peak().saturating_sub(before) as f64 / 1e6;
    let listed = record.memory.iter().map(|line| line.bytes).sum::<u64>() as f64 / 1e6;
    let ratio = if listed > 1.0 { format!("{:.3}", rise / listed) } else { "-".to_owned() };
    println!(
        "{name:>26} {:>9} {threads:>7} {:>10.3} {:>10.3} {:>10.3} {:>5.0}% {:>12.3e} {listed:>10.3} {rise:>10.3} {ratio:>6}",
        record.wear.len(),
        reading * 1e3,
        least * 1e3,
        record.cost.law_time_s * 1e3,
        100.0 * record.cost.law_time_s / (least * threads as f64),
        record.cost.points_evaluated as f64 / least,
    );
}

/// Forgets the peak so far, where the system can.
fn reset_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

fn peak() -> u64 {
    status("VmHWM:")
}

fn resident() -> u64 {
    status("VmRSS:")
}

/// A line of what Linux says of this process, bytes; 0 elsewhere.
fn status(name: &str) -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok()).unwrap_or(0) * 1024
}
