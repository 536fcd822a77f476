//! From the name of a law in a scene, or on the command line, to a law that is loaded.

use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::build::compiled;
use super::console::Console;
use super::inspect::opened_embedded;
use super::interrupt::Interrupt;
use crate::error::{Error, UsageError};
use crate::law::build::BuildRequest;
use crate::law::lookup::{self, LawSource};
use crate::law::{Law, LoadError, LoadOptions, Plugin};
use crate::scene::{Located, Scene};

/// A law of a scene, loaded but not created.
#[derive(Debug)]
pub(super) struct OpenedLaw {
    /// The library, or this program's own laws.
    pub(super) plugin: Plugin,
    /// The law.
    pub(super) law: Law,
    /// The path or name that it came from, for reports.
    pub(super) origin: String,
    /// The library's file, where there is one.
    pub(super) library: Option<PathBuf>,
    /// Wall time of compiling it, s; `None` where nothing was compiled.
    pub(super) build_seconds: Option<f64>,
    /// Where it was built; it goes when the law goes.
    _room: Option<TempDir>,
}

/// Loads the law of a scene, or the one of `--law`, which is looked for from the current folder.
pub(super) fn open(
    console: &Console,
    interrupt: &Interrupt,
    scene: &Scene,
    instead: Option<&str>,
) -> Result<OpenedLaw, Error> {
    let found = match instead {
        Some(name) => lookup::find(name, Path::new("")).map_err(|error| Located::new(error, None))?,
        None => {
            let base = scene.file.parent().unwrap_or(Path::new(""));
            lookup::find(&scene.law.plugin, base).map_err(|error| scene.error_at("law.use", error))?
        }
    };
    let options = LoadOptions { sha256: scene.law.sha256.clone() };
    let mut room = None;
    let mut build_seconds = None;
    let (plugin, library, origin) = match found.source {
        LawSource::Embedded(name) => (opened_embedded(name)?, None, format!("embedded:{name}")),
        LawSource::Library(path) => {
            let origin = path.display().to_string();
            (Plugin::open(&path, &options)?, Some(path), origin)
        }
        LawSource::Source(path) => {
            let place = temporary()?;
            let library = place.path().join(library_name(&path));
            room = Some(place);
            let origin = path.display().to_string();
            let request =
                BuildRequest { sources: vec![path], output: Some(library.clone()), ..BuildRequest::default() };
            let built = interrupt.over(compiled(console, &request))?;
            build_seconds = Some(built.seconds);
            (Plugin::open(&library, &options)?, Some(library), origin)
        }
    };
    let law = plugin.law(found.law.as_deref()).map_err(|error| several(error, &origin))?.clone();
    Ok(OpenedLaw { plugin, law, origin, library, build_seconds, _room: room })
}

/// Says how a scene names one of several laws.
fn several(error: LoadError, origin: &str) -> Error {
    match error {
        LoadError::Ambiguous { known, .. } => UsageError::SeveralLaws { origin: origin.to_owned(), known }.into(),
        other => other.into(),
    }
}

fn temporary() -> Result<TempDir, Error> {
    let made = tempfile::Builder::new().prefix("wearlaw-law-").tempdir();
    made.map_err(|source| Error::Temporary { path: std::env::temp_dir(), source })
}

fn library_name(source: &Path) -> String {
    let stem = source.file_stem().unwrap_or_default().to_string_lossy();
    let stem = if stem.is_empty() || stem == "." || stem == ".." { "law".into() } else { stem };
    format!("{}{stem}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX)
}
