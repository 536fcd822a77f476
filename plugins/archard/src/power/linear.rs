//! Exponents that are 0 or 1: products only, each correctly rounded, at the speed of memory.

use super::kernel::{ABSENT, LINEAR, Outcome};

/// `(c p) v` with the factor `c` as a double, its slope `c v`, or the shorter products where a
/// kind is [`ABSENT`]; not a number where a product in between leaves the normal range or an
/// input is not finite, so that [`exact`](super::exact::wide) must answer.
#[inline(always)]
pub(super) fn lane<const M: u8, const N: u8>(p: f64, v: f64, c: f64) -> Outcome {
    let v = if N == ABSENT { 1.0 } else { v.abs() };
    let open = p <= 0.0;
    let first = if M == LINEAR { c * p } else { c };
    let normal = first.abs() >= f64::MIN_POSITIVE && first.abs() <= f64::MAX;
    // The double `c` holds the factor only while it is normal itself.
    let factor = c.abs() >= f64::MIN_POSITIVE && c.abs() <= f64::MAX;
    let known = p.abs() <= f64::MAX && v <= f64::MAX && factor && (normal || open);
    let settle = |x: f64| {
        let x = if open { 0.0 } else { x };
        if known { x } else { f64::NAN }
    };
    Outcome { wear: settle(first * v), slope: settle(if M == LINEAR { c * v } else { 0.0 }) }
}
