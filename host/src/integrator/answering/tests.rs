use super::{Answering, Formula, Span, Stages, Tried};
use crate::integrator::Reply;

/// Decoupled decays w' = rate (limit - w), one for each cell.
struct Decay {
    rates: Vec<f64>,
}

impl Answering for Decay {
    type Error = std::convert::Infallible;

    fn explicit(&mut self, _: f64, wear: &[f64], rate: &mut [f64]) -> Result<Reply, Self::Error> {
        for ((rate, wear), l) in rate.iter_mut().zip(wear).zip(&self.rates) {
            *rate = l * (1.0 - wear);
        }
        Ok(Reply::Good)
    }

    fn implicit(&mut self, _: f64, weight: f64, base: &[f64], rate: &mut [f64]) -> Result<Reply, Self::Error> {
        for ((rate, base), l) in rate.iter_mut().zip(base).zip(&self.rates) {
            *rate = l * (1.0 - base) / (1.0 + weight * l);
        }
        Ok(Reply::Good)
    }
}

/// What is left to wear after time 1 in `steps` steps.
fn decayed(formula: Formula, rate: f64, steps: usize) -> f64 {
    let mut contact = Decay { rates: vec![rate] };
    let mut stages = Stages::new(1);
    let (mut wear, mut end) = (vec![0.0], vec![0.0]);
    contact.explicit(0.0, &wear, &mut stages.start).unwrap();
    for k in 0..steps {
        let length = 1.0 / steps as f64;
        let span = Span { start: k as f64 * length, length, scale: 1.0 };
        assert_eq!(stages.step(&mut contact, formula, span, &wear, &mut end).unwrap(), Tried::Taken);
        std::mem::swap(&mut wear, &mut end);
        let Stages { start, end, .. } = &mut stages;
        std::mem::swap(start, end);
    }
    1.0 - wear[0]
}

/// Amplification of one step of length z in units of 1/rate.
fn growth(formula: Formula, z: f64) -> f64 {
    // Both second-order methods are L-stable with two stages of the same diagonal d, which leaves one such function.
    let second = |d: f64| (1.0 - (1.0 - 2.0 * d) * z) / ((1.0 + d * z) * (1.0 + d * z));
    match formula {
        Formula::ExplicitEuler => 1.0 - z,
        Formula::ImplicitEuler => 1.0 / (1.0 + z),
        Formula::TrBdf2 | Formula::Sdirk2 => second(1.0 - std::f64::consts::FRAC_1_SQRT_2),
    }
}

#[test]
fn every_formula_is_its_own_rational_function() {
    for formula in [Formula::ExplicitEuler, Formula::ImplicitEuler, Formula::TrBdf2, Formula::Sdirk2] {
        for z in [0.01, 0.3612831551628, 1.7, 30.0] {
            let left = decayed(formula, z, 1);
            let exact = growth(formula, z);
            assert!((left - exact).abs() < 1e-13 * (1.0 + z), "{formula:?} at {z}: {left} {exact}");
        }
    }
}

#[test]
fn a_mode_of_a_half_space_decays_by_the_published_factors() {
    // E* = 115e9, c = 1e-14, wavelength 1 mm: 3.612831551628 /s; 0.1 s in ten steps.
    let rate = 0.3612831551628;
    for (formula, left) in [
        (Formula::ExplicitEuler, 0.6921372491338),
        (Formula::ImplicitEuler, 0.7012366018413),
        (Formula::TrBdf2, 0.6967683404498),
        (Formula::Sdirk2, 0.6967683404498),
    ] {
        let found = decayed(formula, rate, 10);
        assert!((found - left).abs() < 1e-12, "{formula:?}: {found}");
    }
}

#[test]
fn errors_fall_with_the_order_of_the_formula() {
    for formula in [Formula::ExplicitEuler, Formula::ImplicitEuler, Formula::TrBdf2, Formula::Sdirk2] {
        let exact = (-2.0_f64).exp();
        let error = |steps| decayed(formula, 2.0, steps) - exact;
        let order = (error(64) / error(128)).abs().log2();
        assert!((order - f64::from(formula.order())).abs() < 0.05, "{formula:?}: order {order}");
    }
}

#[test]
fn scale_stretches_time() {
    let mut contact = Decay { rates: vec![3.0, 0.5] };
    for formula in [Formula::ExplicitEuler, Formula::ImplicitEuler, Formula::TrBdf2, Formula::Sdirk2] {
        let mut ends = Vec::new();
        for (length, scale) in [(0.1, 4.0), (0.4, 1.0)] {
            let mut stages = Stages::new(2);
            contact.explicit(0.0, &[0.1, 0.2], &mut stages.start).unwrap();
            let mut end = vec![0.0; 2];
            let span = Span { start: 0.0, length, scale };
            stages.step(&mut contact, formula, span, &[0.1, 0.2], &mut end).unwrap();
            ends.push(end);
        }
        assert_eq!(ends[0], ends[1], "{formula:?}");
    }
}
