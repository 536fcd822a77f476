//! A law by itself: how fast it answers, alone and in a process of its own, how near that is to the speed of the memory,
//! and how exact its answers are.
//!
//! Here are interleaved timing, the triad that the memory is measured by, and the calls that are timed; inputs and known
//! values are those of `sampling`. What is printed is in `cli::bench`; whether a law keeps its contract, in
//! `conformance`.

mod accuracy;
mod error;
mod laid;
mod measure;
mod opened;
pub mod placed;
pub mod timing;

pub use accuracy::{Accuracy, Worst};
pub use error::BenchError;

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::conformance::sampling::known::Expected;
use crate::law::Source;
use crate::law::isolate::DEADLINE;

/// Points of a call unless the user says otherwise: a decade apart, the last beyond the caches of most machines.
pub const POINTS: [usize; 8] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 4_000_000];
/// Seconds for all timing unless the user says otherwise: a hundred rounds of most sizes for one law.
pub const BUDGET: Duration = Duration::from_secs(10);

/// A library whose laws are measured, or one law of it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// What the user calls it.
    pub origin: String,
    /// Where it comes from.
    pub source: Source,
    /// Name of the law; none: all laws of the library.
    pub law: Option<String>,
    /// The options text that the law is created with.
    pub options: Option<String>,
    /// Where known values are.
    pub expected: Expected,
}

/// How laws are measured.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// Points of a call, ascending.
    pub points: Vec<usize>,
    /// Numbers of threads that share a call, ascending.
    pub threads: Vec<usize>,
    /// Time for all timing together; what would take longer is left out, and told.
    pub budget: Duration,
    /// Longest time for one call in a process of its own.
    pub deadline: Duration,
    /// Seed of the random inputs.
    pub seed: u64,
    /// The program that is the worker; none: this one.
    pub program: Option<PathBuf>,
}

impl Default for BenchOptions {
    /// [`POINTS`], on one thread and on all that the machine has, within [`BUDGET`].
    fn default() -> Self {
        let all = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = if all > 1 { vec![1, all] } else { vec![1] };
        Self { points: POINTS.to_vec(), threads, budget: BUDGET, deadline: DEADLINE, seed: 1, program: None }
    }
}

/// What came of a bench.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Each law, in the order in which they were named.
    pub laws: Vec<LawReport>,
    /// Wall time of all timing, s.
    pub seconds: f64,
}

/// What came of one law.
#[derive(Debug, Serialize)]
pub struct LawReport {
    /// Its name.
    pub name: String,
    /// Its version; may be empty.
    pub version: String,
    /// What the user calls its library.
    pub from: String,
    /// Bytes that a call moves at each point by the fields, inputs and outputs that the law declares.
    pub bytes_per_point: usize,
    /// Times of calls.
    pub speeds: Vec<Speed>,
    /// Its answers against known values; none: there are none to compare with.
    pub accuracy: Option<Accuracy>,
    /// What a reader of the figures should know.
    pub notes: Vec<String>,
    /// Why it was not measured, or not to the end.
    #[serde(serialize_with = "in_words")]
    pub failure: Option<BenchError>,
}

/// How long a call takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Speed {
    /// Points of the call.
    pub points: usize,
    /// Threads that share it.
    pub threads: usize,
    /// Whether the law is in a process of its own.
    pub isolated: bool,
    /// Least wall time of the rounds, ns per point.
    pub least_ns: f64,
    /// Median wall time of the rounds, ns per point.
    pub median_ns: f64,
    /// Number of rounds.
    pub rounds: usize,
    /// The memory's speed beside it, with the largest number of points.
    pub memory: Option<Memory>,
}

/// A call against a triad that moves as many bytes on as many threads.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Memory {
    /// Bytes that each of them moves.
    pub bytes: usize,
    /// The triad's speed, 1e9 bytes a second.
    pub triad_gb_per_s: f64,
    /// Least time of the triad over least time of the call: the part of the memory's bandwidth that the law has.
    pub part: f64,
}

fn in_words<S: serde::Serializer>(failure: &Option<BenchError>, to: S) -> Result<S::Ok, S::Error> {
    match failure {
        Some(error) => to.collect_str(error),
        None => to.serialize_none(),
    }
}

/// Measures laws: `on` is told what is next, `stop` ends it early.
///
/// A law that fails while it is measured has its failure in the report, and the others go on.
///
/// # Errors
/// A law that cannot be opened, known values that were asked for and do not fit, no threads, or the wish to stop.
pub fn run(
    subjects: &[Subject],
    options: &BenchOptions,
    on: &mut dyn FnMut(&str),
    stop: &AtomicBool,
) -> Result<Report, BenchError> {
    let mut laws = Vec::new();
    for subject in subjects {
        on(&subject.origin);
        laws.extend(opened::open(subject, options)?);
    }
    let begin = Instant::now();
    measure::all(&mut laws, options, on, stop)?;
    let laws = laws.into_iter().map(|law| law.report).collect();
    Ok(Report { laws, seconds: begin.elapsed().as_secs_f64() })
}
