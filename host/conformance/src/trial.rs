//! One check in one worker: the task, what became of it, and a closer look where the worker was lost.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use super::CheckOptions;
use super::attempt::{Attempt, Ended, attempt, fault};
use super::bodies::ORDINARY;
use super::check::Check;
use super::error::ConformanceError;
use super::evidence::{lost, outcome};
use super::message::{Answer, Task};
use super::needs::FAULTS;
use super::outcome::Outcome;
use super::slate::{Phase, Touched};
use wearlaw_law::Source;

/// Part of a check's time after which its loops of many calls are cut short.
const BUDGET: f64 = 0.4;
/// Time of loops that are not to be cut short, s: more than any check may take.
pub(super) const PATIENT: f64 = 1e6;
/// Time for a check of a law that is known to hang at some inputs.
const HANGING: Duration = Duration::from_secs(5);
/// Time for the attempt that looks for the point at which a law hangs.
const NARROWING: Duration = Duration::from_secs(3);

/// What every worker of a run is started with.
pub(super) struct Trials<'r> {
    options: &'r CheckOptions,
    /// With an absolute path: a law may change the working directory.
    source: Source,
    program: PathBuf,
    stop: &'r AtomicBool,
    /// How many laws the library holds.
    laws: AtomicUsize,
}

impl<'r> Trials<'r> {
    /// Workers for these options, which end once `stop` is set.
    pub(super) fn new(options: &'r CheckOptions, stop: &'r AtomicBool) -> Self {
        let source = match &options.source {
            Source::File(path) => Source::File(std::path::absolute(path).unwrap_or_else(|_| path.clone())),
            Source::Embedded(name) => Source::Embedded(name.clone()),
        };
        let here = || std::env::current_exe().unwrap_or_else(|_| PathBuf::from("/proc/self/exe"));
        let program = options.program.clone().unwrap_or_else(here);
        Self { options, source, program, stop, laws: AtomicUsize::new(1) }
    }

    /// Notes how many laws the library turned out to hold.
    pub(super) fn holds(&self, laws: usize) {
        self.laws.store(laws.max(1), Ordering::Relaxed);
    }

    /// The task of a check.
    fn task(&self, law: Option<&str>, check: Check) -> Task {
        let options = self.options;
        Task {
            check,
            source: self.source.clone(),
            law: law.map(str::to_owned).or_else(|| options.law.clone()),
            options: options.options.clone(),
            seed: options.seed,
            quick: options.quick,
            expected: self.expected(law),
            budget: if options.patient { PATIENT } else { BUDGET * options.timeout.as_secs_f64() },
            narrow: None,
            bits: Vec::new(),
        }
    }

    /// The table of known values of a law.
    pub(super) fn expected(&self, law: Option<&str>) -> Option<PathBuf> {
        let found = self.options.expected.file(law, self.laws.load(Ordering::Relaxed))?;
        Some(std::path::absolute(&found).unwrap_or(found))
    }

    fn attempt(&self, task: &Task, timeout: Duration) -> Result<Attempt, ConformanceError> {
        let attempted = attempt(&self.program, task, timeout, self.stop)
            .map_err(|source| ConformanceError::Start { program: self.program.clone(), source })?;
        match &attempted.ended {
            Ended::Interrupted => Err(ConformanceError::Interrupted),
            Ended::Answered(answer) => match &answer.fault {
                Some(what) => Err(ConformanceError::Fault { check: task.check.name(), what: what.clone() }),
                None => Ok(attempted),
            },
            _ => Ok(attempted),
        }
    }

    /// One check in one worker, or two of them where processes are compared.
    ///
    /// `known` tells whether the law is known to have a fault, by the check that is named after it.
    pub(super) fn single(
        &self,
        law: Option<&str>,
        check: Check,
        known: impl Fn(Check) -> bool,
    ) -> Result<(Outcome, Option<Answer>), ConformanceError> {
        let mut task = self.task(law, check);
        let mut timeout = self.options.timeout;
        if known(Check::FaultsHang) {
            // It is most likely to hang again, which says nothing new.
            timeout = timeout.min(HANGING);
            task.budget = task.budget.min(BUDGET * timeout.as_secs_f64());
        }
        let mut attempted = self.attempt(&task, timeout)?;
        if check == Check::DeterminismProcess
            && let Ended::Answered(answer) = &attempted.ended
            && !answer.bits.is_empty()
        {
            task.bits.clone_from(&answer.bits);
            attempted = self.attempt(&task, timeout)?;
        }
        if let Some((kind, _)) = fault(&attempted, timeout)
            && !is_own(check, &attempted)
            && known(kind)
        {
            return Ok((Outcome::Blocked(kind), None));
        }
        let mut outcome = outcome(check, &attempted, timeout);
        self.narrow(&task, &attempted, &mut outcome)?;
        let answer = match attempted.ended {
            Ended::Answered(answer) => Some(*answer),
            _ => None,
        };
        Ok((outcome, answer))
    }

    /// Looks for the one point of a batch at which a worker was lost.
    fn narrow(&self, task: &Task, attempted: &Attempt, outcome: &mut Outcome) -> Result<(), ConformanceError> {
        let crumb = &attempted.crumb;
        let (Outcome::Crashed(finding) | Outcome::TimedOut(finding)) = outcome else { return Ok(()) };
        if crumb.phase != Phase::Evaluating || crumb.points <= 1 || task.check == Check::ThreadsConcurrent {
            return Ok(());
        }
        let again = Task { narrow: Some(crumb.call), budget: PATIENT, ..task.clone() };
        let hangs = matches!(attempted.ended, Ended::TimedOut);
        // Point by point is slow, and a crash ends it anyway.
        let time = if hangs { self.options.timeout.min(NARROWING) } else { self.options.timeout * 3 };
        let again = self.attempt(&again, time)?;
        // One that was only slow was at many points one after the other.
        let stuck = !matches!(again.ended, Ended::TimedOut) || again.crumb.stayed > time / 4;
        let lost_again = !matches!(again.ended, Ended::Answered(_)) && stuck;
        if lost_again && again.crumb.call == crumb.call && again.crumb.points == 1 {
            let single = lost(&again, time);
            finding.input = single.input;
            finding.what = format!("{}; one point of them is enough", finding.what);
        } else {
            finding.what = format!("{}; no point of them alone does it, shown is the first", finding.what);
        }
        Ok(())
    }

    /// The checks that one run of the law judges: each fails by its own kind of fault.
    ///
    /// Answers too whether a failure makes other checks pointless.
    pub(super) fn faults(
        &self,
        law: Option<&str>,
        checks: &[Check],
    ) -> Result<(Vec<(Check, Outcome)>, bool), ConformanceError> {
        // The same for all of them: one that is asked for alone meets the same inputs as in a run of all.
        let task = self.task(law, FAULTS[0]);
        let attempted = self.attempt(&task, self.options.timeout)?;
        let Some((kind, _)) = fault(&attempted, self.options.timeout) else {
            let outcome = outcome(checks[0], &attempted, self.options.timeout);
            return Ok((checks.iter().map(|check| (*check, outcome.clone())).collect(), true));
        };
        let mut found = outcome(kind, &attempted, self.options.timeout);
        self.narrow(&task, &attempted, &mut found)?;
        // Told even if another kind was asked for: the answer to that is not known.
        let mut outcomes: Vec<(Check, Outcome)> =
            checks.iter().filter(|check| **check != kind).map(|check| (*check, Outcome::Blocked(kind))).collect();
        outcomes.push((kind, found));
        // What ordinary inputs do happens everywhere; what odd ones do happens where they are given.
        let label = &attempted.crumb.label;
        Ok((outcomes, label.is_empty() || label == ORDINARY))
    }
}

/// True for an end that is what this very check looks for, whatever else the law is known for.
fn is_own(check: Check, attempt: &Attempt) -> bool {
    let guarded = matches!(attempt.crumb.touched, Touched::Behind | Touched::Before | Touched::ReadOnly);
    let absent = matches!(check, Check::MemoryUndeclared | Check::MemoryUses | Check::MemoryOutputs);
    let loading = matches!(check, Check::LoadSymbols | Check::LoadOpens | Check::LoadTwice);
    guarded || absent || loading || check == Check::FaultsCreate
}
