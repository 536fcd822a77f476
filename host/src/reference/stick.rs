//! The limit of wear with a stick zone: nothing slips within a radius s, everything beyond wears until it carries nothing.
//!
//! In the limit the pressure acts on r < s only, where the bodies keep their shape: the contact of the unworn profile over
//! a fixed radius, singular at its edge like that of a flat punch. Beyond, wear has just closed the gap that the free
//! surface would leave: w = approach - r^2/2R - u(r), up to the radius at which that is zero. The limit depends neither on
//! the wear law's constants nor on the path to it, only on what is held (load or approach).
//! Source: V. L. Popov, Analytic solution for the limiting shape of profiles due to fretting wear, Sci. Rep. 4 (2014) 3749,
//! for the principle and the sphere at a constant approach.
//!
//! Sphere (I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47, with g(t) = d - t^2/R on t < s):
//! p(r) = (E*/pi) {(d - s^2/R) (s^2 - r^2)^(-1/2) + (2/R) (s^2 - r^2)^(1/2)}, P = 2 E* (d s - s^3 / 3R),
//! u(r) = (2/pi) {(d - r^2/2R) asin(s/r) + (s/2R) (r^2 - s^2)^(1/2)}.
//!
//! Line (Chebyshev series; K. L. Johnson, Contact Mechanics, section 2.7), xi = x/s, c0 = P / pi s, c2 = -E* s / 4R:
//! p(x) = {c0 + c2 (2 xi^2 - 1)} (1 - xi^2)^(-1/2),
//! u(x) - u(s) = (2 s/E*) {-c0 acosh xi + (c2/2) ((xi - (xi^2 - 1)^(1/2))^2 - 1)}.

use std::f64::consts::PI;

use super::answer::{Indenter, PointAnswer, QuantityError, positive};
use super::hertz::Hertz;

/// The limit. Where the stick zone holds the whole Hertz contact nothing wears, and it is that contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickLimit {
    /// The contact before any wear, under the load of the limit.
    pub start: Hertz,
    /// Radius or half-width s without slip.
    pub stick_radius: f64,
    /// Load in the limit; per length for a line.
    pub load: f64,
    /// Radius or half-width within which the bodies touch.
    pub contact_radius: f64,
    /// Largest wear depth.
    pub largest_wear_depth: f64,
    /// Approach d of a sphere; for a line that of the edge of the stick zone, less its displacement: s^2 / 2R.
    approach: f64,
}

impl StickLimit {
    /// The limit under a constant load.
    ///
    /// # Errors
    /// Numbers that are not above zero.
    pub fn under_load(
        indenter: Indenter,
        radius: f64,
        modulus: f64,
        load: f64,
        stick_radius: f64,
    ) -> Result<StickLimit, QuantityError> {
        let start = Hertz::new(indenter, radius, modulus, load)?;
        let s = positive("the stick radius", stick_radius)?;
        let approach = match indenter {
            Indenter::Line => s / radius * s / 2.0,
            Indenter::Sphere if s < start.contact_radius => load / (2.0 * modulus * s) + s / radius * s / 3.0,
            Indenter::Sphere => start.approach(0.0),
        };
        Ok(StickLimit::new(start, s, approach))
    }

    /// The limit of a sphere at a constant approach.
    ///
    /// # Errors
    /// Numbers that are not above zero.
    pub fn sphere_at_approach(
        radius: f64,
        modulus: f64,
        approach: f64,
        stick_radius: f64,
    ) -> Result<StickLimit, QuantityError> {
        let start = Hertz::at_approach(radius, modulus, approach)?;
        let s = positive("the stick radius", stick_radius)?;
        if s >= start.contact_radius {
            return Ok(StickLimit::new(start, s, approach));
        }
        let load = 2.0 * modulus * s * (approach - s / radius * s / 3.0);
        Ok(StickLimit::new(Hertz::new(Indenter::Sphere, radius, modulus, load)?, s, approach))
    }

    /// The limit of a line at a constant approach, with the displacement zero at the distance `datum` (see
    /// [`Hertz::approach`]).
    ///
    /// # Errors
    /// Numbers that are not above zero, or an approach that the stick zone alone cannot reach with pressure on all of it.
    pub fn line_at_approach(
        radius: f64,
        modulus: f64,
        approach: f64,
        stick_radius: f64,
        datum: f64,
    ) -> Result<StickLimit, QuantityError> {
        let (radius, modulus) = (positive("the radius", radius)?, positive("the modulus", modulus)?);
        let s = positive("the stick radius", stick_radius)?;
        let logarithm = positive("ln(2 datum / stick radius)", (2.0 * positive("the datum", datum)? / s).ln())?;
        // approach = s^2 / 2R + u(s), u(s) = (2 s / E*) (c0 ln(2 datum / s) + c2 / 2).
        let displacement = positive("the approach", approach)? - s / radius * s / 2.0;
        let c2 = -modulus * s / (4.0 * radius);
        let c0 = (displacement * modulus / (2.0 * s) - c2 / 2.0) / logarithm;
        if c0 < -c2 {
            let expected = "so much that the pressure at the edge of the stick zone is above 0";
            return Err(QuantityError { name: "the approach", found: approach, expected });
        }
        StickLimit::under_load(Indenter::Line, radius, modulus, PI * s * c0, s)
    }

    fn new(start: Hertz, stick_radius: f64, approach: f64) -> StickLimit {
        let load = start.load;
        let contact_radius = start.contact_radius;
        let mut limit = StickLimit { start, stick_radius, load, contact_radius, largest_wear_depth: 0.0, approach };
        if stick_radius < start.contact_radius {
            limit.contact_radius = limit.end_of_wear();
            limit.largest_wear_depth = limit.deepest();
        }
        limit
    }

    /// Wear depth and contact pressure at a distance from the axis; the pressure at the stick radius itself is infinite.
    #[must_use]
    pub fn at(&self, distance: f64) -> PointAnswer {
        let r = distance.abs();
        if self.stick_radius >= self.start.contact_radius {
            return self.start.at(r);
        }
        if r <= self.stick_radius {
            return PointAnswer { wear_depth: 0.0, pressure: self.pressure(r) };
        }
        let wear_depth = if r < self.contact_radius { self.closed_gap(r).max(0.0) } else { 0.0 };
        PointAnswer { wear_depth, pressure: 0.0 }
    }

    fn pressure(&self, r: f64) -> f64 {
        let (s, radius, modulus) = (self.stick_radius, self.start.radius, self.start.modulus);
        let root = ((s - r) * (s + r)).sqrt();
        match self.start.indenter {
            Indenter::Sphere => modulus / PI * ((self.approach - s / radius * s) / root + 2.0 / radius * root),
            Indenter::Line => {
                let xi = r / s;
                let [c0, c2] = self.coefficients();
                (c0 + c2 * (2.0 * xi * xi - 1.0)) * s / root
            }
        }
    }

    /// c0 and c2 of a line.
    fn coefficients(&self) -> [f64; 2] {
        let s = self.stick_radius;
        [self.load / (PI * s), -self.start.modulus * s / (4.0 * self.start.radius)]
    }

    /// approach - r^2/2R - u(r): the depth that wear has closed, negative where a gap is left.
    fn closed_gap(&self, r: f64) -> f64 {
        let (s, radius) = (self.stick_radius, self.start.radius);
        let root = ((r - s) * (r + s)).sqrt();
        match self.start.indenter {
            Indenter::Sphere => {
                // 1 - (2/pi) asin(s/r) is (2/pi) acos(s/r), which keeps its digits near s.
                let free = self.approach - r / radius * r / 2.0;
                2.0 / PI * (free * root.atan2(s) - s / radius * root / 2.0)
            }
            Indenter::Line => {
                let [c0, c2] = self.coefficients();
                let (xi, root) = (r / s, root / s);
                let near = xi - root;
                let rise = 2.0 * s / self.start.modulus * (-c0 * (xi + root).ln() + c2 / 2.0 * (near * near - 1.0));
                -root * root * s / radius * s / 2.0 - rise
            }
        }
    }

    /// Where wear ends: beyond the deepest point the closed gap falls monotonically.
    fn end_of_wear(&self) -> f64 {
        let mut high = self.start.contact_radius;
        while self.closed_gap(high) > 0.0 {
            high *= 2.0;
        }
        let mut low = self.stick_radius;
        while low.midpoint(high) > low && low.midpoint(high) < high {
            let middle = low.midpoint(high);
            if self.closed_gap(middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    }

    /// The largest closed gap, by golden sections of its single rise and fall.
    fn deepest(&self) -> f64 {
        let part = (5.0_f64.sqrt() - 1.0) / 2.0;
        let (mut low, mut high) = (self.stick_radius, self.contact_radius);
        for _ in 0..80 {
            let (left, right) = (high - part * (high - low), low + part * (high - low));
            if self.closed_gap(left) < self.closed_gap(right) { low = left } else { high = right }
        }
        self.closed_gap(low.midpoint(high)).max(0.0)
    }
}

#[cfg(test)]
#[path = "stick_tests.rs"]
mod tests;
