//! Does a law keep the contract? The checks, each in a process of its own, and what came of them.
//!
//! Here are the checks and what each does, the checker that runs them and the worker it runs them in, waivers, replay
//! files, and reports as text, JSON and JUnit. Not here: the command that prints them (`cli::check`), loading and calling
//! laws for a run (`law`). Linux only.

mod check;
mod error;
mod message;
mod outcome;
mod replay;
pub mod report;
pub mod sampling;
mod selection;
mod waiver;

#[cfg(target_os = "linux")]
mod attempt;
#[cfg(target_os = "linux")]
mod bodies;
#[cfg(target_os = "linux")]
mod evidence;
#[cfg(target_os = "linux")]
mod harness;
#[cfg(target_os = "linux")]
mod keeper;
#[cfg(target_os = "linux")]
mod needs;
#[cfg(target_os = "linux")]
mod runner;
#[cfg(target_os = "linux")]
mod schedule;
#[cfg(target_os = "linux")]
mod slate;
#[cfg(target_os = "linux")]
mod trial;
#[cfg(target_os = "linux")]
mod worker;

#[cfg(not(target_os = "linux"))]
mod elsewhere;

pub use check::{Check, Facts, Group};
#[cfg(not(target_os = "linux"))]
pub use elsewhere::{run, worker_main};
pub use error::ConformanceError;
pub use outcome::{CheckResult, Finding, Outcome};
pub use replay::Replay;
#[cfg(target_os = "linux")]
pub use runner::run;
pub use selection::select;
pub use waiver::Waivers;
#[cfg(target_os = "linux")]
pub use worker::worker_main;

use std::path::PathBuf;
use std::time::Duration;

use outcome::NOT_STARTED;

pub use crate::sampling::known::Expected;
use wearlaw_law::Source;

/// First argument that makes the program a worker of the checker.
pub const WORKER_COMMAND: &str = "__check_worker";

/// Seconds that a check may take unless the user says otherwise: several times what the longest takes.
pub const TIMEOUT: Duration = Duration::from_secs(20);

/// Which law is checked, and how.
#[derive(Clone, Debug)]
pub struct CheckOptions {
    /// Where the law comes from.
    pub source: Source,
    /// Name of the law, where a library holds several; none: all of them.
    pub law: Option<String>,
    /// The options text that the law is created with.
    pub options: Option<String>,
    /// Where known values are.
    pub expected: Expected,
    /// The checks to run.
    pub selected: Vec<Check>,
    /// Checks that were meant too, and that `--quick` leaves out: the report names them.
    pub left_out: Vec<Check>,
    /// Checks that are switched off, with their reasons.
    pub waivers: Waivers,
    /// Seed of the random inputs.
    pub seed: u64,
    /// Less is tried where much would be; which checks run is said by `selected`.
    pub quick: bool,
    /// Longest time for one check.
    pub timeout: Duration,
    /// Loops of many calls are not cut short where the machine is slow: what comes late comes back.
    pub patient: bool,
    /// Checks that run at the same time.
    pub parallel: usize,
    /// Folder for the files that bring a failure back; none: they are not written.
    pub replays: Option<PathBuf>,
    /// The program that is the worker; none: this one.
    pub program: Option<PathBuf>,
}

impl CheckOptions {
    /// The seed where none is asked for.
    pub const SEED: u64 = 1;

    /// Every check of a law, with nothing else said.
    pub fn new(source: Source) -> Self {
        Self {
            source,
            law: None,
            options: None,
            expected: Expected::Nowhere,
            selected: Check::ALL.to_vec(),
            left_out: Vec::new(),
            waivers: Waivers::default(),
            seed: Self::SEED,
            quick: false,
            timeout: TIMEOUT,
            patient: false,
            parallel: std::thread::available_parallelism().map_or(2, usize::from),
            replays: None,
            program: None,
        }
    }
}

/// What happens while checks run.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// A check was begun.
    Started {
        /// The check.
        check: Check,
        /// How many are done.
        done: usize,
        /// How many there are.
        total: usize,
    },
    /// A check is done.
    Finished(&'a CheckResult),
}

/// All that came of a run of checks.
#[derive(Clone, Debug)]
pub struct Report {
    /// Names of the laws that were checked.
    pub laws: Vec<String>,
    /// What came of each check: of the library first, then law by law, in the order of [`Check::ALL`].
    pub results: Vec<CheckResult>,
    /// Seed of the random inputs.
    pub seed: u64,
    /// Wall time, s.
    pub seconds: f64,
}

impl Report {
    /// True if nothing falls short.
    pub fn passes(&self) -> bool {
        self.results.iter().all(|result| !result.outcome.falls_short())
    }

    /// Why nearly nothing was tried, if no instance could be made: that is no pass.
    pub fn untested(&self) -> Option<&str> {
        let reasons = self.results.iter().filter_map(|result| match &result.outcome {
            Outcome::Skipped(reason) => Some(reason.as_str()),
            _ => None,
        });
        reasons.into_iter().find(|reason| reason.starts_with(NOT_STARTED)).filter(|_| self.passes())
    }

    /// How many ended with that name of an outcome.
    pub fn count(&self, name: &str) -> usize {
        self.results.iter().filter(|result| result.outcome.name() == name).count()
    }
}
