//! Why a law could not be measured.

use thiserror::Error;

use super::laid::AskError;
use crate::law::{BatchError, EvaluateError, IsolateError, LoadError};

/// Why a law could not be measured.
#[derive(Debug, Error)]
pub enum BenchError {
    /// A library gives no law.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The law could not be opened in a process of its own, where it is tried before it is called here.
    #[error(transparent)]
    Isolate(#[from] IsolateError),
    /// The law answers no point that was tried.
    #[error(
        "law `{law}` refused every ordinary point that was tried{}; rows in expected.csv give constants to try",
        last.as_ref().map_or(String::new(), |reason| format!(", the last because {reason}"))
    )]
    NoInputs {
        /// The law.
        law: String,
        /// Why it refused the last one.
        last: Option<String>,
    },
    /// The law failed at points that it had answered one by one.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// The law wants a shorter substep for points that it had answered one by one.
    #[error("law `{law}` wants a shorter substep for {points} points that it answers one by one")]
    CutStep {
        /// The law.
        law: String,
        /// Points of the call.
        points: usize,
    },
    /// A call was laid out wrongly.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// The table of known values that was asked for does not fit.
    #[error("{reason}")]
    Expected {
        /// What is wrong with it.
        reason: String,
    },
    /// The system gave no threads.
    #[error("{threads} threads could not be started: {reason}")]
    Threads {
        /// How many.
        threads: usize,
        /// What the thread pool said.
        reason: String,
    },
    /// Ctrl-C, or a request to end.
    #[error("interrupted")]
    Interrupted,
}

impl From<AskError> for BenchError {
    fn from(error: AskError) -> Self {
        match error {
            AskError::Batch(error) => error.into(),
            AskError::Law(error) => error.into(),
        }
    }
}
