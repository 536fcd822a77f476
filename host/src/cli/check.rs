//! `wearlaw check LIB`: whether a law keeps the contract, a line for each check.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use tempfile::TempDir;

use super::args::{CheckArguments, ReportFormat};
use super::build::compiled;
use super::console::Console;
use super::interrupt::Interrupt;
use super::opening::{library_name, temporary};
use crate::conformance::{
    Check, CheckOptions, ConformanceError, Event, Expected, Replay, Report, TIMEOUT, Waivers, report, run, select,
};
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use crate::law::Source;
use crate::law::build::BuildRequest;
use crate::law::file_facts::FileFacts;
use crate::law::lookup::{self, LawSource, LookupError};
use crate::scene::Located;

pub(super) fn command(console: &Console, arguments: &CheckArguments) -> Result<ExitCode, Error> {
    let format = if console.json { ReportFormat::Json } else { arguments.format };
    if arguments.list {
        match format {
            ReportFormat::Json => console.document(&report::list_json())?,
            ReportFormat::Text | ReportFormat::Junit => console.result(&report::list_text())?,
        }
        return Ok(ExitCode::Done);
    }
    let Some(typed) = arguments.law.as_deref() else { return Err(UsageError::NoLaw.into()) };
    let interrupt = Interrupt::watch();
    let found = found(console, &interrupt, typed)?;
    if let Source::File(path) = &found.source {
        // What is no law at all ends here, before any of its code has run.
        FileFacts::read(path)?;
    }
    let meant = select(&arguments.only)?;
    let is_run = |check: &Check| !arguments.quick || check.facts().quick;
    let mut options = CheckOptions {
        law: found.law,
        expected: arguments.expected.clone().map_or(found.expected, Expected::File),
        options: arguments.options.clone(),
        selected: meant.iter().copied().filter(is_run).collect(),
        left_out: meant.iter().copied().filter(|check| !is_run(check)).collect(),
        waivers: arguments.waive.as_deref().map(Waivers::read).transpose()?.unwrap_or_default(),
        seed: arguments.seed,
        quick: arguments.quick,
        timeout: arguments.timeout.unwrap_or(TIMEOUT),
        replays: Some(PathBuf::from(format!("{}.check", found.name))),
        ..CheckOptions::new(found.source)
    };
    if let Some(threads) = arguments.threads {
        options.parallel = usize::from(threads);
    }
    if let Some(path) = &arguments.replay {
        let replay = Replay::read(path)?;
        replay.apply(&mut options);
        options.replays = None;
    }
    let checked = checked(console, &interrupt, &options)?;
    match format {
        ReportFormat::Json => console.document(&report::json(&checked, typed))?,
        ReportFormat::Junit => console.result(&report::junit(&checked, typed))?,
        ReportFormat::Text if console.quiet => console.result(&report::quiet(&checked))?,
        ReportFormat::Text => console.result(&report::text(&checked, &options, typed))?,
    }
    Ok(if checked.passes() { ExitCode::Done } else { ExitCode::FallsShort })
}

/// A law to be checked.
struct Found {
    source: Source,
    /// Which of several.
    law: Option<String>,
    expected: Expected,
    /// What files about it are called.
    name: String,
    /// Where it was built; it goes when the value goes.
    _room: Option<TempDir>,
}

/// Finds the law that is meant; sources are built first.
fn found(console: &Console, interrupt: &Interrupt, typed: &str) -> Result<Found, Error> {
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

/// Runs the checks, with a line on a terminal that says which.
fn checked(console: &Console, interrupt: &Interrupt, options: &CheckOptions) -> Result<Report, Error> {
    let bar = if console.shows_progress() { ProgressBar::new(0) } else { ProgressBar::hidden() };
    let style = ProgressStyle::with_template("[{pos}/{len}] {msg}  {elapsed}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let stop: Arc<AtomicBool> = interrupt.flag();
    let mut on = |event: Event<'_>| {
        if let Event::Started { check, done, total } = event {
            bar.set_length(total as u64);
            bar.set_position(done as u64);
            bar.set_message(check.name());
        }
    };
    bar.enable_steady_tick(Duration::from_millis(200));
    let checked = run(options, &mut on, &stop);
    bar.finish_and_clear();
    match checked {
        Err(ConformanceError::Interrupted) => Err(Error::Interrupted),
        other => Ok(other?),
    }
}
