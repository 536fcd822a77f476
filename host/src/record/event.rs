//! What a run tells while it goes on.

use super::{Checkpoint, HistoryRow, Snapshot};

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
    /// A place to go on from, of which [`Observer::wants_checkpoint`] said that it is wanted.
    Checkpoint {
        /// Everything that the rest of the run depends on.
        checkpoint: &'a Checkpoint<'a>,
        /// Whether the run ends here.
        last: bool,
    },
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

    /// Whether to be told of a checkpoint now; asked after every step or stretch that can be gone on from, and once more
    /// when the run ends (`last`), before its last fields are told.
    fn wants_checkpoint(&mut self, last: bool) -> bool {
        let _ = last;
        false
    }
}

/// Listens to nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nobody;

impl Observer for Nobody {
    fn observe(&mut self, _event: Event<'_>) -> Wish {
        Wish::GoOn
    }
}
