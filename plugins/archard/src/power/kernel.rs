//! One point of the fused power, without a branch: the loop over points is left to the
//! compiler, which evaluates four lanes at a time where the processor has AVX2 and FMA.
//!
//! The equations and the error budget stand in the documentation of [the module](super).

use super::coefficients::{C0_HI, C0_LO, C1_HI, C1_LO, EXP_TAIL, LN2_HI, LN2_LO, LOG_TAIL};
use super::double::{Double, fast_two_sum, two_product, two_sum};
use super::scale::{Scale, ldexp, split};

/// An exponent of 0: the factor is 1 and its base is not looked at.
pub(super) const ABSENT: u8 = 0;
/// An exponent of 1: the factor is multiplied, no logarithm is taken.
pub(super) const LINEAR: u8 = 1;
/// Any other exponent.
pub(super) const GENERAL: u8 = 2;

/// Largest `|m log2 p| + |n log2 v|` that [`lane`] answers for.
const REACH: f64 = 1024.0;

/// What an exponent asks for.
#[inline]
pub(super) fn kind(exponent: f64) -> u8 {
    if exponent == 0.0 {
        ABSENT
    } else if exponent == 1.0 {
        LINEAR
    } else {
        GENERAL
    }
}

/// An increment and its derivative with respect to pressure.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    /// Wear increment.
    pub(super) wear: f64,
    /// d(increment)/d(pressure).
    pub(super) slope: f64,
}

/// `c p^m v^n` and its slope `m c p^(m-1) v^n`; not a number where the lane must be left to
/// [`exact`](super::exact::point): inputs that are 0, subnormal or not finite (but for
/// the silent points `p <= 0` and `v = 0 < n`, which give 0), and exponents beyond [`REACH`].
///
/// `M` and `N` are the kinds of `m` and `n`, at least one of them [`GENERAL`].
#[inline(always)]
pub(super) fn lane<const M: u8, const N: u8>(p: f64, v: f64, m: f64, n: f64, c: Scale) -> Outcome {
    let v = if N == ABSENT { 1.0 } else { v.abs() };
    let open = p <= 0.0 && p >= -f64::MAX;
    let still = v == 0.0 && n > 0.0;
    let known_p = open || (p >= f64::MIN_POSITIVE && p <= f64::MAX);
    let known_v = still || (v >= f64::MIN_POSITIVE && v <= f64::MAX);
    let silent = open || still;
    let ps = if silent { 1.0 } else { p };
    let vs = if silent { 1.0 } else { v };

    let (fp, kp) = split(ps);
    let (fv, kv) = split(vs);
    let (mut hi, mut lo, mut k) = (c.hi, c.lo, c.exponent);
    if M == LINEAR {
        (hi, lo) = times(hi, lo, fp);
        k += kp;
    }
    if N == LINEAR {
        (hi, lo) = times(hi, lo, fv);
        k += kv;
    }
    let (t, size) = match (M, N) {
        (GENERAL, GENERAL) => {
            let a = product(m, log2(fp, kp));
            let b = product(n, log2(fv, kv));
            let (s, e) = two_sum(a.hi, b.hi);
            let lo = e + (a.lo + b.lo);
            (Double { hi: s, lo }, a.hi.abs() + b.hi.abs())
        }
        (GENERAL, _) => {
            let a = product(m, log2(fp, kp));
            (a, a.hi.abs())
        }
        _ => {
            let b = product(n, log2(fv, kv));
            (b, b.hi.abs())
        }
    };
    let (r, k) = exp2(t, hi, lo, k);
    let known = known_p && known_v && size <= REACH;
    let settle = |x: f64| {
        let x = if silent { 0.0 } else { x };
        if known { x } else { f64::NAN }
    };
    Outcome { wear: settle(ldexp(r, k)), slope: settle(ldexp(r / fp * m, k - kp)) }
}

/// `(hi + lo) f`, not normalised: `|lo|` stays below two units in the last place of `hi`.
#[inline(always)]
fn times(hi: f64, lo: f64, f: f64) -> (f64, f64) {
    let (h, e) = two_product(hi, f);
    (h, lo.mul_add(f, e))
}

/// `m (hi + lo)`, not normalised.
#[inline(always)]
fn product(m: f64, x: Double) -> Double {
    let (hi, e) = two_product(m, x.hi);
    Double { hi, lo: m.mul_add(x.lo, e) }
}

/// `log2(f 2^k)` for `sqrt(1/2) <= f < sqrt(2)` and an integer `k`.
///
/// With `s = (f - 1) / (f + 1)` and `z = s^2` it is `k + C0 s + C1 s z + s z^2 T(z)`; the first
/// three terms are carried to twice the precision of a double.
#[inline(always)]
pub(super) fn log2(f: f64, k: f64) -> Double {
    // s = s + s_lo to 2^-104: one division, the remainder from fused multiply-adds.
    let top = f - 1.0;
    let bottom = f + 1.0;
    let bottom_lo = f - (bottom - 1.0);
    let inverse = 1.0 / bottom;
    let s = top * inverse;
    let s_lo = (-s).mul_add(bottom_lo, (-s).mul_add(bottom, top)) * inverse;

    let z = s * s;
    let z_lo = s.mul_add(s, -z);
    let z2 = z * z;
    let [t0, t1, t2, t3, t4, t5, t6, t7] = LOG_TAIL;
    let low = t3.mul_add(z, t2).mul_add(z2, t1.mul_add(z, t0));
    let high = t7.mul_add(z, t6).mul_add(z2, t5.mul_add(z, t4));
    let tail = high.mul_add(z2 * z2, low);

    // The cubic term s z (C1 + z T).
    let (g, g_lo) = fast_two_sum(C1_HI, z * tail);
    let (cube, cube_e) = two_product(s, z);
    let cube_lo = s.mul_add(z_lo, cube_e);
    let (second, second_e) = two_product(cube, g);
    let second_lo = cube.mul_add(g_lo + C1_LO, cube_lo.mul_add(g, second_e));
    // The linear one; s_lo is worth s_lo C0 / (1 - z), nearly s_lo C0 (1 + z).
    let (first, first_e) = two_product(C0_HI, s);
    let first_lo = s_lo.mul_add(C0_HI.mul_add(z, C0_HI), C0_LO.mul_add(s, first_e));

    let (part, part_e) = fast_two_sum(first, second);
    let (hi, hi_e) = fast_two_sum(k, part);
    Double { hi, lo: hi_e + (part_e + (first_lo + second_lo)) }
}

/// `(hi + lo) 2^(t + k)` as a double near 1 and a binary exponent.
///
/// With `f = t - round(t)`, `2^f = 1 + f ln 2 + f^2 E(f)`; the factor `hi + lo` enters before the
/// one final rounding.
#[inline(always)]
pub(super) fn exp2(t: Double, hi: f64, lo: f64, k: f64) -> (f64, f64) {
    /// Adding and taking away 1.5 * 2^52 rounds to the nearest integer.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let whole = (t.hi + ROUND) - ROUND;
    let (f, f_lo) = fast_two_sum(t.hi - whole, t.lo);
    let f2 = f * f;
    let f4 = f2 * f2;
    let [e0, e1, e2, e3, e4, e5, e6, e7, e8, e9] = EXP_TAIL;
    let low = e3.mul_add(f, e2).mul_add(f2, e1.mul_add(f, e0));
    let high = e7.mul_add(f, e6).mul_add(f2, e5.mul_add(f, e4));
    let high = e9.mul_add(f, e8).mul_add(f4, high);
    let tail = high.mul_add(f4, low);
    let rest = f2.mul_add(tail, LN2_HI.mul_add(f_lo, LN2_LO * f));
    // 2^f - 1, and hi + lo + (hi + lo)(2^f - 1).
    let q = LN2_HI.mul_add(f, rest);
    (hi + hi.mul_add(q, lo), whole + k)
}
