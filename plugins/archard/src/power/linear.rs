//! Exponents that are 0 or 1: products only, each correctly rounded, at the speed of memory.

use super::double::doubt;
use super::kernel::{ABSENT, LINEAR, Outcome};

/// `(c p) v` with the factor `c` as a double, its slope `c v`, or the shorter products where a
/// kind is [`ABSENT`]; and whether [`exact`](super::exact::wide) must answer instead, because a
/// product in between leaves the normal range or something is not finite.
#[inline(always)]
pub(super) fn products<const M: u8, const N: u8>(p: f64, v: f64, c: f64) -> (Outcome, bool) {
    let v = if N == ABSENT { 1.0 } else { v.abs() };
    let first = match M {
        LINEAR => c * if p > 0.0 { p } else { 0.0 },
        _ => {
            if p > 0.0 {
                c
            } else {
                0.0
            }
        }
    };
    // The sum also makes every zero a positive one.
    let wear = first * v + doubt(p);
    let slope = if M == LINEAR && p > 0.0 { c * v } else { 0.0 };
    // The double `c` holds the factor only while it is normal itself.
    let vague = c.abs() < f64::MIN_POSITIVE;
    let lost = (first.abs() < f64::MIN_POSITIVE) & (p > 0.0);
    let finite = wear.abs() <= f64::MAX;
    (Outcome { wear, slope }, !finite | lost | vague)
}

/// [`products`], not a number where it does not answer.
#[inline(always)]
pub(super) fn lane<const M: u8, const N: u8>(p: f64, v: f64, c: f64) -> Outcome {
    let (o, left) = products::<M, N>(p, v, c);
    if left { Outcome { wear: f64::NAN, slope: f64::NAN } } else { o }
}
