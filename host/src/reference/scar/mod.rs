//! The scar that a sphere or a cylinder wears under constant load, the contact zone being fixed in space: Archard's law
//! with m = n = 1 on an elastic half-space, dw/dt = c p.
//!
//! There is no closed form. The continuous problem is solved here by expansion of the pressure in functions that the
//! half-space answers with themselves (growth.rs), twice, with 40 and 80 of them. The pressure starts at the edge with a
//! power that is no multiple of 1/2 and changes in time, so errors fall like the number of functions to a power between
//! -2.5 (tau = 0.1) and -2 (tau = 1e4). Both results together are extrapolated so that the worn volume, which is known,
//! comes out exactly.
//!
//! What is left, by comparison with 60 and 120 functions for tau = 0.1 .. 1e4 and relative to the largest value: 2e-6 in
//! the depth and the pressure at the centre and in the approach, 5e-6 in the radius, 1e-5 in the depth anywhere, 3e-5 in
//! the pressure up to 0.9 of the radius and 1e-3 beyond, where it starts; 2e-4 in the depth below tau = 1e-3.
//!
//! This file turns it into the user's units.

mod basis;
mod dense;
mod growth;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use super::answer::{Indenter, PointAnswer, QuantityError, not_negative};
use super::hertz::Hertz;
use growth::Growth;

/// Largest tau that is answered: by then the contact is 10 to 20 times as wide as at the start.
pub const LARGEST_TAU: f64 = 1e4;

/// How many pressures the two solutions have.
const ORDERS: [usize; 2] = [40, 80];

/// A scar at a time.
///
/// tau = c t P / V0 counts the worn volume in units of V0 = pi a0^4 / 4R (sphere) or 2 a0^3 / 3R (line), the volume of
/// the unworn body below its Hertz contact radius.
pub struct Scar {
    /// The contact before any wear.
    pub start: Hertz,
    /// Worn volume over V0.
    pub tau: f64,
    /// Radius or half-width of the contact.
    pub contact_radius: f64,
    /// Wear depth at the centre, the largest.
    pub central_wear_depth: f64,
    /// Contact pressure at the centre.
    pub central_pressure: f64,
    /// Worn volume c t P; area for a line.
    pub worn_volume: f64,
    solutions: [Growth; 2],
    /// How far beyond the finer solution the exact one lies, in differences of both.
    beyond: f64,
}

impl Scar {
    /// The scar of a body under a constant load, after the product of wear rate per pressure and time has reached
    /// `wear_per_pressure` (c t, or the integral of (K/H) v over time: only it matters; length per pressure).
    ///
    /// # Errors
    /// Numbers that are not above zero, or a tau beyond [`LARGEST_TAU`].
    pub fn new(
        indenter: Indenter,
        radius: f64,
        modulus: f64,
        load: f64,
        wear_per_pressure: f64,
    ) -> Result<Scar, QuantityError> {
        let start = Hertz::new(indenter, radius, modulus, load)?;
        let dose = not_negative("the wear per pressure", wear_per_pressure)?;
        Scar::after(start, worn_part(&start, dose))
    }

    /// The scar that grows from a contact until tau.
    ///
    /// # Errors
    /// A tau below zero or beyond [`LARGEST_TAU`].
    pub fn after(start: Hertz, tau: f64) -> Result<Scar, QuantityError> {
        Scar::with(ORDERS, start, tau)
    }

    fn with(orders: [usize; 2], start: Hertz, tau: f64) -> Result<Scar, QuantityError> {
        if !(0.0..=LARGEST_TAU).contains(&tau) {
            return Err(QuantityError { name: "tau, the worn volume over V0,", found: tau, expected: "0 to 1e4" });
        }
        let mut solutions = orders.map(|order| Growth::new(start.indenter, order));
        for solution in &mut solutions {
            if tau > 0.0 && !solution.advance(tau) {
                return Err(QuantityError { name: "tau, the worn volume over V0,", found: tau, expected: "less" });
            }
        }
        let beyond = beyond(solutions.each_ref().map(|solution| solution.volume_error(tau)));
        let worn_volume = tau * time_unit(&start) * start.load;
        let mut scar = Scar {
            contact_radius: 0.0,
            central_wear_depth: 0.0,
            central_pressure: 0.0,
            worn_volume,
            start,
            tau,
            solutions,
            beyond,
        };
        scar.contact_radius = scar.exact(|solution| solution.state[0]) * start.contact_radius;
        let center = scar.at(0.0);
        (scar.central_wear_depth, scar.central_pressure) = (center.wear_depth, center.pressure);
        Ok(scar)
    }

    /// Wear depth and contact pressure at a distance from the axis.
    #[must_use]
    pub fn at(&self, distance: f64) -> PointAnswer {
        let place = distance.abs() / self.start.contact_radius;
        if self.tau == 0.0 {
            return self.start.at(distance);
        }
        let [coarse, fine] = self.solutions.each_ref().map(|solution| solution.at(place));
        let [pressure, depth] = [0, 1].map(|i| (fine[i] + self.beyond * (fine[i] - coarse[i])).max(0.0));
        PointAnswer { wear_depth: depth * self.start.depth_unit(), pressure: pressure * self.start.largest_pressure }
    }

    /// Approach of the bodies; for a line with the displacement zero at the distance `datum` (see
    /// [`Hertz::approach`]), which is not read for a sphere.
    #[must_use]
    pub fn approach(&self, datum: f64) -> f64 {
        let own = self.exact(Growth::approach) * self.start.depth_unit();
        match self.start.indenter {
            // The mean pressure alone displaces the contact by (2 P / pi E*) ln(2 datum / a).
            Indenter::Line => {
                own + 2.0 * self.start.load / (PI * self.start.modulus) * (2.0 * datum / self.contact_radius).ln()
            }
            Indenter::Sphere => own,
        }
    }

    /// A value for ever more functions.
    fn exact(&self, value: impl Fn(&Growth) -> f64) -> f64 {
        let [coarse, fine] = self.solutions.each_ref().map(value);
        fine + self.beyond * (fine - coarse)
    }
}

/// tau, the worn volume over V0, after a product of wear rate per pressure and time; no unit.
#[must_use]
pub fn worn_part(start: &Hertz, wear_per_pressure: f64) -> f64 {
    wear_per_pressure / time_unit(start)
}

/// c t for which tau is one: V0 / P.
fn time_unit(start: &Hertz) -> f64 {
    let a = start.contact_radius;
    match start.indenter {
        Indenter::Line => 2.0 / 3.0 * a * a * (a / start.radius) / start.load,
        Indenter::Sphere => PI / 4.0 * a * a * a * (a / start.radius) / start.load,
    }
}

/// How far to go beyond the finer solution so that the errors of the worn volume cancel; where they are mere rounding, by
/// errors like N^-2.1.
fn beyond([coarse, fine]: [f64; 2]) -> f64 {
    let ratio = coarse / fine;
    1.0 / (if (3.5..7.0).contains(&ratio) { ratio } else { 4.3 } - 1.0)
}

/// The radius of an old scar in units of a0, from alpha^4 = tau + (64 / 9 pi^2) alpha (sphere) or alpha^3 = tau + 3/4 alpha
/// (line): the worn volume fills what lies below the contact radius, less the displacement under a uniform pressure.
/// Approximate; the error falls as tau grows.
///
/// # Errors
/// A tau below zero or not finite.
pub fn long_time_radius(indenter: Indenter, tau: f64) -> Result<f64, QuantityError> {
    let tau = not_negative("tau", tau)?;
    let (power, factor) = match indenter {
        Indenter::Line => (3, 0.75),
        Indenter::Sphere => (4, 64.0 / (9.0 * PI * PI)),
    };
    // Convex and increasing right of the root: Newton's steps go down to it.
    let mut alpha = 1.0 + tau.powf(1.0 / f64::from(power));
    loop {
        let value = alpha.powi(power) - tau - factor * alpha;
        let next = alpha - value / (f64::from(power) * alpha.powi(power - 1) - factor);
        if next >= alpha {
            return Ok(alpha);
        }
        alpha = next;
    }
}
