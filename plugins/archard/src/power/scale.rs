//! The factor (K/H) dt as a mantissa of two doubles and a binary exponent of its own.
//!
//! Held so, it neither overflows nor underflows whatever K, H and dt are, and a factor of
//! 1e-620 still meets a power of 1e600 with all its digits.

use super::double::{fast_two_sum, two_product};

/// Bits of `sqrt(1/2)`, lower end of the interval that mantissas are brought into.
const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE: u64 = 0x3ff0_0000_0000_0000;
const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
/// Bits of 2^52: a number below 2^52 in the low bits of this one reads as 2^52 plus it.
const TWO_52: u64 = 0x4330_0000_0000_0000;
/// 1.5 * 2^52 + 1023: adding it rounds to an integer and leaves it, biased, in the low bits.
const BIASED: f64 = 6_755_399_441_055_744.0 + 1023.0;
const TWO_54: f64 = 18_014_398_509_481_984.0;

/// `x = f 2^k` with `sqrt(1/2) <= f < sqrt(2)`, for normal `x > 0`; exact.
#[inline(always)]
pub(super) fn split(x: f64) -> (f64, f64) {
    let shifted = x.to_bits().wrapping_add(ONE - SQRT_HALF);
    let k = f64::from_bits((shifted >> 52) | TWO_52) - (4_503_599_627_370_496.0 + 1023.0);
    let f = f64::from_bits((shifted & MANTISSA).wrapping_add(SQRT_HALF));
    (f, k)
}

/// [`split`] for any finite `x > 0`, subnormal or not; exact.
#[inline(always)]
pub(super) fn split_any(x: f64) -> (f64, f64) {
    let small = x < f64::MIN_POSITIVE;
    let (f, k) = split(if small { x * TWO_54 } else { x });
    (f, if small { k - 54.0 } else { k })
}

/// `x 2^k` with one rounding, for `2^-400 < |x| < 2^400` (or 0) and an integer `k`; beyond the
/// range of doubles the result is infinite or zero.
///
/// The power is applied in two halves: if the result is not zero, the first product is normal.
#[inline(always)]
pub(super) fn ldexp(x: f64, k: f64) -> f64 {
    let k = if k < -2040.0 { -2040.0 } else { k };
    let k = if k > 2040.0 { 2040.0 } else { k };
    let half = (0.5 * k + BIASED) - BIASED;
    x * two_to(half) * two_to(k - half)
}

/// `2^k` for an integer `-1022 <= k <= 1023`; some number for any other.
#[inline(always)]
pub(super) fn two_to(k: f64) -> f64 {
    f64::from_bits((k + BIASED).to_bits() << 52)
}

/// The product (K/H) dt as `(hi + lo) 2^exponent`.
///
/// `hi` is 0, not a number, or `1/3 < |hi| < 3`, and `|lo| <= ulp(hi) / 2`; the exponent is an
/// integer held in a double. The relative error is below 2^-101.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    pub(super) hi: f64,
    pub(super) lo: f64,
    pub(super) exponent: f64,
}

impl Scale {
    /// The factor 1: the bare power p^m v^n.
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0, exponent: 0.0 };

    /// `(k / h) dt` with `k` the wear coefficient, `h` the hardness, `dt` a length of time.
    ///
    /// Exactly zero if `k` or `dt` is zero. A scale that is not a number, so that every
    /// increment made with it is one neither, if an argument is not finite or `h` is zero:
    /// a law checks its constants before.
    #[inline]
    #[must_use]
    pub fn new(k: f64, h: f64, dt: f64) -> Self {
        Self::from_parts(k, h, dt)
    }

    /// [`Scale::new`] without a branch, for loops over points.
    #[inline(always)]
    pub(super) fn from_parts(k: f64, h: f64, dt: f64) -> Self {
        let (ka, ha, da) = (k.abs(), h.abs(), dt.abs());
        // A factor that is not finite and positive is replaced by 1, and settled at the end.
        let (kf, ke) = split_any(if usable(ka) { ka } else { 1.0 });
        let (hf, he) = split_any(if usable(ha) { ha } else { 1.0 });
        let (df, de) = split_any(if usable(da) { da } else { 1.0 });
        let q = kf / hf;
        // The reciprocal does not wait for the quotient, and the remainder needs no more than its few digits.
        let q_lo = (-q).mul_add(hf, kf) * (1.0 / hf);
        let (w, e) = two_product(q, df);
        let (hi, lo) = fast_two_sum(w, q_lo.mul_add(df, e));
        let finite = ka <= f64::MAX && ha <= f64::MAX && da <= f64::MAX && ha > 0.0;
        let nothing = ka == 0.0 || da == 0.0;
        let sign = 1f64.copysign(k) * 1f64.copysign(h) * 1f64.copysign(dt);
        let sign = if nothing { 0.0 } else { sign };
        let sign = if finite { sign } else { f64::NAN };
        Self { hi: hi * sign, lo: lo * sign, exponent: if nothing { 0.0 } else { ke - he + de } }
    }

    /// The same number as `Scale::new(k, h, dt).value()` where all that arises is positive and normal: as every step is
    /// rounded relative to its size, binary exponents need not be held apart.
    #[inline(always)]
    pub(super) fn value_of_usual(k: f64, h: f64, dt: f64) -> f64 {
        let q = k / h;
        let q_lo = (-q).mul_add(h, k) * (1.0 / h);
        let (w, e) = two_product(q, dt);
        w + q_lo.mul_add(dt, e)
    }

    /// The factor rounded to a double (infinite or zero beyond the range of doubles).
    #[inline(always)]
    #[must_use]
    pub fn value(self) -> f64 {
        ldexp(self.hi, self.exponent)
    }
}

/// Whether `x >= 0` has a logarithm.
#[inline(always)]
fn usable(x: f64) -> bool {
    x > 0.0 && x <= f64::MAX
}
