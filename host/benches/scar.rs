//! Wear of a ball on a flat until the scar has three times the Hertz radius: processor time, work and true errors.
//!
//! `cargo bench -p wearlaw --bench scar`; without `--bench` only small cases run. Further words pick cases by what their
//! line begins with: `-- scar`, the same scar on 64 to 2048 cells a side, `-- square`, a law of pressure exponent 2, or
//! `-- cycles`, 10 to 1000 strokes.

mod support;

use std::f64::consts::PI;
use std::path::Path;

use support::processor::seconds;
use support::timing::is_measured;
use wearlaw::law::{Evaluator, LawInstance, Plugin, embedded};
use wearlaw::plan::Plan;
use wearlaw::record::{End, Nobody, Record};
use wearlaw::scene::Scene;
use wearlaw::solve::{Run, SolveError};

const MODULUS: f64 = 110e9;
const RADIUS: f64 = 10e-3;
const LOAD: f64 = 20.0;
/// K / H of the linear law, 1/Pa.
const COEFFICIENT: f64 = 1e-13;

fn main() {
    let plugin = Plugin::from_entry(embedded::entry("archard").expect("archard is embedded")).expect("a law");
    let archard = plugin.law(None).expect("one law").create(None).expect("no options are needed");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let words = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let case = Case { folder: folder.path(), law: &archard, words };
    println!(
        "{:>24} {:>6} {:>9} {:>7} {:>11} {:>9} {:>9} {:>6} {:>10} {:>10} {:>10}",
        "case",
        "steps",
        "rejected",
        "solves",
        "iterations",
        "FFT pairs",
        "cpu, s",
        "law",
        "wear err",
        "press. err",
        "volume err"
    );
    let few = !is_measured();
    for n in if few { &[32][..] } else { &[64, 128, 256, 512] } {
        // Of the largest grids a cheaper yardstick has to do; the twelve steps of the case itself are good to 1e-5.
        let yardstick = if *n > 128 { 1e-6 } else { 2e-7 };
        case.row(&format!("scar periodic {n}"), yardstick, |accuracy| scar("periodic", *n, 1.0, accuracy));
    }
    for n in if few { &[][..] } else { &[1024, 2048] } {
        // No yardstick: these show how time grows with the cells.
        case.timed(&format!("scar periodic {n}"), &scar("periodic", *n, 1.0, Accuracy { wear: 1e-3, contact: None }));
    }
    for n in if few { &[32][..] } else { &[256] } {
        case.row(&format!("scar free {n}"), 1e-6, |accuracy| scar("free", *n, 1.0, accuracy));
    }
    for n in if few { &[32][..] } else { &[128, 256] } {
        // At ten times the tolerance: a hundredth of the volume is what is asked for.
        let coarse = |accuracy: Accuracy| Accuracy { wear: 10.0 * accuracy.wear, ..accuracy };
        case.row(&format!("square periodic {n}"), 5e-6, |accuracy| scar("periodic", *n, 2.0, coarse(accuracy)));
    }
    for count in if few { &[2][..] } else { &[10, 100, 1000] } {
        case.timed(&format!("cycles {count}"), &cycles(*count));
    }
}

/// How exact a run is to be: the tolerance of the wear and, if it is not the usual one, that of the contact.
struct Accuracy {
    wear: f64,
    contact: Option<f64>,
}

/// Runs scenes and prints their lines.
struct Case<'a> {
    folder: &'a Path,
    law: &'a LawInstance,
    /// What the names of the wanted cases begin with; none: all are.
    words: Vec<String>,
}

impl Case<'_> {
    fn run(&self, scene: &str) -> Record<SolveError> {
        let path = self.folder.join("scene.toml");
        std::fs::write(&path, scene).expect("a temporary folder can be written");
        let scene = Scene::read(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        let plan = Plan::new(&scene, self.law.descriptor()).unwrap_or_else(|error| panic!("{error}"));
        let run = Run::prepare(&plan, self.law).unwrap_or_else(|error| panic!("{error}"));
        let record = run.go(1, &mut Nobody);
        assert!(matches!(record.end, End::Done), "a run ended early");
        record
    }

    /// The least processor time of a few runs, and what the last came to.
    fn least(&self, scene: &str) -> (f64, Record<SolveError>) {
        let mut least = f64::INFINITY;
        let repeats = if is_measured() { 5 } else { 1 };
        let mut last = None;
        for _ in 0..repeats {
            let begin = seconds();
            let record = self.run(scene);
            least = least.min(seconds() - begin);
            last = Some(record);
        }
        (least, last.expect("it ran"))
    }

    fn wants(&self, name: &str) -> bool {
        self.words.is_empty() || self.words.iter().any(|word| name.starts_with(word))
    }

    /// One scene at the tolerance 1e-3, against the same at the tolerance `refined`.
    fn row(&self, name: &str, refined: f64, scene: impl Fn(Accuracy) -> String) {
        if !self.wants(name) {
            return;
        }
        let (time, record) = self.least(&scene(Accuracy { wear: 1e-3, contact: None }));
        let refined = if is_measured() { refined } else { 1e-4 };
        let refined = self.run(&scene(Accuracy { wear: refined, contact: Some(1e-10) }));
        assert!(refined.cost.steps >= 2 * record.cost.steps || !is_measured(), "the refined run is not much finer");
        let volume = |record: &Record<SolveError>| record.wear.iter().sum::<f64>();
        let errors = [
            distance(&record.wear, &refined.wear),
            distance(&record.pressure, &refined.pressure),
            (volume(&record) / volume(&refined) - 1.0).abs(),
        ];
        print(name, time, &record, &errors.map(|error| format!("{error:.1e}")));
    }

    /// One scene, timed only.
    fn timed(&self, name: &str, scene: &str) {
        if !self.wants(name) {
            return;
        }
        let (time, record) = self.least(scene);
        print(name, time, &record, &["-", "-", "-"].map(str::to_owned));
    }
}

fn print(name: &str, time: f64, record: &Record<SolveError>, errors: &[String; 3]) {
    let cost = &record.cost;
    println!(
        "{name:>24} {:>6} {:>9} {:>7} {:>11} {:>9} {time:>9.3} {:>5.1}% {:>10} {:>10} {:>10}",
        cost.steps,
        cost.rejected_steps,
        cost.contact_solves,
        cost.contact_iterations,
        cost.fft_pairs,
        100.0 * cost.law_time_s / cost.run_time_s,
        errors[0],
        errors[1],
        errors[2],
    );
}

/// A ball of R = 10 mm under 20 N on a square of ten Hertz radii, E* = 110 GPa, until the scar of a linear law with
/// K / H = 1e-13 /Pa has three of them. A law with another exponent wears as much at a tenth of the Hertz pressure.
fn scar(boundary: &str, n: usize, m: f64, accuracy: Accuracy) -> String {
    let hertz = (0.75 * LOAD * RADIUS / MODULUS).cbrt();
    let pressure = 0.1 * 1.5 * LOAD / (PI * hertz.powi(2));
    let duration = PI * (3.0 * hertz).powi(4) / (4.0 * RADIUS) / (COEFFICIENT * LOAD);
    let hardness = 1e10;
    let coefficient = COEFFICIENT * hardness * pressure.powf(1.0 - m);
    let Accuracy { wear: tolerance, contact } = accuracy;
    let contact = contact.map_or(String::new(), |contact| format!("tolerance = {contact:e}\n"));
    format!(
        "[law]\nuse = \"archard\"\nconstants = {{ K = {coefficient:e}, H = {hardness:e}, m = {m:?}, n = 1.0 }}\n\
         [contact]\nmodel = \"halfspace\"\nmodulus = {MODULUS:e}\nboundary = \"{boundary}\"\n{contact}\
         [grid]\nsize = [{size:e}, {size:e}]\ncells = [{n}, {n}]\n\
         [surface]\nshape = \"sphere\"\nradius = {RADIUS:e}\n\
         [[step]]\nduration = {duration:e}\nload = {LOAD:e}\nvelocity = 1.0\n\
         [integrator]\ntolerance = {tolerance:e}\n[output]\nfields = []\n",
        size = 10.0 * hertz,
    )
}

/// Cycles of a load that rises and falls, two substeps each, on 64 x 64 cells; a scar grows by 1e-4 of its volume in one.
fn cycles(count: u64) -> String {
    let scene = scar("free", 64, 1.0, Accuracy { wear: 1e-3, contact: None });
    let (before, step) = scene.split_once("[[step]]\n").expect("a scene with a step");
    let (step, after) = step.split_once("[integrator]").expect("a scene with an integrator");
    let (_, output) = after.split_once("[output]").expect("a scene with output");
    let (_, rest) = step.split_once("load").expect("a step with a load");
    let (_, rest) = rest.split_once('\n').expect("something after it");
    let step = |load: f64| format!("[[cycle.step]]\nduration = 2e-5\nload = {load:e}\n{rest}\n");
    let (low, high) = (step(0.8 * LOAD), step(LOAD));
    format!("{before}[[cycle]]\ncount = {count}\n{low}{high}[integrator]\nsubsteps = 1\n[output]{output}")
}

/// ||a - b|| / ||b||.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    (square / b.iter().map(|b| b * b).sum::<f64>()).sqrt()
}
