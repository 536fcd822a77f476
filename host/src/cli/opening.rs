//! From the name of a law in a scene, or on the command line, to a law that can be called.

use std::path::Path;
use std::time::Duration;

use tempfile::TempDir;

use super::args::SceneArguments;
use super::build::compiled;
use super::console::Console;
use super::inspect::opened_embedded;
use super::interrupt::Interrupt;
use crate::conformance::Expected;
use crate::error::{Error, UsageError};
use crate::law::build::BuildRequest;
use crate::law::file_facts::FileFacts;
use crate::law::isolate::{DEADLINE, IsolateError, IsolateOptions, IsolatedLaw, Source};
use crate::law::lookup::{self, LawSource, LookupError};
use crate::law::{Evaluator, LoadError, LoadOptions, Plugin};
use crate::scene::{Located, Scene};

/// A law of a scene, ready to be called.
pub(super) struct OpenedLaw {
    /// The law, in this process or in a worker of its own.
    pub(super) evaluator: Box<dyn Evaluator>,
    /// The path or name that it came from, for reports.
    pub(super) origin: String,
    /// The facts of the library's file; `None` for a law of this program.
    pub(super) facts: Option<FileFacts>,
    /// Wall time of compiling it, s; `None` where nothing was compiled.
    pub(super) build_seconds: Option<f64>,
    /// What was put right while it was loaded.
    pub(super) warnings: Vec<String>,
    /// Where it was built; it goes when the law goes.
    _room: Option<TempDir>,
}

/// Loads the law of a scene, or the one of `--law`, which is looked for from the current folder.
pub(super) fn open(
    console: &Console,
    interrupt: &Interrupt,
    scene: &Scene,
    shared: &SceneArguments,
) -> Result<OpenedLaw, Error> {
    let found = match shared.law.as_deref() {
        Some(name) => lookup::find(name, Path::new("")).map_err(|error| Located::new(error, None))?,
        None => {
            let base = scene.file.parent().unwrap_or(Path::new(""));
            lookup::find(&scene.law.plugin, base).map_err(|error| scene.error_at("law.use", error))?
        }
    };
    let (mut room, mut build_seconds) = (None, None);
    let (origin, source) = match found.source {
        LawSource::Embedded(name) => (format!("embedded:{name}"), Source::Embedded(name.to_owned())),
        LawSource::Library(path) => (path.display().to_string(), Source::File(path)),
        LawSource::Source(path) if !path.exists() => {
            let error = LookupError::NoSource { path };
            return Err(match shared.law {
                Some(_) => Located::new(error, None),
                None => scene.error_at("law.use", error),
            }
            .into());
        }
        LawSource::Source(path) => {
            let place = temporary()?;
            let library = place.path().join(library_name(&path));
            room = Some(place);
            let origin = path.display().to_string();
            let request =
                BuildRequest { sources: vec![path], output: Some(library.clone()), ..BuildRequest::default() };
            build_seconds = Some(interrupt.over(compiled(console, &request))?.seconds);
            (origin, Source::File(library))
        }
    };
    let facts = match &source {
        Source::File(path) => Some(FileFacts::read(path).map_err(|error| match shared.law {
            // What was typed is no place in the scene.
            Some(_) => Error::from(error),
            None => scene.error_at("law.use", error).into(),
        })?),
        Source::Embedded(_) => None,
    };
    let (sha256, options, law) = (scene.law.sha256.clone(), scene.law.options.clone(), found.law);
    let mut warnings = Vec::new();
    let evaluator: Box<dyn Evaluator> = if shared.isolate {
        let deadline = shared.deadline.unwrap_or(DEADLINE);
        let wanted = IsolateOptions { sha256, law, options, deadline, ..IsolateOptions::new(source) };
        Box::new(IsolatedLaw::open(&wanted)?)
    } else {
        let plugin = match &source {
            Source::File(path) => Plugin::open(path, &LoadOptions { sha256 })?,
            Source::Embedded(name) => opened_embedded(name)?,
        };
        warnings.extend_from_slice(plugin.warnings());
        let law = plugin.law(law.as_deref()).map_err(|error| several(error, &origin))?;
        Box::new(law.create(options.as_deref())?)
    };
    Ok(OpenedLaw { evaluator, origin, facts, build_seconds, warnings, _room: room })
}

/// Says how a scene names one of several laws.
pub(super) fn several(error: LoadError, origin: &str) -> Error {
    match error {
        LoadError::Ambiguous { known, .. } => UsageError::SeveralLaws { origin: origin.to_owned(), known }.into(),
        other => other.into(),
    }
}

/// Longest time in which a library that is to be described has to open.
const DESCRIBED_WITHIN: Duration = Duration::from_secs(10);

/// Opens a library that is to be described, first in a process of its own: what hangs or ends its process while it is opened
/// does so there.
pub(super) fn opened_library(path: &Path) -> Result<Plugin, Error> {
    let deadline = DESCRIBED_WITHIN;
    let wanted = IsolateOptions { deadline, ..IsolateOptions::new(Source::File(path.to_owned())) };
    match IsolatedLaw::open(&wanted) {
        Err(lost @ IsolateError::Lost { .. }) => Err(lost.into()),
        // Which of several laws, or options that it needs, is no question here, and the rest is said again.
        _ => Ok(Plugin::open(path, &LoadOptions::default())?),
    }
}

/// A law to be tried by itself.
pub(super) struct Found {
    pub(super) source: Source,
    /// Which of several.
    pub(super) law: Option<String>,
    pub(super) expected: Expected,
    /// What files about it are called.
    pub(super) name: String,
    /// Where it was built; it goes when the value goes.
    _room: Option<TempDir>,
}

/// Finds the law that is meant; sources are built first, and what is no law at all is refused before any of it has run.
pub(super) fn found(console: &Console, interrupt: &Interrupt, typed: &str) -> Result<Found, Error> {
    let (source, law) = match lookup::find(typed, Path::new("")) {
        Ok(found) => (found.source, found.law),
        // A file without an ending in this folder is what was meant.
        Err(LookupError::PathWithoutSlash { kind: "file", .. }) => (LawSource::Library(typed.into()), None),
        Err(error) => return Err(Located::new(error, None).into()),
    };
    let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let beside = |path: &Path| Expected::Beside(path.parent().unwrap_or(Path::new("")).to_path_buf());
    Ok(match source {
        LawSource::Embedded(name) => Found {
            source: Source::Embedded(name.to_owned()),
            law,
            expected: Expected::Nowhere,
            name: name.to_owned(),
            _room: None,
        },
        LawSource::Library(path) => {
            FileFacts::read(&path)?;
            Found { law, expected: beside(&path), name: stem(&path), source: Source::File(path), _room: None }
        }
        LawSource::Source(path) => {
            let room = temporary()?;
            let library = room.path().join(library_name(&path));
            let expected = if path.is_dir() { Expected::Beside(path.clone()) } else { beside(&path) };
            let whole = path.canonicalize().unwrap_or_else(|_| path.clone());
            let request =
                BuildRequest { sources: vec![path], output: Some(library.clone()), ..BuildRequest::default() };
            interrupt.over(compiled(console, &request))?;
            Found { source: Source::File(library), law, expected, name: stem(&whole), _room: Some(room) }
        }
    })
}

pub(super) fn temporary() -> Result<TempDir, Error> {
    let made = tempfile::Builder::new().prefix("wearlaw-law-").tempdir();
    made.map_err(|source| Error::Temporary { path: std::env::temp_dir(), source })
}

pub(super) fn library_name(source: &Path) -> String {
    let stem = source.file_stem().unwrap_or_default().to_string_lossy();
    let stem = if stem.is_empty() || stem == "." || stem == ".." { "law".into() } else { stem };
    format!("{}{stem}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX)
}
