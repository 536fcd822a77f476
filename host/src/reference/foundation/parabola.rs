//! Parabolic bodies on an elastic foundation under Archard's law with m = n = 1, dw/dt = c p.
//!
//! Held at an approach the contact stays as it is: p = p0 exp(-k c t). Under a load over a fixed contact set the mean
//! pressure stays and differences decay: p = pm + (p0 - pm) exp(-k c t). Under a load that spreads the contact, the load
//! carried and the volume worn fill what lies below the contact radius, which gives the radius at any time:
//!
//! line:   P (1/k + c t) = 2 a^3 / 3R,     sphere: P (1/k + c t) = pi a^4 / 4R,     approach = a^2 / 2R.
//!
//! A cell at x is touched when a(t) = x; dp/dt = k (d approach/dt - c p) from then on. With dt = (a-dependent) da this is
//! p(x, t) = (k/R) int from max(x, a(0)) to a(t) of s exp(-B (a^n - s^n)) ds, plus, for x < a(0), its first pressure
//! k (a(0)^2 - x^2) / 2R times exp(-k c t); n = 3, B = 2 k / 3 P R (line) or n = 4, B = pi k / 4 P R (sphere). The depth is
//! what the spring leaves of the approach: w = (a^2 - x^2) / 2R - p / k.

use std::f64::consts::PI;

use super::super::answer::{Indenter, PointAnswer, QuantityError, not_negative, positive};
use super::super::quadrature::tanh_sinh;

/// p0 exp(-k c t): the pressure at a point whose approach is held.
#[must_use]
pub fn held_pressure(first_pressure: f64, stiffness: f64, wear_per_pressure: f64) -> f64 {
    first_pressure * (-stiffness * wear_per_pressure).exp()
}

/// pm + (p0 - pm) exp(-k c t): the pressure at a point of a contact set that stays the same under a load, its mean
/// pressure being pm.
#[must_use]
pub fn loaded_pressure(first_pressure: f64, mean_pressure: f64, stiffness: f64, wear_per_pressure: f64) -> f64 {
    mean_pressure + held_pressure(first_pressure - mean_pressure, stiffness, wear_per_pressure)
}

/// A parabolic body under a constant load, worn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WornParabola {
    indenter: Indenter,
    radius: f64,
    stiffness: f64,
    /// k c t.
    decay: f64,
    /// Contact radius or half-width before any wear.
    pub first_contact_radius: f64,
    /// Contact radius or half-width a.
    pub contact_radius: f64,
    /// Approach a^2 / 2R.
    pub approach: f64,
}

impl WornParabola {
    /// The body after the product c t of wear per pressure and time has reached `wear_per_pressure`; the load is per
    /// length for a line, the stiffness k is pressure per length.
    ///
    /// # Errors
    /// Numbers that are not above zero.
    pub fn new(
        indenter: Indenter,
        radius: f64,
        stiffness: f64,
        load: f64,
        wear_per_pressure: f64,
    ) -> Result<WornParabola, QuantityError> {
        let (radius, stiffness) = (positive("the radius", radius)?, positive("the stiffness", stiffness)?);
        let load = positive("the load", load)?;
        let dose = not_negative("the wear per pressure", wear_per_pressure)?;
        let contact_radius = |compliance: f64| match indenter {
            Indenter::Line => (1.5 * load * radius * compliance).cbrt(),
            Indenter::Sphere => (4.0 / PI * load * radius * compliance).sqrt().sqrt(),
        };
        let (first, now) = (contact_radius(1.0 / stiffness), contact_radius(1.0 / stiffness + dose));
        let approach = now / radius * now / 2.0;
        let decay = stiffness * dose;
        Ok(WornParabola {
            indenter,
            radius,
            stiffness,
            decay,
            first_contact_radius: first,
            contact_radius: now,
            approach,
        })
    }

    /// Wear depth and contact pressure at a distance from the axis.
    #[must_use]
    pub fn at(&self, distance: f64) -> PointAnswer {
        let (x, first, a) = (distance.abs(), self.first_contact_radius, self.contact_radius);
        if x >= a {
            return PointAnswer::default();
        }
        let from = x.max(first);
        let power = if self.indenter == Indenter::Line { 3 } else { 4 };
        // B a(0)^n = 1 by the definition of a(0), so B a^n = (a / a(0))^n; with s = a - y,
        // a^n - s^n = a^n (1 - (1 - y/a)^n) keeps its digits near y = 0.
        let scale = (a / first).powi(power);
        let integrand = |y: f64| {
            let left = -(f64::from(power) * (-y / a).ln_1p()).exp_m1();
            (a - y) / self.radius * (-scale * left).exp()
        };
        // All of it lies within a few decay lengths of y = 0 once the wear is long.
        let reach = 60.0 * a / (f64::from(power) * scale);
        let length = a - from;
        let near = length.min(reach);
        let mut pressed = tanh_sinh(near, |y, _| integrand(y));
        pressed += tanh_sinh(length - near, |y, _| integrand(near + y));
        if x < first {
            pressed += (first - x) * (first + x) / (2.0 * self.radius) * (-self.decay).exp();
        }
        let wear_depth = ((a - x) * (a + x) / (2.0 * self.radius) - pressed).max(0.0);
        PointAnswer { wear_depth, pressure: self.stiffness * pressed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64, tolerance: f64) {
        assert!((found / expected - 1.0).abs() <= tolerance, "{found:e}, expected {expected:e}");
    }

    fn line(time: f64) -> WornParabola {
        WornParabola::new(Indenter::Line, 10e-3, 1e13, 1000.0, 1e-14 * time).unwrap()
    }

    #[test]
    fn a_line_at_two_times() {
        let worn = line(10.0);
        near(worn.contact_radius, 1.442249570307e-4, 1e-12);
        near(worn.at(0.0).pressure, 4798179.34679, 1e-11);
        near(worn.at(0.5 * worn.contact_radius).pressure, 3841654.253772, 1e-11);
        near(worn.at(0.0).wear_depth, 5.60223976847e-7, 1e-11);
        let worn = line(100.0);
        near(worn.contact_radius, 2.54582168483e-4, 1e-11);
        near(worn.at(0.0).pressure, 2033213.357291, 1e-11);
        near(worn.at(0.0).wear_depth, 3.037282689746e-6, 1e-11);
        near(worn.approach, worn.contact_radius.powi(2) / 20e-3, 1e-14);
    }

    #[test]
    fn pressure_carries_the_load_and_wear_the_volume() {
        for indenter in [Indenter::Line, Indenter::Sphere] {
            for dose in [0.0, 1e-15, 1e-13, 1e-11] {
                let worn = WornParabola::new(indenter, 10e-3, 1e13, 1000.0, dose).unwrap();
                let (first, a) = (worn.first_contact_radius, worn.contact_radius);
                let around = |r: f64| if indenter == Indenter::Line { 2.0 } else { 2.0 * PI * r };
                let over = |of: fn(PointAnswer) -> f64| {
                    tanh_sinh(first, |r, _| around(r) * of(worn.at(r)))
                        + tanh_sinh(a - first, |r, _| around(first + r) * of(worn.at(first + r)))
                };
                near(over(|at| at.pressure), 1000.0, 1e-9);
                near(over(|at| at.wear_depth) + 1.0, dose * 1000.0 + 1.0, 1e-12);
                assert!(dose == 0.0 || (over(|at| at.wear_depth) / (dose * 1000.0) - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn wear_follows_the_pressure() {
        for indenter in [Indenter::Line, Indenter::Sphere] {
            let (dose, d) = (2e-13, 1e-18);
            let of = |dose| WornParabola::new(indenter, 10e-3, 1e13, 1000.0, dose).unwrap();
            for part in [0.0, 0.3, 0.9] {
                let x = part * of(dose).contact_radius;
                let rate = (of(dose + d).at(x).wear_depth - of(dose - d).at(x).wear_depth) / (2.0 * d);
                near(rate, of(dose).at(x).pressure, 1e-5);
            }
        }
        assert_eq!(line(10.0).at(1.5e-4), PointAnswer::default());
    }

    #[test]
    fn fixed_sets_decay_to_what_holds_them() {
        near(held_pressure(2.0, 1e13, 1e-13), 2.0 * (-1.0_f64).exp(), 1e-14);
        near(loaded_pressure(2.0, 1.5, 1e13, 1e-13), 1.5 + 0.5 * (-1.0_f64).exp(), 1e-14);
        near(loaded_pressure(2.0, 1.5, 1e13, 1.0), 1.5, 1e-14);
    }
}
