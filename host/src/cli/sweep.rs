//! `wearlaw sweep SCENE`: many cases of a scene over all cores, each kept as soon as it is done, in one table.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use super::args::{SceneArguments, SweepArguments};
use super::console::Console;
use super::guard::caught;
use super::interrupt::Interrupt;
use super::opening::{self, OpenedLaw};
use super::restart;
use super::run::{missed, report};
use super::table::labelled;
use super::unit_text::elapsed;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::output::sweep_folder;
use crate::plan::Plan;
use crate::record::{End, Event, Observer, Wish};
use crate::scene::{Override, Scene};
use crate::solve::{Estimate, Run, SolveError};
use crate::sweep::{Case, Found, RESULTS, Row, Shard, Sweep, Vary, read_row, write_row, write_table};

/// Stack of a thread that runs cases: as much as the program's own.
const STACK: usize = 8 << 20;
/// Failed cases that the summary names; all are in the table.
const NAMED: usize = 10;

pub(super) fn command(console: &Console, arguments: &SweepArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let sweep = match &arguments.cases {
        Some(path) => Sweep::read(path)?,
        None => Sweep::grid(arguments.vary.iter().map(|text| Vary::parse(text)).collect::<Result<_, _>>()?)?,
    };
    let shard = arguments.shard.as_deref().map_or(Ok(Shard::WHOLE), Shard::parse)?;
    let out = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.scene));
    let folder = sweep_folder(&out)?;
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = arguments.threads.map_or_else(cores, usize::from);
    let mine: Vec<usize> = (1..=sweep.count()).filter(|case| shard.has(*case)).collect();
    let work = Work {
        console,
        interrupt: &interrupt,
        sweep: &sweep,
        scene: &arguments.scene,
        shared: &arguments.shared,
        folder: &folder,
        laws: Mutex::default(),
        bar: bar(console, mine.len()),
    };
    let begin = Instant::now();
    let done = work.all(&mine, threads)?;
    work.bar.finish_and_clear();
    let wall = begin.elapsed();
    let rows = rows(&sweep, &folder)?;
    let table = out.join("cases.csv");
    write_table(&sweep, &rows, &table)?;
    let told = Told { sweep: &sweep, done: &done, rows: &rows, wall, threads, table };
    told.tell(console, &arguments.scene)?;
    Ok(match () {
        () if interrupt.asked() => ExitCode::Interrupted,
        () if rows.iter().any(|row| row.exit_code != 0) => ExitCode::FallsShort,
        () => ExitCode::Done,
    })
}

/// Every case that is there, of this sweep and not of an earlier one with other values.
fn rows(sweep: &Sweep, folder: &Path) -> Result<Vec<Row>, Error> {
    let mut rows = Vec::new();
    for number in 1..=sweep.count() {
        let row = read_row(folder, number)?;
        rows.extend(row.filter(|row| row.values == sweep.case(number).values));
    }
    Ok(rows)
}

fn bar(console: &Console, cases: usize) -> ProgressBar {
    let bar = if console.shows_progress() { ProgressBar::new(cases as u64) } else { ProgressBar::hidden() };
    let style = ProgressStyle::with_template("[{bar:30}] {pos} of {len} cases  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> "));
    bar
}

/// `NAME.sweep` in the current folder for a scene `NAME.toml` in any.
fn default_folder(scene: &Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or("scene".as_ref()).to_owned();
    name.push(".sweep");
    PathBuf::from(name)
}

/// How a case came about.
#[derive(Clone, Copy, PartialEq)]
enum Done {
    /// It was run, for so long.
    Run(Duration),
    /// It was there already.
    Kept,
    /// The sweep was interrupted before it or in it.
    Left,
}

/// What every case needs.
struct Work<'a> {
    console: &'a Console,
    interrupt: &'a Interrupt,
    sweep: &'a Sweep,
    scene: &'a Path,
    shared: &'a SceneArguments,
    folder: &'a Path,
    /// Laws that cases share, by what a scene says of them.
    laws: Mutex<BTreeMap<String, Arc<OpenedLaw>>>,
    bar: ProgressBar,
}

impl Work<'_> {
    /// Sees to all cases, each thread to one at a time: in a pool of threads a case that waits for its own pool would begin
    /// another, and the times of both would be in each.
    fn all(&self, mine: &[usize], threads: usize) -> Result<Vec<Done>, Error> {
        let next = AtomicUsize::new(0);
        let one_by_one = || {
            let mut done = Vec::new();
            while let Some(case) = mine.get(next.fetch_add(1, Ordering::Relaxed)) {
                match self.done(*case) {
                    Ok(found) => done.push(found),
                    Err(error) => {
                        next.store(mine.len(), Ordering::Relaxed);
                        return Err(error);
                    }
                }
            }
            Ok(done)
        };
        std::thread::scope(|scope| {
            let mut started = Vec::new();
            for number in 0..threads.min(mine.len()) {
                let thread = std::thread::Builder::new().name(format!("case {number}"));
                let thread = thread.stack_size(STACK).spawn_scoped(scope, one_by_one);
                started.push(thread.map_err(|error| Error::Threads { threads, reason: error.to_string() })?);
            }
            let mut done = Vec::new();
            for thread in started {
                done.extend(thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?);
            }
            Ok(done)
        })
    }

    /// Sees to one case. Only what is wrong with the sweep itself is an error.
    fn done(&self, number: usize) -> Result<Done, Error> {
        if self.interrupt.asked() {
            return Ok(Done::Left);
        }
        let begin = Instant::now();
        let case = self.sweep.case(number);
        let earlier = read_row(self.folder, number)?.filter(|row| row.values == case.values);
        let row = match caught(|| self.row(&case, earlier.as_ref())) {
            Ok(None) => {
                self.bar.inc(1);
                return Ok(Done::Kept);
            }
            Ok(Some(row)) => row,
            Err(Error::Interrupted) => return Ok(Done::Left),
            Err(error) => Row {
                case: number,
                values: case.values,
                identity: None,
                exit_code: error.exit_code().number(),
                found: None,
                message: error.to_string(),
            },
        };
        write_row(self.folder, &row)?;
        self.bar.inc(1);
        Ok(Done::Run(begin.elapsed()))
    }

    /// What comes of a case; `None`: what came of it earlier still holds.
    fn row(&self, case: &Case, earlier: Option<&Row>) -> Result<Option<Row>, Error> {
        let mut overrides: Vec<Override> =
            self.shared.overrides.iter().map(|text| Override::from(text.as_str())).collect();
        overrides.extend(self.sweep.overrides(case));
        let scene = Scene::read(self.scene, &overrides)?;
        let law = self.law(&scene)?;
        let plan = Plan::new(&scene, law.evaluator.descriptor())?;
        let run = Run::prepare(&plan, law.evaluator.as_ref())?;
        run.check_reference()?;
        let identity = restart::identity(&scene, &law, &run)?;
        // A run that failed may have done so for want of memory or time: it is tried again.
        if earlier.is_some_and(|row| row.identity.as_ref() == Some(&identity) && row.exit_code == 0) {
            return Ok(None);
        }
        let mut watch = Watch(self.interrupt);
        let record = run.go(1, &mut watch);
        let finished = matches!(record.end, End::Done | End::Stopped(_));
        // A reference that fails costs its error norm, not the results.
        let compared = if finished { run.error(&record, &mut watch) } else { Ok(None) };
        let estimate = match plan.output.error_estimate {
            true => run.estimate(&record, &mut watch),
            false => Estimate::of_steps(&record),
        };
        if self.interrupt.asked() {
            return Err(Error::Interrupted);
        }
        let (error, without) = match compared {
            Ok(error) => (error, None),
            Err(failure) => (None, Some(failure)),
        };
        let known = (error.as_ref(), &estimate);
        let report = report(&scene, &plan, &law, self.shared.isolate, &run.skipped(), &record, known)?.document();
        let found = Found {
            ended: match record.end {
                End::Failed(_) => "failed".to_owned(),
                _ => report["ended"].as_str().unwrap_or_default().to_owned(),
            },
            results: RESULTS.iter().map(|name| report["result"][*name].as_f64()).collect(),
            error: report["error"]["value"].as_f64(),
            reference: report["error"]["reference"].as_str().unwrap_or_default().to_owned(),
            steps: record.cost.steps,
            run_time_s: record.cost.run_time_s,
        };
        let failed = |error: SolveError| {
            let error = Error::from(error);
            (error.exit_code(), error.to_string())
        };
        let (code, message) = match (record.end, without, missed(&plan, error.as_ref())) {
            (End::Failed(error), ..) | (_, Some(error), _) => failed(error),
            _ if record.stability.is_unstable => (ExitCode::NumbersFailed, record.stability.verdict),
            (_, _, Some(words)) => (ExitCode::FallsShort, words),
            _ => (ExitCode::Done, String::new()),
        };
        let (number, values) = (case.number, case.values.clone());
        let exit_code = code.number();
        Ok(Some(Row { case: number, values, identity: Some(identity), exit_code, found: Some(found), message }))
    }

    /// The law of a case: in this process one for all cases that name it alike, isolated one for each.
    fn law(&self, scene: &Scene) -> Result<Arc<OpenedLaw>, Error> {
        if self.shared.isolate {
            return Ok(Arc::new(opening::open(self.console, self.interrupt, scene, self.shared)?));
        }
        let law = &scene.law;
        let name = format!("{:?} {:?} {:?} {:?}", law.plugin, law.options, law.sha256, self.shared.law);
        // Held while a source is built: no other case builds it too.
        let mut laws = self.laws.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        if let Some(law) = laws.get(&name) {
            return Ok(law.clone());
        }
        let law = Arc::new(opening::open(self.console, self.interrupt, scene, self.shared)?);
        law.warnings.iter().for_each(|warning| self.console.note(&format!("warning: {warning}")));
        laws.insert(name, law.clone());
        Ok(law)
    }
}

/// Ends a run when the sweep is to end.
struct Watch<'a>(&'a Interrupt);

impl Observer for Watch<'_> {
    fn observe(&mut self, _: Event<'_>) -> Wish {
        if self.0.asked() { Wish::Stop } else { Wish::GoOn }
    }
}

/// What is told of a sweep.
struct Told<'a> {
    sweep: &'a Sweep,
    done: &'a [Done],
    rows: &'a [Row],
    wall: Duration,
    threads: usize,
    table: PathBuf,
}

impl Told<'_> {
    fn tell(&self, console: &Console, scene: &Path) -> Result<(), Error> {
        let count = |wanted: fn(&Done) -> bool| self.done.iter().filter(|done| wanted(done)).count();
        let (run, kept) = (count(|done| matches!(done, Done::Run(_))), count(|done| *done == Done::Kept));
        let busy: f64 =
            self.done.iter().map(|done| if let Done::Run(time) = done { time.as_secs_f64() } else { 0.0 }).sum();
        let wall = self.wall.as_secs_f64();
        let used = if run > 0 { busy / (wall * self.threads as f64) } else { 0.0 };
        let failed: Vec<&Row> = self.rows.iter().filter(|row| row.exit_code != 0).collect();
        let missing = self.sweep.count() - self.rows.len();
        if console.json {
            return console.document(&json!({
                "scene": scene.display().to_string(),
                "table": self.table.display().to_string(),
                "cases": self.sweep.count(),
                "run": run,
                "kept": kept,
                "missing": missing,
                "failed": failed.iter().map(|row| json!({ "case": row.case, "exit_code": row.exit_code, "message": row.message })).collect::<Vec<_>>(),
                "wall_s": wall,
                "threads": self.threads,
                "busy": used,
            }));
        }
        if console.quiet {
            return Ok(());
        }
        let mut text = format!("{}\n", console.headline(&format!("sweep of {}", scene.display())));
        let mut line = |label: &str, value: &str| text.push_str(&labelled(label, value, 14, 96));
        let mut cases =
            format!("{} in all: {run} run now, {kept} kept from before, {missing} not there yet", self.sweep.count());
        if !failed.is_empty() {
            cases.push_str(&format!(", {} failed", failed.len()));
        }
        line("cases", &cases);
        if run > 0 {
            let threads = format!("on {} threads, which were at work {:.0} % of it", self.threads, 100.0 * used);
            line("time", &format!("{} {threads}", elapsed(wall)));
        }
        for row in failed.iter().take(NAMED) {
            line(&format!("case {}", row.case), &row.message);
        }
        if failed.len() > NAMED {
            line("", &format!("and {} more, in the column `message`", failed.len() - NAMED));
        }
        line("table", &self.table.display().to_string());
        console.result(&text)
    }
}
