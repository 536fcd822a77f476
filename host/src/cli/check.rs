//! `wearlaw check LIB`: whether a law keeps the contract, a line for each check.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use super::args::{CheckArguments, ReportFormat};
use super::console::Console;
use super::interrupt::Interrupt;
use super::opening::found;
use super::table::folded;
use crate::conformance::{
    Check, CheckOptions, ConformanceError, Event, Expected, Replay, Report, TIMEOUT, Waivers, report, run, select,
};
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use indicatif::{ProgressBar, ProgressStyle};

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
        ReportFormat::Text => console.result(&for_people(&report::text(&checked, &options, typed)))?,
    }
    Ok(match checked.untested() {
        // The options are missing or wrong, and nearly nothing was tried.
        Some(_) => ExitCode::InputWrong,
        None if checked.passes() => ExitCode::Done,
        None => ExitCode::FallsShort,
    })
}

/// A report in lines as long as the terminal is wide, where it goes to one; the commands in it stay whole.
fn for_people(text: &str) -> String {
    let Some((terminal_size::Width(width), _)) = terminal_size::terminal_size_of(std::io::stdout()) else {
        return text.to_owned();
    };
    folded(text, usize::from(width), |line| match line.trim_start() {
        command if command.starts_with("again ") => None,
        _ if line.starts_with("      ") => Some(report::EVIDENCE),
        _ if line.starts_with("  ") => Some(report::WORDS),
        _ => Some(2),
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
