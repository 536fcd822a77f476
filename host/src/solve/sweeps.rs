//! Sweeps over one chunk's columns that find out the little that must be known of them, compiled for AVX2 where the
//! processor has it: they read what the law reads next or has just written, so they cost instructions, not memory.
#![allow(unsafe_code)] // reason: calls functions that are compiled for a processor's feature.

/// Defines a sweep as one loop, compiled twice.
macro_rules! sweep {
    ($(#[$text:meta])* $name:ident, $wide:ident, $lanes:ident, $answer:ty) => {
        $(#[$text])*
        pub(super) fn $name(values: &[f64]) -> $answer {
            #[cfg(target_arch = "x86_64")]
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: the processor has just been asked for the feature.
                return unsafe { $wide(values) };
            }
            $lanes(values)
        }

        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2")]
        fn $wide(values: &[f64]) -> $answer {
            $lanes(values)
        }
    };
}

sweep!(
    /// Whether every number is above zero.
    all_positive, all_positive_avx2, all_positive_lanes, bool
);
sweep!(
    /// Whether no number has the sign of a negative one, so that each is its own absolute value.
    no_sign, no_sign_avx2, no_sign_lanes, bool
);
sweep!(
    /// The largest number, at least 0.
    largest, largest_avx2, largest_lanes, f64
);

/// Numbers between two looks at whether the answer is known already.
const PART: usize = 512;

#[inline(always)]
fn all_positive_lanes(values: &[f64]) -> bool {
    values.chunks(PART).all(|part| {
        // As whole numbers: less one is negative for 0 and negative numbers, and infinity less it for what is no number.
        let odd = part.iter().fold(0, |odd, p| {
            let bits = p.to_bits();
            odd | bits.wrapping_sub(1) | f64::INFINITY.to_bits().wrapping_sub(bits)
        });
        odd >> 63 == 0
    })
}

#[inline(always)]
fn no_sign_lanes(values: &[f64]) -> bool {
    values.chunks(PART).all(|part| part.iter().fold(0, |signs, value| signs | value.to_bits()) >> 63 == 0)
}

#[inline(always)]
fn largest_lanes(values: &[f64]) -> f64 {
    let more = |most: f64, value: f64| if value > most { value } else { most };
    let (strips, rest) = values.as_chunks::<16>();
    let mut lanes = [0.0; 16];
    for strip in strips {
        #[allow(clippy::needless_range_loop)] // reason: a zip in here is a call, as its code lies in another unit
        for lane in 0..16 {
            lanes[lane] = more(lanes[lane], strip[lane]);
        }
    }
    let mut most = 0.0;
    for value in lanes.iter().chain(rest) {
        most = more(most, *value);
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    const ODD: [f64; 9] =
        [0.0, -0.0, -1.0, -5e-324, 5e-324, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MIN_POSITIVE];

    #[test]
    fn every_sweep_is_what_its_name_says_wherever_the_odd_number_lies() {
        for points in [1, 4, 15, 16, 17, 511, 513, 1030] {
            for at in [0, points / 2, points - 1] {
                for odd in ODD.into_iter().chain([-f64::NAN]) {
                    let mut values: Vec<f64> = (0..points).map(|i| 1.0 + (i % 7) as f64).collect();
                    values[at] = odd;
                    assert_eq!(all_positive(&values), odd > 0.0, "{odd} at {at} of {points}");
                    assert_eq!(no_sign(&values), odd.is_sign_positive(), "{odd} at {at} of {points}");
                    let most = values.iter().copied().filter(|x| !x.is_nan()).fold(0.0, f64::max);
                    assert_eq!(largest(&values).to_bits(), most.to_bits(), "{odd} at {at} of {points}");
                }
            }
        }
        assert!(all_positive(&[]) && no_sign(&[]) && largest(&[-3.0, -0.0]).to_bits() == 0);
    }
}
