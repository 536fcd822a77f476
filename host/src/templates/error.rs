//! What can go wrong when a law's folder is made.

use std::path::PathBuf;

/// Why no folder was made.
#[derive(Debug, thiserror::Error)]
pub enum TemplateError {
    /// A name that no law can have.
    #[error("`{name}` cannot be the name of a law, expected {expected}")]
    Name {
        /// The name.
        name: String,
        /// What it may be.
        expected: &'static str,
    },
    /// The folder is there and holds something.
    #[error("the folder `{}` is not empty (it holds `{found}`), expected a new or an empty one", path.display())]
    NotEmpty {
        /// The folder.
        path: PathBuf,
        /// One of its entries.
        found: String,
    },
    /// A file has the folder's name.
    #[error("`{}` is a file, expected the name of a new folder", path.display())]
    NotAFolder {
        /// The file.
        path: PathBuf,
    },
    /// The folder cannot be written.
    #[error("the folder `{}` could not be made: {source}", path.display())]
    Io {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

impl TemplateError {
    /// Whether writing failed, as opposed to the request being wrong.
    pub fn is_io(&self) -> bool {
        matches!(self, Self::Io { .. })
    }
}
