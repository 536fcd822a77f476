//! What the dynamic linker said, in words that name what is missing.

use std::path::PathBuf;

use super::FileFacts;

/// Why the dynamic linker refused a library whose file facts were in order; none of its code has run.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LinkerRefusal {
    /// No loaded library defines a symbol.
    #[error(
        "`{path}` needs the symbol `{symbol}`, which neither it nor the libraries it needs ({}) define",
        list(needed)
    )]
    MissingSymbol {
        /// The library.
        path: PathBuf,
        /// The undefined symbol.
        symbol: String,
        /// The libraries it needs.
        needed: Vec<String>,
    },
    /// Built against a newer system library.
    #[error("`{path}` needs `{version}` of `{library}`, which this system's one is too old to have")]
    MissingVersion {
        /// The library.
        path: PathBuf,
        /// The symbol version, such as `GLIBC_2.38`.
        version: String,
        /// The library that should have it.
        library: String,
    },
    /// A library that it needs, directly or through another, cannot be found.
    #[error(
        "`{path}` needs the library `{library}`, directly or through another, and the dynamic linker does not find it"
    )]
    MissingLibrary {
        /// The library.
        path: PathBuf,
        /// The needed library.
        library: String,
    },
    /// Any other reason, as the linker put it.
    #[error("`{path}` was refused by the dynamic linker, which says: {message}")]
    Other {
        /// The library.
        path: PathBuf,
        /// Its message.
        message: String,
    },
}

impl LinkerRefusal {
    /// Reads the error of a failed `dlopen`.
    pub fn from_error(facts: &FileFacts, error: &libloading::Error) -> Self {
        match error {
            libloading::Error::DlOpen { source } => Self::from_message(facts, &source.to_string()),
            other => Self::from_message(facts, &other.to_string()),
        }
    }

    /// Reads the message of a failed `dlopen` with all symbols resolved at once (RTLD_NOW).
    pub fn from_message(facts: &FileFacts, message: &str) -> Self {
        let path = facts.path.clone();
        let message = message.trim();
        if let Some((_, rest)) = message.split_once("undefined symbol: ") {
            let symbol = rest.split([',', ' ', '\n']).next().unwrap_or(rest).to_owned();
            return Self::MissingSymbol { path, symbol, needed: facts.elf.needed.clone() };
        }
        if message.contains("' not found (required by")
            && let Some((library, rest)) = message.split_once(": version `")
            && let Some((version, _)) = rest.split_once('\'')
        {
            return Self::MissingVersion { path, version: version.to_owned(), library: library.to_owned() };
        }
        if let Some((library, _)) = message.split_once(": cannot open shared object file: No such file")
            && std::path::Path::new(library) != path
        {
            return Self::MissingLibrary { path, library: library.to_owned() };
        }
        Self::Other { path, message: message.to_owned() }
    }
}

fn list(needed: &[String]) -> String {
    if needed.is_empty() { "none".into() } else { needed.join(", ") }
}
