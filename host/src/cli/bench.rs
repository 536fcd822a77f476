//! `wearlaw bench LIB..`: laws by themselves, a column for each.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use super::args::BenchArguments;
use super::console::Console;
use super::interrupt::Interrupt;
use super::opening::{Found, found};
use super::table::aligned;
use super::unit_text::significant;
use crate::bench::{BenchError, BenchOptions, LawReport, Report, Speed, Subject, Worst, run};
use crate::conformance::Expected;
use crate::error::{Error, UsageError, printable};
use crate::exit_code::ExitCode;

pub(super) fn command(console: &Console, arguments: &BenchArguments) -> Result<ExitCode, Error> {
    if arguments.expected.is_some() && arguments.laws.len() > 1 {
        return Err(UsageError::ExpectedOfSeveral { laws: arguments.laws.len() }.into());
    }
    let interrupt = Interrupt::watch();
    // Libraries that are built on the way live as long as these.
    let mut founds: Vec<Found> = Vec::new();
    for typed in &arguments.laws {
        founds.push(found(console, &interrupt, typed)?);
    }
    let subjects: Vec<Subject> = founds
        .iter()
        .zip(&arguments.laws)
        .map(|(found, typed)| Subject {
            origin: typed.clone(),
            source: found.source.clone(),
            law: found.law.clone(),
            options: arguments.options.clone(),
            expected: arguments.expected.clone().map_or(found.expected.clone(), Expected::File),
        })
        .collect();
    let mut report = measured(console, &interrupt, &subjects, &options(arguments))?;
    if let [only] = &mut report.laws[..]
        && let Some(failure) = only.failure.take()
    {
        return Err(failure.into());
    }
    if console.json {
        console.document(&report)?;
    } else {
        console.result(&text(&report, console))?;
        let laws = report.laws.iter().flat_map(|law| law.notes.iter().map(move |note| (law, note)));
        laws.for_each(|(law, note)| console.note(&format!("{}: {note}", law.name)));
    }
    let failures = report.laws.into_iter().filter_map(|law| law.failure);
    let codes: Vec<ExitCode> = failures.map(|failure| told(console, failure)).collect();
    Ok(codes.into_iter().next().unwrap_or(ExitCode::Done))
}

/// Says why one of several laws failed, beside the table.
fn told(console: &Console, failure: BenchError) -> ExitCode {
    let error = Error::from(failure);
    if console.json { error.exit_code() } else { console.error(&error) }
}

fn options(arguments: &BenchArguments) -> BenchOptions {
    let usual = BenchOptions::default();
    let or = |given: Vec<usize>, usual: Vec<usize>| {
        let mut chosen = if given.is_empty() { usual } else { given };
        chosen.sort_unstable();
        chosen.dedup();
        chosen
    };
    BenchOptions {
        points: or(arguments.points.iter().map(|&points| points as usize).collect(), usual.points),
        threads: or(arguments.threads.iter().copied().map(usize::from).collect(), usual.threads),
        budget: arguments.budget.unwrap_or(usual.budget),
        deadline: arguments.deadline.unwrap_or(usual.deadline),
        seed: arguments.seed,
        program: None,
    }
}

/// Measures, with a line on a terminal that says what.
fn measured(
    console: &Console,
    interrupt: &Interrupt,
    subjects: &[Subject],
    options: &BenchOptions,
) -> Result<Report, Error> {
    let bar = if console.shows_progress() { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
    let style = ProgressStyle::with_template("{spinner} {msg}  {elapsed}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    // Seldom, so that drawing it does not disturb what is timed.
    bar.enable_steady_tick(Duration::from_secs(1));
    let report = run(subjects, options, &mut |what| bar.set_message(printable(what)), &interrupt.flag());
    bar.finish_and_clear();
    match report {
        Err(BenchError::Interrupted) => Err(Error::Interrupted),
        other => Ok(other?),
    }
}

/// The table: a column for each law, a row for each figure.
fn text(report: &Report, console: &Console) -> String {
    let laws = &report.laws;
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut row = |label: String, cell: &dyn Fn(&LawReport) -> String| {
        let cells = laws.iter().map(|law| printable(&cell(law)));
        rows.push(std::iter::once(label).chain(cells).collect());
    };
    row(String::new(), &|law| format!("{} {}", law.name, law.version).trim_end().to_owned());
    row("from".to_owned(), &|law| law.from.clone());
    row("bytes per point".to_owned(), &|law| law.bytes_per_point.to_string());
    row("ns per point, least (median)".to_owned(), &|_| String::new());
    for key in ways(laws) {
        row(format!("  {}", label(key)), &|law| of(law, key).map_or_else(|| absent(law), time));
    }
    let measured = |law: &LawReport, key| of(law, key).and_then(|speed| speed.memory);
    let mut keys = ways(laws);
    keys.retain(|key| laws.iter().any(|law| measured(law, *key).is_some()));
    if !keys.is_empty() {
        row("part of the bandwidth (triad, GB/s)".to_owned(), &|_| String::new());
    }
    for key in keys {
        row(format!("  {}", label(key)), &|law| match measured(law, key) {
            Some(memory) => {
                format!("{} ({})", significant(memory.part, 3), significant(memory.triad_gb_per_s, 3))
            }
            None => absent(law),
        });
    }
    row("largest error, ulp (row)".to_owned(), &|law| match &law.accuracy {
        Some(accuracy) => format!("{} rows", accuracy.rows),
        None => "not known".to_owned(),
    });
    let mut answers: Vec<&str> = Vec::new();
    for worst in laws.iter().filter_map(|law| law.accuracy.as_ref()).flat_map(|accuracy| &accuracy.answers) {
        if !answers.contains(&worst.answer.as_str()) {
            answers.push(&worst.answer);
        }
    }
    for answer in answers {
        row(format!("  {answer}"), &|law| {
            let mut all = law.accuracy.iter().flat_map(|accuracy| &accuracy.answers);
            all.find(|worst| worst.answer == answer).map_or_else(|| "-".to_owned(), error)
        });
    }
    let table = aligned(&rows, 0);
    match table.split_once('\n') {
        Some((head, rest)) => format!("{}\n{rest}", console.headline(head)),
        None => table,
    }
}

/// Every way in which a law was called: isolated, threads, points; in the order of the table.
fn ways(laws: &[LawReport]) -> Vec<(bool, usize, usize)> {
    let speeds = laws.iter().flat_map(|law| &law.speeds);
    let mut ways: Vec<_> = speeds.map(|speed| (speed.isolated, speed.threads, speed.points)).collect();
    ways.sort_unstable();
    ways.dedup();
    ways
}

fn of(law: &LawReport, key: (bool, usize, usize)) -> Option<&Speed> {
    law.speeds.iter().find(|speed| (speed.isolated, speed.threads, speed.points) == key)
}

fn label((isolated, threads, points): (bool, usize, usize)) -> String {
    let several = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let apart = if isolated { ", isolated" } else { "" };
    format!("{}, {}{apart}", several(points, "point"), several(threads, "thread"))
}

fn absent(law: &LawReport) -> String {
    if law.failure.is_some() { "failed" } else { "-" }.to_owned()
}

fn time(speed: &Speed) -> String {
    format!("{} ({})", significant(speed.least_ns, 3), significant(speed.median_ns, 3))
}

fn error(worst: &Worst) -> String {
    match worst.ulp {
        Some(u64::MAX) => format!("no number ({})", worst.row),
        Some(ulp) => format!("{ulp} ({})", worst.row),
        None => format!("agrees to its {} digits", worst.digits),
    }
}
