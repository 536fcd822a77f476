//! What a run tells while it goes on.

use super::{HistoryRow, Snapshot};

/// Something that has just happened.
#[derive(Debug)]
pub enum Event<'a> {
    /// A substep was accepted.
    Step {
        /// The quantities at its end.
        row: &'a HistoryRow,
        /// Accepted steps so far.
        steps: u64,
        /// Part of the represented time that is done, 0 to 1.
        done: f64,
    },
    /// A step was tried whose accuracy is not known yet: a chance to show where the run is, and to stop it.
    Trial {
        /// Represented time.
        time: f64,
        /// Part of the represented time that is done, 0 to 1.
        done: f64,
    },
    /// Fields were asked for at this time.
    Snapshot(&'a Snapshot<'a>),
    /// Something to know that does not end the run.
    Warning(&'a str),
}

/// What an observer wants next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Go on.
    GoOn,
    /// End after this step and keep what was done.
    Stop,
}

/// Whoever listens to a run: a progress bar, a writer of fields, nobody.
pub trait Observer {
    /// Hears of an event and says whether to go on.
    fn observe(&mut self, event: Event<'_>) -> Wish;
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nobody;

impl Observer for Nobody {
    fn observe(&mut self, _event: Event<'_>) -> Wish {
        Wish::GoOn
    }
}
