//! Checks on what a law answered, written so that the compiler vectorises them; they run while a piece is in cache.

/// What a sweep over numbers found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sweep {
    /// No infinity and no NaN.
    pub(super) finite: bool,
    /// None below zero.
    pub(super) non_negative: bool,
}

const LANES: usize = 8;

/// Sweeps over numbers: x - x is 0 for a finite number and NaN for any other, and NaN stays in a sum.
#[inline]
#[allow(clippy::eq_op)] // reason: x - x is the test itself
pub(super) fn sweep(values: &[f64]) -> Sweep {
    let (chunks, rest) = values.as_chunks::<LANES>();
    let mut waste = [0.0_f64; LANES];
    let mut least = [0.0_f64; LANES];
    for chunk in chunks {
        for lane in 0..LANES {
            let value = chunk[lane];
            waste[lane] += value - value;
            least[lane] = if value < least[lane] {
                value
            } else {
                least[lane]
            };
        }
    }
    for &value in rest {
        waste[0] += value - value;
        least[0] = if value < least[0] { value } else { least[0] };
    }
    Sweep {
        finite: waste.iter().sum::<f64>() == 0.0,
        non_negative: least.iter().all(|least| *least >= 0.0),
    }
}

/// True if no number is NaN; infinities pass (the derivative of p^m at p = 0 for m < 1 is one).
pub(super) fn no_nan(values: &[f64]) -> bool {
    values
        .iter()
        .fold(true, |good, value| good & !value.is_nan())
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
            assert_eq!(
                sweep(&good),
                Sweep {
                    finite: true,
                    non_negative: true
                }
            );
            for place in 0..length {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut values = good.clone();
                    values[place] = bad;
                    assert!(!sweep(&values).finite, "{bad} at {place} of {length}");
                    assert_eq!(no_nan(&values), !bad.is_nan());
                }
                let mut values = good.clone();
                values[place] = -5e-324;
                assert_eq!(
                    sweep(&values),
                    Sweep {
                        finite: true,
                        non_negative: false
                    }
                );
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
