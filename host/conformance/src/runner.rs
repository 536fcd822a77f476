//! Runs the checks, several at a time, each in a worker of its own.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::check::{Check, Group};
use super::error::ConformanceError;
use super::needs::FAULTS;
use super::outcome::{CheckResult, Outcome};
use super::replay::Replay;
use super::schedule::{Item, Next, Schedule, Unit};
use super::trial::Trials;
use super::{CheckOptions, Event, Report};
use wearlaw_law::Source;
use wearlaw_law::file_facts::FileFacts;

/// Runs the selected checks of a law, or of all laws of a library.
///
/// `on` is told of every check that begins and ends; once `stop` is set the checks that run are ended.
///
/// # Errors
/// No worker could be started, a fault of the checker itself, the wish to end, or nothing that was run.
pub fn run(
    options: &CheckOptions,
    on: &mut (dyn FnMut(Event<'_>) + Send),
    stop: &AtomicBool,
) -> Result<Report, ConformanceError> {
    let start = Instant::now();
    if let Some(folder) = &options.replays {
        Replay::clear(folder, options)?;
    }
    let runner = Runner::new(options, on, stop)?;
    let laws = runner.run()?;
    let mut results = runner.into_results();
    let law_of = |result: &CheckResult| laws.iter().position(|law| Some(law) == result.law.as_ref());
    results.sort_by_key(|result| (law_of(result), result.check));
    if !results.iter().any(|result| result.outcome.has_run() || result.outcome.falls_short()) {
        let reasons: Vec<&str> = results
            .iter()
            .filter_map(
                |result| if let Outcome::Skipped(reason) = &result.outcome { Some(reason.as_str()) } else { None },
            )
            .collect();
        let reason = reasons.first().map_or("none was selected", |reason| *reason).to_owned();
        return Err(ConformanceError::NothingRun { reason });
    }
    Ok(Report { laws, results, seed: options.seed, seconds: start.elapsed().as_secs_f64() })
}

struct Runner<'r> {
    options: &'r CheckOptions,
    trials: Trials<'r>,
    sha256: Option<String>,
    stop: &'r AtomicBool,
    /// Set by the first error: everything else ends too.
    failed: AtomicBool,
    shared: Mutex<Shared<'r>>,
    changed: Condvar,
}

struct Shared<'r> {
    on: &'r mut (dyn FnMut(Event<'_>) + Send),
    results: Vec<CheckResult>,
    total: usize,
    schedule: Schedule,
    laws: Vec<String>,
    error: Option<ConformanceError>,
}

impl<'r> Runner<'r> {
    fn new(
        options: &'r CheckOptions,
        on: &'r mut (dyn FnMut(Event<'_>) + Send),
        stop: &'r AtomicBool,
    ) -> Result<Self, ConformanceError> {
        let sha256 = match &options.source {
            Source::File(path) => FileFacts::examine(path).ok().map(|facts| facts.sha256),
            Source::Embedded(_) => None,
        };
        let shared = Shared {
            on,
            results: Vec::new(),
            total: options.selected.len(),
            schedule: Schedule::new(&[], &[]),
            laws: Vec::new(),
            error: None,
        };
        Ok(Self {
            options,
            trials: Trials::new(options, stop),
            sha256,
            stop,
            failed: AtomicBool::new(false),
            shared: Mutex::new(shared),
            changed: Condvar::new(),
        })
    }

    fn lock(&self) -> MutexGuard<'_, Shared<'r>> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn into_results(self) -> Vec<CheckResult> {
        self.shared.into_inner().unwrap_or_else(PoisonError::into_inner).results
    }

    fn is_wanted(&self, check: Check) -> bool {
        self.options.selected.contains(&check) && self.options.waivers.reason(check).is_none()
    }

    /// Runs everything; answers the names of the laws.
    fn run(&self) -> Result<Vec<String>, ConformanceError> {
        let mut failed: Vec<(Item, Check)> = Vec::new();
        if self.is_wanted(Check::LoadSymbols) {
            let (outcome, _) = self.trials.single(None, Check::LoadSymbols, |_| false)?;
            if outcome.falls_short() {
                failed.push(((None, Check::LoadSymbols), Check::LoadSymbols));
                failed.push(((None, Check::LoadOpens), Check::LoadSymbols));
            }
            self.report(None, Check::LoadSymbols, outcome, 0.0)?;
        }
        let mut laws = Vec::new();
        if failed.is_empty() {
            // Always, because it tells which laws there are.
            let start = Instant::now();
            let (outcome, answer) = self.trials.single(None, Check::LoadOpens, |_| false)?;
            laws = answer.map(|answer| answer.laws).unwrap_or_default();
            self.trials.holds(laws.len());
            let broken = outcome.falls_short();
            if broken {
                failed.push(((None, Check::LoadOpens), Check::LoadOpens));
            }
            if broken || self.is_wanted(Check::LoadOpens) {
                self.report(None, Check::LoadOpens, outcome, start.elapsed().as_secs_f64())?;
            }
        } else if self.is_wanted(Check::LoadOpens) {
            self.report(None, Check::LoadOpens, Outcome::Blocked(Check::LoadSymbols), 0.0)?;
        }
        if let Some(wanted) = &self.options.law {
            if failed.is_empty() && !laws.contains(wanted) {
                let reason = format!("the library holds no law `{wanted}`, it has {}", laws.join(", "));
                return Err(ConformanceError::NothingRun { reason });
            }
            laws = vec![wanted.clone()];
        }
        self.waived()?;
        let items = self.items(laws.len().max(1));
        {
            let mut shared = self.lock();
            shared.total = shared.results.len() + items.len();
            shared.schedule = Schedule::new(&items, &failed);
            shared.laws.clone_from(&laws);
        }
        std::thread::scope(|scope| {
            for _ in 0..self.options.parallel.max(1) {
                scope.spawn(|| self.work());
            }
        });
        match self.lock().error.take() {
            Some(error) => Err(error),
            None if self.stop.load(Ordering::Relaxed) => Err(ConformanceError::Interrupted),
            None => Ok(laws),
        }
    }

    /// Checks that are switched off are reported with their reasons.
    fn waived(&self) -> Result<(), ConformanceError> {
        for check in &self.options.selected {
            if let Some(reason) = self.options.waivers.reason(*check) {
                self.report(None, *check, Outcome::Skipped(format!("waived: {reason}")), 0.0)?;
            }
        }
        Ok(())
    }

    /// What is left to do: checks of the library once, the others for every law.
    fn items(&self, laws: usize) -> Vec<Item> {
        let wanted = self.options.selected.iter().copied().filter(|check| self.is_wanted(*check));
        let mut items = Vec::new();
        for check in wanted.filter(|check| !matches!(check, Check::LoadSymbols | Check::LoadOpens)) {
            let library = check.facts().group == Group::Load || check == Check::FloatLoad;
            match library {
                true => items.push((None, check)),
                false => items.extend((0..laws).map(|law| (Some(law), check))),
            }
        }
        items
    }

    /// Takes units until none is left.
    fn work(&self) {
        let mut shared = self.lock();
        loop {
            if self.failed.load(Ordering::Relaxed) || self.stop.load(Ordering::Relaxed) {
                return;
            }
            match shared.schedule.next() {
                Next::Finished => return,
                Next::Wait => {
                    let waited = self.changed.wait_timeout(shared, Duration::from_millis(100));
                    shared = waited.unwrap_or_else(PoisonError::into_inner).0;
                }
                Next::Blocked(blocked) => {
                    let laws = shared.laws.clone();
                    drop(shared);
                    for ((law, check), by) in blocked {
                        let law = law.and_then(|law| laws.get(law).cloned());
                        self.keep(self.report(law, check, Outcome::Blocked(by), 0.0));
                    }
                    shared = self.lock();
                }
                Next::Run(index) => {
                    let unit = shared.schedule.unit(index).clone();
                    let law = unit.law.and_then(|law| shared.laws.get(law).cloned());
                    let (done, total) = (shared.results.len(), shared.total);
                    (shared.on)(Event::Started { check: unit.checks[0], done, total });
                    drop(shared);
                    self.keep(self.unit(index, &unit, law));
                    shared = self.lock();
                    self.changed.notify_all();
                }
            }
        }
    }

    /// Keeps the first error, and lets everything else end.
    fn keep(&self, result: Result<(), ConformanceError>) {
        if let Err(error) = result {
            self.failed.store(true, Ordering::Relaxed);
            self.lock().error.get_or_insert(error);
            self.changed.notify_all();
        }
    }

    /// Runs a unit and reports its checks.
    fn unit(&self, index: usize, unit: &Unit, law: Option<String>) -> Result<(), ConformanceError> {
        let start = Instant::now();
        let check = unit.checks[0];
        let (outcomes, blocks) = if FAULTS.contains(&check) {
            self.trials.faults(law.as_deref(), &unit.checks)?
        } else {
            let known = |kind| self.has_fault(law.as_deref(), kind);
            (vec![(check, self.trials.single(law.as_deref(), check, known)?.0)], true)
        };
        let seconds = start.elapsed().as_secs_f64();
        self.lock().schedule.finish(index, &outcomes, blocks);
        for (check, outcome) in outcomes {
            self.report(law.clone(), check, outcome, seconds)?;
        }
        Ok(())
    }

    /// True if the law is known to have that fault.
    fn has_fault(&self, law: Option<&str>, kind: Check) -> bool {
        let shared = self.lock();
        let of_law = shared.results.iter().filter(|result| law.is_none() || result.law.as_deref() == law);
        of_law.into_iter().any(|result| result.check == kind && result.outcome.finding().is_some())
    }

    fn report(
        &self,
        law: Option<String>,
        check: Check,
        outcome: Outcome,
        seconds: f64,
    ) -> Result<(), ConformanceError> {
        let mut result = CheckResult { law, check, outcome, seconds, replay: None };
        if let Some(folder) = &self.options.replays
            && let Some(replay) =
                Replay::of(&result, self.options, self.trials.expected(result.law.as_deref()), self.sha256.clone())
        {
            result.replay = Some(replay.write(folder)?);
        }
        let mut shared = self.lock();
        (shared.on)(Event::Finished(&result));
        shared.results.push(result);
        Ok(())
    }
}
