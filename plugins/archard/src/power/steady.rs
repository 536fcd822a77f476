//! m = n = 1 with ordinary numbers throughout, the common case: products at the speed of memory.
//!
//! The increments are those of the general path, to the bit. What is left to that path is found out on the way, by
//! whole numbers: the upper half of a double, as an unsigned number, is at least [`INFINITE`] if the double is
//! negative, infinite or not a number, so one maximum over all points tells of every increment.
#![allow(unsafe_code)] // Loads and stores of four doubles; a call of functions compiled for AVX2 and FMA.

use std::sync::atomic::{AtomicU8, Ordering};

use super::scale::Scale;

/// Upper half of infinity.
const INFINITE: u32 = 0x7ff0_0000;
/// Points that are computed at once.
const LANES: usize = 4;
/// Bytes of that many points: a store that crosses a line of the cache takes twice as long.
const LINE: usize = 32;
/// Points that columns are asked for ahead of their use: the memory then goes on working across the ends of pages and
/// batches, where a processor that guesses by itself begins anew. Of 32, 64, 128, 192, 256 and 512 this was the fastest.
const AHEAD: usize = 128;
/// K, H and dt outside `1 / WIDE ..= WIDE` are left to the general path: (K/H) dt and the steps to it stay normal.
const WIDE: f64 = 1.0e60;
/// Bits of a pressure (about 1e-100) that every such factor multiplies to a normal number, as do all above it. The lower
/// half is zero, so that differences from it keep infinity apart from the largest number in the upper half.
const LEAST: u64 = 0x2b2b_ff2f_0000_0000;

/// Writes `(K/H) dt p |v|` to `out` and says whether that is the answer: K, H, dt and every pressure are positive and
/// of an ordinary size (a pressure may be 0 or negative: no wear), inputs and increments are finite.
///
/// If not, `out` holds nothing of use and [`increments`](super::increments) must answer.
#[inline]
#[must_use]
pub fn steady(wide: Wide, p: &[f64], v: &[f64], (k, h, dt): (f64, f64, f64), out: &mut [f64]) -> bool {
    #[cfg(target_arch = "x86_64")]
    {
        // Bits of positive numbers are in order; those of negative ones and of no number lie above.
        let least = const { (1.0 / WIDE).to_bits() };
        let above = k.to_bits().wrapping_sub(least).max(h.to_bits().wrapping_sub(least));
        let above = above.max(dt.to_bits().wrapping_sub(least));
        if above <= const { WIDE.to_bits() - (1.0 / WIDE).to_bits() } {
            // SAFETY: a `Wide` says that the processor has both features.
            return unsafe {
                match out.len() {
                    0..LANES => singly(p, v, factor(k, h, dt), out),
                    _ => steady_avx2(p, v, k, h, dt, out),
                }
            };
        }
    }
    let _ = (wide, p, v, k, h, dt, out, WIDE);
    false
}

/// A processor that has AVX2 and FMA.
#[derive(Clone, Copy, Debug)]
pub struct Wide(());

impl Wide {
    /// Whether this processor is one. The answer is kept as one number: to ask for two takes a nanosecond more.
    #[inline(always)]
    #[must_use]
    pub fn here() -> Option<Self> {
        match KNOWN.load(Ordering::Relaxed) {
            UNKNOWN => Self::ask(),
            known => (known == YES).then_some(Self(())),
        }
    }

    #[cold]
    #[inline(never)]
    fn ask() -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        let both = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        #[cfg(not(target_arch = "x86_64"))]
        let both = false;
        KNOWN.store(if both { YES } else { NO }, Ordering::Relaxed);
        both.then_some(Self(()))
    }
}

static KNOWN: AtomicU8 = AtomicU8::new(UNKNOWN);
const UNKNOWN: u8 = 0;
const NO: u8 = 1;
const YES: u8 = 2;

/// The factor for usual constants. It alone needs to be compiled for a processor's feature where there are few points.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn factor(k: f64, h: f64, dt: f64) -> f64 {
    Scale::value_of_usual(k, h, dt)
}

/// [`steady`] with the factor given, for a few points, one by one; whether all of them are usual.
#[inline(always)]
fn singly(p: &[f64], v: &[f64], c: f64, out: &mut [f64]) -> bool {
    let mut good = true;
    // The fixed bound keeps the compiler from making more of this than it is.
    for i in 0..LANES - 1 {
        let (Some(p), Some(v), Some(out)) = (p.get(i), v.get(i), out.get_mut(i)) else { break };
        let wear = c * if *p > 0.0 { *p } else { 0.0 } * v.abs();
        *out = wear;
        let usual = p.to_bits().wrapping_sub(LEAST) <= f64::MAX.to_bits() - LEAST;
        good &= (usual || (-f64::MAX..=0.0).contains(p)) && wear.to_bits() <= f64::MAX.to_bits();
    }
    good
}

/// [`steady`] for usual constants.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn steady_avx2(p: &[f64], v: &[f64], k: f64, h: f64, dt: f64, out: &mut [f64]) -> bool {
    use std::arch::x86_64::*;
    let c = Scale::value_of_usual(k, h, dt);
    // As many points as bring the stores to an even address; the rest goes by fours, and what is over singly again.
    let head = out.as_ptr().align_offset(LINE).min(out.len());
    let (p, v) = (&p[..out.len()], &v[..out.len()]);
    let (first_out, out) = out.split_at_mut(head);
    let (first_p, p) = p.split_at(head);
    let (first_v, v) = v.split_at(head);
    let whole = out.len() - out.len() % LANES;
    let (factor, zero) = (_mm256_set1_pd(c), _mm256_setzero_pd());
    let size = _mm256_set1_pd(f64::from_bits(!(1 << 63)));
    let least = _mm256_set1_epi64x(LEAST as i64);
    let (mut most_p, mut most_w) = (_mm256_setzero_si256(), _mm256_setzero_si256());
    let mut four = |i: usize| {
        // SAFETY: every `i` below is such that `i + LANES <= whole`, at most the length of each of the three slices.
        unsafe {
            let bits = _mm256_loadu_si256(p.as_ptr().add(i).cast());
            // The second operand is the answer where the first is not a number.
            let first = _mm256_mul_pd(factor, _mm256_max_pd(_mm256_castsi256_pd(bits), zero));
            let wear = _mm256_mul_pd(first, _mm256_and_pd(_mm256_loadu_pd(v.as_ptr().add(i)), size));
            _mm256_storeu_pd(out.as_mut_ptr().add(i), wear);
            // Below LEAST the difference wraps around, to above everything that is usual.
            most_p = _mm256_max_epu32(most_p, _mm256_sub_epi64(bits, least));
            most_w = _mm256_max_epu32(most_w, _mm256_castpd_si256(wear));
        }
    };
    let lines = whole - whole % (2 * LANES);
    for i in (0..lines).step_by(2 * LANES) {
        // A line of the cache from each column. To ask for one beyond its end does no harm: it is not read.
        _mm_prefetch::<_MM_HINT_T0>(p.as_ptr().wrapping_add(i + AHEAD).cast());
        _mm_prefetch::<_MM_HINT_T0>(v.as_ptr().wrapping_add(i + AHEAD).cast());
        four(i);
        four(i + LANES);
    }
    if lines < whole {
        four(lines);
    }
    let mut good = singly(first_p, first_v, c, first_out);
    good &= singly(&p[whole..], &v[whole..], c, &mut out[whole..]);
    if whole == 0 {
        return good;
    }
    let most = |x: __m256i| {
        let x = _mm_max_epu32(_mm256_castsi256_si128(x), _mm256_extracti128_si256::<1>(x));
        let x = _mm_max_epu32(x, _mm_shuffle_epi32::<0b01_00_11_10>(x));
        _mm_extract_epi32::<1>(x) as u32
    };
    good &= most(most_w) < INFINITE;
    // The largest usual difference is that of f64::MAX; those of negative numbers, NaN and small numbers are larger.
    if most(most_p) > ((f64::MAX.to_bits() - LEAST) >> 32) as u32 {
        good &= !some_unusual(&p[..whole]);
    }
    good
}

/// Whether a pressure is not finite or lies between 0 and [`LEAST`].
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
#[cold]
fn some_unusual(p: &[f64]) -> bool {
    let least = f64::from_bits(LEAST);
    p.iter().fold(0u64, |all, p| all | u64::from(!p.is_finite() | ((*p > 0.0) & (*p < least)))) != 0
}
