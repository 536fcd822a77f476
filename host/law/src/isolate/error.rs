//! Why a law could not be opened in a worker.

use std::path::PathBuf;

use thiserror::Error;

use super::super::loader::LoadError;

/// Why a law could not be opened in a worker.
#[derive(Debug, Error)]
pub enum IsolateError {
    /// Another system.
    #[error("running a law in a process of its own needs Linux")]
    Platform,
    /// The file was refused before a worker was started.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// The worker could not load the law.
    #[error("{reason}")]
    Refused {
        /// What the loader said in the worker.
        reason: String,
        /// True if code of the law had run by then.
        code_has_run: bool,
    },
    /// The worker could not be started.
    #[error("the worker process `{program}` could not be started: {source}")]
    Start {
        /// The program.
        program: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The worker ended, hung or closed its channel while the law was opened.
    #[error("`{library}` {how} while it was opened")]
    Lost {
        /// The library.
        library: String,
        /// What became of the worker.
        how: String,
    },
    /// What the worker sent cannot be read.
    #[error("the worker of `{library}` sent what is no answer: {reason}")]
    Answer {
        /// The library.
        library: String,
        /// Why it cannot be read.
        reason: String,
    },
}

impl IsolateError {
    /// True if code of the law has run by then: the law failed, where otherwise the input was wrong.
    pub fn code_has_run(&self) -> bool {
        match self {
            Self::Load(error) => error.code_has_run(),
            Self::Refused { code_has_run, .. } => *code_has_run,
            Self::Lost { .. } | Self::Answer { .. } => true,
            Self::Platform | Self::Start { .. } => false,
        }
    }
}
