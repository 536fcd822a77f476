//! Checks on what a law answered, written so that the compiler vectorises them; they run while a piece is in cache.
#![allow(unsafe_code)] // reason: calls a function that is compiled for a processor's feature.

/// What a sweep over numbers found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sweep {
    /// No infinity and no NaN.
    pub(super) finite: bool,
    /// None below zero.
    pub(super) non_negative: bool,
}

/// Sweeps over numbers; fast where all are positive or zero, as wear increments are.
#[inline]
pub(super) fn sweep(values: &[f64]) -> Sweep {
    if plain(values) { Sweep { finite: true, non_negative: true } } else { exact(values) }
}

#[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN is not finite; it is not negative too")]
pub(super) fn exact(values: &[f64]) -> Sweep {
    values.iter().fold(Sweep { finite: true, non_negative: true }, |found, value| Sweep {
        finite: found.finite & value.is_finite(),
        non_negative: found.non_negative & (*value >= 0.0 || value.is_nan()),
    })
}

/// One in the exponent of a double: it carries the exponent of an infinity or a NaN over into the sign.
const EXPONENT_ONE: u64 = 1 << 52;
/// Fewer numbers than this are swept sooner than the processor is asked what it can.
const FEW: usize = 32;

/// True if all are finite and have the sign of a positive number; false says nothing.
#[inline]
fn plain(values: &[f64]) -> bool {
    #[cfg(target_arch = "x86_64")]
    if values.len() >= FEW && std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has just been asked for the feature.
        return unsafe { plain_avx2(values) };
    }
    plain_lanes(values)
}

/// The upper half of a double, as an unsigned number, is at least that of infinity if the double is negative, infinite
/// or not a number; so one maximum over all halves tells, whatever the lower ones are.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn plain_avx2(values: &[f64]) -> bool {
    use std::arch::x86_64::*;
    let mut most = [_mm256_setzero_si256(); 4];
    let (strips, rest) = values.as_chunks::<16>();
    for strip in strips {
        for (k, most) in most.iter_mut().enumerate() {
            // SAFETY: the strip has 16 numbers, and four are loaded from each of its quarters.
            let quarter = unsafe { _mm256_loadu_si256(strip.as_ptr().add(4 * k).cast()) };
            *most = _mm256_max_epu32(*most, quarter);
        }
    }
    let most = _mm256_max_epu32(_mm256_max_epu32(most[0], most[1]), _mm256_max_epu32(most[2], most[3]));
    upper_halves_are_finite(most) && plain_lanes(rest)
}

/// Whether the upper half of each of four numbers is below that of infinity.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline]
pub(super) fn upper_halves_are_finite(numbers: std::arch::x86_64::__m256i) -> bool {
    use std::arch::x86_64::*;
    let most = _mm_max_epu32(_mm256_castsi256_si128(numbers), _mm256_extracti128_si256::<1>(numbers));
    let most = _mm_max_epu32(most, _mm_shuffle_epi32::<0b01_00_11_10>(most));
    let infinite = (f64::INFINITY.to_bits() >> 32) as u32;
    (_mm_extract_epi32::<1>(most) as u32) < infinite
}

/// A plain fold: whole numbers may be gathered in any order, so the compiler spreads it over lanes itself.
#[inline(always)]
pub(super) fn plain_lanes(values: &[f64]) -> bool {
    let all = values.iter().fold(0, |all, value| {
        let bits = value.to_bits();
        all | bits | bits.wrapping_add(EXPONENT_ONE)
    });
    all >> 63 == 0
}

/// True if no number is NaN; infinities pass (the derivative of p^m at p = 0 for m < 1 is one).
pub(super) fn no_nan(values: &[f64]) -> bool {
    values.iter().fold(true, |good, value| good & !value.is_nan())
}

/// How far a direction may be from unit length.
pub(super) const LENGTH_TOLERANCE: f64 = 1e-9;

/// True if every vector has unit length within [`LENGTH_TOLERANCE`]; compares squares, so by twice that.
pub(super) fn unit_lengths(vectors: &[f64]) -> bool {
    let (vectors, _) = vectors.as_chunks::<3>();
    vectors.iter().fold(true, |good, [x, y, z]| {
        let square = x * x + y * y + z * z;
        good & ((square - 1.0).abs() <= 2.0 * LENGTH_TOLERANCE)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bad_number_is_found_wherever_it_stands() {
        for length in [1, 2, 7, 8, 9, 31, 100] {
            let good = vec![1e-300; length];
            assert_eq!(sweep(&good), Sweep { finite: true, non_negative: true });
            for place in 0..length {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut values = good.clone();
                    values[place] = bad;
                    assert!(!sweep(&values).finite, "{bad} at {place} of {length}");
                    assert_eq!(no_nan(&values), !bad.is_nan());
                }
                let mut values = good.clone();
                values[place] = -5e-324;
                assert_eq!(sweep(&values), Sweep { finite: true, non_negative: false });
            }
        }
    }

    #[test]
    fn a_negative_zero_is_no_negative_number() {
        assert!(sweep(&[-0.0; 9]).non_negative);
        assert!(sweep(&[]).finite);
    }

    #[test]
    fn a_length_is_compared_to_nine_digits() {
        assert!(unit_lengths(&[0.0, 0.6, -0.8, 1.0 + 0.9e-9, 0.0, 0.0]));
        assert!(!unit_lengths(&[0.0, 0.6, -0.8, 1.0 + 1.1e-9, 0.0, 0.0]));
        assert!(!unit_lengths(&[f64::NAN, 0.0, 1.0]));
        assert!(!unit_lengths(&[0.0; 3]));
    }
}
