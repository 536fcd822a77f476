//! What can be wrong with a sweep.

use std::path::PathBuf;

/// Why there are no cases to run, or no table of them.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// Text of `--vary` that is none.
    #[error("--vary {text}: found {found}, expected KEY=VALUE,VALUE,.. or KEY=FIRST..LAST:COUNT, or :COUNT:log")]
    Vary {
        /// The text.
        text: String,
        /// What is wrong.
        found: String,
    },
    /// A key that two options vary.
    #[error("`{key}` is varied twice, expected once")]
    Twice {
        /// The key.
        key: String,
    },
    /// Text of `--shard` that is none.
    #[error("--shard {text}: expected I/N, shards counted from 1 to N")]
    Shard {
        /// The text.
        text: String,
    },
    /// More cases than anybody wants.
    #[error("{count} cases, expected at most {most}")]
    Many {
        /// Their number.
        count: u128,
        /// The largest number.
        most: usize,
    },
    /// A file of cases that cannot be read.
    #[error("could not read the cases in {}: {source}", path.display())]
    Cases {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// A file of cases without any, or with an empty cell or name.
    #[error("{}:{line}: found {found}, expected {expected}", path.display())]
    Cell {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// What was found.
        found: String,
        /// What should have been there.
        expected: &'static str,
    },
    /// A row of an earlier sweep that is none.
    #[error("{} is no case of a sweep ({reason}); remove it to have it run again", path.display())]
    Row {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}
