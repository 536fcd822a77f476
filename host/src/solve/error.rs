//! What can go wrong while a plan is carried out.

use thiserror::Error;

use crate::contact::ContactError;
use crate::contact::prescribed::HistoryError;
use crate::contact::surface::SurfaceError;
use crate::integrator::AdvanceError;
use crate::law::{BatchError, EvaluateError, PointInputs};

/// Why a run ended before its time.
#[derive(Debug, Error)]
pub enum SolveError {
    /// The history could not be read.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// One instant and no duration.
    #[error("`{history}` has a single time and a load step has no duration, expected `step.duration` or a second time")]
    NoDuration {
        /// The history.
        history: String,
    },
    /// The history ends before the loading.
    #[error("the load steps last {asked} but `{history}` covers {covered}, expected a history at least as long")]
    HistoryTooShort {
        /// The history.
        history: String,
        /// What the load steps ask for.
        asked: f64,
        /// What the history covers.
        covered: f64,
    },
    /// The points could not be advanced over a piece of loading.
    #[error("load step {load_step}, substep {substep}, from time {}: {source}", instant(*time))]
    Advance {
        /// Number of the load step, from 1.
        load_step: i64,
        /// Number of the substep, from 1.
        substep: i64,
        /// Time at the start of the substep.
        time: f64,
        /// What happened.
        source: Box<AdvanceError<PointError>>,
    },
    /// The initial gap could not be made.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// An explicit step is beyond the stability limit.
    #[error(
        "load step {load_step}, from time {}: an explicit substep of {step:e} is beyond the stability limit {limit:e}, \
         expected less, an implicit method, or `integrator.beyond_limit` = \"substep\" or \"run\"",
        instant(*time)
    )]
    BeyondLimit {
        /// Number of the load step, from 1.
        load_step: i64,
        /// Time at the start of the substep.
        time: f64,
        /// Length of the substep.
        step: f64,
        /// The limit there.
        limit: f64,
    },
    /// A time that the loading does not reach.
    #[error("time {at} is outside the loading, expected `--at` from 0 to {end}")]
    NoSuchTime {
        /// The time asked for.
        at: f64,
        /// Where the loading ends.
        end: f64,
    },
    /// A study of the contact at a time without any.
    #[error("at time {time} nothing is in contact, expected a time under load (`--at`)")]
    NothingTouches {
        /// The time.
        time: f64,
    },
    /// A study was interrupted.
    #[error("interrupted")]
    Interrupted,
    /// The contact covers a free grid to its rim.
    #[error(
        "load step {load_step}, time {}: the contact covers all of the grid's rim, so the load is larger than the \
         domain can carry and the answer would be that of another body; expected a larger `grid.size`, or less load",
        instant(*time)
    )]
    DomainFull {
        /// Number of the load step, from 1.
        load_step: i64,
        /// Time.
        time: f64,
    },
    /// Threads could not be started.
    #[error("could not start {threads} threads: {text}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system said.
        text: String,
    },
    /// A checkpoint that the plan cannot go on from.
    #[error(transparent)]
    Checkpoint(#[from] crate::record::CheckpointError),
    /// What the plan depends on could not be read for the checkpoint.
    #[error("could not read {} for the checkpoint: {source}", path.display())]
    Contents {
        /// The file.
        path: std::path::PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The reference could not be evaluated.
    #[error(transparent)]
    Reference(#[from] super::ReferenceError),
}

/// Why the law could not be evaluated at some points.
#[derive(Debug, Error)]
pub enum PointError {
    /// The law or its worker failed.
    #[error(transparent)]
    Law(Box<EvaluateError>),
    /// The inputs could not be laid out: a fault of the program.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// The law asked for a substep below the smallest one allowed.
    #[error(transparent)]
    SmallestStep(Box<ShortStep>),
    /// A law that is not linear in dt although it claims to be.
    #[error(
        "law `{law}` claims to be linear in dt, but at point {point} it gave the increment {whole:e} for a substep of \
         {dt:e} and {half:e} for one half as long, expected half of it"
    )]
    NotLinear {
        /// The law.
        law: String,
        /// Number of the point.
        point: i64,
        /// The longer substep; time.
        dt: f64,
        /// Increment over it.
        whole: f64,
        /// Increment over half of it.
        half: f64,
    },
    /// The contact could not be solved.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// A stage of an implicit step did not converge.
    #[error(
        "the implicit stage stays at a residual of {residual:.2e} after {iterations} linearisations of the law, expected at \
         most {tolerance:e} (`contact.tolerance`, as a part of the gap's size); shorter steps may help: a smaller \
         `integrator.tolerance`, or more `integrator.substeps`"
    )]
    Newton {
        /// Linearisations.
        iterations: usize,
        /// Residual reached, measured as the complementarity error.
        residual: f64,
        /// Residual asked for.
        tolerance: f64,
    },
    /// A law that falls with pressure.
    #[error(
        "law `{law}` wears less where the pressure is higher: at point {point} the slope of the increment is {slope:e} at \
         pressure {pressure:e}, expected at least 0 (implicit contact needs a law that does not fall with pressure, and a \
         right derivative if it gives one: `wearlaw check LIB --only derivative`)"
    )]
    NotMonotone {
        /// The law.
        law: String,
        /// Number of the cell.
        point: usize,
        /// Contact pressure.
        pressure: f64,
        /// d increment / d pressure.
        slope: f64,
    },
    /// A law that is not of pressure degree 1 although it claims to be.
    #[error(
        "law `{law}` claims to be of pressure degree 1, but at point {point} it gave the increment {increment:e} at \
         pressure {pressure:e}, expected {expected:e}"
    )]
    NotProportional {
        /// The law.
        law: String,
        /// Number of the cell.
        point: usize,
        /// Contact pressure.
        pressure: f64,
        /// What it gave.
        increment: f64,
        /// What follows from its answer at another pressure.
        expected: f64,
    },
    /// A direction that does not lead into the worn body.
    #[error(
        "the wear direction d of point {point} has -d.n = {along}, expected more than 0: material would grow or slide \
         along the surface"
    )]
    Direction {
        /// Index of the point, from 0.
        point: usize,
        /// -d.n there.
        along: f64,
        /// Whether the law gave the direction, and not the scene.
        by_law: bool,
    },
}

/// A substep shorter than the smallest one allowed.
#[derive(Debug, Error)]
#[error(
    "law `{law}` asked for a substep shorter than {asked:e} at {}, time {time}, expected at least {}{}",
    at.as_ref().map_or_else(|| "points it does not name".to_owned(), ToString::to_string),
    least(*smallest),
    if text.is_empty() { String::new() } else { format!(": {text}") }
)]
pub struct ShortStep {
    /// The law.
    pub law: String,
    /// Time at the start of the substep.
    pub time: f64,
    /// The substep that it wanted.
    pub asked: f64,
    /// The smallest one allowed; 0: whatever numbers can tell apart.
    pub smallest: f64,
    /// The first such point, if it is known.
    pub at: Option<PointInputs>,
    /// The law's own words; may be empty.
    pub text: String,
}

/// A time, with a power of ten where it would have many zeros.
fn instant(time: f64) -> String {
    if time == 0.0 || (1e-5..1e16).contains(&time) { time.to_string() } else { format!("{time:e}") }
}

fn least(smallest: f64) -> String {
    match smallest > 0.0 {
        true => format!("the smallest step {smallest:e} (`integrator.smallest_step`)"),
        false => "the smallest step that numbers can tell apart".to_owned(),
    }
}

impl From<EvaluateError> for PointError {
    fn from(error: EvaluateError) -> PointError {
        PointError::Law(Box::new(error))
    }
}
