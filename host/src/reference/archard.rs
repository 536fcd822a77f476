//! Archard wear, dw/dt = K p^m |v|^n / H, where pressure, velocity and constants are data in time.
//!
//! Pressure that is not greater than zero wears nothing. Units are any consistent set; K carries
//! those that the exponents leave open.

use super::pieces::Piece;
use super::quadrature::{Compensated, tanh_sinh};

/// The constants of Archard's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArchardConstants {
    /// Wear coefficient K.
    pub wear_coefficient: f64,
    /// Hardness H.
    pub hardness: f64,
    /// Pressure exponent m.
    pub pressure_exponent: f64,
    /// Velocity exponent n.
    pub velocity_exponent: f64,
}

impl ArchardConstants {
    /// From the order K, H, m, n.
    pub fn from_array([k, h, m, n]: [f64; 4]) -> ArchardConstants {
        ArchardConstants { wear_coefficient: k, hardness: h, pressure_exponent: m, velocity_exponent: n }
    }

    fn mix(&self, other: &ArchardConstants, left: f64, right: f64) -> ArchardConstants {
        let mix = |a: f64, b: f64| if a == b { a } else { a * left + b * right };
        ArchardConstants {
            wear_coefficient: mix(self.wear_coefficient, other.wear_coefficient),
            hardness: mix(self.hardness, other.hardness),
            pressure_exponent: mix(self.pressure_exponent, other.pressure_exponent),
            velocity_exponent: mix(self.velocity_exponent, other.velocity_exponent),
        }
    }
}

/// Constants at a time of a table: linear between its points, held outside them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TablePoint {
    /// Time.
    pub time: f64,
    /// Constants at that time.
    pub constants: ArchardConstants,
}

/// What keeps an exact answer from existing.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArchardReferenceError {
    /// No table point.
    #[error("no table points, expected at least one")]
    EmptyTable,
    /// Table points whose times do not increase.
    #[error("table time {time} follows {before}, expected increasing times")]
    TableOrder {
        /// Time of the point before.
        before: f64,
        /// Time that does not lie after it.
        time: f64,
    },
    /// A hardness that passes or reaches zero, or is not finite.
    #[error("hardness {0}, expected more than 0")]
    Hardness(f64),
    /// A wear coefficient below zero, or not finite.
    #[error("wear coefficient {0}, expected 0 or more")]
    WearCoefficient(f64),
    /// A pressure exponent for which the rate has no finite integral or no meaning.
    #[error("pressure exponent {0}, expected a finite number of 0 or more")]
    PressureExponent(f64),
    /// A velocity exponent below zero where the velocity is zero.
    #[error("velocity exponent {0} where the velocity is zero, expected 0 or more")]
    VelocityExponent(f64),
    /// The wear depth is larger than a double holds, or the input is not finite.
    #[error("the wear depth is not a finite number")]
    NotFinite,
}

/// Wear depth at a constant rate: w = K p^m |v|^n t / H.
///
/// The product is taken so that only the result can overflow: e.g. K = 1e-300, p = 1e9, m = 40.
///
/// # Errors
/// Constants out of their bounds, or a result that is not finite.
pub fn constant_rate(
    constants: &ArchardConstants,
    pressure: f64,
    velocity: f64,
    duration: f64,
) -> Result<f64, ArchardReferenceError> {
    check(constants)?;
    if velocity == 0.0 && constants.velocity_exponent < 0.0 && pressure > 0.0 {
        return Err(ArchardReferenceError::VelocityExponent(constants.velocity_exponent));
    }
    finite(rate(constants, pressure, velocity, duration))
}

/// Wear depth for m = n = 1 with K = K0 + K1 t and H = H0 + H1 t, at constant p and v, after time T.
///
/// w = p |v| { K1 T / H1 + (K0 H1 - K1 H0) / H1^2 ln(1 + H1 T / H0) }, the integral of
/// (K0 + K1 t) / (H0 + H1 t). It is evaluated as p |v| T / H0 { K0 f(x) + K1 T g(x) } with
/// x = H1 T / H0, f = ln(1 + x) / x and g = (x - ln(1 + x)) / x^2, which has no poles at H1 = 0.
///
/// # Errors
/// A hardness that is not greater than zero over the whole time, or a result that is not finite.
pub fn linear_tables_unit_exponents(
    wear_coefficient: [f64; 2],
    hardness: [f64; 2],
    pressure: f64,
    velocity: f64,
    duration: f64,
) -> Result<f64, ArchardReferenceError> {
    let [k0, k1] = wear_coefficient;
    let [h0, h1] = hardness;
    for h in [h0, h0 + h1 * duration] {
        if h.is_nan() || h <= 0.0 {
            return Err(ArchardReferenceError::Hardness(h));
        }
    }
    if pressure <= 0.0 {
        return Ok(0.0);
    }
    let x = h1 * duration / h0;
    let log = x.ln_1p();
    let (f, g) = if x.abs() < 0.1 { log_series(x) } else { (log / x, (x - log) / (x * x)) };
    finite(pressure * velocity.abs() * duration / h0 * (k0 * f + k1 * duration * g))
}

/// ln(1 + x) / x and (x - ln(1 + x)) / x^2 by their series, for |x| below 0.1.
fn log_series(x: f64) -> (f64, f64) {
    // g = sum (-x)^j / (j + 2), and f = 1 - x g; 18 terms reach 1e-18.
    let g = (0..18).rev().fold(0.0, |sum, j| 1.0 / f64::from(j + 2) - x * sum);
    (1.0 - x * g, g)
}

/// Wear depth for n = 1, m = 1 and constant K and H over pieces of linear pressure and velocity.
///
/// Between zeros of p and v, over a length L: L/6 (2 p0 v0 + p0 v1 + p1 v0 + 2 p1 v1), the
/// integral of a product of two linear functions; velocity counts by its magnitude, and pressure
/// below zero counts nothing.
///
/// # Errors
/// Constants out of their bounds, or a result that is not finite.
pub fn linear_pieces_degree_one(
    wear_coefficient: f64,
    hardness: f64,
    pieces: &[Piece],
) -> Result<f64, ArchardReferenceError> {
    closed_pieces(wear_coefficient, hardness, pieces, |[p0, p1], [v0, v1]| {
        (2.0 * p0 * v0 + p0 * v1 + p1 * v0 + 2.0 * p1 * v1) / 6.0
    })
}

/// Wear depth for n = 1, m = 2 and constant K and H over pieces of linear pressure and velocity.
///
/// Between zeros of p and v, over a length L: L/12 (p0^2 (3 v0 + v1) + 2 p0 p1 (v0 + v1)
/// + p1^2 (v0 + 3 v1)), by the integrals of (1-s)^3, s (1-s)^2, s^2 (1-s), s^3: 1/4, 1/12, 1/12, 1/4.
///
/// # Errors
/// As [`linear_pieces_degree_one`].
pub fn linear_pieces_degree_two(
    wear_coefficient: f64,
    hardness: f64,
    pieces: &[Piece],
) -> Result<f64, ArchardReferenceError> {
    closed_pieces(wear_coefficient, hardness, pieces, |[p0, p1], [v0, v1]| {
        let ends = p0 * p0 * (3.0 * v0 + v1) + p1 * p1 * (v0 + 3.0 * v1);
        (ends + 2.0 * p0 * p1 * (v0 + v1)) / 12.0
    })
}

fn closed_pieces(
    wear_coefficient: f64,
    hardness: f64,
    pieces: &[Piece],
    mean: impl Fn([f64; 2], [f64; 2]) -> f64,
) -> Result<f64, ArchardReferenceError> {
    check(&ArchardConstants::from_array([wear_coefficient, hardness, 1.0, 1.0]))?;
    let mut sum = Compensated::default();
    for piece in pieces.iter().flat_map(|piece| without_zeros(piece, &[])) {
        sum.add((piece.time[1] - piece.time[0]) * mean(piece.pressure, piece.velocity));
    }
    finite(wear_coefficient / hardness * sum.value())
}

/// Wear depth over pieces of linear pressure and velocity, with constants from a table in time.
///
/// w = sum over pieces of the integral of K(t) p(t)^m(t) |v(t)|^n(t) / H(t). Each piece is split
/// at table points and at zeros of p and v and then integrated by [`tanh_sinh`], which holds its
/// accuracy where a power of p or v starts from zero.
///
/// # Errors
/// A table that is empty or out of order, constants out of their bounds, a velocity exponent that
/// is not zero or more at a velocity of zero, or a result that is not finite.
pub fn prescribed(table: &[TablePoint], pieces: &[Piece]) -> Result<f64, ArchardReferenceError> {
    if table.is_empty() {
        return Err(ArchardReferenceError::EmptyTable);
    }
    for pair in table.windows(2) {
        let (before, time) = (pair[0].time, pair[1].time);
        if time.is_nan() || time <= before {
            return Err(ArchardReferenceError::TableOrder { before, time });
        }
    }
    table.iter().try_for_each(|point| check(&point.constants))?;
    let cuts: Vec<f64> = table.iter().map(|point| point.time).collect();
    let mut sum = Compensated::default();
    for piece in pieces.iter().flat_map(|piece| without_zeros(piece, &cuts)) {
        let [start, end] = piece.time;
        let [first, last] = [constants_at(table, start), constants_at(table, end)];
        if piece.pressure == [0.0; 2] {
            continue;
        }
        let least = first.velocity_exponent.min(last.velocity_exponent);
        if least < 0.0 && piece.velocity.contains(&0.0) {
            return Err(ArchardReferenceError::VelocityExponent(least));
        }
        let length = end - start;
        let steady = first == last && piece.pressure[0] == piece.pressure[1] && piece.velocity[0] == piece.velocity[1];
        if steady {
            sum.add(rate(&first, piece.pressure[0], piece.velocity[0], length));
            continue;
        }
        let mix = |ends: [f64; 2], left: f64, right: f64| {
            if ends[0] == ends[1] { ends[0] } else { ends[0] * left + ends[1] * right }
        };
        sum.add(tanh_sinh(length, |from_start, from_end| {
            let (left, right) = (from_end / length, from_start / length);
            let constants = first.mix(&last, left, right);
            let pressure = mix(piece.pressure, left, right);
            rate(&constants, pressure, mix(piece.velocity, left, right), 1.0)
        }));
    }
    finite(sum.value())
}

/// The constants at a time: linear between table points, held outside them.
fn constants_at(table: &[TablePoint], time: f64) -> ArchardConstants {
    let after = table.partition_point(|point| point.time <= time);
    if after == 0 || after == table.len() {
        return table[after.saturating_sub(1)].constants;
    }
    let (a, b) = (&table[after - 1], &table[after]);
    let right = (time - a.time) / (b.time - a.time);
    a.constants.mix(&b.constants, 1.0 - right, right)
}

/// A piece cut at the given times and at zeros of pressure and velocity, without its open parts;
/// velocities come out by their magnitude.
fn without_zeros(piece: &Piece, cuts: &[f64]) -> Vec<Piece> {
    let [start, end] = piece.time;
    let length = end - start;
    let zero_of = |[a, b]: [f64; 2]| (a * b < 0.0).then(|| a / (a - b));
    let zeros = [zero_of(piece.pressure), zero_of(piece.velocity)];
    let mut at: Vec<f64> = vec![0.0, 1.0];
    at.extend(zeros.iter().flatten());
    at.extend(cuts.iter().filter(|t| start < **t && **t < end).map(|t| (t - start) / length));
    at.sort_by(f64::total_cmp);
    at.dedup();
    let value = |[a, b]: [f64; 2], s: f64, zero: Option<f64>| {
        if zero == Some(s) {
            0.0
        } else if s == 1.0 {
            b
        } else {
            a + s * (b - a)
        }
    };
    // A cut is put back on its own time: the table is read there.
    let time = |s: f64| match cuts.iter().find(|t| (**t - start) / length == s) {
        Some(cut) => *cut,
        None => value(piece.time, s, None),
    };
    let between = at.windows(2).filter(|_| length > 0.0).map(|s| Piece {
        time: [time(s[0]), time(s[1])],
        pressure: [value(piece.pressure, s[0], zeros[0]), value(piece.pressure, s[1], zeros[0])],
        velocity: [value(piece.velocity, s[0], zeros[1]).abs(), value(piece.velocity, s[1], zeros[1]).abs()],
    });
    between.filter(|piece| piece.pressure.iter().sum::<f64>() > 0.0).collect()
}

/// K p^m |v|^n / H times a factor; by logarithms where a partial product leaves the range of doubles.
fn rate(constants: &ArchardConstants, pressure: f64, velocity: f64, factor: f64) -> f64 {
    let ArchardConstants { wear_coefficient: k, hardness: h, pressure_exponent: m, velocity_exponent: n } = *constants;
    let v = velocity.abs();
    if pressure <= 0.0 || k == 0.0 || factor == 0.0 || (v == 0.0 && n > 0.0) {
        return 0.0;
    }
    let powers = [pressure.powf(m), v.powf(n)];
    let parts = [k, powers[0], k * powers[0], powers[1], k * powers[0] * powers[1]];
    let product = parts[4] / h * factor;
    let safe = |x: &f64| x.is_normal();
    if parts.iter().all(safe) && product.is_normal() {
        return product;
    }
    let speed = if v == 0.0 { 0.0 } else { n * v.ln() };
    (k.ln() - h.ln() + m * pressure.ln() + speed + factor.ln()).exp()
}

fn check(constants: &ArchardConstants) -> Result<(), ArchardReferenceError> {
    let (k, h, m) = (constants.wear_coefficient, constants.hardness, constants.pressure_exponent);
    if !h.is_finite() || h <= 0.0 {
        Err(ArchardReferenceError::Hardness(h))
    } else if !k.is_finite() || k < 0.0 {
        Err(ArchardReferenceError::WearCoefficient(k))
    } else if !m.is_finite() || m < 0.0 {
        Err(ArchardReferenceError::PressureExponent(m))
    } else if !constants.velocity_exponent.is_finite() {
        Err(ArchardReferenceError::VelocityExponent(constants.velocity_exponent))
    } else {
        Ok(())
    }
}

fn finite(depth: f64) -> Result<f64, ArchardReferenceError> {
    if depth.is_finite() { Ok(depth) } else { Err(ArchardReferenceError::NotFinite) }
}

#[cfg(test)]
mod tests;
