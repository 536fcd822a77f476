//! A run as a whole: what came out, what it cost and how it ended.

use serde::{Deserialize, Serialize};

use super::{Geometry, History, Profile, Units};

/// Work and time of a run. Times are wall seconds; what depends on the machine's load stands here and nowhere else.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Time of the run without building and loading the law; s.
    pub run_time_s: f64,
    /// Time inside calls of the law, summed over threads; s.
    pub law_time_s: f64,
    /// Time in contact solves; s.
    pub contact_time_s: f64,
    /// Time that measuring the stability limit of explicit steps took; s.
    #[serde(default)]
    pub limit_time_s: f64,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected panels and substeps.
    pub rejected_steps: u64,
    /// Calls of the law.
    pub law_calls: u64,
    /// Points at which the law was evaluated, summed over calls.
    pub points_evaluated: u64,
    /// Contact solves.
    pub contact_solves: u64,
    /// Iterations of contact solves.
    pub contact_iterations: u64,
    /// Pairs of transforms.
    pub fft_pairs: u64,
    /// Most memory that the process has held; bytes. 0 where the system does not tell.
    pub peak_memory_bytes: u64,
}

/// How a run ended.
#[derive(Debug)]
pub enum End<E> {
    /// At its end.
    Done,
    /// Early, as the scene's `stop` asked.
    Stopped(String),
    /// Early, as the observer wished.
    Interrupted,
    /// Early, by an error; what was done so far is in the record.
    Failed(E),
}

/// Where a run's memory goes, before it is allocated.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct MemoryLine {
    /// What is held.
    pub what: String,
    /// How much; bytes.
    pub bytes: u64,
}

/// How a run stands to the stability limit of explicit steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stability {
    /// Largest measured rate at which unevenness decays; per time. `None`: not measured.
    pub stiffness: Option<f64>,
    /// Smallest of the largest stable explicit steps; time. `None`: not measured, or no limit.
    pub explicit_limit: Option<f64>,
    /// Whether explicit steps beyond the limit were taken.
    pub is_unstable: bool,
    /// In words.
    pub verdict: String,
}

/// How a report's error begins what it is compared with where there is no reference, before what was estimated.
pub const ESTIMATED: &str = "none; estimated: ";

/// Estimated relative errors at the end of a run, in the L2 norm over the points where they are of a field; `None`: not
/// estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Estimated {
    /// Of the wear depth.
    pub wear_l2_relative: Option<f64>,
    /// Of the contact pressure.
    pub pressure_l2_relative: Option<f64>,
    /// Of the worn volume.
    pub volume_relative: Option<f64>,
}

impl Estimated {
    /// Errors of two causes together; what one of them does not say is not known.
    #[must_use]
    pub fn plus(self, other: Estimated) -> Estimated {
        let sum = |a: Option<f64>, b: Option<f64>| Some(a? + b?);
        Estimated {
            wear_l2_relative: sum(self.wear_l2_relative, other.wear_l2_relative),
            pressure_l2_relative: sum(self.pressure_l2_relative, other.pressure_l2_relative),
            volume_relative: sum(self.volume_relative, other.volume_relative),
        }
    }
}

/// What happened in a run; numbers in the scene's units.
#[derive(Debug)]
pub struct Record<E> {
    /// Quantities over time; the first row is the start.
    pub history: History,
    /// Wear depth `[points]`; length.
    pub wear: Vec<f64>,
    /// Contact pressure `[points]` at the end; empty where it is prescribed.
    pub pressure: Vec<f64>,
    /// State variables `[points * variables]`.
    pub state: Vec<f64>,
    /// Errors of the steps in time, as the integrator estimates them on its way.
    pub estimated: Estimated,
    /// Largest accepted step; time.
    pub largest_step: f64,
    /// What it cost.
    pub cost: Cost,
    /// Memory as it was planned.
    pub memory: Vec<MemoryLine>,
    /// Things to know, each once.
    pub warnings: Vec<String>,
    /// How it stands to the stability limit of explicit steps.
    pub stability: Stability,
    /// Profile along the points, where they lie on a line.
    pub profile: Option<Profile<'static>>,
    /// Where the points lie.
    pub geometry: Geometry<'static>,
    /// Labels of the units.
    pub units: Units,
    /// How it ended.
    pub end: End<E>,
}
