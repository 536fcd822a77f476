//! One point of the fused power, without a branch: the loop over points is left to the
//! compiler, which evaluates four lanes at a time where the processor has AVX2 and FMA.
//!
//! The equations and the error budget stand in the documentation of [the module](super).

use super::coefficients::{C0_HI, C0_LO, C1, EXP_TAIL, LN2_HI, LN2_LO, LOG_TAIL};
use super::double::{Double, doubt, fast_two_sum, two_product, two_sum};
use super::scale::{Scale, split, two_to};

/// An exponent of 0: the factor is 1 and its base is not looked at.
pub(super) const ABSENT: u8 = 0;
/// An exponent of 1: the factor is multiplied, no logarithm is taken.
pub(super) const LINEAR: u8 = 1;
/// Any other exponent.
pub(super) const GENERAL: u8 = 2;

/// Largest `|m log2 p| + |n log2 v|` that [`lane`] answers for at usual exponents.
const REACH: f64 = 1024.0;
/// Largest `|m| + |n|` that it answers for.
const LARGEST: f64 = 32.0;
/// Largest binary exponent of an increment that it answers for.
const SPAN: f64 = 960.0;

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

/// `c p^m v^n` and its slope `m c p^(m-1) v^n`; not a number where the point must be left to
/// [`exact`](super::exact::wide): inputs that are subnormal or not finite, `v = 0` unless `n > 0`,
/// exponents and results beyond what [`conclude`] answers for.
///
/// `M` and `N` are the kinds of `m` and `n`, at least one of them [`GENERAL`].
#[inline(always)]
pub(super) fn lane<const M: u8, const N: u8>(p: f64, v: f64, m: f64, n: f64, c: Scale) -> Outcome {
    const ZERO: Double = Double::from(0.0);
    let a = if M == GENERAL { logarithm(m, p) } else { ZERO };
    let b = if N == GENERAL { logarithm(n, v) } else { ZERO };
    conclude::<M, N>(p, v, a, b, m, n, c)
}

/// `m log2 |x|` for a normal `x`; some number for any other.
#[inline(always)]
pub(super) fn logarithm(m: f64, x: f64) -> Double {
    let (f, k) = split(x.abs());
    let x = log2(f, k);
    let (hi, e) = two_product(m, x.hi);
    Double { hi, lo: m.mul_add(x.lo, e) }
}

/// [`lane`] from the two logarithms on (of which a kind that is not general has none).
///
/// Conditions are joined without branches and as few as can be: what is not finite becomes a
/// sum that is not a number, instead of a comparison.
#[inline(always)]
pub(super) fn conclude<const M: u8, const N: u8>(
    p: f64,
    v: f64,
    a: Double,
    b: Double,
    m: f64,
    n: f64,
    c: Scale,
) -> Outcome {
    let v = if N == ABSENT { 1.0 } else { v.abs() };
    let (mut hi, mut lo, mut k) = (c.hi, c.lo, c.exponent);
    if M == LINEAR {
        let (f, e) = split(p);
        (hi, lo) = times(hi, lo, f);
        k += e;
    }
    if N == LINEAR {
        let (f, e) = split(v);
        (hi, lo) = times(hi, lo, f);
        k += e;
    }
    let (t, size) = match (M, N) {
        (GENERAL, GENERAL) => {
            let (s, e) = two_sum(a.hi, b.hi);
            let lo = e + (a.lo + b.lo);
            (Double { hi: s, lo }, a.hi.abs() + b.hi.abs())
        }
        (GENERAL, _) => (a, a.hi.abs()),
        _ => (b, b.hi.abs()),
    };
    let (r, k) = exp2(t, hi, lo, k);
    let wear = r * two_to(k);
    // The sum makes every zero a positive one, as where no wear is known beforehand.
    let slope = m * wear / p + 0.0;

    // 0, or not a number if p or v is not finite.
    let doubt = doubt(p) + doubt(v);
    let still = doubt + if n > 0.0 { 0.0 } else { f64::NAN };
    let known = (size + doubt <= reach(m, n)) & (k.abs() <= SPAN);
    let settle = |x: f64| {
        let x = if known { x } else { f64::NAN };
        let x = if v >= f64::MIN_POSITIVE {
            x
        } else if v == 0.0 {
            still
        } else {
            f64::NAN
        };
        if p >= f64::MIN_POSITIVE {
            x
        } else if p <= 0.0 {
            doubt
        } else {
            f64::NAN
        }
    };
    Outcome { wear: settle(wear), slope: settle(slope) }
}

/// Largest `|m log2 p| + |n log2 v|` that [`lane`] answers for, negative if it answers for none:
/// beyond [`LARGEST`] in sum of exponents the error of a logarithm would show, and a very small
/// `m` would push a slope out of range on the way.
#[inline(always)]
fn reach(m: f64, n: f64) -> f64 {
    let small = (m.abs() < f64::EPSILON) & (m != 0.0);
    let usual = (m.abs() + n.abs() <= LARGEST) & !small;
    if usual { REACH } else { -1.0 }
}

/// `(hi + lo) f`, not normalised: `|lo|` stays below two units in the last place of `hi`.
#[inline(always)]
fn times(hi: f64, lo: f64, f: f64) -> (f64, f64) {
    let (h, e) = two_product(hi, f);
    (h, lo.mul_add(f, e))
}

/// `log2(f 2^k)` for `sqrt(1/2) <= f < sqrt(2)` and an integer `k`.
///
/// With `s = (f - 1) / (f + 1)` and `z = s^2` it is `k + s u`, `u = C0 + z (C1 + z T(z))`; `s` and
/// the sum `u` are carried to twice the precision of a double, the small `z (C1 + ..)` is not.
#[inline(always)]
pub(super) fn log2(f: f64, k: f64) -> Double {
    // s + s_lo to 2^-104: one division, the remainder from fused multiply-adds.
    let top = f - 1.0;
    let bottom = f + 1.0;
    let bottom_lo = f - (bottom - 1.0);
    let inverse = 1.0 / bottom;
    let s = top * inverse;
    let s_lo = (-s).mul_add(bottom_lo, (-s).mul_add(bottom, top)) * inverse;

    let z = s * s;
    let z2 = z * z;
    let [t0, t1, t2, t3, t4, t5, t6] = LOG_TAIL;
    let low = t3.mul_add(z, t2).mul_add(z2, t1.mul_add(z, t0));
    let high = t6.mul_add(z2, t5.mul_add(z, t4));
    let tail = high.mul_add(z2 * z2, low);

    let y = z * tail.mul_add(z, C1);
    let (u, u_e) = fast_two_sum(C0_HI, y);
    let u_lo = u_e + C0_LO;
    // d(s u)/ds = C0 / (1 - z), nearly u + 2 y.
    let (first, first_e) = two_product(s, u);
    let first_lo = s_lo.mul_add(y.mul_add(2.0, u), s.mul_add(u_lo, first_e));
    let (hi, hi_e) = fast_two_sum(k, first);
    Double { hi, lo: hi_e + first_lo }
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
