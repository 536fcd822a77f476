//! Advancing wear in time.
//!
//! Here are the quadrature of a wear rate over a piece of loading ([`quadrature`]) and the advance by whole substeps
//! of laws that have a memory ([`substeps`]), both over one chunk of points with an error estimate and step control; and
//! the steps of a surface that answers back ([`Stages`]). The choice of what to advance with is not here.

mod answering;
mod counters;
mod rules;

pub mod quadrature;
pub mod substeps;

pub use answering::{Answering, Formula, Span, Stages, Tried};
pub use counters::Tally;
pub use rules::Rule;

/// What an evaluation over a chunk of points came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reply {
    /// The increments are written.
    Good,
    /// The law wants a substep shorter by this factor in (0, 1); nothing was written.
    Cut(f64),
}

/// Why a chunk of points could not be advanced; `E` is what the evaluation itself failed with.
#[derive(Debug, thiserror::Error)]
pub enum AdvanceError<E: std::error::Error + 'static> {
    /// The evaluation failed.
    #[error(transparent)]
    Evaluate(#[from] E),
    /// The law asked for a substep below the smallest one allowed.
    #[error(
        "at time {time} the law asked for a substep shorter than {asked:e}, expected at least the smallest step \
         {smallest:e}"
    )]
    SmallestStep {
        /// Time at the start of the substep.
        time: f64,
        /// The substep that the law wanted.
        asked: f64,
        /// The smallest one allowed.
        smallest: f64,
    },
    /// The tolerance was not met within the smallest piece of time that numbers can tell apart.
    #[error(
        "at time {time} the error estimate of the wear increment stays at {estimate:e} relative with a substep of \
         {step:e}, expected at most the tolerance {tolerance:e}"
    )]
    Tolerance {
        /// Time at the start of the piece.
        time: f64,
        /// Length of the piece.
        step: f64,
        /// Relative error estimate there.
        estimate: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// More substeps between two events than are allowed do not meet the tolerance.
    #[error(
        "from time {time} on the error estimate of the wear depth stays at {estimate:e} relative with {substeps} substeps, \
         expected at most the tolerance {tolerance:e} within {most} (`integrator.most_substeps`); it never falls for a \
         law whose wear depends on the length of the substep, nor where `contact.tolerance` leaves the pressure open"
    )]
    Stalled {
        /// Time at the start of the stretch.
        time: f64,
        /// Substeps that were tried.
        substeps: u64,
        /// Relative error estimate with them.
        estimate: f64,
        /// The tolerance.
        tolerance: f64,
        /// Most substeps.
        most: u64,
    },
    /// Short substeps made too many of them between two events.
    #[error(
        "at time {time} the substeps since the last event are {substeps}, because the law, its tolerance or the stability \
         limit want them short; expected at most {most} (`integrator.most_substeps`)"
    )]
    ManySubsteps {
        /// Time.
        time: f64,
        /// Substeps since the last event.
        substeps: u64,
        /// Most substeps.
        most: u64,
    },
}

/// Whether an error vanishes in the rounding of the wear it is added to.
///
/// Close to a zero crossing the inputs are differences of large numbers: their noise, relative to what little wears
/// there, does not fall with the substep, and only the wear so far says that it does not matter.
pub(crate) fn invisible(error: f64, wear: &[f64]) -> bool {
    error <= 4.0 * f64::EPSILON * norm(wear.iter().copied())
}

/// Euclidean norm of a chunk's values, scaled so that neither tiny nor huge lengths leave the range of doubles.
pub(crate) fn norm(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let largest = values.clone().fold(0.0_f64, |most, v| most.max(v.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    // A power of two scales without rounding.
    let scale = (-largest.log2().floor()).exp2();
    let sum: f64 = values.map(|v| (v * scale) * (v * scale)).sum();
    sum.sqrt() / scale
}
