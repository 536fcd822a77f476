//! Where a body works: its task, the slate, and what most bodies begin with.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::super::harness::call::{Answers, Call, Layout};
use super::super::harness::closeness::Difference;
use super::super::harness::points::{Case, number_text};
use super::super::harness::sample::Sampler;
use super::super::harness::subject::{Instance, Law, Library};
use super::super::message::{Judged, Task, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::super::slate::Slate;
use super::super::trial::PATIENT;
use super::expected::table_of;
use wearlaw_law::{Claim, LawDescriptor, Source};

/// The place of one body.
pub(crate) struct Bench {
    pub(crate) task: Task,
    pub(crate) slate: &'static Slate,
    laws: Mutex<Vec<String>>,
    bits: Mutex<Vec<u64>>,
    start: Instant,
}

/// Points of most calls: two lines of a cache, and no remainder of a vectorised loop.
pub(super) const POINTS: usize = 16;

impl Bench {
    pub(crate) fn new(task: Task, slate: &'static Slate) -> Self {
        Self { task, slate, laws: Mutex::default(), bits: Mutex::default(), start: Instant::now() }
    }

    /// Names of the library's laws, for the checker.
    pub(crate) fn laws(&self) -> MutexGuard<'_, Vec<String>> {
        self.laws.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Bits of answers, for a comparison with another process.
    pub(crate) fn bits(&self) -> MutexGuard<'_, Vec<u64>> {
        self.bits.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Opens the library.
    pub(super) fn open(&self) -> Judged<Library> {
        Library::open(&self.task, self.slate)
    }

    /// Opens the library, makes an instance of the law and works with it; both are gone afterwards.
    pub(super) fn with<T>(&self, work: impl FnOnce(&Law<'_>, &Instance<'_>) -> Judged<T>) -> Judged<T> {
        let library = self.open()?;
        let law = library.law(&self.task)?;
        let instance = law.instance(&self.task)?;
        work(&law, &instance)
    }

    /// Gives up with the reason if the law is part of this program, so that there is no library to load.
    pub(super) fn needs_file(&self) -> Judged<&std::path::Path> {
        match &self.task.source {
            Source::File(path) => Ok(path),
            Source::Embedded(_) => skip("the law is part of this program, no library is loaded"),
        }
    }

    /// Picks inputs, the same for the same seed and check.
    pub(super) fn sampler<'l>(&self, law: &'l Law<'_>, known: &'l [Vec<f64>]) -> Sampler<'l> {
        Sampler::new(&law.about, self.task.seed, self.task.check.name(), known)
    }

    /// Constants that the author computed with, from the table of known values.
    pub(super) fn known_constants(&self, law: &Law<'_>) -> Vec<Vec<f64>> {
        // A table that cannot be read is told by its own check.
        table_of(self, law).ok().flatten().map_or_else(Vec::new, |table| table.constants(&law.about))
    }

    /// A call of `count` good points.
    pub(super) fn good(&self, law: &Law<'_>, instance: &Instance<'_>, count: usize) -> Judged<Case> {
        Ok(self.several(law, instance, count, 1)?.remove(0))
    }

    /// So many calls of `count` good points, each with constants of its own; fewer, but one, where the law refuses them.
    pub(super) fn several(
        &self,
        law: &Law<'_>,
        instance: &Instance<'_>,
        count: usize,
        calls: usize,
    ) -> Judged<Vec<Case>> {
        let known = self.known_constants(law);
        let mut sampler = self.sampler(law, &known);
        let cases: Vec<Case> = (0..calls).filter_map(|_| sampler.good(instance, count)).collect();
        if cases.is_empty() {
            return skip(
                "the law refused every ordinary input that was tried; rows in expected.csv give constants to try",
            );
        }
        Ok(cases)
    }

    /// As [`Bench::good`], and the same where the constants with a default keep it, if there are such points.
    pub(super) fn goods(&self, law: &Law<'_>, instance: &Instance<'_>, count: usize) -> Judged<Vec<Case>> {
        let mut cases = vec![self.good(law, instance, count)?];
        if law.about.constants.iter().any(|constant| constant.default.is_some()) {
            let at_defaults = |known: &[Vec<f64>]| {
                let mut sampler = self.sampler(law, known);
                sampler.at_defaults = true;
                sampler.good(instance, count)
            };
            // Those of a table may all be far from ordinary, and a law may have a way of its own for ordinary ones.
            cases.extend(at_defaults(&[]).or_else(|| at_defaults(&self.known_constants(law))));
        }
        Ok(cases)
    }

    /// Says on the slate what the body is about.
    pub(super) fn label(&self, words: &str) {
        self.slate.label(words);
    }

    /// True as long as there is time for more calls.
    pub(super) fn has_time(&self) -> bool {
        self.start.elapsed().as_secs_f64() < self.task.budget
    }

    /// As much of a time as there is for a loop of many calls; more of it where nothing is to be cut short.
    pub(super) fn at_most(&self, time: Duration) -> Duration {
        if self.task.budget < PATIENT { time.min(self.budget()) } else { self.budget() }
    }

    /// The time for loops of many calls.
    pub(super) fn budget(&self) -> Duration {
        Duration::try_from_secs_f64(self.task.budget).unwrap_or(Duration::from_secs(1))
    }
}

/// Lays a case out and calls the law.
pub(super) fn ask(law: &LawDescriptor, instance: &Instance<'_>, case: &Case, layout: &Layout) -> Answers {
    Call::new(law, case, layout).answers(instance)
}

/// The law must answer good values here, since it did so before.
pub(super) fn still_good(law: &LawDescriptor, case: &Case, answers: &Answers, what: &str) -> Judged<()> {
    if answers.is_good() {
        return Ok(());
    }
    let finding = Finding::new(format!("{what}: it refuses points that it answers otherwise"));
    let found = format!("status {}", answers.status);
    broken(finding.with(found, "status 0 or 1").at(case.named(law, 0)))
}

/// Differences between answers that should be the same, gathered over many comparisons.
#[derive(Default)]
pub(super) struct Differences {
    worst: Option<(Difference, Finding)>,
    compared: usize,
}

impl Differences {
    /// Counts a comparison; `finding` is made only for a difference that is the worst so far.
    pub(super) fn note(&mut self, difference: Option<Difference>, finding: impl FnOnce() -> Finding) {
        self.compared += 1;
        let Some(difference) = difference else { return };
        let worse = self.worst.as_ref().is_none_or(|(worst, _)| {
            (worst.small && !difference.small) || (worst.small == difference.small && difference.ulps > worst.ulps)
        });
        if worse {
            self.worst = Some((difference, finding()));
        }
    }

    /// Same to the bit passes; a small difference warns unless the law claims to be deterministic; others fail.
    pub(super) fn judge(self, law: &LawDescriptor) -> Judged {
        let Some((difference, finding)) = self.worst else {
            return Ok(Verdict::Pass(Some(format!("{} points compared, the same to the bit", self.compared))));
        };
        let claimed = law.claims(Claim::Deterministic);
        let expected = match (claimed, difference.small) {
            (true, _) => "the same bits (the law claims `deterministic`)",
            (false, true) => "the same; 4 units are allowed where the law does not claim `deterministic`",
            (false, false) => "the same to 4 units in the last place",
        };
        let finding = finding.with(difference.words(), expected);
        if difference.small && !claimed { Ok(Verdict::Warn(finding)) } else { broken(finding) }
    }
}

/// The first number of a good answer that is not finite (a derivative may be infinite), and its name.
pub(super) fn not_finite(answers: &Answers, point: usize) -> Option<(&'static str, f64)> {
    let at = answers.at(point);
    let bad = |value: &f64| !value.is_finite();
    if bad(&at.increment) {
        return Some(("increment", at.increment));
    }
    if let Some(value) = at.direction.iter().copied().find(bad) {
        return Some(("direction", value));
    }
    if let Some(value) = at.state.iter().copied().find(bad) {
        return Some(("state", value));
    }
    at.d_pressure.filter(|slope| slope.is_nan()).map(|slope| ("d_pressure", slope))
}

/// Breaks off if a point of a good answer has a number that is not finite.
pub(super) fn finite_or_status(law: &LawDescriptor, case: &Case, answers: &Answers, what: &str) -> Judged<()> {
    for point in (0..case.count).filter(|point| answers.is_good_at(*point)) {
        if let Some((item, value)) = not_finite(answers, point) {
            let found = format!("status {}, {item} {}", answers.status, number_text(value));
            let finding = Finding::new(what).with(found, "a finite value, or a status such as WL_OUT_OF_DOMAIN");
            return broken(finding.at(case.named(law, point)));
        }
    }
    Ok(())
}
