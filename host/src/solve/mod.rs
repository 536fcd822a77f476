//! Carrying out a plan: the only loop over time.
//!
//! [`Run::prepare`] reads the history and says what memory the run will take; [`Run::go`] advances wear piece by piece,
//! tells an observer, and returns a record that holds what was done however the run ended. Nothing here prints or
//! writes a file, and the same plan gives the same numbers to the bit, whatever the number of threads.

mod chunk;
mod claims;
mod contents;
mod coupled;
mod ending;
mod error;
mod estimate;
mod fields;
mod inputs;
mod kinematics;
mod ladder;
mod moment_batch;
mod odd;
mod prescribed;
mod progress;
mod reference;
mod run;
mod schedule;
mod site;
mod source;
mod sums;
mod sweeps;

pub use error::{PointError, ShortStep, SolveError};
pub use estimate::Estimate;
pub use ladder::{Ladder, Moment, Ordinary, Outcome, OwnMethod, Pressed, Row, Stiff};
pub use reference::{ErrorNorm, Expected, ReferenceError, compare};
pub use run::Run;
