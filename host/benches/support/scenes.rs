//! Scenes at any size, and runs of them that are timed substep by substep.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use wearlaw::law::{Evaluator, LawDescriptor};
use wearlaw::plan::Plan;
use wearlaw::record::{End, Event, Observer, Wish};
use wearlaw::scene::Scene;
use wearlaw::solve::Run;
use zip::write::SimpleFileOptions;

use super::timing::{Times, columns, triad};

/// A history of one time with pressure and velocity at every point, stored so that it is read in place.
pub fn one_time_history(folder: &Path, points: usize) -> PathBuf {
    let path = folder.join(format!("one_time_{points}.npz"));
    let (pressure, velocity) = columns(points);
    let file = BufWriter::with_capacity(1 << 20, File::create(&path).expect("a temporary folder can be written"));
    let mut zip = zip::ZipWriter::new(file);
    let options = SimpleFileOptions::default()
        .compression_method(zip::CompressionMethod::Stored)
        .with_alignment(64)
        .large_file(true);
    let arrays: [(&str, String, &[f64]); 3] = [
        ("time", "(1,)".to_owned(), &[0.0]),
        ("pressure", format!("(1, {points})"), &pressure),
        ("velocity", format!("(1, {points})"), &velocity),
    ];
    for (name, shape, values) in arrays {
        zip.start_file(format!("{name}.npy"), options).expect("the archive can be written");
        let mut text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        while !(10 + text.len() + 1).is_multiple_of(64) {
            text.push(' ');
        }
        text.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend_from_slice(&(text.len() as u16).to_le_bytes());
        bytes.extend_from_slice(text.as_bytes());
        zip.write_all(&bytes).expect("the archive can be written");
        for part in values.chunks(1 << 16) {
            let bytes: Vec<u8> = part.iter().flat_map(|value| value.to_le_bytes()).collect();
            zip.write_all(&bytes).expect("the archive can be written");
        }
    }
    zip.finish().expect("the archive can be written").flush().expect("the file can be written");
    path
}

/// The plan of `steps` equal load steps on a history of one time, with linear Archard.
pub fn one_time_plan(history: &Path, steps: usize, law: &LawDescriptor) -> Plan {
    let mut text = format!(
        "[law]\nuse = \"archard\"\nconstants = {{ K = 1e-4, H = 2e9 }}\n[contact]\nmodel = \"prescribed\"\nhistory = {:?}\n\
         [integrator]\nsubsteps = 1\n[output]\nfields = []\n",
        history.display().to_string()
    );
    (0..steps).for_each(|_| text.push_str("[[step]]\nduration = 0.125\n"));
    let file = history.with_extension("toml");
    std::fs::write(&file, text).expect("a temporary folder can be written");
    let scene = Scene::read(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    Plan::new(&scene, law).unwrap_or_else(|error| panic!("{error}"))
}

/// A run's substeps and triads that took turns with them.
pub struct Against {
    pub triad: Times,
    pub step: Times,
    /// Part of the substeps' time that the law's calls took, on average.
    pub law_share: f64,
}

/// Does a triad after every substep, on the run's own threads.
struct Watch {
    arrays: [Vec<f64>; 3],
    mark: Instant,
    triad: Vec<f64>,
    step: Vec<f64>,
}

impl Observer for Watch {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        if let Event::Step { .. } = event {
            self.step.push(self.mark.elapsed().as_secs_f64());
            let [a, b, c] = &mut self.arrays;
            let part = a.len().div_ceil(rayon::current_num_threads());
            let begin = Instant::now();
            rayon::scope(|scope| {
                for ((a, b), c) in a.chunks_mut(part).zip(b.chunks(part)).zip(c.chunks(part)) {
                    scope.spawn(move |_| triad(a, b, c, std::hint::black_box(3.0)));
                }
            });
            std::hint::black_box(a);
            self.triad.push(begin.elapsed().as_secs_f64());
            self.mark = Instant::now();
        }
        Wish::GoOn
    }
}

/// Runs a plan of single-piece load steps and times every piece, and a triad after each.
pub fn substeps_against_triad(plan: &Plan, law: &dyn Evaluator, threads: usize, points: usize) -> Against {
    let run = Run::prepare(plan, law).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(run.points(), points);
    let (b, c) = columns(points);
    let mut watch =
        Watch { arrays: [vec![0.0; points], b, c], mark: Instant::now(), triad: Vec::new(), step: Vec::new() };
    let record = run.go(threads, &mut watch);
    assert!(matches!(record.end, End::Done), "the run ended early");
    let total: f64 = watch.step.iter().sum();
    // The first piece touches its arrays for the first time.
    let steps = |all: &[f64]| Times::new(all[1..].to_vec());
    Against {
        triad: steps(&watch.triad),
        step: steps(&watch.step),
        law_share: record.cost.law_time_s / (total * threads as f64),
    }
}
