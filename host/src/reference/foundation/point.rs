//! One spring at a constant approach, under dw/dt = c p^m.
//!
//! p = k (d - w) gives dp/dt = -k c p^m, so p^(1-m) = p0^(1-m) - (1-m) k c t for m != 1 and p = p0 exp(-k c t) for m = 1.
//! For m < 1 the pressure is gone after a finite time, p0^(1-m) / ((1-m) k c), and the spring is worn to its approach.

use super::super::answer::{PointAnswer, QuantityError, not_negative, positive};

/// A worn spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringPoint {
    stiffness: f64,
    first_pressure: f64,
    rate: f64,
    exponent: f64,
}

impl SpringPoint {
    /// A spring of stiffness k (pressure per length) that starts with the pressure p0 and wears at c p^m.
    ///
    /// # Errors
    /// A stiffness or pressure that is not above zero; a rate or exponent below zero.
    pub fn new(stiffness: f64, first_pressure: f64, rate: f64, exponent: f64) -> Result<SpringPoint, QuantityError> {
        Ok(SpringPoint {
            stiffness: positive("the stiffness", stiffness)?,
            first_pressure: positive("the first pressure", first_pressure)?,
            rate: not_negative("the wear rate", rate)?,
            exponent: not_negative("the pressure exponent", exponent)?,
        })
    }

    /// k c p0^(m-1) t, the time in units of that in which the first rate would wear the whole approach.
    fn scaled(&self, time: f64) -> f64 {
        if self.rate == 0.0 || time == 0.0 {
            return 0.0;
        }
        // By logarithms: p0^(m-1) alone may leave the range of doubles.
        let power = (self.exponent - 1.0) * self.first_pressure.ln();
        (self.stiffness.ln() + self.rate.ln() + time.ln() + power).exp()
    }

    /// Pressure over the first one.
    fn part(&self, time: f64) -> f64 {
        let (z, open) = (self.scaled(time), 1.0 - self.exponent);
        if open == 0.0 {
            return (-z).exp();
        }
        // (1 - (1-m) z)^(1/(1-m)), in a form that is smooth in m at 1.
        if open * z >= 1.0 { 0.0 } else { ((-open * z).ln_1p() / open).exp() }
    }

    /// Wear depth and pressure at a time.
    ///
    /// # Errors
    /// A time below zero.
    pub fn at(&self, time: f64) -> Result<PointAnswer, QuantityError> {
        let part = self.part(not_negative("the time", time)?);
        let approach = self.first_pressure / self.stiffness;
        Ok(PointAnswer { wear_depth: approach * (1.0 - part), pressure: self.first_pressure * part })
    }

    /// When the pressure is gone; `None` for m >= 1, where it never is, and without wear.
    #[must_use]
    pub fn extinction(&self) -> Option<f64> {
        let ends = self.exponent < 1.0 && self.rate > 0.0;
        ends.then(|| 1.0 / ((1.0 - self.exponent) * self.scaled(1.0)))
    }

    /// The pressure after one backward-Euler step: the root of p + k c dt p^m = p0.
    ///
    /// # Errors
    /// A time below zero.
    pub fn implicit_step(&self, time: f64) -> Result<f64, QuantityError> {
        let z = self.scaled(not_negative("the time", time)?);
        // x + z x^m with x = p / p0 rises from 0 at x = 0; halving ends at neighbouring doubles. For m = 0 it starts at z.
        let value = |x: f64| x + z * x.powf(self.exponent) - 1.0;
        let (mut low, mut high) = (0.0, 1.0);
        while f64::midpoint(low, high) > low && f64::midpoint(low, high) < high {
            let middle = f64::midpoint(low, high);
            if value(middle) > 0.0 { high = middle } else { low = middle }
        }
        let root = if self.exponent == 0.0 { (1.0 - z).max(0.0) } else { low };
        Ok(self.first_pressure * root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spring(rate: f64, exponent: f64) -> SpringPoint {
        SpringPoint::new(1e12, 1e8, rate, exponent).unwrap()
    }

    fn near(found: f64, expected: f64, tolerance: f64) {
        assert!((found / expected - 1.0).abs() <= tolerance, "{found:e}, expected {expected:e}");
    }

    #[test]
    fn pressures_for_three_exponents() {
        near(spring(1e-21, 2.0).at(100.0).unwrap().pressure, 9090909.09090909, 1e-13);
        near(spring(1e-18, 1.5).at(100.0).unwrap().pressure, 44444444.4444444, 1e-13);
        let short = spring(1e-9, 0.5);
        near(short.at(10.0).unwrap().pressure, 2.5e7, 1e-13);
        near(short.extinction().unwrap(), 20.0, 1e-13);
        assert_eq!(short.at(20.5).unwrap(), PointAnswer { wear_depth: 1e-4, pressure: 0.0 });
        near(spring(1e-14, 1.0).at(100.0).unwrap().pressure, 1e8 * (-1.0_f64).exp(), 1e-13);
        assert_eq!(spring(1e-14, 1.0).extinction(), None);
    }

    #[test]
    fn one_implicit_step() {
        near(spring(1e-21, 2.0).implicit_step(1e3).unwrap(), 9512492.19725039, 1e-14);
        near(spring(1e-14, 1.0).implicit_step(100.0).unwrap(), 5e7, 1e-14);
        let p = spring(1e-9, 0.5).implicit_step(10.0).unwrap();
        near(p + 1e12 * 1e-9 * 10.0 * p.sqrt(), 1e8, 1e-14);
        near(spring(1e-6, 0.0).implicit_step(10.0).unwrap(), 9e7, 1e-12);
    }

    #[test]
    fn wear_and_spring_share_the_approach() {
        for exponent in [0.0, 0.5, 0.999_999_999, 1.0, 1.000_000_001, 3.0] {
            let at = spring(1e-9 / 1e4_f64.powf(2.0 * exponent - 1.0), exponent).at(4.0).unwrap();
            near(at.wear_depth + at.pressure / 1e12, 1e-4, 1e-13);
            assert!(at.pressure > 0.0 && at.wear_depth > 0.0, "{exponent}");
        }
        // No jump where the formula changes.
        let of = |exponent: f64| spring(1e-14, exponent).at(50.0).unwrap().pressure;
        near(of(1.0 + 1e-12), of(1.0), 1e-10);
        near(of(1.0 - 1e-12), of(1.0), 1e-10);
    }

    #[test]
    fn intermediate_results_stay_in_range() {
        let spring = SpringPoint::new(1e-3, 1e9, 1e-300, 34.0).unwrap();
        near(spring.at(1e6).unwrap().pressure, 1e9 * 34.0_f64.powf(-1.0 / 33.0), 1e-12);
        assert_eq!(spring.at(0.0).unwrap().wear_depth, 0.0);
        assert!(spring.at(-1.0).is_err() && SpringPoint::new(1.0, 0.0, 1.0, 1.0).is_err());
    }
}
