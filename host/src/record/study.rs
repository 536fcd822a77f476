//! A study as a whole: the runs of one scene in many ways, what each cost and how far it was off.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Cost;

/// Errors by the names of their norms; what a scene does not have is not there.
pub type Errors = BTreeMap<String, f64>;

/// What a line of a study varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Fixed substeps per load step.
    Substeps,
    /// The tolerance of the wear profile.
    Tolerance,
    /// The safety factor C1 of scaled substeps or cycles.
    Scaling,
    /// Cells of the grid along its first side.
    Grid,
}

/// What became of a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "status", content = "reason", rename_all = "kebab-case")]
pub enum Status {
    /// It ran to its end.
    Done,
    /// It ran to its end in explicit steps beyond their stability limit.
    Unstable,
    /// The scene cannot have it, and why.
    Refused(String),
    /// It ended early, and why.
    Failed(String),
    /// It was not run, or not to its end, and why.
    LeftOut(String),
}

/// How long a case took; seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// Least wall time of a run.
    pub wall_s: f64,
    /// Largest wall time over the least, less 1; 0 of a single run.
    pub wall_spread: f64,
    /// Least time of the processors on all threads of this process; the process of an isolated law is not in it.
    pub processor_s: f64,
    /// Wall time of measuring the explicit limit, which a run that knows it would not need; taken off from both times.
    pub limit_s: f64,
    /// Runs that were timed.
    pub runs: u32,
    /// Whether a run that is not timed went before.
    pub warmed_up: bool,
}

/// The clock that the picture, the front and the verdict go by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// Wall time.
    #[default]
    Wall,
    /// Time of the processors on this process: tells more where other work shares the machine.
    Processor,
}

impl Case {
    /// How long it took by a clock; `None`: it did not run, or in a process that the clock does not see.
    #[must_use]
    pub fn time(&self, clock: Clock) -> Option<f64> {
        match clock {
            Clock::Wall => Some(self.timing?.wall_s),
            Clock::Processor => Some(self.timing?.processor_s).filter(|_| !self.isolated),
        }
    }
}

/// Work of one run, by counting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Contact solves.
    pub contact_solves: u64,
    /// Iterations of contact solves.
    pub contact_iterations: u64,
    /// Pairs of transforms.
    pub fft_pairs: u64,
    /// Calls of the law.
    pub law_calls: u64,
    /// Points at which the law was evaluated, summed over calls.
    pub points_evaluated: u64,
}

impl From<&Cost> for Work {
    fn from(cost: &Cost) -> Work {
        Work {
            steps: cost.steps,
            contact_solves: cost.contact_solves,
            contact_iterations: cost.contact_iterations,
            fft_pairs: cost.fft_pairs,
            law_calls: cost.law_calls,
            points_evaluated: cost.points_evaluated,
        }
    }
}

/// One way of running the scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    /// The line it belongs to.
    pub line: String,
    /// What the line varies.
    pub kind: Kind,
    /// The method as a scene names it.
    pub method: String,
    /// Whether the law ran in a process of its own.
    pub isolated: bool,
    /// The value that is varied: substeps, tolerance, safety factor or cells.
    pub value: f64,
    /// What `--set` would be told.
    pub overrides: Vec<String>,
    /// What became of it.
    #[serde(flatten)]
    pub status: Status,
    /// How long it took, where it ran.
    pub timing: Option<Timing>,
    /// What it did, where it ran.
    pub work: Option<Work>,
    /// Errors against the yardstick; of a grid against what [`GridError::against`] names.
    pub errors: Errors,
    /// Names of errors below three times the yardstick's own: they say no more than that they are small.
    pub unresolved: Vec<String>,
    /// Something to know about it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

impl Case {
    /// An error by its name, if it is there and the yardstick resolves it.
    #[must_use]
    pub fn resolved(&self, norm: &str) -> Option<f64> {
        let error = *self.errors.get(norm)?;
        (error.is_finite() && !self.unresolved.iter().any(|name| name == norm)).then_some(error)
    }
}

/// What runs are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum YardstickKind {
    /// A built-in exact answer for the points themselves.
    Exact,
    /// A file that the scene names.
    File,
    /// The same scene run to a much smaller tolerance.
    #[serde(rename = "self")]
    SelfConverged,
}

/// One of the runs that lead to a self-converged answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Rung {
    /// What `--set` would be told.
    pub overrides: Vec<String>,
    /// Wall time; s.
    pub wall_s: f64,
    /// Accepted steps.
    pub steps: u64,
    /// Differences to the next finer of the runs that are listed; empty for the last.
    pub to_the_next: Errors,
}

/// What runs are compared with, and how far that is off itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Yardstick {
    /// Which kind.
    pub kind: YardstickKind,
    /// In words.
    pub name: String,
    /// Its own errors in time, stated to be rather too large; empty where it is exact or nothing is known of it.
    pub stated: Errors,
    /// The runs that led to it; empty unless it is self-converged.
    pub rungs: Vec<Rung>,
    /// How far a self-converged answer is from the reference that the scene names, the error of the grid included; empty
    /// where the scene names none.
    pub measured: Errors,
    /// The reference that `measured` is against.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answer: Option<String>,
}

/// How far the grid itself is off, whatever the steps in time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GridError {
    /// What the grids of the study are compared with, in words.
    pub against: String,
    /// Estimated for the scene's own grid, from one of half the cells, to be rather too large; empty where there is none.
    pub estimated: Errors,
}

/// The stability limit of explicit steps at the start of the first load step; times in the scene's unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// Largest stable step.
    pub step: f64,
    /// Fewest substeps of the longest load step that keep it.
    pub substeps: u64,
}

/// How fast the error of a line falls with its step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Order {
    /// The line.
    pub line: String,
    /// Observed order in the norm of the picture, over the finest refinements that the yardstick resolves.
    pub order: f64,
    /// The number of cases it is taken from.
    pub cases: usize,
    /// The smallest and largest number of substeps among them.
    pub from: f64,
    /// See `from`.
    pub to: f64,
}

/// The cheapest way to an error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cheapest {
    /// The error asked for.
    pub error: f64,
    /// Index of the cheapest stable case that reaches it; `None`: none did.
    pub case: Option<usize>,
    /// Index of the cheapest stable explicit case that reaches it.
    pub explicit: Option<usize>,
    /// Wall time of the explicit case over that of the cheapest.
    pub factor: Option<f64>,
    /// Processor time of the explicit case over that of the cheapest.
    pub processor_factor: Option<f64>,
}

/// A whole study.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudyRecord {
    /// The scene's file.
    pub scene: String,
    /// The scene's title.
    pub title: String,
    /// Name and version of the law.
    pub law: String,
    /// Number of points or cells.
    pub points: usize,
    /// Cells along the sides of the grid, where there is one.
    pub cells: Option<Vec<usize>>,
    /// Threads of each run.
    pub threads: usize,
    /// The clock of the picture, the front and the verdict.
    pub clock: Clock,
    /// Processor over wall time, summed over the cases in this process: well below 1 where other work shares the machine.
    pub processor_share: Option<f64>,
    /// Wall seconds that it might take.
    pub budget_s: f64,
    /// Wall seconds that it took.
    pub spent_s: f64,
    /// Whether it was interrupted.
    pub interrupted: bool,
    /// The norm of the picture, the orders and the verdict.
    pub norm: String,
    /// What every norm is.
    pub norms: BTreeMap<String, String>,
    /// What runs are compared with.
    pub yardstick: Yardstick,
    /// How far the grid is off; `None` where there is none.
    pub grid: Option<GridError>,
    /// The limit of explicit steps, where there is one.
    pub explicit_limit: Option<Limit>,
    /// Every case, line by line.
    pub cases: Vec<Case>,
    /// Orders of the lines with fixed substeps.
    pub orders: Vec<Order>,
    /// Indices of the cases that no other beats in both time and error.
    pub front: Vec<usize>,
    /// The cheapest ways to 1e-2, 1e-3 and 1e-4.
    pub cheapest: Vec<Cheapest>,
    /// What it comes to, a sentence each.
    pub verdict: Vec<String>,
    /// What was left out of the study as a whole, and why.
    pub left_out: Vec<String>,
}
