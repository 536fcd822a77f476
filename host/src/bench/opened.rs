//! From a library to laws that are ready to be measured: opened here and in a process of their own, with ordinary inputs.

use std::cell::{Cell, RefCell};
use std::time::{Duration, Instant};

use super::laid::{AskError, Laid, bytes_per_point};
use super::{Accuracy, BenchError, BenchOptions, LawReport, Subject};
use crate::conformance::sampling::known::{Expected, SELFTEST, Table, selftest};
use crate::conformance::sampling::points::Case;
use crate::conformance::sampling::sample::{Answering, Sampler};
use crate::law::{
    EvaluateError, Evaluation, Evaluator, Fields, IsolateError, IsolateOptions, IsolatedLaw, Law, LawInstance,
    LoadOptions, Plugin, Source, embedded,
};

/// Different points of a call, so that no branch of a law is learnt by heart.
const DIFFERENT: usize = 256;
/// Longest search for more points than one that a law answers.
const SEARCH: Duration = Duration::from_secs(5);

/// A law, ready to be measured.
pub(super) struct Opened {
    pub(super) here: LawInstance,
    /// In a process of its own; none where the system has no such thing.
    pub(super) there: Option<IsolatedLaw>,
    /// Ordinary points that it answers; none if it failed.
    pub(super) case: Option<Case>,
    pub(super) report: LawReport,
}

impl Opened {
    /// The law where its failure is an error like others, if the system has such a place.
    pub(super) fn safest(&self) -> &dyn Evaluator {
        self.there.as_ref().map_or(&self.here as &dyn Evaluator, |law| law as &dyn Evaluator)
    }
}

/// Opens the laws of a subject, compares them with known values and finds points that they answer.
///
/// # Errors
/// A library that gives no law, or known values that were asked for and do not fit.
pub(super) fn open(subject: &Subject, options: &BenchOptions) -> Result<Vec<Opened>, BenchError> {
    let alone = IsolateOptions {
        law: subject.law.clone(),
        options: subject.options.clone(),
        deadline: options.deadline,
        program: options.program.clone(),
        ..IsolateOptions::new(subject.source.clone())
    };
    // First in a process of its own, so that a library that crashes meanwhile is an error; what is refused without
    // having run, such as several laws without a name, is told better below.
    match IsolatedLaw::open(&alone) {
        Err(error) if error.code_has_run() || matches!(error, IsolateError::Start { .. }) => return Err(error.into()),
        _ => {}
    }
    let plugin = match &subject.source {
        Source::File(path) => Plugin::open(path, &LoadOptions::default())?,
        Source::Embedded(name) => match embedded::entry(name) {
            Some(entry) => Plugin::from_entry(entry)?,
            None => return Ok(Vec::new()),
        },
    };
    let laws: Vec<&Law> = match &subject.law {
        Some(name) => vec![plugin.law(Some(name))?],
        None => plugin.laws().iter().collect(),
    };
    let mut opened = Vec::new();
    for law in laws {
        let about = law.descriptor();
        let there = match IsolatedLaw::open(&IsolateOptions { law: Some(about.name.clone()), ..alone.clone() }) {
            Ok(law) => Some(law),
            Err(IsolateError::Platform) => None,
            Err(error) => return Err(error.into()),
        };
        let report = LawReport {
            name: about.name.clone(),
            version: about.version.clone(),
            from: subject.origin.clone(),
            bytes_per_point: bytes_per_point(about),
            speeds: Vec::new(),
            accuracy: None,
            notes: plugin.warnings().to_vec(),
            failure: None,
        };
        let here = law.create(subject.options.as_deref())?;
        let mut opening = Opened { here, there, case: None, report };
        let table = opening.known(table(subject, law, plugin.laws().len()), &subject.expected)?;
        opening.find_points(table.as_ref(), options.seed);
        opening.note();
        opened.push(opening);
    }
    Ok(opened)
}

/// The table of known values of a law, if there is one; a word on what is wrong with it otherwise.
#[allow(unsafe_code)] // reason: hands over the address of a text that a law answered.
fn table(subject: &Subject, law: &Law, laws: usize) -> Result<Option<Table>, String> {
    if let Some(path) = subject.expected.file(Some(&law.descriptor().name), laws) {
        return Table::read(&path).map(Some);
    }
    let Some(address) = law.extension(SELFTEST) else { return Ok(None) };
    // SAFETY: the address is what the law answered for this extension, and the law lives through the call.
    unsafe { selftest(address) }.map(Some)
}

impl Opened {
    /// Compares the law with known values; a table that nobody asked for and that does not fit is only told.
    fn known(
        &mut self,
        table: Result<Option<Table>, String>,
        expected: &Expected,
    ) -> Result<Option<Table>, BenchError> {
        let compared = table.and_then(|table| {
            let accuracy = table.as_ref().map(|table| Accuracy::of(self.safest(), table)).transpose()?;
            Ok((table, accuracy))
        });
        match compared {
            Ok((table, accuracy)) => {
                self.report.accuracy = accuracy;
                Ok(table)
            }
            Err(reason) if matches!(expected, Expected::File(_)) => Err(BenchError::Expected { reason }),
            Err(reason) => {
                self.report.notes.push(format!("accuracy not known: {reason}"));
                Ok(None)
            }
        }
    }

    /// Finds ordinary points that the law answers.
    fn find_points(&mut self, table: Option<&Table>, seed: u64) {
        let law = self.safest();
        let about = law.descriptor();
        let known = table.map_or_else(Vec::new, |table| table.constants(about));
        let trying = Trying { law, until: Cell::new(None), lost: RefCell::default(), last: RefCell::default() };
        let mut sampler = Sampler::new(about, seed, "bench", &known);
        // One is needed, however slow the law is.
        let one = sampler.good(&trying, 1);
        trying.until.set(Some(Instant::now() + SEARCH));
        let case = one.map(|one| sampler.good(&trying, DIFFERENT).unwrap_or(one));
        let failure = match (trying.lost.into_inner(), &case) {
            (Some(lost), _) => Some(lost.into()),
            (None, None) => {
                let last = trying.last.into_inner();
                Some(BenchError::NoInputs { law: about.name.clone(), last })
            }
            _ => None,
        };
        let case = case.filter(|_| failure.is_none()).map(|mut case| {
            // They come sorted by pressure, which no surface is.
            sampler.random.shuffle(&mut case.points);
            case
        });
        (self.report.failure, self.case) = (failure, case);
    }

    /// Notes what a reader of the figures should know.
    fn note(&mut self) {
        if self.here.descriptor().is_serial() {
            self.report.notes.push("the law is serial: of several threads one calls it at a time".to_owned());
        }
        if self.there.is_none() {
            self.report.notes.push(IsolateError::Platform.to_string());
        }
        if let Some(case) = self.case.as_ref().filter(|case| case.points.len() < DIFFERENT) {
            let points = case.points.len();
            self.report.notes.push(format!("few points were found in the time for it: the same {points} come again"));
        }
    }
}

/// A law that is tried on one point after the other.
struct Trying<'l> {
    law: &'l dyn Evaluator,
    /// When it is given up.
    until: Cell<Option<Instant>>,
    /// What became of the law, if it is gone.
    lost: RefCell<Option<EvaluateError>>,
    /// Why it refused the last point.
    last: RefCell<Option<String>>,
}

impl Answering for Trying<'_> {
    fn wears(&self, case: &Case) -> Option<bool> {
        if self.lost.borrow().is_some() || self.until.get().is_some_and(|until| Instant::now() > until) {
            return None;
        }
        let reason = match Laid::new(self.law.descriptor(), case, 1, Fields::EMPTY, false).ask(self.law) {
            Ok((Evaluation::Good | Evaluation::Unreliable { .. }, answer)) => return Some(answer.increment != 0.0),
            Ok((Evaluation::CutStep { .. }, _)) => "it wants a shorter substep".to_owned(),
            Err(AskError::Law(error @ (EvaluateError::WorkerLost { .. } | EvaluateError::Channel { .. }))) => {
                self.lost.replace(Some(error));
                return None;
            }
            Err(error) => error.to_string(),
        };
        self.last.replace(Some(reason));
        None
    }
}
