//! Which law a name means: one of this program, a library, or sources that are built first.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::build::Language;
use super::embedded;

/// What a name of a law stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum LawSource {
    /// A law of this program, by its name.
    Embedded(&'static str),
    /// A library file, which may not exist.
    Library(PathBuf),
    /// A source file, a crate's folder or its manifest.
    Source(PathBuf),
}

/// A law's place, and its name there where that was given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Where it is.
    pub source: LawSource,
    /// Which of several laws: what stands behind a `#`.
    pub law: Option<String>,
}

/// Why a name is no law.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LookupError {
    /// A bare name that nothing has.
    #[error(
        "found no law `{name}`, neither in this program ({}) nor as the library {library} with it{}",
        names(known),
        suggestion(nearest)
    )]
    Unknown {
        /// The name.
        name: String,
        /// The laws of this program.
        known: Vec<String>,
        /// The file name that was looked for.
        library: String,
        /// The law of this program that was probably meant.
        nearest: Option<&'static str>,
    },
    /// A bare name that is also a file or folder beside the scene.
    #[error("found no law `{name}`; for the {kind} of that name write `./{name}`")]
    PathWithoutSlash {
        /// The name.
        name: String,
        /// `file` or `folder`.
        kind: &'static str,
    },
    /// A path to sources that are not there.
    #[error("no file `{}`, expected the source of a wear law", path.display())]
    NoSource {
        /// The path.
        path: PathBuf,
    },
    /// `embedded:` with a law that is not.
    #[error("found no law `{name}` in this program, expected {}", names(known))]
    NotEmbedded {
        /// The name.
        name: String,
        /// The laws of this program.
        known: Vec<String>,
    },
}

/// Finds what `name` stands for; relative paths start from `base`.
///
/// `embedded:archard` is always this program's own. A name with a `/` or the ending of a library, a source or a
/// manifest is a path. `LIB#NAME` is the law `NAME` of a library with several. A bare name is first the library `libwearlaw_NAME.so` in the
/// [`library_folders`], then a law of this program.
///
/// # Errors
/// A name that nothing has; whether a path exists is found out by whoever opens it.
pub fn find(name: &str, base: &Path) -> Result<Found, LookupError> {
    let (place, law) = match name.rsplit_once('#') {
        // A file may have the character in its name.
        Some((place, law)) if !law.contains('/') && !base.join(name).exists() => (place, Some(law.to_owned())),
        _ => (name, None),
    };
    Ok(Found { source: find_near(place, base, &library_folders())?, law })
}

/// The folders in which laws of a bare name are looked for: beside the program, `deps/` there, `../lib/wearlaw/`.
pub fn library_folders() -> Vec<PathBuf> {
    let program = std::env::current_exe().and_then(|path| path.canonicalize());
    let Some(folder) = program.ok().and_then(|path| path.parent().map(Path::to_path_buf)) else {
        return Vec::new();
    };
    let lib = folder.parent().map(|prefix| prefix.join("lib").join("wearlaw"));
    [Some(folder.clone()), Some(folder.join("deps")), lib].into_iter().flatten().collect()
}

fn find_near(name: &str, base: &Path, folders: &[PathBuf]) -> Result<LawSource, LookupError> {
    let known = || embedded::NAMES.iter().map(|&name| name.to_owned()).collect();
    let own = |wanted: &str| embedded::NAMES.iter().find(|&&name| name == wanted).copied();
    if let Some(wanted) = name.strip_prefix("embedded:") {
        let found = own(wanted).map(LawSource::Embedded);
        return found.ok_or_else(|| LookupError::NotEmbedded { name: wanted.to_owned(), known: known() });
    }
    if is_path(name) {
        // `scenes/law.so` reads better than `scenes/./law.so`.
        let path = base.join(name.strip_prefix("./").unwrap_or(name));
        // A folder that is named like a library is a library gone wrong, not a crate.
        let source = path.is_dir() && !is_library(&path) || is_manifest(&path) || Language::of(&path).is_some();
        return Ok(if source { LawSource::Source(path) } else { LawSource::Library(path) });
    }
    let mut installed = folders.iter().map(|folder| folder.join(library_name(name)));
    if let Some(library) = installed.find(|path| path.is_file()) {
        return Ok(LawSource::Library(library));
    }
    if let Some(own) = own(name) {
        return Ok(LawSource::Embedded(own));
    }
    let beside = base.join(name);
    if beside.exists() {
        let kind = if beside.is_dir() { "folder" } else { "file" };
        return Err(LookupError::PathWithoutSlash { name: name.to_owned(), kind });
    }
    let library = library_name(name);
    Err(LookupError::Unknown { name: name.to_owned(), known: known(), library, nearest: nearest(name) })
}

/// The file name under which a law is installed as a library.
fn library_name(law: &str) -> String {
    let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    format!("{prefix}wearlaw_{}{suffix}", law.replace('-', "_"))
}

fn is_path(name: &str) -> bool {
    let path = Path::new(name);
    name.contains(['/', std::path::MAIN_SEPARATOR])
        || is_library(path)
        || name.contains(".so.")
        || is_manifest(path)
        || Language::of(path).is_some()
        || [".", ".."].contains(&name)
}

/// Whether a file is a library by its name.
pub fn is_library(path: &Path) -> bool {
    path.extension().is_some_and(|end| ["so", "dylib", "dll"].iter().any(|known| end == *known))
}

fn is_manifest(path: &Path) -> bool {
    path.file_name() == Some(OsStr::new("Cargo.toml"))
}

fn names(known: &[String]) -> String {
    known.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// A law of this program that differs by a slip of the fingers.
fn nearest(name: &str) -> Option<&'static str> {
    let close = |known: &&str| strsim::damerau_levenshtein(name, known) <= 1 + known.len() / 4;
    embedded::NAMES.iter().copied().find(close)
}

fn suggestion(nearest: &Option<&str>) -> String {
    match nearest {
        Some(name) => format!("; did you mean `{name}`?"),
        None => "; a path to one needs a `/` or an ending such as .so, .c, .cpp, .f90".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(name: &str) -> Result<LawSource, LookupError> {
        find_near(name, Path::new("scenes"), &[])
    }

    #[test]
    fn a_slash_or_an_ending_makes_a_path() {
        let library = |path: &str| Ok(LawSource::Library(path.into()));
        let source = |path: &str| Ok(LawSource::Source(path.into()));
        assert_eq!(found("./mine.so"), library("scenes/mine.so"));
        assert_eq!(found("mine.so"), library("scenes/mine.so"));
        assert_eq!(found("libmine.so.1"), library("scenes/libmine.so.1"));
        assert_eq!(found("/tmp/no-such/law"), library("/tmp/no-such/law"));
        for name in ["law.c", "law.cpp", "law.f90", "crate/Cargo.toml"] {
            assert_eq!(found(name), source(&format!("scenes/{name}")));
        }
        assert_eq!(find_near("/tmp", Path::new("a"), &[]), source("/tmp"));
    }

    #[test]
    fn a_bare_name_is_an_installed_library_first_and_then_a_law_of_the_program() {
        let folder = tempfile::tempdir().unwrap();
        let folders = [folder.path().join("empty"), folder.path().to_path_buf()];
        assert_eq!(find_near("archard", Path::new("."), &folders), Ok(LawSource::Embedded("archard")));
        for name in ["archard", "my-law"] {
            let library = folder.path().join(library_name(name));
            std::fs::write(&library, "").unwrap();
            assert_eq!(find_near(name, Path::new("."), &folders), Ok(LawSource::Library(library)));
        }
        let own = find_near("embedded:archard", Path::new("."), &folders);
        assert_eq!(own, Ok(LawSource::Embedded("archard")));
    }

    #[test]
    fn a_law_of_several_stands_behind_a_hash() {
        let found = find("./two.so#second", Path::new("")).unwrap();
        assert_eq!((found.source, found.law.as_deref()), (LawSource::Library("two.so".into()), Some("second")));
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a#b.so"), "").unwrap();
        assert_eq!(find("a#b.so", folder.path()).unwrap().law, None);
    }

    #[test]
    fn an_unknown_name_lists_what_there_is() {
        let message = found("archad").unwrap_err().to_string();
        assert!(message.contains("`archad`") && message.ends_with("did you mean `archard`?"), "{message}");
        let message = found("friction").unwrap_err().to_string();
        assert!(message.contains("libwearlaw_friction.so") && message.contains("needs a `/`"), "{message}");
        let message = found("embedded:mine").unwrap_err().to_string();
        assert!(message.contains("`mine`") && message.contains("`archard`"), "{message}");
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("mine")).unwrap();
        let message = find_near("mine", folder.path(), &[]).unwrap_err().to_string();
        assert!(message.contains("folder") && message.contains("`./mine`"), "{message}");
    }
}
