//! What the law is, and what it makes of a batch.

use std::ffi::CStr;
use std::fmt::Arguments;

use wearlaw_plugin_api::sdk::Column;
use wearlaw_plugin_api::sdk::prelude::*;

use crate::power::{self, Inputs};

/// Points that are computed and then checked while they are in the nearest cache.
const BLOCK: usize = 1024;

/// The known values beside this crate.
const EXPECTED: &CStr = match CStr::from_bytes_with_nul(concat!(include_str!("../expected.csv"), "\0").as_bytes()) {
    Ok(text) => text,
    Err(_) => panic!("a NUL within the table"),
};

/// The Archard law: wear increment = (K / H) p^m v^n dt, with contact pressure p and sliding velocity v.
///
/// Constants K (wear coefficient), H (hardness), m (pressure exponent), n (velocity exponent); Archard, J. F., "Contact
/// and Rubbing of Flat Surfaces", J. Appl. Phys. 24 (1953) 981-988, has m = n = 1. No wear where p <= 0, whatever m.
#[derive(Clone, Copy, Debug)]
pub struct Archard;

impl About for Archard {
    const NAME: &'static str = "archard";
    const VERSION: &'static str = env!("CARGO_PKG_VERSION");
    const SUMMARY: &'static str = "Archard wear: increment = (K / H) p^m v^n dt";
    const SOURCE: &'static str = "J. F. Archard, J. Appl. Phys. 24 (1953) 981-988; exponents m and n generalise it";
    const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
    const WRITES: i64 = WL_OUT_D_PRESSURE;
    const CLAIMS: i64 = WL_CLAIM_DETERMINISTIC
        | WL_CLAIM_NON_NEGATIVE
        | WL_CLAIM_LINEAR_IN_DT
        | WL_CLAIM_ZERO_WITHOUT_PRESSURE
        | WL_CLAIM_FRAME_INDIFFERENT;
    const FLAGS: i64 = WL_FLAG_KINKS;
    const CONSTANTS: &'static [Quantity] = &[
        Quantity::new("K", Unit::NUMBER)
            .at_least(0.0)
            .closes_units()
            .about("wear coefficient (a number for m = n = 1)"),
        Quantity::new("H", Unit::PASCAL).above(0.0).about("hardness of the softer body"),
        Quantity::new("m", Unit::NUMBER).default(1.0).about("pressure exponent"),
        Quantity::new("n", Unit::NUMBER).default(1.0).about("velocity exponent"),
    ];
    const DEGREE: Degree = Degree::Constant(2);
    const KNOWN_VALUES: Option<&'static CStr> = Some(EXPECTED);
    const INSTANCE: Option<Self> = Some(Archard);
}

impl Law for Archard {
    // Out of the way of the common case.
    #[inline(never)]
    fn evaluate(&self, batch: &Batch<'_>, answer: &mut Answer<'_>) -> Status {
        let missing = batch.missing(<Self as About>::READS);
        let constants = [0, 1, 2, 3].map(|k| batch.constant(k));
        let (Some(pressure), Some(velocity), [Some(k), Some(h), Some(m), Some(n)]) =
            (batch.pressure(), batch.velocity(), constants)
        else {
            answer.miss(missing);
            return answer.worst();
        };
        let dt = batch.dt();
        if !(dt >= 0.0 && dt.is_finite()) {
            answer.say(Status::OutOfDomain, format_args!("dt is {dt}, expected a finite number of at least 0"));
            return answer.worst();
        }
        answer.all_good();
        let columns = Columns { pressure, velocity, k, h, m, n };
        let uniform = columns.uniform();
        if let Some(constants) = uniform
            && (constants[0] == 0.0 || dt == 0.0)
            && columns.silent(constants, answer)
        {
            return answer.worst();
        }
        for start in (0..batch.points()).step_by(BLOCK) {
            let end = batch.points().min(start + BLOCK);
            let increments = &mut answer.increment[start..end];
            let slopes = answer.d_pressure.as_deref_mut().map(|d| &mut d[start..end]);
            let inputs = Inputs {
                pressure: part(&pressure, start, end),
                velocity: part(&velocity, start, end),
                m: part(&m, start, end),
                n: part(&n, start, end),
                coefficient: part(&k, start, end),
                hardness: part(&h, start, end),
                dt,
            };
            let plain = power::increments(&inputs, increments, slopes);
            let wild = answer.d_pressure.as_deref().is_some_and(|d| odd(&d[start..end]));
            let known = match uniform {
                Some([_, _, _, n]) if plain && n != 0.0 => true,
                _ => (plain || !odd(&answer.increment[start..end])) && columns.inputs_known(start, end),
            };
            if wild || !known || !uniform.is_some_and(in_domain) {
                columns.judge(start, end, answer);
            }
        }
        answer.worst()
    }

    /// A linear law over columns of ordinary numbers, the common case.
    #[inline]
    fn increments(&self, batch: &Batch<'_>, increment: &mut [f64]) -> bool {
        let Some(wide) = power::Wide::here() else { return false };
        let Some([k, h, 1.0, 1.0]) = batch.uniform_constants() else { return false };
        let (Some(pressure), Some(velocity)) = (batch.pressure(), batch.velocity()) else { return false };
        match (pressure.slice(), velocity.slice()) {
            (Some(p), Some(v)) => power::steady(wide, p, v, (k, h, batch.dt()), increment),
            _ => false,
        }
    }
}

struct Columns<'a> {
    pressure: Column<'a>,
    velocity: Column<'a>,
    k: Column<'a>,
    h: Column<'a>,
    m: Column<'a>,
    n: Column<'a>,
}

impl Columns<'_> {
    /// Whether pressure and velocity are finite at the points `start .. end`.
    fn inputs_known(&self, start: usize, end: usize) -> bool {
        [&self.pressure, &self.velocity].into_iter().all(|column| match (column.slice(), column.uniform()) {
            (Some(values), _) => !odd(&values[start..end]),
            (None, Some(value)) => value.is_finite(),
            (None, None) => (start..end).all(|i| column.get(i).is_finite()),
        })
    }

    /// K, H, m and n, if every point has the same.
    fn uniform(&self) -> Option<[f64; 4]> {
        Some([self.k.uniform()?, self.h.uniform()?, self.m.uniform()?, self.n.uniform()?])
    }

    /// Answers a batch without wear at any pressure and velocity, if these and the constants are good.
    #[cold]
    fn silent(&self, constants: [f64; 4], answer: &mut Answer<'_>) -> bool {
        let good = in_domain(constants) && self.inputs_known(0, answer.increment.len());
        if good {
            answer.increment.fill(0.0);
            if let Some(slopes) = answer.d_pressure.as_deref_mut() {
                slopes.fill(0.0);
            }
        }
        good
    }

    fn constants(&self, i: usize) -> [f64; 4] {
        [self.k.get(i), self.h.get(i), self.m.get(i), self.n.get(i)]
    }

    /// Looks at every point of a block in which something is wrong, or may be, and says what.
    #[cold]
    fn judge(&self, start: usize, end: usize, answer: &mut Answer<'_>) {
        for i in start..end {
            let ([k, h, m, n], p, v) = (self.constants(i), self.pressure.get(i), self.velocity.get(i));
            let increment = answer.increment[i];
            if let Some(slope) = answer.d_pressure.as_deref_mut().map(|d| &mut d[i])
                && slope.is_infinite()
            {
                // The wear itself is good; a slope beyond all doubles is as steep as a double can say.
                *slope = f64::MAX;
            }
            let mut refuse = |text: Arguments<'_>| answer.flag(i, Status::OutOfDomain, text);
            if !p.is_finite() {
                refuse(format_args!("pressure is {p}, expected a finite number"));
            } else if !v.is_finite() {
                refuse(format_args!("velocity is {v}, expected a finite number"));
            } else if !(k >= 0.0 && k.is_finite()) {
                refuse(format_args!("K is {k}, expected a finite number of at least 0"));
            } else if !(h > 0.0 && h.is_finite()) {
                refuse(format_args!("H is {h}, expected a finite number above 0"));
            } else if !(m.is_finite() && n.is_finite()) {
                refuse(format_args!("m is {m} and n is {n}, expected finite numbers"));
            } else if !increment.is_finite() {
                if v == 0.0 && n < 0.0 {
                    refuse(format_args!("n is {n} and the velocity is 0: the wear rate is infinite"));
                } else if m < 0.0 {
                    refuse(format_args!("m is {m} and the pressure is {p:e}: the wear increment overflows"));
                } else {
                    refuse(format_args!("the wear increment overflows"));
                }
            }
        }
    }
}

/// Whether the constants K, H, m and n are ones that the law can work with.
fn in_domain([k, h, m, n]: [f64; 4]) -> bool {
    k >= 0.0 && k.is_finite() && h > 0.0 && h.is_finite() && m.is_finite() && n.is_finite()
}

/// Whether any value is infinite or not a number: one more in the exponent then carries over into the sign, which
/// vectorises on every processor.
fn odd(values: &[f64]) -> bool {
    let all = values.iter().fold(0, |all, x| all | (x.abs().to_bits() + (1 << 52)));
    all >> 63 != 0
}

/// The points `start .. end` of a column, as the kernel takes them.
fn part<'a>(column: &Column<'a>, start: usize, end: usize) -> power::Column<'a> {
    let (values, step) = column.strided();
    power::Column::strided(&values[start * step..(end - 1) * step + 1], step)
}

#[cfg(test)]
mod tests;
