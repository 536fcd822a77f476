//! One point with every case decided: silent, open and still points, subnormal bases, exponents
//! and intermediate results of any size.
//!
//! The vector kernel hands over the few lanes it does not answer for; a law with exponents
//! of one point each is evaluated here where they are 0 or 1.

use super::double::{Double, fast_two_sum};
use super::kernel::{ABSENT, GENERAL, LINEAR, Outcome, exp2, kind, lane};
use super::linear;
use super::scale::{Scale, ldexp, split_any};

/// `c p^m v^n` and its slope by the path that the exponents of this point ask for: the same bits
/// as a batch whose exponents are uniform.
#[inline(always)]
pub(super) fn point(p: f64, v: f64, m: f64, n: f64, c: Scale) -> Outcome {
    let kinds = (kind(m), kind(n));
    let quick = match kinds {
        (GENERAL, GENERAL) => lane::<GENERAL, GENERAL>(p, v, m, n, c),
        (GENERAL, LINEAR) => lane::<GENERAL, LINEAR>(p, v, m, n, c),
        (GENERAL, _) => lane::<GENERAL, ABSENT>(p, v, m, n, c),
        (LINEAR, GENERAL) => lane::<LINEAR, GENERAL>(p, v, m, n, c),
        (_, GENERAL) => lane::<ABSENT, GENERAL>(p, v, m, n, c),
        (LINEAR, LINEAR) => linear::lane::<LINEAR, LINEAR>(p, v, c.value()),
        (LINEAR, _) => linear::lane::<LINEAR, ABSENT>(p, v, c.value()),
        (_, LINEAR) => linear::lane::<ABSENT, LINEAR>(p, v, c.value()),
        _ => linear::lane::<ABSENT, ABSENT>(p, v, c.value()),
    };
    if quick.wear.is_nan() { wide(p, v, m, n, c) } else { quick }
}

/// `c p^m v^n` and its slope for any input, by logarithms of about 100 bits.
#[inline(always)]
pub(super) fn wide(p: f64, v: f64, m: f64, n: f64, c: Scale) -> Outcome {
    const VOID: Outcome = Outcome { wear: f64::NAN, slope: f64::NAN };
    const SILENT: Outcome = Outcome { wear: 0.0, slope: 0.0 };
    let v = if n == 0.0 { 1.0 } else { v.abs() };
    if ![p, v, m, n, c.hi].iter().all(|x| x.is_finite()) {
        return VOID;
    }
    if p <= 0.0 || c.hi == 0.0 || (v == 0.0 && n > 0.0) {
        return SILENT;
    }
    if v == 0.0 {
        let wear = f64::INFINITY.copysign(c.hi);
        let slope = if m == 0.0 { 0.0 } else { wear * m };
        return Outcome { wear, slope };
    }
    let (fp, kp) = split_any(p);
    let (fv, kv) = split_any(v);
    let mut factor = Double { hi: c.hi, lo: c.lo };
    let mut k = c.exponent;
    let mut t = Double::from(0.0);
    for (exponent, f, e) in [(m, fp, kp), (n, fv, kv)] {
        match kind(exponent) {
            ABSENT => {}
            LINEAR => {
                factor = factor.scaled(f);
                k += e;
            }
            // By 2^-12, so that no exponent makes an infinity that another would cancel.
            _ => t = t.plus(log2(f, e).scaled(exponent / 4096.0)),
        }
    }
    let t = if t.hi.abs() > 16.0 { Double::from(16f64.copysign(t.hi)) } else { t };
    let (hi, lo) = fast_two_sum(t.hi * 4096.0, t.lo * 4096.0);
    let (r, k) = exp2(Double { hi, lo }, factor.hi, factor.lo, k);
    Outcome { wear: ldexp(r, k), slope: if m == 0.0 { 0.0 } else { ldexp(r / fp * m, k - kp) } }
}

/// `log2(f 2^k)` to 2^-98 of itself, by the series `2 atanh(s) / ln 2`, `s = (f - 1) / (f + 1)`.
#[inline(always)]
fn log2(f: f64, k: f64) -> Double {
    /// Terms of the series: `s^(2 * 24) < 2^-122`.
    const TERMS: u32 = 24;
    let one = Double::from(1.0);
    let top = Double::from(f - 1.0);
    let s = top.over(Double::from(f).plus(one));
    let z = s.times(s);
    let mut sum = Double::from(0.0);
    for i in (0..TERMS).rev() {
        let term = one.over(Double::from(f64::from(2 * i + 1)));
        sum = sum.times(z).plus(term);
    }
    let c0 = Double { hi: super::coefficients::C0_HI, lo: super::coefficients::C0_LO };
    Double::from(k).plus(s.times(sum).times(c0))
}
