//! What can go wrong between a record and its files.

use std::io;
use std::path::{Path, PathBuf};

/// A result that could not be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The system refused an operation on a file or folder.
    #[error("could not {action} {}: {source}", path.display())]
    Io {
        /// What was tried: `create`, `write`, `rename`, ..
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// Why it failed.
        source: io::Error,
    },
    /// The folder for results holds something else.
    #[error(
        "folder {} holds {found} and no report.json of an earlier run, expected a new or empty folder or an earlier result",
        path.display()
    )]
    NotAResult {
        /// The folder.
        path: PathBuf,
        /// One of the entries that no run writes.
        found: String,
    },
    /// The folder for results holds a report that no run wrote.
    #[error("{} is not the report of a run, expected a new or empty folder or an earlier result", report.display())]
    ForeignReport {
        /// The file.
        report: PathBuf,
    },
    /// The folder for results is a file.
    #[error("{} is a file, expected a folder for results or a new name", path.display())]
    NotAFolder {
        /// The file.
        path: PathBuf,
    },
    /// A result would replace a file that no run wrote.
    #[error("{} exists and is not the work of an earlier run, expected a free name", path.display())]
    InTheWay {
        /// The file or folder that stays.
        path: PathBuf,
    },
    /// A file that is no checkpoint.
    #[error("{} is no checkpoint of a run", path.display())]
    NotACheckpoint {
        /// The file.
        path: PathBuf,
    },
    /// A checkpoint in another layout.
    #[error(
        "checkpoint {} has layout {found}, expected {expected}: another version of the program wrote it",
        path.display()
    )]
    CheckpointVersion {
        /// The file.
        path: PathBuf,
        /// Its layout.
        found: u64,
        /// The one that is read here.
        expected: u64,
    },
    /// A checkpoint that is not as it was written.
    #[error("checkpoint {} is damaged: {what}", path.display())]
    CheckpointDamaged {
        /// The file.
        path: PathBuf,
        /// What was found.
        what: &'static str,
    },
    /// Fields that a checkpoint counts on are not there any more.
    #[error("{} has {found}, expected the {expected} bytes that the checkpoint counts on", path.display())]
    EarlierFields {
        /// The file.
        path: PathBuf,
        /// What was found, in words.
        found: String,
        /// Its length when the checkpoint was written.
        expected: u64,
    },
    /// An array does not have the numbers that its geometry asks for.
    #[error("`{name}` holds {found} numbers, expected {expected} ({points} points, {components} each)")]
    FieldLength {
        /// Field, or `coordinates`.
        name: String,
        /// Numbers in the array.
        found: usize,
        /// Numbers it must have.
        expected: usize,
        /// Points of the geometry.
        points: usize,
        /// Numbers per point.
        components: usize,
    },
    /// Two columns of a snapshot would have one name.
    #[error("two fields are called `{name}`, expected one name for each")]
    TwoOfOneName {
        /// The name.
        name: String,
    },
    /// The figure could not be drawn.
    #[error("could not draw {}: {source}", path.display())]
    Drawing {
        /// The file of the figure.
        path: PathBuf,
        /// What the drawing library found.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl OutputError {
    /// Wraps an input or output error with what was tried on which path.
    pub(super) fn io(action: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { action, path, source }
    }
}
