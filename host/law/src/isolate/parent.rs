//! The parent's side: sends batches to a worker, waits with a deadline, and says what became of it.

use std::io::{PipeReader, PipeWriter, Read, Write};
use std::ops::Range;
use std::os::fd::{AsFd, AsRawFd};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::super::batch::{Batch, Outputs};
use super::super::descriptor::LawDescriptor;
use super::super::evaluation::{EvaluateError, Evaluation, Evaluator};
use super::super::file_facts::{FileFacts, check_pin};
use super::super::handle::{PIECE, fits};
use super::super::loader::LoadError;
use super::process::{Event, Process};
use super::protocol::{self, Channels, Ended, FIXED_WORDS, Header, Open, Opened, Place};
use super::search::Asked;
use super::shared::Shared;
use super::{IsolateError, IsolateOptions, Source, WORKER_COMMAND};

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

    fn lost(&self, call: u64, batch: &Batch<'_>, how: String, piece: Range<usize>, asked: Asked) -> EvaluateError {
        let at = self.search(batch, piece.clone(), asked);
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
        let asked = Asked::of(outputs);
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
                    let piece = part.start + piece.start..part.start + piece.end;
                    return Err(self.lost(call, batch, how, piece, asked));
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

/// A worker process with the law open, and the channel to it.
pub(super) struct Worker {
    // The channel is closed first, so that a worker that waits ends by itself.
    to: PipeWriter,
    from: PipeReader,
    memory: Shared,
    process: Process,
}

/// Why a call of a worker has no end.
pub(super) enum Trouble {
    Lost { how: String, piece: Range<usize> },
    Channel(std::io::Error),
}

impl From<std::io::Error> for Trouble {
    fn from(error: std::io::Error) -> Self {
        Self::Channel(error)
    }
}

impl Worker {
    fn start(options: &IsolateOptions) -> Result<(Self, LawDescriptor, Vec<String>), IsolateError> {
        let library = protocol::source_name(&options.source);
        let here = || std::env::current_exe().unwrap_or_else(|_| PathBuf::from("/proc/self/exe"));
        let program = options.program.clone().unwrap_or_else(here);
        let started = Self::start_process(&program);
        let mut worker = started.map_err(|source| IsolateError::Start { program, source })?;
        let request = Open {
            source: options.source.clone(),
            sha256: options.sha256.clone(),
            law: options.law.clone(),
            options: options.options.clone(),
        };
        // A worker that is gone is told by what became of it, below.
        let _ = protocol::send(&mut worker.to, protocol::OPEN, &request);
        match worker.answer(options.deadline) {
            Ok(protocol::OPENED) => {}
            Ok(tag) => {
                let reason = format!("a message of kind {tag}");
                return Err(IsolateError::Answer { library, reason });
            }
            Err(Trouble::Lost { how, .. }) => return Err(IsolateError::Lost { library, how }),
            Err(Trouble::Channel(error)) => {
                return Err(IsolateError::Answer { library, reason: error.to_string() });
            }
        }
        match protocol::payload(&mut worker.from) {
            Ok(Opened::Law { descriptor, warnings }) => Ok((worker, *descriptor, warnings)),
            Ok(Opened::Refused { reason, code_has_run }) => Err(IsolateError::Refused { reason, code_has_run }),
            Err(error) => Err(IsolateError::Answer { library, reason: error.to_string() }),
        }
    }

    fn start_process(program: &std::path::Path) -> std::io::Result<Self> {
        let memory = Shared::create(FIXED_WORDS)?;
        let (for_worker, to) = std::io::pipe()?;
        let (from, by_worker) = std::io::pipe()?;
        let channels = Channels {
            from_parent: for_worker.as_raw_fd(),
            to_parent: by_worker.as_raw_fd(),
            memory: memory.descriptor(),
        };
        let inherited = vec![channels.from_parent, channels.to_parent, channels.memory];
        let arguments = std::iter::once(WORKER_COMMAND.to_owned()).chain(channels.arguments()).collect();
        let process = Process::start(program, arguments, inherited, std::io::stderr().as_fd())?;
        Ok(Self { to, from, memory, process })
    }

    /// Waits for the first byte of an answer.
    fn answer(&mut self, deadline: Duration) -> Result<u8, Trouble> {
        let lost = |how: String| Trouble::Lost { how, piece: 0..0 };
        match self.process.wait_for(self.from.as_raw_fd(), deadline)? {
            Event::Readable => {
                let mut tag = [0];
                match self.from.read(&mut tag)? {
                    0 => Err(lost(self.process.fate())),
                    _ => Ok(tag[0]),
                }
            }
            Event::Ended => Err(lost(self.process.fate())),
            Event::Deadline => {
                self.process.end();
                Err(lost(format!("did not answer within {} s and was ended", deadline.as_secs_f64())))
            }
        }
    }

    /// One call: columns into the shared memory, a byte each way, outputs back.
    pub(super) fn call(
        &mut self,
        batch: &Batch<'_>,
        outputs: &mut Outputs<'_>,
        deadline: Duration,
    ) -> Result<Ended, Trouble> {
        let header = self.lay_out(batch, outputs)?;
        let piece = |memory: &Shared| memory.noted(batch.points());
        if self.to.write_all(&[protocol::EVALUATE]).is_err() {
            let how = self.process.fate();
            return Err(Trouble::Lost { how, piece: piece(&self.memory) });
        }
        let ended = match self.answer(deadline) {
            Ok(protocol::GOOD) => Ended { result: Ok(Evaluation::Good), warnings: Vec::new() },
            Ok(protocol::ENDED) => protocol::payload::<Ended>(&mut self.from)?,
            Ok(tag) => {
                return Err(Trouble::Channel(std::io::Error::other(format!("a message of kind {tag}"))));
            }
            Err(Trouble::Lost { how, .. }) => {
                return Err(Trouble::Lost { how, piece: piece(&self.memory) });
            }
            Err(other) => return Err(other),
        };
        if ended.result.is_ok() {
            self.fetch(&header, outputs);
        }
        Ok(ended)
    }

    fn lay_out(&mut self, batch: &Batch<'_>, outputs: &Outputs<'_>) -> std::io::Result<Header> {
        let law = batch.descriptor();
        let spans = batch.spans();
        let mut used = Header::words(law);
        let mut room = |words: usize| {
            // Arrays begin on a cache line, as a host's own do not always: the law must not depend on it.
            let offset = used.next_multiple_of(8);
            used = offset + words;
            offset as u64
        };
        let lengths = [
            Some(outputs.increment.len()),
            outputs.direction.as_ref().map(|array| array.len()),
            outputs.state.as_ref().map(|array| array.len()),
            outputs.d_pressure.as_ref().map(|array| array.len()),
            outputs.status.as_ref().map(|array| array.len().div_ceil(2)),
        ];
        let places = lengths.map(|length| length.map_or(protocol::ABSENT, &mut room));
        let columns: Vec<Place> = spans
            .iter()
            .map(|span| match span {
                Some(span) => Place { offset: room(span.words.len()), step: span.step as u64 },
                None => Place { offset: protocol::ABSENT, step: 0 },
            })
            .collect();
        self.memory.reserve(used)?;
        for (span, place) in spans.iter().zip(&columns) {
            if let Some(span) = span {
                self.memory.words_mut(place.offset as usize, span.words.len()).copy_from_slice(span.words);
            }
        }
        let header = Header {
            bytes: 8 * self.memory.len() as u64,
            points: batch.points() as u64,
            numbers: *batch.numbers(),
            outputs: places,
            columns,
        };
        header.write(self.memory.words_mut(0, Header::words(law)));
        Ok(header)
    }

    fn fetch(&self, header: &Header, outputs: &mut Outputs<'_>) {
        let arrays = [
            Some(&mut *outputs.increment),
            outputs.direction.as_deref_mut(),
            outputs.state.as_deref_mut(),
            outputs.d_pressure.as_deref_mut(),
        ];
        for (array, offset) in arrays.into_iter().zip(header.outputs) {
            if let Some(array) = array {
                let words = self.memory.words(offset as usize, array.len());
                array.iter_mut().zip(words).for_each(|(place, word)| *place = f64::from_bits(*word));
            }
        }
        if let Some(status) = outputs.status.as_deref_mut() {
            let words = self.memory.words(header.outputs[4] as usize, status.len().div_ceil(2));
            let halves = words.iter().flat_map(|word| {
                let bytes = word.to_ne_bytes();
                [[bytes[0], bytes[1], bytes[2], bytes[3]], [bytes[4], bytes[5], bytes[6], bytes[7]]]
            });
            status.iter_mut().zip(halves).for_each(|(place, half)| *place = i32::from_ne_bytes(half));
        }
    }
}
