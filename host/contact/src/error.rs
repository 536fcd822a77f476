//! Why a contact problem has no answer.

/// Why a contact problem could not be solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The iterations ended before the tolerance was met.
    #[error(
        "the contact solve stays at a complementarity error of {error:.2e} after {iterations} iterations, expected at \
         most {tolerance:e} (`contact.tolerance`); the best state was kept"
    )]
    NotConverged {
        /// Iterations.
        iterations: u64,
        /// Error reached.
        error: f64,
        /// Error asked for.
        tolerance: f64,
    },
    /// The approach is beyond what the model can answer.
    #[error(
        "the approach {approach:e} has no solution: a periodic surface is in full contact from {most:e} on, and its \
         mean displacement is not determined; expected less, or a load"
    )]
    NoSolution {
        /// The approach asked for.
        approach: f64,
        /// The approach at full contact.
        most: f64,
    },
    /// There is a load and nowhere that could carry it.
    #[error("a load of {load:e} is given, but no cell can touch: every gap is infinite")]
    NowhereToTouch {
        /// The load.
        load: f64,
    },
    /// Numbers left the range of doubles.
    #[error(
        "the contact solve met {what} that is not finite; gaps are up to {gap:e}, the load or approach is {given:e}"
    )]
    NotFinite {
        /// What.
        what: &'static str,
        /// Largest gap.
        gap: f64,
        /// What was given.
        given: f64,
    },
}
