//! What a library file says without running any of its code.
//!
//! The file is read once; its SHA-256 and its facts come from the same bytes. [`FileFacts::read`] also
//! refuses, in one sentence, whatever the dynamic linker would refuse or would end the process over; what
//! stays in doubt is left to the linker, whose answer [`LinkerRefusal`] puts into words. Loading is not here.

mod elf_file;
mod library_search;
mod linker_refusal;
mod look_alike;
mod sanitizer;
#[cfg(test)]
mod tests;
#[cfg(all(test, unix))]
mod tests_load;
#[cfg(all(test, unix))]
mod tests_needs;

pub use elf_file::ElfFacts;
pub use linker_refusal::LinkerRefusal;
pub use look_alike::LookAlike;
pub use sanitizer::Sanitizer;

use std::io::Read;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// The function that every wear-law library of this major version exports.
pub const ENTRY_SYMBOL: &str = "wearlaw_entry_1";

/// The symbol that carries the type layout of a law written in Rust.
pub const LAYOUT_SYMBOL: &str = "wearlaw_layout_1";

/// The major version of the ABI that this host speaks.
pub const MAJOR_VERSION: u32 = 1;

/// The facts of a library file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileFacts {
    /// The file, as it was named.
    pub path: PathBuf,
    /// Size in bytes.
    pub size: u64,
    /// SHA-256 of the whole file, 64 lower-case hexadecimal digits.
    pub sha256: String,
    /// What its headers say: architecture, exports, needed libraries.
    pub elf: ElfFacts,
}

/// Why a file is not a wear-law library that this process could load.
#[derive(Debug, thiserror::Error)]
pub enum FileFactsError {
    /// Nothing has this name.
    #[error("no file `{path}`, expected a wear-law library")]
    NotFound {
        /// The name that was given.
        path: PathBuf,
    },
    /// A folder, a pipe or a device.
    #[error("`{path}` is a {found}, expected a wear-law library file")]
    NotAFile {
        /// The name that was given.
        path: PathBuf,
        /// What it is instead.
        found: &'static str,
    },
    /// The operating system would not let it be read.
    #[error("`{path}` could not be read: {source}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// No bytes at all.
    #[error("`{path}` is empty, expected a wear-law library")]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// Something else than a shared library.
    #[error("`{path}` is not a shared library but {found}{}", found.hint())]
    NotALibrary {
        /// The file.
        path: PathBuf,
        /// What it looks like.
        found: LookAlike,
    },
    /// The headers describe more bytes than there are.
    #[error("`{path}` is cut short: it holds {found} bytes, its headers describe {expected}")]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Bytes found.
        found: u64,
        /// Bytes that the headers account for.
        expected: u64,
    },
    /// The headers contradict themselves.
    #[error("`{path}` is a damaged shared library: {what}")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The part that cannot be followed.
        what: &'static str,
    },
    /// Made for another processor.
    #[error("`{path}` is built for {found}, this program runs on {expected}")]
    OtherArchitecture {
        /// The file.
        path: PathBuf,
        /// Its architecture.
        found: String,
        /// The host's architecture.
        expected: &'static str,
    },
    /// Made for another operating system.
    #[error("`{path}` is built for {found}, this program runs on Linux")]
    OtherSystem {
        /// The file.
        path: PathBuf,
        /// Its operating system.
        found: String,
    },
    /// No entry of any version.
    #[error("`{path}` exports no function `{ENTRY_SYMBOL}`, so it is no wear law{}", near_miss_words(near_miss))]
    NoEntry {
        /// The file.
        path: PathBuf,
        /// An exported symbol that was probably meant to be the entry.
        near_miss: Option<String>,
    },
    /// An entry of another major version.
    #[error(
        "`{path}` exports {}, this host speaks major version {MAJOR_VERSION} (`{ENTRY_SYMBOL}`)",
        entry_names(found)
    )]
    OtherMajorVersion {
        /// The file.
        path: PathBuf,
        /// The major versions it has entries for.
        found: Vec<u32>,
    },
    /// A needed library is nowhere to be found.
    #[error("`{path}` needs the library `{library}`, which is not there{}", folder_names(searched))]
    MissingLibrary {
        /// The file.
        path: PathBuf,
        /// The needed library's name.
        library: String,
        /// The folders that were looked into.
        searched: Vec<PathBuf>,
    },
    /// A sanitizer's runtime would have to be there from the start of the process.
    #[error(
        "`{path}` is built with the {sanitizer} and needs its runtime `{runtime}` from the start of the process: start \
         this program with `{}`",
        sanitizer.preload(runtime)
    )]
    SanitizerRuntime {
        /// The file.
        path: PathBuf,
        /// Which sanitizer.
        sanitizer: Sanitizer,
        /// The runtime library, or the symbol that asks for it.
        runtime: String,
    },
}

/// Why a file is not the one that was pinned.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub enum PinMismatch {
    /// Another file.
    #[error("`{path}` has the SHA-256 {found}, expected {expected}")]
    Differs {
        /// The file.
        path: PathBuf,
        /// Its SHA-256.
        found: String,
        /// The pinned SHA-256.
        expected: String,
    },
    /// The pin itself cannot be a SHA-256.
    #[error("the pin `{pin}` for `{path}` is not a SHA-256, expected 64 hexadecimal digits")]
    NotASha256 {
        /// The file.
        path: PathBuf,
        /// What was given.
        pin: String,
    },
}

impl FileFacts {
    /// Reads a file's facts and refuses whatever could not be loaded as a wear law; runs no code of it.
    ///
    /// # Errors
    /// Everything that [`FileFacts::examine`] and [`FileFacts::check_loadable`] refuse.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileFactsError> {
        let facts = Self::examine(path)?;
        facts.check_loadable()?;
        Ok(facts)
    }

    /// Reads the facts of any whole shared library of this machine's kind, whether it holds a law or not.
    ///
    /// # Errors
    /// Not found, not a regular file, unreadable, empty, not a shared library, truncated, damaged, or made
    /// for another architecture or operating system.
    pub fn examine(path: impl AsRef<Path>) -> Result<Self, FileFactsError> {
        let path = path.as_ref();
        let bytes = read_library(path)?;
        let elf = ElfFacts::parse(path, &bytes)?;
        Ok(Self { path: path.to_path_buf(), size: bytes.len() as u64, sha256: sha256_hex(&bytes), elf })
    }

    /// Checks that the library has the entry of this major version and that its needs can be met.
    ///
    /// # Errors
    /// No entry, an entry of another major version, a sanitizer's runtime that is not in this process, or a
    /// needed library that is nowhere to be found.
    pub fn check_loadable(&self) -> Result<(), FileFactsError> {
        let path = || self.path.clone();
        let elf = &self.elf;
        if !elf.has_entry {
            return Err(if elf.other_majors.is_empty() {
                FileFactsError::NoEntry { path: path(), near_miss: elf.near_miss.clone() }
            } else {
                FileFactsError::OtherMajorVersion { path: path(), found: elf.other_majors.clone() }
            });
        }
        // The sanitizer comes first: its runtime is often also a library that is not installed.
        if let Some((sanitizer, runtime)) = sanitizer::runtime_wanted(elf) {
            return Err(FileFactsError::SanitizerRuntime { path: path(), sanitizer, runtime });
        }
        if let Some((library, searched)) = library_search::first_missing(&self.path, elf) {
            return Err(FileFactsError::MissingLibrary { path: path(), library, searched });
        }
        Ok(())
    }
}

/// Checks a file against the SHA-256 that a scene pins (`[law] sha256`), in either case of letters.
///
/// # Errors
/// The pin is of another file, or is not a SHA-256 at all.
pub fn check_pin(facts: &FileFacts, expected_sha256: &str) -> Result<(), PinMismatch> {
    let expected = expected_sha256.trim().to_ascii_lowercase();
    let path = facts.path.clone();
    if expected.len() != 64 || !expected.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(PinMismatch::NotASha256 { path, pin: expected_sha256.to_owned() });
    }
    if expected != facts.sha256 {
        return Err(PinMismatch::Differs { path, found: facts.sha256.clone(), expected });
    }
    Ok(())
}

/// Reads the whole file, but only once its first bytes say that it can be a library.
///
/// Read rather than mapped: a compiler that rewrites a mapped file in place would end this process (SIGBUS).
fn read_library(path: &Path) -> Result<Vec<u8>, FileFactsError> {
    let name = || path.to_path_buf();
    let unreadable = |source: std::io::Error| match source.kind() {
        std::io::ErrorKind::NotFound => FileFactsError::NotFound { path: name() },
        _ => FileFactsError::Unreadable { path: name(), source },
    };
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(FileFactsError::NotAFile { path: name(), found: "folder" });
    }
    if !metadata.is_file() {
        // Opening a pipe would wait for a writer, reading a device might never end.
        return Err(FileFactsError::NotAFile { path: name(), found: "pipe, socket or device" });
    }
    let mut file = std::fs::File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::with_capacity(4096);
    Read::by_ref(&mut file).take(4096).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.is_empty() {
        return Err(FileFactsError::Empty { path: name() });
    }
    if let Some(found) = LookAlike::of_no_elf(path, &bytes) {
        return Err(FileFactsError::NotALibrary { path: name(), found });
    }
    bytes.reserve(usize::try_from(metadata.len()).unwrap_or(0).saturating_sub(bytes.len()));
    file.read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

fn sha256_hex(bytes: &[u8]) -> String {
    use std::fmt::Write;
    Sha256::digest(bytes).iter().fold(String::with_capacity(64), |mut hex, byte| {
        let _ = write!(hex, "{byte:02x}");
        hex
    })
}

fn near_miss_words(near_miss: &Option<String>) -> String {
    match near_miss.as_deref() {
        None => String::new(),
        Some(name) if name.starts_with("_Z") => {
            format!("; its export `{name}` is a C++ name: declare the function extern \"C\"")
        }
        Some(name) if name == ENTRY_SYMBOL => {
            format!("; its export `{name}` is data, not a function")
        }
        Some(name) if name.starts_with("__") => {
            format!(
                "; its export `{name}` lies in a Fortran module: give the function bind(c, name=\"{ENTRY_SYMBOL}\")"
            )
        }
        Some(name) => format!("; its export `{name}` comes close (in Fortran: bind(c, name=\"{ENTRY_SYMBOL}\"))"),
    }
}

fn entry_names(majors: &[u32]) -> String {
    majors.iter().map(|major| format!("`wearlaw_entry_{major}`")).collect::<Vec<_>>().join(" and ")
}

fn folder_names(folders: &[PathBuf]) -> String {
    if folders.is_empty() {
        return String::new();
    }
    let names = folders.iter().map(|folder| folder.display().to_string()).collect::<Vec<_>>().join(", ");
    format!(" (searched: {names})")
}
