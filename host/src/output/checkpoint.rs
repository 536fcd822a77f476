//! The file of a checkpoint: everything to go on with to the bit, and a hash that finds what time has done to it.
//!
//! Layout, numbers in little-endian order: a line that says what the file is; format version (u64); length of the header (u64); the header, a JSON
//! document of names and lengths; the numbers; the rows of the history, each a word whose bits say which quantities are
//! known and then all quantities; the arrays; SHA-256 over everything before it.

mod keeper;

use std::borrow::Cow;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::OutputError;
use super::little_endian::{write_counts, write_floats};
use crate::record::{Checkpoint, Cost, History, HistoryRow, Identity};
pub use keeper::{CHECKPOINT, Keeper};

/// How the file begins.
const MAGIC: &[u8; 16] = b"wearlaw-restart\n";
/// Version of the layout; a file of another one is refused.
const VERSION: u64 = 1;
/// Quantities of a row.
const QUANTITIES: usize = 12;
/// Length of the hash.
const HASH: usize = 32;

/// A file of fields of the part of a run that is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EarlierFile {
    /// Its name in the folder `fields`.
    pub name: String,
    /// Represented time of it.
    pub time: f64,
    /// Its length.
    pub bytes: u64,
}

/// The fields of the part of a run that is done.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EarlierFields {
    /// The folder whose `fields` holds them, relative to the folder of the results: `.` after a run has ended.
    pub place: String,
    /// The files in the order in which they were written.
    pub files: Vec<EarlierFile>,
}

#[derive(Serialize, Deserialize)]
struct Header {
    identity: Identity,
    fields: EarlierFields,
    /// Whether the run had come to its end.
    ended: bool,
    warnings: Vec<String>,
    asides: Vec<String>,
    cost: Cost,
    numbers: Vec<String>,
    rows: usize,
    arrays: Vec<(String, usize)>,
}

/// What a file of a checkpoint holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Stored {
    /// What it is a checkpoint of.
    pub identity: Identity,
    /// Fields written before.
    pub fields: EarlierFields,
    /// Whether the run had come to its end.
    pub ended: bool,
    /// The state.
    pub checkpoint: Checkpoint<'static>,
}

/// Writes the bytes of a checkpoint.
///
/// # Errors
/// Those of the writer.
pub fn write_checkpoint(
    to: &mut BufWriter<fs::File>,
    identity: &Identity,
    fields: &EarlierFields,
    ended: bool,
    checkpoint: &Checkpoint<'_>,
) -> io::Result<()> {
    encode(to, identity, fields, ended, checkpoint)
}

fn encode(
    to: &mut impl Write,
    identity: &Identity,
    fields: &EarlierFields,
    ended: bool,
    checkpoint: &Checkpoint<'_>,
) -> io::Result<()> {
    let header = Header {
        identity: identity.clone(),
        fields: fields.clone(),
        ended,
        warnings: checkpoint.warnings.to_vec(),
        asides: checkpoint.asides.to_vec(),
        cost: checkpoint.cost,
        numbers: checkpoint.numbers.keys().cloned().collect(),
        rows: checkpoint.history.rows.len(),
        arrays: checkpoint.arrays.iter().map(|(name, data)| (name.clone(), data.len())).collect(),
    };
    let header = serde_json::to_vec(&header)?;
    let mut to = Hashing { to, hash: Sha256::new() };
    to.write_all(MAGIC)?;
    write_counts(&mut to, [VERSION, header.len() as u64])?;
    to.write_all(&header)?;
    write_floats(&mut to, std::iter::once(checkpoint.time).chain(checkpoint.numbers.values().copied()))?;
    write_counts(&mut to, checkpoint.history.rows.iter().flat_map(taken_apart))?;
    for data in checkpoint.arrays.values() {
        write_floats(&mut to, data.iter().copied())?;
    }
    let Hashing { to, hash } = to;
    to.write_all(&hash.finalize())
}

/// Passes bytes on and adds them to a hash.
struct Hashing<'w, W> {
    to: &'w mut W,
    hash: Sha256,
}

impl<W: Write> Write for Hashing<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Reads the checkpoint `path`.
///
/// # Errors
/// `Io`; `NotACheckpoint`, `CheckpointVersion` and `CheckpointDamaged` for other files, other versions of the layout and
/// files that are cut short or changed.
pub fn read_checkpoint(path: &Path) -> Result<Stored, OutputError> {
    let bytes = fs::read(path).map_err(OutputError::io("read", path))?;
    decode(&bytes).map_err(|problem| match problem {
        Problem::Other => OutputError::NotACheckpoint { path: path.into() },
        Problem::Version(found) => OutputError::CheckpointVersion { path: path.into(), found, expected: VERSION },
        Problem::Damaged(what) => OutputError::CheckpointDamaged { path: path.into(), what },
    })
}

#[derive(Debug, PartialEq)]
enum Problem {
    Other,
    Version(u64),
    Damaged(&'static str),
}

fn decode(bytes: &[u8]) -> Result<Stored, Problem> {
    let rest = bytes.strip_prefix(MAGIC).ok_or(Problem::Other)?;
    let mut from = Words { bytes: rest };
    let version = from.count()?;
    if version != VERSION {
        return Err(Problem::Version(version));
    }
    let end = bytes.len().checked_sub(HASH).filter(|end| *end >= MAGIC.len() + 16);
    let (content, hash) = bytes.split_at(end.ok_or(SHORT)?);
    if Sha256::digest(content)[..] != *hash {
        return Err(Problem::Damaged("its content does not agree with its hash, so it was cut short or changed"));
    }
    from = Words { bytes: &content[MAGIC.len() + 8..] };
    let length = from.count()?;
    let header: Header = serde_json::from_slice(from.take(length)?).map_err(|_| ODD)?;
    let time = from.float()?;
    let numbers = header.numbers.into_iter().map(|name| Ok((name, from.float()?))).collect::<Result<_, _>>()?;
    let mut history = History::default();
    for _ in 0..header.rows {
        let known = from.count()?;
        let mut values = [0.0; QUANTITIES];
        for value in &mut values {
            *value = from.float()?;
        }
        history.rows.push(put_together(known, values));
    }
    let mut arrays = std::collections::BTreeMap::new();
    for (name, count) in header.arrays {
        let taken = from.take((count as u64).checked_mul(8).ok_or(SHORT)?)?;
        let data: Vec<f64> = taken.chunks_exact(8).map(float).collect();
        arrays.insert(name, Cow::Owned(data));
    }
    if !from.bytes.is_empty() {
        return Err(ODD);
    }
    Ok(Stored {
        identity: header.identity,
        fields: header.fields,
        ended: header.ended,
        checkpoint: Checkpoint {
            time,
            history: Cow::Owned(history),
            warnings: header.warnings.into(),
            asides: header.asides.into(),
            cost: header.cost,
            numbers,
            arrays,
        },
    })
}

const SHORT: Problem = Problem::Damaged("it ends too early");
const ODD: Problem = Problem::Damaged("its header does not describe its content");

fn float(word: &[u8]) -> f64 {
    f64::from_bits(word.iter().rev().fold(0, |bits, byte| bits << 8 | u64::from(*byte)))
}

/// The part of a file that is still to be read.
struct Words<'b> {
    bytes: &'b [u8],
}

impl<'b> Words<'b> {
    fn take(&mut self, length: u64) -> Result<&'b [u8], Problem> {
        let length = usize::try_from(length).map_err(|_| SHORT)?;
        let (taken, rest) = self.bytes.split_at_checked(length).ok_or(SHORT)?;
        self.bytes = rest;
        Ok(taken)
    }

    fn float(&mut self) -> Result<f64, Problem> {
        self.take(8).map(float)
    }

    fn count(&mut self) -> Result<u64, Problem> {
        self.float().map(f64::to_bits)
    }
}

/// A word whose bit is set where a quantity of a row is known, and the bits of all of them.
fn taken_apart(row: &HistoryRow) -> [u64; QUANTITIES + 1] {
    let all: [Option<f64>; QUANTITIES] = [
        Some(row.time),
        Some(row.dt),
        Some(row.sliding_distance),
        row.load,
        row.approach,
        Some(row.max_pressure),
        row.contact_area,
        Some(row.max_wear_depth),
        row.wear_volume,
        Some(row.scale),
        Some(row.simulated_time),
        Some(row.cycle),
    ];
    let mut words = [0; QUANTITIES + 1];
    for (bit, value) in all.iter().enumerate() {
        words[0] |= u64::from(value.is_some()) << bit;
        words[bit + 1] = value.unwrap_or_default().to_bits();
    }
    words
}

fn put_together(known: u64, v: [f64; QUANTITIES]) -> HistoryRow {
    let maybe = |bit: usize| (known >> bit & 1 == 1).then_some(v[bit]);
    HistoryRow {
        time: v[0],
        dt: v[1],
        sliding_distance: v[2],
        load: maybe(3),
        approach: maybe(4),
        max_pressure: v[5],
        contact_area: maybe(6),
        max_wear_depth: v[7],
        wear_volume: maybe(8),
        scale: v[9],
        simulated_time: v[10],
        cycle: v[11],
    }
}

#[cfg(test)]
mod tests;
