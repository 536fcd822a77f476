//! Decay of waves of wear on an elastic half-space in full contact, and what one step of each integrator makes of it.
//!
//! A periodic half-space answers the Fourier mode q of the pressure by u_q = 2 p_q / (E* |q|), in 2-D and in 3-D (K. L.
//! Johnson, Contact Mechanics, section 13.2). While all of it stays closed, u_q = -(g_q + w_q) for every q that is not
//! zero, and Archard's law dw/dt = c p makes dp_q/dt = -lambda p_q with lambda = c E* |q| / 2. The mean pressure wears evenly.

use std::f64::consts::TAU;

use super::answer::{PointAnswer, QuantityError, not_negative, positive};

/// Length of the wave vector of `waves` waves over the lengths `size`: 2 pi ((kx/Lx)^2 + (ky/Ly)^2)^(1/2).
#[must_use]
pub fn wave_number(waves: [f64; 2], size: [f64; 2]) -> f64 {
    TAU * (waves[0] / size[0]).hypot(waves[1] / size[1])
}

/// Rate of decay lambda = c E* |q| / 2 of a mode; per unit of the time in `rate`.
///
/// `rate` is c, the wear per pressure and time.
#[must_use]
pub fn decay_rate(rate: f64, modulus: f64, wave_number: f64) -> f64 {
    rate * modulus * wave_number / 2.0
}

/// A one-step integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// The exact solution, exp(-z).
    Exact,
    /// 1 - z.
    ExplicitEuler,
    /// 1 / (1 + z).
    ImplicitEuler,
    /// (1 - (1 - 2 gamma) z) / (1 + gamma z)^2 with gamma = 1 - 1/sqrt 2.
    Sdirk2,
    /// The same as SDIRK2: its stages 2 - sqrt 2 and 1 have the diagonal 1 - 1/sqrt 2 too.
    TrBdf2,
}

impl Step {
    /// What one step of length dt leaves of a mode that decays at lambda, z = lambda dt.
    ///
    /// Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.6, for SDIRK2; M. E.
    /// Hosea and L. F. Shampine, Appl. Numer. Math. 20 (1996) 21, for TR-BDF2.
    #[must_use]
    pub fn amplification(self, z: f64) -> f64 {
        match self {
            Step::Exact => (-z).exp(),
            Step::ExplicitEuler => 1.0 - z,
            Step::ImplicitEuler => 1.0 / (1.0 + z),
            Step::Sdirk2 | Step::TrBdf2 => {
                let gamma = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
                (1.0 - (1.0 - 2.0 * gamma) * z) / (1.0 + gamma * z).powi(2)
            }
        }
    }
}

/// A wavy surface that wears in full contact under a constant load.
///
/// The gap is A (1 - cos(2 pi kx x / Lx) cos(2 pi ky y / Ly)), x and y counted from a crest. With
/// C = cos .. cos .. : p = pm + (E* |q| A / 2) exp(-lambda t) C and w = c t pm + A (1 - exp(-lambda t)) C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WavyWear {
    waves: [f64; 2],
    size: [f64; 2],
    amplitude: f64,
    mean_pressure: f64,
    /// Pressure over the mean at a crest before any wear.
    pub first_crest: f64,
    /// lambda t.
    pub decay: f64,
    wear_per_pressure: f64,
}

impl WavyWear {
    /// The surface after the product c t of wear per pressure and time has reached `wear_per_pressure`. In 2-D the second
    /// number of waves is 0.
    ///
    /// # Errors
    /// Numbers below zero, no waves, or a mean pressure at which a trough is not closed: the answer is that of full
    /// contact.
    pub fn new(
        amplitude: f64,
        waves: [f64; 2],
        size: [f64; 2],
        modulus: f64,
        mean_pressure: f64,
        wear_per_pressure: f64,
    ) -> Result<WavyWear, QuantityError> {
        let amplitude = not_negative("the amplitude", amplitude)?;
        let modulus = positive("the modulus", modulus)?;
        for size in size {
            positive("the size", size)?;
        }
        let q = positive("the wave number", wave_number(waves, size))?;
        let first_crest = modulus * q * amplitude / 2.0;
        let mean_pressure = positive("the mean pressure", mean_pressure)?;
        if mean_pressure < first_crest {
            let expected = "at least E* q A / 2, which closes the troughs";
            return Err(QuantityError { name: "the mean pressure", found: mean_pressure, expected });
        }
        let wear_per_pressure = not_negative("the wear per pressure", wear_per_pressure)?;
        let decay = decay_rate(wear_per_pressure, modulus, q);
        Ok(WavyWear { waves, size, amplitude, mean_pressure, first_crest, decay, wear_per_pressure })
    }

    /// Wear depth and contact pressure at a point, counted from a crest.
    #[must_use]
    pub fn at(&self, point: [f64; 2]) -> PointAnswer {
        let cosine = |axis: usize| (TAU * self.waves[axis] * point[axis] / self.size[axis]).cos();
        let wave = cosine(0) * cosine(1);
        PointAnswer {
            wear_depth: self.wear_per_pressure * self.mean_pressure - self.amplitude * (-self.decay).exp_m1() * wave,
            pressure: self.mean_pressure + self.first_crest * (-self.decay).exp() * wave,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64, tolerance: f64) {
        assert!((found / expected - 1.0).abs() <= tolerance, "{found:e}, expected {expected:e}");
    }

    #[test]
    fn a_mode_of_one_millimetre_and_ten_steps_of_every_integrator() {
        let lambda = decay_rate(1e-14, 115e9, wave_number([1.0, 0.0], [1e-3, 1.0]));
        near(lambda, 3.612831551628, 1e-12);
        let after = |step: Step| step.amplification(lambda * 0.01).powi(10);
        near(after(Step::ExplicitEuler), 0.6921372491338, 1e-12);
        near(after(Step::ImplicitEuler), 0.7012366018413, 1e-12);
        near(after(Step::Sdirk2), 0.6967683404498, 1e-12);
        near(after(Step::TrBdf2), 0.6967683404498, 1e-12);
        near(after(Step::Exact), 0.6967816732032, 1e-12);
    }

    #[test]
    fn huge_steps_leave_nothing_with_stiffly_stable_integrators() {
        assert!(Step::TrBdf2.amplification(1e9).abs() < 1e-8 && Step::ImplicitEuler.amplification(1e9) < 1e-8);
        assert!(Step::ExplicitEuler.amplification(2.1) < -1.0);
        // Second order: the error of one step falls like z^3.
        let error = |z: f64| (Step::Sdirk2.amplification(z) - Step::Exact.amplification(z)).abs();
        near(error(0.02) / error(0.01), 8.0, 0.05);
    }

    #[test]
    fn a_wave_of_pressure_turns_into_a_wave_of_wear() {
        let (waves, size) = ([2.0, 1.0], [1e-3, 2e-3]);
        let worn = |dose: f64| WavyWear::new(1e-8, waves, size, 115e9, 9e6, dose).unwrap();
        let q = wave_number(waves, size);
        near(q, TAU * (2e3_f64.powi(2) + 0.5e3_f64.powi(2)).sqrt(), 1e-14);
        let fresh = worn(0.0);
        assert_eq!(fresh.at([0.0, 0.0]).wear_depth, 0.0);
        near(fresh.at([0.0, 0.0]).pressure, 9e6 + 115e9 * q * 1e-8 / 2.0, 1e-14);
        near(fresh.at([0.25e-3, 0.0]).pressure, 9e6 - 115e9 * q * 1e-8 / 2.0, 1e-12);
        // dw/dt = c p, and the closed gap: u_q = -(g_q + w_q).
        let (dose, d) = (1e-16, 1e-20);
        for point in [[0.0, 0.0], [0.1e-3, 0.3e-3]] {
            let rate = (worn(dose + d).at(point).wear_depth - worn(dose - d).at(point).wear_depth) / (2.0 * d);
            near(rate, worn(dose).at(point).pressure, 1e-6);
            let wave = worn(dose).at(point).pressure - 9e6;
            let gap = 1e-8 * (1.0 - (TAU * 2.0 * point[0] / 1e-3).cos() * (TAU * point[1] / 2e-3).cos());
            let even = gap + worn(dose).at(point).wear_depth + 2.0 * wave / (115e9 * q);
            near(even, 1e-8 + dose * 9e6, 1e-12);
        }
        let open = WavyWear::new(1e-8, waves, size, 115e9, 7e6, 0.0).unwrap_err().to_string();
        assert!(open.starts_with("the mean pressure is 7e6, expected at least E* q A / 2"), "{open}");
        assert!(WavyWear::new(1e-8, [0.0, 0.0], size, 115e9, 7e6, 0.0).is_err());
    }
}
