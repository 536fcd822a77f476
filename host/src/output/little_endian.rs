//! Numbers as little-endian bytes, in pieces that stay in cache.

use std::io::{self, Write};

/// Numbers converted at a time: 32 KiB of them fit the first-level cache beside their source.
const PIECE: usize = 4096;

/// Writes `numbers` as 8-byte little-endian floats.
pub(super) fn write_floats(to: &mut impl Write, numbers: impl IntoIterator<Item = f64>) -> io::Result<()> {
    write_words(to, numbers.into_iter().map(f64::to_le_bytes))
}

/// Writes `numbers` as 8-byte little-endian unsigned integers.
pub(super) fn write_counts(to: &mut impl Write, numbers: impl IntoIterator<Item = u64>) -> io::Result<()> {
    write_words(to, numbers.into_iter().map(u64::to_le_bytes))
}

fn write_words(to: &mut impl Write, mut words: impl Iterator<Item = [u8; 8]>) -> io::Result<()> {
    let mut piece = [0_u8; 8 * PIECE];
    loop {
        let mut filled = 0;
        for (slot, word) in piece.chunks_exact_mut(8).zip(&mut words) {
            slot.copy_from_slice(&word);
            filled += 8;
        }
        if filled == 0 {
            return Ok(());
        }
        to.write_all(&piece[..filled])?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_written_once_across_pieces() {
        for count in [0, 1, PIECE - 1, PIECE, PIECE + 1, 3 * PIECE] {
            let mut bytes = Vec::new();
            write_counts(&mut bytes, 0..count as u64).unwrap();
            let back: Vec<u64> = bytes.chunks_exact(8).map(|w| u64::from_le_bytes(w.try_into().unwrap())).collect();
            assert_eq!(back, (0..count as u64).collect::<Vec<_>>());
        }
        let mut bytes = Vec::new();
        write_floats(&mut bytes, [1.0]).unwrap();
        assert_eq!(bytes, [0, 0, 0, 0, 0, 0, 0xf0, 0x3f]);
    }
}
