//! What can go wrong on the way from sources to a library.

use std::path::PathBuf;

use super::language::{ENDINGS, Language};

/// Why no library was built.
#[derive(Debug, thiserror::Error)]
pub enum BuildError {
    /// Nothing to build.
    #[error("no sources given, expected files ending in {ENDINGS}, or a Rust crate")]
    NoSources,
    /// A source is missing or unreadable.
    #[error("source `{path}` could not be read: {source}")]
    SourceUnreadable {
        /// The source.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// A name whose ending says nothing.
    #[error("source `{path}` has an unknown ending, expected {ENDINGS}, or a Rust crate (a folder with Cargo.toml)")]
    UnknownEnding {
        /// The source.
        path: PathBuf,
    },
    /// A folder that is no crate.
    #[error(
        "folder `{path}` holds no Cargo.toml, expected a Rust crate or source files by name{}",
        if holds.is_empty() { String::new() } else { format!(", such as `{}`", holds.join("`, `")) }
    )]
    FolderWithoutCrate {
        /// The folder.
        path: PathBuf,
        /// Sources and libraries in it, and crates below it; a few.
        holds: Vec<String>,
    },
    /// One Rust file instead of its crate.
    #[error("`{path}` is a single Rust file, expected its crate: the folder that holds Cargo.toml")]
    RustFile {
        /// The file.
        path: PathBuf,
    },
    /// A crate together with other sources.
    #[error("the Rust crate `{path}` was given with other sources, expected it alone")]
    CrateWithOthers {
        /// The crate.
        path: PathBuf,
    },
    /// The compiler is not there.
    #[error("no {language} compiler: the command `{command}` was not found (on Debian: apt install {})", language.debian_package())]
    MissingCompiler {
        /// The language.
        language: Language,
        /// The command that was tried.
        command: String,
    },
    /// The compiler is there and could not be started.
    #[error("the command `{command}` could not be started: {source}")]
    NotStarted {
        /// The command.
        command: String,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The `cc` crate could not work out how to call the compiler.
    #[error("no way was found to call the {language} compiler: {source}")]
    Unusable {
        /// The language.
        language: Language,
        /// What it said.
        source: cc::Error,
    },
    /// The compiler said no.
    #[error("compiling failed: `{command}` ended with {}", exit_words(*exit_code))]
    CompilerFailed {
        /// The command, as one would type it.
        command: String,
        /// Its exit code, `None` if a signal ended it.
        exit_code: Option<i32>,
        /// All compiler messages up to here, as they are.
        messages: String,
    },
    /// The output cannot be written.
    #[error("library `{path}` could not be written: {source}")]
    OutputNotWritable {
        /// The output.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The temporary folder for headers and objects cannot be written.
    #[error("temporary files in `{path}` could not be written: {source}")]
    TemporaryFiles {
        /// The folder.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// A source that holds no subroutine of the form that was asked for.
    #[error("source `{path}` cannot be made a law: {what}")]
    NoSubroutine {
        /// The source.
        path: PathBuf,
        /// What was found, and what was expected.
        what: String,
    },
    /// A crate that is no shared library.
    #[error("the Rust crate `{manifest}` gives no shared library, expected [lib] crate-type = [\"cdylib\"] in it")]
    NoCdylib {
        /// The crate's manifest.
        manifest: PathBuf,
    },
}

impl BuildError {
    /// The compiler's messages, empty where no compiler has spoken.
    pub fn messages(&self) -> &str {
        match self {
            Self::CompilerFailed { messages, .. } => messages,
            _ => "",
        }
    }
}

fn exit_words(exit_code: Option<i32>) -> String {
    exit_code.map_or_else(|| "a signal".to_owned(), |code| format!("exit code {code}"))
}
