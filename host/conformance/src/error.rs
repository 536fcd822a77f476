//! Why checks could not be run at all.

use std::path::PathBuf;

use thiserror::Error;

/// Why checks could not be run at all; what a law does wrong is no error but a result.
#[derive(Debug, Error)]
pub enum ConformanceError {
    /// Another system.
    #[error("checking a law needs Linux")]
    Platform,
    /// A name that no check and no group has.
    #[error("found no check or group `{name}`{}; `wearlaw check --list` shows them", suggestion(nearest))]
    NoSuchCheck {
        /// The name.
        name: String,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// Nothing was run.
    #[error("no check was run: {reason}")]
    NothingRun {
        /// Why not.
        reason: String,
    },
    /// A waiver file is wrong.
    #[error("`{}`: {problem}", path.display())]
    Waiver {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// A replay file is wrong.
    #[error("`{}` is no replay file: {problem}", path.display())]
    Replay {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// A file could not be read.
    #[error("`{}` could not be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file could not be written.
    #[error("`{}` could not be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// No worker could be started.
    #[error("the worker process `{}` could not be started: {source}", program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The checker itself is at fault.
    #[error("check {check}: {what}")]
    Fault {
        /// The check.
        check: &'static str,
        /// The panic's own words.
        what: String,
    },
    /// The user wanted to end.
    #[error("interrupted")]
    Interrupted,
}

/// The name that differs by a slip of the fingers.
pub(super) fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<String> {
    let distance = |known: &&str| strsim::damerau_levenshtein(name, known);
    let found = known.min_by_key(distance)?;
    (distance(&found) <= 1 + found.len() / 4).then(|| found.to_owned())
}

/// A question for the name that was probably meant.
pub(super) fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}
