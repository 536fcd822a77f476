//! The worker: opens one law, then evaluates what the shared memory holds until its parent closes the channel.
#![allow(unsafe_code)] // reason: resets signals, takes over inherited descriptors, makes slices of shared memory.

use std::fs::File;
use std::io::{self, Read, Write};
use std::mem::ManuallyDrop;
use std::os::fd::FromRawFd;
use std::sync::Arc;

use super::super::batch::{Batch, Outputs};
use super::super::descriptor::LawDescriptor;
use super::super::evaluation::{Evaluation, Evaluator};
use super::super::fields::{Field, Shape};
use super::super::handle::LawInstance;
use super::super::loader::{LoadError, LoadOptions, Plugin};
use super::super::values::{Indices, Values};
use super::protocol::{self, Channels, Ended, Header, Open, Opened, Place};
use super::shared::Shared;
use super::{FindEmbedded, Source};

/// Exit code of a worker whose arguments or channel are wrong: it is not meant to be started by hand.
const WRONG_START: i32 = 2;
/// Exit code of a worker that lost its channel.
const LOST_CHANNEL: i32 = 5;

/// Runs a worker with the arguments behind [`super::WORKER_COMMAND`]; answers the exit code of the process.
///
/// `embedded` finds the laws of this program by name.
pub fn worker_main(arguments: &[String], embedded: FindEmbedded<'_>) -> i32 {
    let Some(channels) = Channels::parse(arguments) else {
        return WRONG_START;
    };
    reset_signals();
    keep_from_children(channels);
    // Never dropped: a law may have closed them, and Rust aborts when it closes a descriptor that is closed already.
    let mut memory = match Shared::inherit(channels.memory) {
        Ok(memory) => ManuallyDrop::new(memory),
        Err(_) => return WRONG_START,
    };
    // SAFETY: the parent made this descriptor for this process, which opens it once.
    let mut from = ManuallyDrop::new(unsafe { File::from_raw_fd(channels.from_parent) });
    // SAFETY: as above.
    let mut to = ManuallyDrop::new(unsafe { File::from_raw_fd(channels.to_parent) });
    match serve(&mut from, &mut to, &mut memory, embedded) {
        Ok(()) => 0,
        Err(_) => LOST_CHANNEL,
    }
}

/// Rust's runtime catches these to tell a stack overflow; a law's own fault must end the process at once.
fn reset_signals() {
    for signal in [libc::SIGSEGV, libc::SIGBUS, libc::SIGABRT, libc::SIGFPE, libc::SIGILL] {
        // SAFETY: setting the default action needs no handler and is allowed for all of these.
        unsafe { libc::signal(signal, libc::SIG_DFL) };
    }
}

fn keep_from_children(channels: Channels) {
    for descriptor in [channels.from_parent, channels.to_parent, channels.memory] {
        // SAFETY: takes integers; the descriptors are this process's own.
        unsafe { libc::fcntl(descriptor, libc::F_SETFD, libc::FD_CLOEXEC) };
    }
}

fn serve(from: &mut File, to: &mut File, memory: &mut Shared, embedded: FindEmbedded<'_>) -> io::Result<()> {
    let mut law: Option<LawInstance> = None;
    let mut tag = [0];
    loop {
        if from.read(&mut tag)? == 0 {
            return Ok(());
        }
        match (tag[0], &law) {
            (protocol::OPEN, _) => {
                let request: Open = protocol::payload(from)?;
                let opened = match open(&request, embedded) {
                    Ok((instance, mut warnings)) => {
                        warnings.extend(instance.take_warnings());
                        let descriptor = Box::new(instance.descriptor().clone());
                        law = Some(instance);
                        Opened::Law { descriptor, warnings }
                    }
                    Err(refused) => refused,
                };
                protocol::send(to, protocol::OPENED, &opened)?;
            }
            (protocol::EVALUATE, Some(law)) => {
                memory.follow()?;
                let ended = evaluate(law, memory)?;
                if ended.warnings.is_empty() && ended.result == Ok(Evaluation::Good) {
                    to.write_all(&[protocol::GOOD])?;
                } else {
                    protocol::send(to, protocol::ENDED, &ended)?;
                }
            }
            _ => return Err(io::Error::other("a request that does not exist")),
        }
    }
}

fn open(request: &Open, embedded: FindEmbedded<'_>) -> Result<(LawInstance, Vec<String>), Opened> {
    let refused = |error: LoadError| Opened::Refused { reason: error.to_string(), code_has_run: error.code_has_run() };
    let plugin = match &request.source {
        Source::File(path) => Plugin::open(path, &LoadOptions { sha256: request.sha256.clone() }),
        Source::Embedded(name) => match embedded(name) {
            Some(entry) => Plugin::from_entry(Arc::clone(&entry)),
            None => {
                let reason = format!("this program holds no law `{name}`");
                return Err(Opened::Refused { reason, code_has_run: false });
            }
        },
    };
    let plugin = plugin.map_err(refused)?;
    let law = plugin.law(request.law.as_deref()).map_err(refused)?;
    let instance = law.create(request.options.as_deref()).map_err(refused)?;
    Ok((instance, plugin.warnings().to_vec()))
}

fn evaluate(law: &LawInstance, memory: &Shared) -> io::Result<Ended> {
    let descriptor = law.descriptor();
    let words = memory.words(0, Header::words(descriptor));
    let header = Header::read(words, protocol::column_count(descriptor));
    let batch = batch_of(descriptor, &header, memory).map_err(io::Error::other)?;
    let points = header.points as usize;
    let widths = [1, 3, descriptor.state.len(), 1];
    let [increment, direction, state, d_pressure] =
        [0, 1, 2, 3].map(|index| output::<f64>(memory, header.outputs[index], widths[index] * points));
    let mut nothing = [];
    let mut outputs = Outputs {
        increment: increment.unwrap_or(&mut nothing),
        direction,
        state,
        status: output::<i32>(memory, header.outputs[4], points),
        d_pressure,
    };
    let result = law.evaluate_watched(&batch, &mut outputs, |piece| memory.note(&piece));
    Ok(Ended { result, warnings: law.take_warnings() })
}

/// The array of an output; the parent gave each a place of its own in the shared memory.
#[allow(clippy::mut_from_ref)] // reason: the memory is shared between processes, and these ranges never overlap
fn output<T>(memory: &Shared, offset: u64, length: usize) -> Option<&mut [T]> {
    if offset == protocol::ABSENT {
        return None;
    }
    let words = (length * size_of::<T>()).div_ceil(8);
    let first = memory.at(offset as usize, words).cast::<T>();
    // SAFETY: `at` checked the range, which overlaps no column and no other output; the parent waits and does not touch it.
    Some(unsafe { std::slice::from_raw_parts_mut(first, length) })
}

fn batch_of<'m>(
    law: &'m LawDescriptor,
    header: &Header,
    memory: &'m Shared,
) -> Result<Batch<'m>, super::super::batch::BatchError> {
    let points = header.points as usize;
    let mut builder = Batch::builder(law, points).numbers(header.numbers);
    let mut columns = header.columns.iter();
    let mut next = || columns.next().copied().unwrap_or(Place { offset: protocol::ABSENT, step: 0 });
    for field in law.fields().iter() {
        let place = next();
        builder = match field.shape() {
            Shape::Index => builder.indices(field, indices(memory, place, points)),
            shape => builder.field(field, values(memory, place, points, shape.width(), is_vector(field))),
        };
    }
    let constants: Vec<Values<'_>> = law.constants.iter().map(|_| values(memory, next(), points, 1, false)).collect();
    let inputs: Vec<Values<'_>> = law.inputs.iter().map(|_| values(memory, next(), points, 1, false)).collect();
    builder = builder.constant_values(&constants).inputs(&inputs);
    if !law.state.is_empty() {
        builder = builder.state(values(memory, next(), points, law.state.len(), false));
    }
    builder.build()
}

fn is_vector(field: Field) -> bool {
    field.shape() == Shape::Vector
}

/// The words of a column as the parent copied them: the step is kept, so that the law takes the same path.
fn reals(memory: &Shared, place: Place, length: usize) -> &[f64] {
    let words = memory.words(place.offset as usize, length);
    // SAFETY: u64 and f64 have the same size and alignment, and any bits are a double.
    unsafe { std::slice::from_raw_parts(words.as_ptr().cast(), words.len()) }
}

fn values(memory: &Shared, place: Place, points: usize, width: usize, vector: bool) -> Values<'_> {
    let step = place.step as usize;
    if place.offset == protocol::ABSENT {
        return Values::Absent;
    }
    let Some(last) = points.checked_sub(1) else {
        return Values::PerPoint(&[]);
    };
    let data = reals(memory, place, last * step + width);
    match data {
        [x, y, z] if step == 0 && vector => Values::UniformVector([*x, *y, *z]),
        [first, ..] if step == 0 => Values::Uniform(*first),
        data if step == width => Values::PerPoint(data),
        data => Values::Strided { data, step },
    }
}

fn indices(memory: &Shared, place: Place, points: usize) -> Indices<'_> {
    let step = place.step as usize;
    if place.offset == protocol::ABSENT {
        return Indices::Absent;
    }
    let Some(last) = points.checked_sub(1) else {
        return Indices::PerPoint(&[]);
    };
    let words = memory.words(place.offset as usize, last * step + 1);
    // SAFETY: u64 and i64 have the same size and alignment, and any bits are an integer.
    let data: &[i64] = unsafe { std::slice::from_raw_parts(words.as_ptr().cast(), words.len()) };
    match data {
        [first, ..] if step == 0 => Indices::Uniform(*first),
        data if step == 1 => Indices::PerPoint(data),
        data => Indices::Strided { data, step },
    }
}
