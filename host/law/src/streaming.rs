//! Stores that go past the caches, where the processor has them.
#![allow(unsafe_code)] // reason: such stores, and the fence behind them, are intrinsics.

use super::checks::{Sweep, exact};
#[cfg(target_arch = "x86_64")]
use super::checks::{plain_lanes, upper_halves_are_finite};

/// Whether this processor has stores that go past the caches, and this program knows them.
#[inline]
pub(super) fn is_possible() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

/// Copies numbers past the caches, if that is possible, and sweeps over them on the way; for each line stored, one of
/// what is read next is fetched.
///
/// Another thread may see them late unless an [`InOrder`] is dropped first.
///
/// # Panics
/// If the lengths differ, as copying slices does.
pub(super) fn sweep_past_caches(from: &[f64], to: &mut [f64], ahead: &Ahead) -> Sweep {
    assert_eq!(from.len(), to.len(), "numbers to copy and their places");
    #[cfg(target_arch = "x86_64")]
    let plain = if is_possible() {
        // SAFETY: the processor has just been asked for the feature.
        unsafe { stream_avx2(from, to, ahead) }
    } else {
        to.copy_from_slice(from);
        false
    };
    #[cfg(not(target_arch = "x86_64"))]
    let plain = {
        let _ = ahead;
        to.copy_from_slice(from);
        false
    };
    if plain { Sweep { finite: true, non_negative: true } } else { exact(from) }
}

/// Columns fetched ahead at most: more would push out of the nearest cache what they are to meet there.
const COLUMNS: usize = 4;

/// Where the numbers that are read next stand, a number a point; they are only fetched, so any address will do.
#[derive(Clone, Copy, Default)]
pub(super) struct Ahead {
    columns: [usize; COLUMNS],
    count: usize,
}

impl Ahead {
    /// The first few of these columns.
    pub(super) fn new(columns: impl Iterator<Item = *const f64>) -> Self {
        let mut ahead = Self::default();
        for (place, column) in ahead.columns.iter_mut().zip(columns) {
            *place = column.addr();
            ahead.count += 1;
        }
        ahead
    }

    /// Asks for a line of each column.
    #[cfg(target_arch = "x86_64")]
    #[inline]
    fn fetch(&self, line: usize) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        for column in &self.columns[..self.count] {
            let address = std::ptr::without_provenance(column.wrapping_add(line * LINE * size_of::<f64>()));
            // SAFETY: this is a hint; it reads nothing into the program and takes any address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(address) };
        }
    }
}

/// Puts stores past the caches in order with all that follows, when it is dropped.
pub(super) struct InOrder;

impl Drop for InOrder {
    fn drop(&mut self) {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: every processor of this architecture has SSE, and the fence touches no memory.
        unsafe {
            std::arch::x86_64::_mm_sfence();
        }
    }
}

/// Numbers of a line of the cache.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 8;

/// Copies numbers to `to`, as long as `from`; true if all are finite and have the sign of a positive one.
///
/// Only whole lines of the cache go past it: a line that is written in parts would be read first.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn stream_avx2(from: &[f64], to: &mut [f64], ahead: &Ahead) -> bool {
    use std::arch::x86_64::*;
    let head = to.as_ptr().align_offset(LINE * size_of::<f64>()).min(to.len());
    let (first_from, from) = from.split_at(head);
    let (first_to, to) = to.split_at_mut(head);
    let (lines_from, last_from) = from.as_chunks::<LINE>();
    let (lines_to, last_to) = to.as_chunks_mut::<LINE>();
    let mut most = [_mm256_setzero_si256(); 2];
    for (line, (from, to)) in lines_from.iter().zip(lines_to).enumerate() {
        ahead.fetch(line);
        for (k, most) in most.iter_mut().enumerate() {
            // SAFETY: both lines have 8 numbers, of which each half is moved; `to` begins at an address that is a
            // multiple of 64, because the head before it was cut to that and a line has 64 bytes.
            unsafe {
                let half = _mm256_loadu_si256(from.as_ptr().add(4 * k).cast());
                *most = _mm256_max_epu32(*most, half);
                _mm256_stream_si256(to.as_mut_ptr().add(4 * k).cast(), half);
            }
        }
    }
    first_to.copy_from_slice(first_from);
    last_to.copy_from_slice(last_from);
    upper_halves_are_finite(_mm256_max_epu32(most[0], most[1])) & plain_lanes(first_from) & plain_lanes(last_from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_copied_and_the_odd_one_is_found_wherever_it_stands() {
        for (length, shift) in [(0, 0), (1, 7), (7, 1), (8, 0), (9, 3), (16, 0), (31, 5), (64, 0), (100, 2)] {
            for place in (0..length).chain([usize::MAX]) {
                for odd in [-0.0, -5e-324, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut from: Vec<f64> = (0..length).map(|i| 1e-300 * (1 + i) as f64).collect();
                    if let Some(value) = from.get_mut(place) {
                        *value = odd;
                    }
                    let mut room = vec![7.0; length + 24];
                    let start = room.as_ptr().align_offset(64) + shift;
                    let found = sweep_past_caches(&from, &mut room[start..start + length], &Ahead::default());
                    drop(InOrder);
                    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                    assert_eq!(bits(&room[start..start + length]), bits(&from), "{odd} at {place} of {length}");
                    assert_eq!((room[start + length], room[..start].last().copied().unwrap_or(7.0)), (7.0, 7.0));
                    let odd = if place < length { odd } else { 1.0 };
                    assert_eq!(found, Sweep { finite: odd.is_finite(), non_negative: odd >= 0.0 || odd.is_nan() });
                }
            }
        }
    }
}
