//! Which language a source is in, by the ending of its name.

use std::fmt;
use std::path::{Path, PathBuf};

use super::super::lookup::is_library;
use super::BuildError;

/// A language that laws are built from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// `.c`
    C,
    /// `.cc .cpp .cxx`
    Cpp,
    /// `.f90 .F90 .f95 .f .for`
    Fortran,
    /// `.rs`, built as a crate only.
    Rust,
}

/// The endings that are compiled directly, for messages.
pub(super) const ENDINGS: &str = ".c, .cc, .cpp, .cxx, .f90, .F90, .f95, .f, .for";

impl Language {
    /// The language of a source file's name, `None` for any other ending.
    pub fn of(path: &Path) -> Option<Self> {
        Some(match path.extension()?.to_str()? {
            "c" => Self::C,
            "cc" | "cpp" | "cxx" | "C" | "c++" => Self::Cpp,
            "f90" | "F90" | "f95" | "F95" | "f03" | "f08" | "f" | "F" | "for" => Self::Fortran,
            "rs" => Self::Rust,
            _ => return None,
        })
    }

    /// The Debian package that brings its compiler.
    pub fn debian_package(self) -> &'static str {
        match self {
            Self::C => "gcc",
            Self::Cpp => "g++",
            Self::Fortran => "gfortran",
            Self::Rust => "cargo",
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::C => "C",
            Self::Cpp => "C++",
            Self::Fortran => "Fortran",
            Self::Rust => "Rust",
        })
    }
}

/// Most laws of a folder that an error lists.
const LISTED: usize = 5;

/// What in a folder may be a law: sources and libraries in it, crates below it; a few, sorted.
fn laws_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut found: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    found.retain(|path| {
        let native = Language::of(path).is_some_and(|language| language != Language::Rust);
        native || is_library(path) || path.join("Cargo.toml").is_file()
    });
    found.sort();
    found.iter().take(LISTED).map(|path| path.display().to_string()).collect()
}

/// Sources that belong to one build.
pub(super) enum Sources {
    /// The manifest of a Rust crate.
    RustCrate(PathBuf),
    /// Files for the compilers, in the order given.
    Native(Vec<(PathBuf, Language)>),
}

/// Sorts the sources of a request.
pub(super) fn sort(sources: &[PathBuf]) -> Result<Sources, BuildError> {
    if sources.is_empty() {
        return Err(BuildError::NoSources);
    }
    let mut native = Vec::new();
    for path in sources {
        let metadata =
            std::fs::metadata(path).map_err(|source| BuildError::SourceUnreadable { path: path.clone(), source })?;
        let manifest = if metadata.is_dir() {
            let manifest = path.join("Cargo.toml");
            if !manifest.is_file() {
                return Err(BuildError::FolderWithoutCrate { path: path.clone(), holds: laws_in(path) });
            }
            Some(manifest)
        } else if path.file_name().is_some_and(|name| name == "Cargo.toml") {
            Some(path.clone())
        } else {
            None
        };
        if let Some(manifest) = manifest {
            if sources.len() > 1 {
                return Err(BuildError::CrateWithOthers { path: path.clone() });
            }
            return Ok(Sources::RustCrate(manifest));
        }
        match Language::of(path) {
            Some(Language::Rust) => return Err(BuildError::RustFile { path: path.clone() }),
            Some(language) => native.push((path.clone(), language)),
            None => return Err(BuildError::UnknownEnding { path: path.clone() }),
        }
    }
    Ok(Sources::Native(native))
}
