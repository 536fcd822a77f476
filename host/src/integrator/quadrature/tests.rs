//! Integrals that are known, by every kind of quadrature.

use std::convert::Infallible;

use super::*;

struct Given<F: Fn(f64) -> f64> {
    rate: F,
    longest: f64,
}

impl<F: Fn(f64) -> f64> Rate for Given<F> {
    type Error = Infallible;
    fn points(&self) -> usize {
        4
    }
    fn increments(&mut self, at: f64, dt: f64, out: &mut [f64]) -> Result<Reply, Infallible> {
        if dt > self.longest {
            return Ok(Reply::Cut(self.longest / dt));
        }
        for (i, value) in out.iter_mut().enumerate() {
            *value = (i as f64 + 1.0) * dt * (self.rate)(at);
        }
        Ok(Reply::Good)
    }
}

fn integrate(quadrature: Quadrature, rate: impl Fn(f64) -> f64, longest: f64) -> (f64, Tally) {
    let mut wear = vec![1.0; 4];
    let span = Span { start: 5.0, length: 2.0, smallest: 0.0, most: u64::MAX };
    let tally = quadrature
        .integrate(&mut Given { rate, longest }, span, &mut Room::default(), &mut wear)
        .expect("the integral exists");
    for (i, w) in wear.iter().enumerate() {
        let part = (w - 1.0) / (i as f64 + 1.0);
        assert!((part - (wear[0] - 1.0)).abs() < 1e-12, "points differ: {wear:?}");
    }
    (wear[0] - 1.0, tally)
}

#[test]
fn adaptive_integrals_meet_their_tolerance_and_estimate_their_error() {
    let bend = |x: f64| (x - 0.3).abs().sqrt() + (8.0 * x).sin();
    let exact = 2.0 * ((0.3_f64.powf(1.5) + 0.7_f64.powf(1.5)) / 1.5 + (1.0 - 8.0_f64.cos()) / 8.0);
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let (sum, tally) = integrate(Quadrature::Adaptive(tolerance), bend, 10.0);
        let error = (sum - exact).abs();
        assert!(error <= tolerance * exact, "{error:e} at {tolerance:e}");
        // The estimate is an L2 norm over points 1, 2, 3, 4: sqrt 30 of the first.
        assert!(error * 30.0_f64.sqrt() <= tally.error, "{error:e} {tally:?}");
    }
}

#[test]
fn smooth_rates_take_one_panel() {
    let (sum, tally) = integrate(Quadrature::Adaptive(1e-11), |x| x.exp(), 10.0);
    assert!((sum - 2.0 * (1.0_f64.exp() - 1.0)).abs() < 1e-13);
    assert_eq!((tally.accepted, tally.rejected), (1, 0));
}

#[test]
fn one_evaluation_is_exact_for_a_linear_rate() {
    let (sum, tally) = integrate(Quadrature::Exact, |x| 3.0 - x, 10.0);
    assert_eq!((sum, tally.law_calls, tally.points_evaluated, tally.error), (5.0, 1, 4, 0.0));
}

#[test]
fn named_rules_have_their_orders() {
    let exact = 2.0 * (1.0_f64.exp() - 1.0);
    let orders =
        [(&Rule::EXPLICIT_EULER, 1.0), (&Rule::IMPLICIT_EULER, 1.0), (&Rule::TR_BDF2, 2.0), (&Rule::SDIRK2, 2.0)];
    for (rule, order) in orders {
        let at = |n: u32| {
            let parts = (0..n).map(|k| {
                let rate = |x: f64| ((f64::from(k) + x) / f64::from(n)).exp();
                integrate(Quadrature::FixedRule(rule), rate, 10.0).0 / f64::from(n)
            });
            (parts.sum::<f64>() - exact).abs()
        };
        let seen = (at(32) / at(64)).log2();
        assert!((seen - order).abs() < 0.05, "{rule:?}: order {seen}");
    }
}

#[test]
fn a_named_rule_can_be_held_to_a_tolerance() {
    let exact = 2.0 * (1.0_f64.exp() - 1.0);
    let (sum, tally) = integrate(Quadrature::AdaptiveRule(&Rule::IMPLICIT_EULER, 1e-3), |x| x.exp(), 10.0);
    assert!((sum - exact).abs() < 1e-3 * exact && tally.accepted > 100, "{tally:?}");
}

#[test]
fn a_wish_for_a_shorter_substep_is_honoured_or_refused() {
    let (sum, tally) = integrate(Quadrature::Adaptive(1e-6), |_| 1.0, 0.15);
    assert!((sum - 2.0).abs() < 1e-14 && tally.longest <= 0.15 && tally.rejected >= 1, "{tally:?}");
    let span = Span { start: 0.0, length: 2.0, smallest: 0.5, most: u64::MAX };
    let mut rate = Given { rate: |_| 1.0, longest: 0.15 };
    let error = Quadrature::Fixed.integrate(&mut rate, span, &mut Room::default(), &mut [0.0; 4]);
    assert!(matches!(error, Err(AdvanceError::SmallestStep { .. })));
}

#[test]
fn a_rate_that_no_rule_resolves_is_an_error() {
    let mixed = |x: f64| (x.to_bits() ^ (x.to_bits() >> 29)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let noise = |x: f64| if mixed(x) >> 63 == 0 { 1.0 } else { -1.0 };
    let mut rate = Given { rate: noise, longest: 10.0 };
    let span = Span { start: 0.0, length: 1.0, smallest: 0.0, most: u64::MAX };
    let error = Quadrature::Adaptive(1e-9).integrate(&mut rate, span, &mut Room::default(), &mut [0.0; 4]);
    assert!(matches!(error, Err(AdvanceError::Tolerance { .. })), "{error:?}");
}

/// Neither end of t^0.3 has a relative error that falls with the length of the panel there.
#[test]
fn rates_that_start_or_end_like_a_power_of_time_meet_their_tolerance() {
    for tolerance in [1e-3, 1e-8, 1e-12] {
        for power in [0.3, 1.6] {
            let (start, first) = integrate(Quadrature::Adaptive(tolerance), |x| x.powf(power), 10.0);
            let (end, last) = integrate(Quadrature::Adaptive(tolerance), |x| (1.0 - x).powf(power), 10.0);
            let exact = 2.0 / (power + 1.0);
            for (sum, tally) in [(start, first), (end, last)] {
                let error = (sum / exact - 1.0).abs();
                assert!(error < tolerance && tally.error < tolerance * exact * 30.0_f64.sqrt(), "{error:e} {tally:?}");
                assert!(tally.accepted < 80, "{tally:?}");
            }
        }
    }
}

#[test]
fn noise_that_vanishes_in_the_wear_so_far_is_no_error() {
    // A rate like a difference of large numbers close to a zero crossing, after wear of its usual size.
    let mixed = |x: f64| (x.to_bits() ^ (x.to_bits() >> 29)).wrapping_mul(0x9E37_79B9_7F4A_7C15) as i64;
    let rate = |x: f64| 1e-11 * x + 1e-16 * (mixed(x) as f64 / i64::MAX as f64);
    let quadrature = Quadrature::Adaptive(1e-13);
    let span = Span { start: 0.0, length: 1.0, smallest: 0.0, most: u64::MAX };
    let mut noisy = Given { rate, longest: 10.0 };
    let fresh = quadrature.integrate(&mut noisy, span, &mut Room::default(), &mut [0.0; 4]);
    assert!(matches!(fresh, Err(AdvanceError::Tolerance { .. })), "{fresh:?}");
    let mut wear = [1.0; 4];
    let tally =
        quadrature.integrate(&mut noisy, span, &mut Room::default(), &mut wear).expect("the noise is invisible");
    assert!((wear[3] - 1.0 - 4.0 * 5e-12).abs() < 1e-15 && tally.error < 1e-14, "{wear:?} {tally:?}");
}
