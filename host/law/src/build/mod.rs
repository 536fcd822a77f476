//! From the sources of a wear law to a library.
//!
//! C, C++ and Fortran sources go through the system's compilers with the headers that this program carries, user
//! subroutines of other solvers with a layer around them (`adapt`); a Rust crate goes through cargo. A library appears whole, under its name, or not at all. Loading it is not here.

pub mod adapt;
mod cargo;
mod command;
mod error;
pub mod headers;
mod language;
mod native;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_crate;

pub use error::BuildError;
pub use headers::CARRIED;
pub use language::Language;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to build, and how.
#[derive(Debug, Clone, Default)]
pub struct BuildRequest {
    /// Source files of C, C++ and Fortran, or one Rust crate: its folder or its `Cargo.toml`.
    pub sources: Vec<PathBuf>,
    /// The library to write; `None`: `lib` + the first source's name (or the crate's) in the current folder.
    pub output: Option<PathBuf>,
    /// Folders searched for headers, before the carried ones.
    pub include_dirs: Vec<PathBuf>,
    /// Further flags for every compiler call (for cargo: for `cargo build`), after all others.
    pub extra_flags: Vec<OsString>,
    /// Compilers to use.
    pub compilers: Compilers,
    /// The first source holds a user subroutine of another solver, which becomes a law.
    pub adaptation: Option<adapt::Adaptation>,
}

/// Commands to use instead of the usual compilers; a command may carry flags behind blanks.
#[derive(Debug, Clone, Default)]
pub struct Compilers {
    /// `None`: `$CC`, else `cc`.
    pub c: Option<OsString>,
    /// `None`: `$CXX`, else `c++`.
    pub cpp: Option<OsString>,
    /// `None`: `$FC`, else `gfortran`.
    pub fortran: Option<OsString>,
    /// `None`: `$CARGO`, else `cargo`.
    pub cargo: Option<OsString>,
}

/// A library that was built.
#[derive(Debug, Clone)]
pub struct Built {
    /// The library.
    pub library: PathBuf,
    /// The commands that were run, as one would type them.
    pub commands: Vec<String>,
    /// What the compilers said, as they said it.
    pub messages: String,
    /// Wall time of the build, s.
    pub seconds: f64,
}

/// Builds a wear-law library.
///
/// C, C++ and Fortran are compiled with `-O3 -fPIC -Wall -ffp-contract=off` for the baseline processor of this
/// machine's architecture: a law then gives the same numbers on every machine, and the same as a law in Rust,
/// which never contracts either. `CFLAGS`, `CXXFLAGS` and `FFLAGS` are respected. All symbols must be defined.
///
/// # Errors
/// See [`BuildError`]; whatever goes wrong, a library that stood under the output's name stays as it was.
pub fn build(request: &BuildRequest) -> Result<Built, BuildError> {
    let start = Instant::now();
    let what = language::sort(&request.sources)?;
    let (library, log) = match what {
        language::Sources::RustCrate(manifest) if request.adaptation.is_some() => {
            let what = "found a Rust crate, expected a Fortran source".to_owned();
            return Err(BuildError::NoSubroutine { path: manifest, what });
        }
        language::Sources::RustCrate(manifest) => cargo::build(request, &manifest)?,
        language::Sources::Native(sources) => native::build(request, &sources)?,
    };
    Ok(Built { library, commands: log.commands, messages: log.messages, seconds: start.elapsed().as_secs_f64() })
}

/// The file name of a library of this system: `liblaw.so` for `law`.
fn library_file_name(stem: &str) -> String {
    format!("{}{stem}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX)
}

/// A folder beside the output, to make the library in, so that a rename brings it whole into its place.
struct Aside {
    folder: tempfile::TempDir,
    output: PathBuf,
}

impl Aside {
    fn new(output: &Path) -> Result<Self, BuildError> {
        let fail = |source| BuildError::OutputNotWritable { path: output.to_path_buf(), source };
        if output.is_dir() {
            return Err(fail(std::io::Error::from(std::io::ErrorKind::IsADirectory)));
        }
        let parent = output.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = tempfile::Builder::new().prefix(".wearlaw-build-").tempdir_in(parent).map_err(fail)?;
        Ok(Self { folder, output: output.to_path_buf() })
    }

    /// Where to make the library.
    fn library(&self) -> PathBuf {
        self.folder.path().join("library")
    }

    /// Brings the library into its place.
    fn finish(self) -> Result<PathBuf, BuildError> {
        match std::fs::rename(self.library(), &self.output) {
            Ok(()) => Ok(self.output),
            Err(source) => Err(BuildError::OutputNotWritable { path: self.output, source }),
        }
    }
}
