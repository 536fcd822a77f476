//! The channel to a worker: columns into shared memory, a byte each way, a deadline on the answer.

use std::io::{PipeReader, PipeWriter, Read, Write};
use std::ops::Range;
use std::os::fd::AsRawFd;
use std::path::PathBuf;
use std::time::Duration;

use super::super::batch::{Batch, Outputs};
use super::super::descriptor::LawDescriptor;
use super::super::evaluation::Evaluation;
use super::process::{Event, Process};
use super::protocol::{self, Channels, Ended, FIXED_WORDS, Header, Open, Opened, Place};
use super::shared::Shared;
use super::{IsolateError, IsolateOptions, WORKER_COMMAND};

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
    /// Starts a worker and has it open the law; gives the law's description and the loader's warnings too.
    pub(super) fn start(options: &IsolateOptions) -> Result<(Self, LawDescriptor, Vec<String>), IsolateError> {
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
        let inherited = [channels.from_parent, channels.to_parent, channels.memory];
        let arguments = std::iter::once(WORKER_COMMAND.to_owned()).chain(channels.arguments()).collect();
        let process = Process::start(program, arguments, inherited)?;
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
