//! Frictionless contact of a parabolic body with an elastic half-space.
//!
//! Source: K. L. Johnson, Contact Mechanics (1985), sections 4.2 (a) and 4.2 (c); E* is given by
//! 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

use std::f64::consts::PI;

use super::answer::{Indenter, PointAnswer, QuantityError, positive};

/// Hertz contact.
///
/// Sphere: a^3 = 3 P R / 4 E*, p0 = 3 P / 2 pi a^2 = 2 E* a / pi R, approach a^2 / R.
/// Line: a^2 = 4 P R / pi E*, p0 = 2 P / pi a = E* a / 2 R. Pressure p0 (1 - r^2/a^2)^(1/2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hertz {
    /// The body.
    pub indenter: Indenter,
    /// Its radius R.
    pub radius: f64,
    /// E*.
    pub modulus: f64,
    /// Load P; per length for a line.
    pub load: f64,
    /// Radius or half-width a of the contact.
    pub contact_radius: f64,
    /// Largest pressure p0.
    pub largest_pressure: f64,
}

impl Hertz {
    /// Contact under a load.
    ///
    /// # Errors
    /// Numbers that are not above zero.
    pub fn new(indenter: Indenter, radius: f64, modulus: f64, load: f64) -> Result<Hertz, QuantityError> {
        let (radius, modulus) = (positive("the radius", radius)?, positive("the modulus", modulus)?);
        // Roots of the factors one by one: their product may leave the range of doubles.
        let reduced = positive("the load", load)? / modulus;
        let contact_radius = match indenter {
            Indenter::Line => (4.0 * reduced / PI).sqrt() * radius.sqrt(),
            Indenter::Sphere => (0.75 * reduced).cbrt() * radius.cbrt(),
        };
        let slope = contact_radius / radius;
        let largest_pressure = match indenter {
            Indenter::Line => modulus * slope / 2.0,
            Indenter::Sphere => modulus * slope * 2.0 / PI,
        };
        Ok(Hertz { indenter, radius, modulus, load, contact_radius, largest_pressure })
    }

    /// Contact of a sphere at an approach.
    ///
    /// # Errors
    /// Numbers that are not above zero.
    pub fn at_approach(radius: f64, modulus: f64, approach: f64) -> Result<Hertz, QuantityError> {
        let (radius, modulus) = (positive("the radius", radius)?, positive("the modulus", modulus)?);
        let contact_radius = positive("the approach", approach)?.sqrt() * radius.sqrt();
        let load = 4.0 / 3.0 * modulus * contact_radius * approach;
        Hertz::new(Indenter::Sphere, radius, modulus, load)
    }

    /// Contact pressure at a distance from the axis.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        let part = distance / self.contact_radius;
        self.largest_pressure * (1.0 - part * part).max(0.0).sqrt()
    }

    /// No wear, and the pressure at a distance from the axis.
    #[must_use]
    pub fn at(&self, distance: f64) -> PointAnswer {
        PointAnswer { wear_depth: 0.0, pressure: self.pressure(distance) }
    }

    /// Approach of the bodies. That of a line depends on where the displacement is zero, which `datum`, a distance large
    /// against the contact, says: a^2/2R (ln(2 datum / a) + 1/2). The datum is not read for a sphere.
    #[must_use]
    pub fn approach(&self, datum: f64) -> f64 {
        let height = self.contact_radius * (self.contact_radius / self.radius);
        match self.indenter {
            Indenter::Line => height / 2.0 * ((2.0 * datum / self.contact_radius).ln() + 0.5),
            Indenter::Sphere => height,
        }
    }

    /// a p0 / E*, the unit of depth of scars.
    #[must_use]
    pub fn depth_unit(&self) -> f64 {
        self.contact_radius * (self.largest_pressure / self.modulus)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::quadrature::tanh_sinh;

    fn near(found: f64, expected: f64, tolerance: f64) {
        assert!((found / expected - 1.0).abs() <= tolerance, "{found:e}, expected {expected:e}");
    }

    #[test]
    fn a_sphere_of_five_millimetres() {
        let hertz = Hertz::new(Indenter::Sphere, 5e-3, 115e9, 10.0).unwrap();
        near(hertz.contact_radius, 6.88300062715e-5, 1e-11);
        near(hertz.largest_pressure, 1007826487.27, 1e-11);
        near(hertz.depth_unit(), 6.03206116862e-7, 1e-11);
        near(hertz.approach(f64::NAN), hertz.contact_radius.powi(2) / 5e-3, 1e-14);
        let again = Hertz::at_approach(5e-3, 115e9, hertz.approach(0.0)).unwrap();
        near(again.load, 10.0, 1e-13);
    }

    #[test]
    fn a_line_of_six_millimetres() {
        let hertz = Hertz::new(Indenter::Line, 6e-3, 109.89011e9, 18.5e3).unwrap();
        near(hertz.contact_radius, 3.58622261459e-5, 1e-9);
        near(hertz.largest_pressure, 328408664.339, 1e-9);
        near(hertz.depth_unit(), 1.07174938678e-7, 1e-9);
    }

    #[test]
    fn the_pressure_carries_the_load() {
        let line = Hertz::new(Indenter::Line, 2.0, 3.0, 0.5).unwrap();
        let integral = 2.0 * tanh_sinh(line.contact_radius, |x, _| line.at(x).pressure);
        near(integral, 0.5, 1e-13);
        let sphere = Hertz::new(Indenter::Sphere, 2.0, 3.0, 0.5).unwrap();
        near(tanh_sinh(sphere.contact_radius, |r, _| 2.0 * PI * r * sphere.pressure(r)), 0.5, 1e-13);
        assert_eq!(sphere.pressure(1.01 * sphere.contact_radius), 0.0);
        assert_eq!(sphere.at(0.0), PointAnswer { wear_depth: 0.0, pressure: sphere.largest_pressure });
    }

    #[test]
    fn the_approach_of_a_line_closes_its_gap_at_the_centre() {
        // Displacement at the centre by the logarithmic kernel, zero at the datum.
        let line = Hertz::new(Indenter::Line, 2.0, 3.0, 1e-3).unwrap();
        let (a, datum) = (line.contact_radius, 40.0);
        let kernel = |x: f64| 2.0 * 2.0 / (PI * 3.0) * line.pressure(x) * (datum / x).ln();
        near(line.approach(datum), tanh_sinh(a, |x, _| kernel(x)), 1e-12);
    }

    #[test]
    fn numbers_without_an_answer_are_refused_and_extreme_ones_are_not() {
        let error = Hertz::new(Indenter::Line, 1.0, 0.0, 1.0).unwrap_err();
        assert_eq!(error.to_string(), "the modulus is 0e0, expected a finite number above 0");
        assert!(Hertz::new(Indenter::Line, f64::NAN, 1.0, 1.0).is_err());
        assert!(Hertz::new(Indenter::Line, 1.0, 1.0, -1.0).is_err());
        let tiny = Hertz::new(Indenter::Sphere, 1e-12, 1e-30, 1e-55).unwrap();
        near(tiny.contact_radius, (0.75e-37_f64).cbrt(), 1e-14);
    }
}
