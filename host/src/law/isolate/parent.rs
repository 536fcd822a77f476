//! The parent's side: an evaluator that hands its batches to workers and says what became of one that was lost.

use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::super::batch::{Batch, Outputs};
use super::super::descriptor::LawDescriptor;
use super::super::evaluation::{EvaluateError, Evaluation, Evaluator};
use super::super::file_facts::{FileFacts, check_pin};
use super::super::handle::{PIECE, fits};
use super::super::loader::LoadError;
use super::channel::{Trouble, Worker};
use super::{IsolateError, IsolateOptions, Source};

/// Points in one call of a worker: whole pieces, so that the law sees the same ones as in process, and enough of them
/// that the two microseconds of a call do not show.
const CALL: usize = 16 * PIECE;

/// A law in worker processes of its own, one for each thread that calls it at the same time.
///
/// A worker that is lost ends the call; the next call starts a new one.
pub struct IsolatedLaw {
    options: IsolateOptions,
    descriptor: LawDescriptor,
    idle: Mutex<Vec<Worker>>,
    turn: Option<Mutex<()>>,
    calls: Mutex<u64>,
    warnings: Mutex<Warnings>,
}

#[derive(Default)]
struct Warnings {
    fresh: Vec<String>,
    told: Vec<String>,
}

impl std::fmt::Debug for IsolatedLaw {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("IsolatedLaw").field("name", &self.descriptor.name).finish_non_exhaustive()
    }
}

impl IsolatedLaw {
    /// Starts a worker and has it open the law.
    ///
    /// # Errors
    /// What is wrong with the file (before a worker is started), what the loader says in the worker, or what became of
    /// a worker that was lost meanwhile.
    pub fn open(options: &IsolateOptions) -> Result<Self, IsolateError> {
        if let Source::File(path) = &options.source {
            let facts = FileFacts::read(path).map_err(LoadError::from)?;
            if let Some(pin) = &options.sha256 {
                check_pin(&facts, pin).map_err(LoadError::from)?;
            }
        }
        let (worker, descriptor, warnings) = Worker::start(options)?;
        let law = Self {
            options: options.clone(),
            turn: descriptor.is_serial().then(Mutex::default),
            descriptor,
            idle: Mutex::new(vec![worker]),
            calls: Mutex::new(0),
            warnings: Mutex::default(),
        };
        law.warn(warnings);
        Ok(law)
    }

    fn warn(&self, texts: Vec<String>) {
        let mut warnings = lock(&self.warnings);
        for text in texts {
            // Each worker says it anew.
            if !warnings.told.contains(&text) {
                warnings.told.push(text.clone());
                warnings.fresh.push(text);
            }
        }
    }

    /// A new worker with the law open.
    pub(super) fn fresh(&self) -> Result<Worker, IsolateError> {
        Worker::start(&self.options).map(|(worker, _, warnings)| {
            self.warn(warnings);
            worker
        })
    }

    pub(super) fn deadline(&self) -> Duration {
        self.options.deadline
    }

    fn channel_error(&self, call: u64, reason: impl ToString) -> EvaluateError {
        EvaluateError::Channel { law: self.descriptor.name.clone(), call, reason: reason.to_string() }
    }

    fn lost(&self, call: u64, batch: &Batch<'_>, how: String, piece: Range<usize>) -> EvaluateError {
        let at = self.search(batch, piece.clone());
        EvaluateError::WorkerLost {
            law: self.descriptor.name.clone(),
            how,
            call,
            first: batch.first() + piece.start,
            last: batch.first() + piece.end.max(piece.start + 1) - 1,
            at,
        }
    }
}

impl Evaluator for IsolatedLaw {
    fn descriptor(&self) -> &LawDescriptor {
        &self.descriptor
    }

    fn evaluate(&self, batch: &Batch<'_>, outputs: &mut Outputs<'_>) -> Result<Evaluation, EvaluateError> {
        fits(&self.descriptor, batch, outputs)?;
        let _turn = self.turn.as_ref().map(lock);
        let call = {
            let mut calls = lock(&self.calls);
            *calls += 1;
            *calls
        };
        let idle = lock(&self.idle).pop();
        let mut worker = match idle {
            Some(worker) => worker,
            None => self.fresh().map_err(|error| self.channel_error(call, error))?,
        };
        let mut worst = Evaluation::Good;
        let mut rest = outputs.reborrow();
        let mut start = 0;
        while start < batch.points() {
            let part = start..batch.points().min(start + CALL);
            let (mut mine, others) = rest.split_at(part.len(), self.descriptor.state.len());
            rest = others;
            start = part.end;
            let ended = match worker.call(&batch.range(part.clone()), &mut mine, self.options.deadline) {
                Ok(ended) => ended,
                Err(Trouble::Lost { how, piece }) => {
                    drop(worker);
                    return Err(self.lost(call, batch, how, part.start + piece.start..part.start + piece.end));
                }
                Err(Trouble::Channel(error)) => return Err(self.channel_error(call, error)),
            };
            self.warn(ended.warnings);
            // The worker counts from the first point of its part.
            let first = batch.first() + part.start;
            match ended.result {
                Ok(mut evaluation) => {
                    if let Some(at) = evaluation.at_mut() {
                        at.point += first;
                    }
                    worst = worst.worse(evaluation);
                }
                Err(mut error) => {
                    if let Some(at) = error.at_mut() {
                        at.point += first;
                    }
                    lock(&self.idle).push(worker);
                    return Err(error);
                }
            }
        }
        lock(&self.idle).push(worker);
        Ok(worst)
    }

    fn take_warnings(&self) -> Vec<String> {
        std::mem::take(&mut lock(&self.warnings).fresh)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
