//! What passes between parent and worker: tagged messages on two pipes, and a header of words in shared memory.

use std::io::{self, Read, Write};
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::super::descriptor::LawDescriptor;
use super::super::evaluation::{EvaluateError, Evaluation};
use super::super::values::{CallNumbers, UnitSizes};
use super::Source;

/// To the worker: evaluate what the shared memory holds. No payload.
pub(super) const EVALUATE: u8 = b'E';
/// To the worker: open a law ([`Open`]).
pub(super) const OPEN: u8 = b'O';
/// From the worker: the values are good. No payload.
pub(super) const GOOD: u8 = b'G';
/// From the worker: any other end of a call ([`Ended`]).
pub(super) const ENDED: u8 = b'R';
/// From the worker: the law is open ([`Opened`]) or refused.
pub(super) const OPENED: u8 = b'D';

/// More than any message: what a law wrote over the channel is not taken for a length.
const LONGEST: u32 = 1 << 26;

/// Which law to open.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Open {
    pub(super) source: Source,
    pub(super) sha256: Option<String>,
    pub(super) law: Option<String>,
    pub(super) options: Option<String>,
}

/// What became of it.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Opened {
    Law { descriptor: Box<LawDescriptor>, warnings: Vec<String> },
    Refused { reason: String, code_has_run: bool },
}

/// How a call ended.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Ended {
    pub(super) result: Result<Evaluation, EvaluateError>,
    pub(super) warnings: Vec<String>,
}

/// Sends a message with a payload.
pub(super) fn send<T: Serialize>(to: &mut impl Write, tag: u8, payload: &T) -> io::Result<()> {
    let payload = serde_json::to_vec(payload)?;
    let length = u32::try_from(payload.len()).map_err(io::Error::other)?;
    let mut message = vec![tag];
    message.extend(length.to_le_bytes());
    message.extend(payload);
    to.write_all(&message)
}

/// Receives the payload of a message whose tag has been read.
pub(super) fn payload<T: for<'de> Deserialize<'de>>(from: &mut impl Read) -> io::Result<T> {
    let mut length = [0; 4];
    from.read_exact(&mut length)?;
    let length = u32::from_le_bytes(length);
    if length > LONGEST {
        return Err(io::Error::other(format!("a message of {length} bytes")));
    }
    let mut bytes = vec![0; length as usize];
    from.read_exact(&mut bytes)?;
    Ok(serde_json::from_slice(&bytes)?)
}

/// The arguments of a worker: the descriptors that it inherits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Channels {
    pub(super) from_parent: i32,
    pub(super) to_parent: i32,
    pub(super) memory: i32,
}

impl Channels {
    pub(super) fn arguments(self) -> [String; 3] {
        [self.from_parent, self.to_parent, self.memory].map(|descriptor| descriptor.to_string())
    }

    pub(super) fn parse(arguments: &[String]) -> Option<Self> {
        let mut numbers = arguments.iter().map(|argument| argument.parse::<i32>().ok().filter(|number| *number > 2));
        let channels = Self { from_parent: numbers.next()??, to_parent: numbers.next()??, memory: numbers.next()?? };
        numbers.next().is_none().then_some(channels)
    }
}

/// Words of the header before those of the columns.
pub(super) const FIXED_WORDS: usize = 32;
/// Word: bytes of the shared memory.
pub(super) const WORD_BYTES: usize = 0;
/// Word: first point that the law is at, written by the worker.
pub(super) const WORD_AT_FIRST: usize = 1;
/// Word: point behind the last that the law is at, written by the worker.
pub(super) const WORD_AT_END: usize = 2;
const WORD_POINTS: usize = 3;
const WORD_OUTPUTS: usize = 4;
const WORD_NUMBERS: usize = 10;

/// Offset of a column or output that is not there.
pub(super) const ABSENT: u64 = u64::MAX;

/// One column: where it begins, in words from the start of the memory, and words from point to point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) offset: u64,
    pub(super) step: u64,
}

/// What the parent says of a call before it sends [`EVALUATE`].
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) bytes: u64,
    pub(super) points: u64,
    pub(super) numbers: CallNumbers,
    /// Offsets of increment, direction, state, d_pressure and status.
    pub(super) outputs: [u64; 5],
    /// Fields of the law in the order of their bits, constants, inputs, state.
    pub(super) columns: Vec<Place>,
}

/// Columns of a law: its fields, constants, inputs and, if there are any, state variables.
pub(super) fn column_count(law: &LawDescriptor) -> usize {
    law.fields().iter().count() + law.constants.len() + law.inputs.len() + usize::from(!law.state.is_empty())
}

impl Header {
    /// Words of the header of a law.
    pub(super) fn words(law: &LawDescriptor) -> usize {
        FIXED_WORDS + 2 * column_count(law)
    }

    /// Writes it at the start of the shared memory.
    pub(super) fn write(&self, words: &mut [u64]) {
        words[WORD_BYTES] = self.bytes;
        words[WORD_AT_FIRST] = 0;
        words[WORD_AT_END] = self.points;
        words[WORD_POINTS] = self.points;
        words[WORD_OUTPUTS..WORD_OUTPUTS + 5].copy_from_slice(&self.outputs);
        words[WORD_NUMBERS..WORD_NUMBERS + 17].copy_from_slice(&number_words(&self.numbers));
        for (pair, column) in words[FIXED_WORDS..].chunks_exact_mut(2).zip(&self.columns) {
            pair.copy_from_slice(&[column.offset, column.step]);
        }
    }

    /// Reads it from the start of the shared memory.
    pub(super) fn read(words: &[u64], columns: usize) -> Self {
        let mut outputs = [0; 5];
        outputs.copy_from_slice(&words[WORD_OUTPUTS..WORD_OUTPUTS + 5]);
        let places = words[FIXED_WORDS..].chunks_exact(2).take(columns);
        Self {
            bytes: words[WORD_BYTES],
            points: words[WORD_POINTS],
            numbers: numbers_of(&words[WORD_NUMBERS..WORD_NUMBERS + 17]),
            outputs,
            columns: places.map(|pair| Place { offset: pair[0], step: pair[1] }).collect(),
        }
    }
}

fn number_words(numbers: &CallNumbers) -> [u64; 17] {
    [
        numbers.dimension.cast_unsigned(),
        numbers.time.to_bits(),
        numbers.dt.to_bits(),
        numbers.step_time.to_bits(),
        numbers.load_step.cast_unsigned(),
        numbers.substep.cast_unsigned(),
        numbers.cycle.cast_unsigned(),
        numbers.material.cast_unsigned(),
        numbers.pair.cast_unsigned(),
        numbers.body.cast_unsigned(),
        numbers.counter_body.cast_unsigned(),
        numbers.reference_temperature.to_bits(),
        numbers.absolute_zero.to_bits(),
        numbers.units.metre.to_bits(),
        numbers.units.kilogram.to_bits(),
        numbers.units.second.to_bits(),
        numbers.units.kelvin.to_bits(),
    ]
}

fn numbers_of(words: &[u64]) -> CallNumbers {
    let whole = |index: usize| words[index].cast_signed();
    let real = |index: usize| f64::from_bits(words[index]);
    CallNumbers {
        dimension: whole(0),
        time: real(1),
        dt: real(2),
        step_time: real(3),
        load_step: whole(4),
        substep: whole(5),
        cycle: whole(6),
        material: whole(7),
        pair: whole(8),
        body: whole(9),
        counter_body: whole(10),
        reference_temperature: real(11),
        absolute_zero: real(12),
        units: UnitSizes { metre: real(13), kilogram: real(14), second: real(15), kelvin: real(16) },
    }
}

/// What messages call a source.
pub(super) fn source_name(source: &Source) -> String {
    match source {
        Source::File(path) => PathBuf::from(path).display().to_string(),
        Source::Embedded(name) => name.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_survives_the_shared_memory() {
        let header = Header {
            bytes: 4096,
            points: 7,
            numbers: CallNumbers { time: 0.1, dt: -0.0, load_step: -3, cycle: 9, ..CallNumbers::default() },
            outputs: [50, ABSENT, 51, ABSENT, 52],
            columns: vec![
                Place { offset: 40, step: 0 },
                Place { offset: ABSENT, step: 0 },
                Place { offset: 41, step: 9 },
            ],
        };
        let mut words = vec![0; FIXED_WORDS + 6];
        header.write(&mut words);
        assert_eq!(Header::read(&words, 3), header);
        assert_eq!((words[WORD_AT_FIRST], words[WORD_AT_END]), (0, 7));
    }

    #[test]
    fn channels_are_three_descriptors_above_the_standard_ones() {
        let channels = Channels { from_parent: 3, to_parent: 5, memory: 4 };
        assert_eq!(Channels::parse(&channels.arguments()), Some(channels));
        for wrong in [&["3", "4"][..], &["1", "4", "5"], &["3", "4", "x"], &["3", "4", "5", "6"]] {
            let wrong: Vec<String> = wrong.iter().map(|text| (*text).to_owned()).collect();
            assert_eq!(Channels::parse(&wrong), None, "{wrong:?}");
        }
    }

    #[test]
    fn a_message_that_is_cut_or_absurdly_long_is_an_error() {
        let mut message = Vec::new();
        send(&mut message, ENDED, &vec![1.0e-300_f64, 0.1 + 0.2]).expect("memory takes it");
        assert_eq!(message[0], ENDED);
        assert_eq!(payload::<Vec<f64>>(&mut &message[1..]).expect("its own text"), [1.0e-300, 0.1 + 0.2]);
        assert!(payload::<Vec<f64>>(&mut &message[1..message.len() - 1]).is_err());
        assert!(payload::<Vec<f64>>(&mut &[255; 64][..]).is_err());
    }
}
