//! Why there is no fit.

use std::path::PathBuf;

/// What is wrong with a fit.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// The measurements cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// The measurements are not what a fit needs.
    #[error("{}{}: found {found}, expected {expected}", path.display(), line.map_or_else(String::new, |line| format!(":{line}")))]
    Data {
        /// The file.
        path: PathBuf,
        /// The line, where it is one.
        line: Option<u64>,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// A name that is varied and cannot be.
    #[error("--vary {name}: found {found}, expected {expected}")]
    Vary {
        /// The name.
        name: String,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The scene does not come to where something was measured.
    #[error("measured at {across} {at}, and the scene ends at {end}: expected a longer scene or earlier measurements")]
    Beyond {
        /// What the measurements are over.
        across: &'static str,
        /// Where the last was taken.
        at: f64,
        /// Where the scene ends.
        end: f64,
    },
    /// A run of the scene with the values that it has, or nearly those.
    #[error("the scene does not run with {values}: {reason}")]
    Run {
        /// The values.
        values: String,
        /// Why.
        reason: String,
    },
    /// The scene with the values that it has.
    #[error(transparent)]
    Scene(#[from] crate::scene::SceneError),
    /// The search ended without an answer.
    #[error("no fit was found: {0}")]
    Search(String),
    /// Somebody ended it.
    #[error("interrupted")]
    Interrupted,
}
