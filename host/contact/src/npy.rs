//! One array in `.npy` format, alone or in an NPZ archive: its header, and its elements as doubles or as ids.
//!
//! Source: the NumPy format description (`numpy.lib.format`), versions 1 to 3.

use std::io::Read;

/// What can be wrong with an array, apart from its shape.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ArrayFault {
    /// The first bytes are not those of an array.
    #[error("not an array in .npy format")]
    Magic,
    /// A format version other than 1, 2 and 3.
    #[error("format version {0}, expected 1, 2 or 3")]
    Version(u8),
    /// The header lacks a key or holds something else than expected there.
    #[error("header without a readable `{0}`")]
    Header(&'static str),
    /// Elements that are not real numbers.
    #[error("elements of type {0}, expected float64 or float32, or integers of 1 to 8 bytes")]
    Type(String),
    /// Fewer or more bytes than the shape says.
    #[error("{found} bytes of elements, expected {expected} for its shape")]
    Length {
        /// Bytes that are there.
        found: u64,
        /// Bytes that the shape asks for.
        expected: u64,
    },
    /// The file or archive member cannot be read to its end.
    #[error("cannot be read to its end: {0}")]
    Damaged(String),
}

/// Type of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    Float,
    Signed,
    Unsigned,
}

/// What the header of an array says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ArrayHeader {
    pub element: Element,
    /// Bytes of an element.
    pub width: usize,
    pub big_endian: bool,
    /// Whether the first index runs fastest.
    pub fortran: bool,
    pub shape: Vec<usize>,
    /// Bytes from the start of the member to the first element.
    pub offset: u64,
}

impl ArrayHeader {
    /// Reads the header and leaves the reader at the first element.
    pub fn read(reader: &mut impl Read) -> Result<ArrayHeader, ArrayFault> {
        let mut start = [0_u8; 8];
        reader.read_exact(&mut start).map_err(|_| ArrayFault::Magic)?;
        if !start.starts_with(b"\x93NUMPY") {
            return Err(ArrayFault::Magic);
        }
        let (size, length) = match start[6] {
            1 => {
                let mut size = [0_u8; 2];
                reader.read_exact(&mut size).map_err(|_| ArrayFault::Magic)?;
                (2, u64::from(u16::from_le_bytes(size)))
            }
            2 | 3 => {
                let mut size = [0_u8; 4];
                reader.read_exact(&mut size).map_err(|_| ArrayFault::Magic)?;
                (4, u64::from(u32::from_le_bytes(size)))
            }
            other => return Err(ArrayFault::Version(other)),
        };
        let mut text = Vec::new();
        // A header of numbers is a line of text; a damaged length must not ask for gigabytes.
        let read = reader.take(length.min(1 << 16)).read_to_end(&mut text);
        if read.is_err() || text.len() as u64 != length {
            return Err(ArrayFault::Header("descr"));
        }
        let text = String::from_utf8_lossy(&text);
        let mut header = parse_dictionary(&text)?;
        header.offset = 8 + size + length;
        Ok(header)
    }

    /// Number of elements, if it can be counted.
    pub fn elements(&self) -> Option<usize> {
        self.shape.iter().try_fold(1_usize, |all, n| all.checked_mul(*n))
    }

    /// Whether the elements lie in the order of a C array.
    pub fn in_c_order(&self) -> bool {
        !self.fortran || self.shape.iter().filter(|n| **n > 1).count() < 2
    }

    /// Whether the elements are doubles of a little-endian machine.
    pub fn is_native_double(&self) -> bool {
        self.element == Element::Float && self.width == 8 && !self.big_endian
    }

    /// Reads the elements in the order in which they lie, as doubles.
    pub fn each(&self, reader: &mut impl Read, mut take: impl FnMut(f64)) -> Result<(), ArrayFault> {
        let (element, big) = (self.element, self.big_endian);
        if self.is_native_double() {
            return self.each_chunk(reader, |chunk| {
                for bytes in chunk.as_chunks::<8>().0 {
                    take(f64::from_le_bytes(*bytes));
                }
            });
        }
        self.each_chunk(reader, |chunk| {
            for bytes in chunk.chunks_exact(self.width) {
                let bits = bits(bytes, big);
                take(match element {
                    Element::Float if bytes.len() == 4 => f64::from(f32::from_bits(bits as u32)),
                    Element::Float => f64::from_bits(bits),
                    Element::Signed => signed(bits, bytes.len()) as f64,
                    Element::Unsigned => bits as f64,
                });
            }
        })
    }

    /// Reads integer elements exactly; `None` for one that is no 64-bit signed integer.
    pub fn each_integer(
        &self,
        reader: &mut impl Read,
        mut take: impl FnMut(Option<i64>, f64),
    ) -> Result<(), ArrayFault> {
        if self.element == Element::Float {
            return self.each(reader, |value| take(exact_integer(value), value));
        }
        self.each_chunk(reader, |chunk| {
            for bytes in chunk.chunks_exact(self.width) {
                let bits = bits(bytes, self.big_endian);
                match self.element {
                    Element::Unsigned => take(i64::try_from(bits).ok(), bits as f64),
                    _ => take(Some(signed(bits, bytes.len())), signed(bits, bytes.len()) as f64),
                }
            }
        })
    }

    /// Reads all elements in pieces of whole elements, then the end, where the checksum is tested.
    fn each_chunk(&self, reader: &mut impl Read, mut take: impl FnMut(&[u8])) -> Result<(), ArrayFault> {
        let expected = self.elements().unwrap_or(usize::MAX) as u64 * self.width as u64;
        let mut buffer = vec![0_u8; 1 << 16];
        let (mut held, mut found) = (0, 0_u64);
        loop {
            let read = match reader.read(&mut buffer[held..]) {
                Ok(read) => read,
                Err(fault) if fault.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(fault) => return Err(ArrayFault::Damaged(fault.to_string())),
            };
            found += read as u64;
            if found > expected || (read == 0 && found != expected) {
                return Err(ArrayFault::Length { found, expected });
            }
            if read == 0 {
                return Ok(());
            }
            held += read;
            let whole = held - held % self.width;
            take(&buffer[..whole]);
            buffer.copy_within(whole..held, 0);
            held -= whole;
        }
    }
}

/// The integer that a double stands for exactly.
pub(super) fn exact_integer(value: f64) -> Option<i64> {
    (value.fract() == 0.0 && value.abs() <= 9_007_199_254_740_992.0).then_some(value as i64)
}

/// The bytes of an element as an unsigned number.
fn bits(bytes: &[u8], big_endian: bool) -> u64 {
    let join = |all: u64, byte: &u8| all << 8 | u64::from(*byte);
    if big_endian { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) }
}

/// Extends the sign of an integer of `width` bytes.
fn signed(bits: u64, width: usize) -> i64 {
    let unused = 64 - 8 * width as u32;
    ((bits << unused) as i64) >> unused
}

/// Reads the Python dictionary that makes up a header.
fn parse_dictionary(text: &str) -> Result<ArrayHeader, ArrayFault> {
    let descr = value_of(text, "descr").ok_or(ArrayFault::Header("descr"))?;
    let quote = descr.chars().next().filter(|c| matches!(c, '\'' | '"'));
    let Some(descr) = quote.and_then(|quote| descr[1..].split(quote).next()) else {
        let shown = descr.split(']').next().unwrap_or(descr);
        return Err(ArrayFault::Type(format!("{shown}]")));
    };
    let kind = || ArrayFault::Type(format!("'{descr}'"));
    let bytes = descr.as_bytes();
    let (order, letter, digits) = match bytes {
        [order @ (b'<' | b'>' | b'|' | b'='), letter, digits @ ..] => (*order, *letter, digits),
        _ => return Err(kind()),
    };
    let width = match digits {
        b"1" => 1,
        b"2" => 2,
        b"4" => 4,
        b"8" => 8,
        _ => return Err(kind()),
    };
    let element = match (letter, width) {
        (b'f', 4 | 8) => Element::Float,
        (b'i', _) => Element::Signed,
        (b'u', _) => Element::Unsigned,
        _ => return Err(kind()),
    };
    let fortran = value_of(text, "fortran_order").ok_or(ArrayFault::Header("fortran_order"))?;
    let fortran = match fortran {
        flag if flag.starts_with("True") => true,
        flag if flag.starts_with("False") => false,
        _ => return Err(ArrayFault::Header("fortran_order")),
    };
    let shape = value_of(text, "shape").and_then(parse_shape).ok_or(ArrayFault::Header("shape"))?;
    let native_big = order == b'=' && cfg!(target_endian = "big");
    Ok(ArrayHeader { element, width, big_endian: order == b'>' || native_big, fortran, shape, offset: 0 })
}

/// The text behind a key of the dictionary.
fn value_of<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let quoted = ['\'', '"'].into_iter().find_map(|quote| {
        let key = format!("{quote}{key}{quote}");
        text.find(&key).map(|at| &text[at + key.len()..])
    })?;
    Some(quoted.trim_start().strip_prefix(':')?.trim_start())
}

/// Numbers in brackets: `()`, `(3,)`, `(3, 4)`.
fn parse_shape(text: &str) -> Option<Vec<usize>> {
    let inner = text.strip_prefix('(')?.split_once(')')?.0.trim();
    let inner = inner.strip_suffix(',').unwrap_or(inner);
    if inner.is_empty() {
        return Some(Vec::new());
    }
    inner.split(',').map(|n| n.trim().trim_end_matches('L').parse().ok()).collect()
}
