//! Growth of a scar in time: collocation over the contact, Radau steps in time.
//!
//! In units of a0, p0 and a0 p0 / E* the pressure is p = sum c_n B_n(eta) / eta on a contact of radius a (see [`Basis`]),
//! so the worn depth that closes the gap is W = delta - g a^2 (1 - eta^2) - a sum lambda_n c_n B_n, and W = 0 at the edge
//! gives delta. Wear at a fixed place, dW/dtau = kappa p, becomes at a fixed eta
//!
//! 2 g a a' - a' sum f_n c_n - a sum e_n c_n' = kappa p,  e_n = lambda_n (B_n - B_n(0)),  f_n = e_n + lambda_n D_n,
//!
//! D_n = 2 (1 - y) dB_n/dy. Pressure that starts from zero at the edge, sum c_n B_n(0) = 0, is the last equation; c_0
//! carries the load. The unknowns are a and c_1 .. c_N.
//!
//! Time: Radau IIA with three stages (order 5; E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 1996,
//! section IV.5), for the equations are algebraic in part and stiff.

use std::f64::consts::PI;

use super::super::answer::Indenter;
use super::basis::Basis;
use super::dense::Factors;

/// A contact with its pressure.
pub(super) struct Growth {
    pub basis: Basis,
    points: Vec<Collocation>,
    /// a, then c_1 .. c_N.
    pub state: Vec<f64>,
}

struct Collocation {
    /// 1 / eta.
    steep: f64,
    /// B_n / eta.
    pressure: Vec<f64>,
    /// e_n.
    depth: Vec<f64>,
    /// f_n.
    moving: Vec<f64>,
}

const STAGES: usize = 3;
const ROOT: f64 = 2.449_489_742_783_178;
const WEIGHTS: [[f64; STAGES]; STAGES] = [
    [(88.0 - 7.0 * ROOT) / 360.0, (296.0 - 169.0 * ROOT) / 1800.0, (-2.0 + 3.0 * ROOT) / 225.0],
    [(296.0 + 169.0 * ROOT) / 1800.0, (88.0 + 7.0 * ROOT) / 360.0, (-2.0 - 3.0 * ROOT) / 225.0],
    [(16.0 - ROOT) / 36.0, (16.0 + ROOT) / 36.0, 1.0 / 9.0],
];
/// First step, and how much longer each is than the one before; the pressure changes over ever longer times.
const FIRST_STEP: f64 = 1e-4;
const STEP_GROWTH: f64 = 1.35;

impl Growth {
    /// Hertz contact, with N = `order` unknown coefficients.
    pub fn new(indenter: Indenter, order: usize) -> Growth {
        let basis = Basis::new(indenter, order);
        let points = basis.angles().map(|angle| {
            let values = basis.at(angle);
            let steep = 1.0 / angle.cos();
            let parts = || basis.lambda.iter().zip(values.value.iter().zip(&basis.edge));
            let depth: Vec<f64> = parts().map(|(lambda, (value, edge))| lambda * (value - edge)).collect();
            let drift = basis.lambda.iter().zip(&values.drift).map(|(lambda, drift)| lambda * drift);
            let moving = depth.iter().zip(drift).map(|(depth, drift)| depth + drift).collect();
            Collocation { steep, pressure: values.value.iter().map(|value| value * steep).collect(), depth, moving }
        });
        let points = points.collect();
        // p = eta is B_0 / 2 + B_1 / 2 for a line and B_0 / 3 + 2 B_1 / 3 for a sphere, over eta.
        let mut state = vec![0.0; order + 1];
        (state[0], state[1]) = (1.0, if indenter == Indenter::Line { 0.5 } else { 2.0 / 3.0 });
        Growth { basis, points, state }
    }

    /// Lets it wear for `tau`; whether every step converged.
    pub fn advance(&mut self, tau: f64) -> bool {
        let (mut now, mut step) = (0.0, FIRST_STEP.min(tau / 8.0));
        let mut rate = vec![0.0; self.state.len()];
        while now < tau {
            let left = tau - now;
            let taken = if left < 1.3 * step { left } else { step };
            if !self.step(taken, &mut rate) {
                return false;
            }
            now = if taken == left { tau } else { now + taken };
            step *= STEP_GROWTH;
        }
        true
    }

    /// One Radau step; `rate` is that at its start as a first guess, and at its end on return.
    fn step(&mut self, step: f64, rate: &mut [f64]) -> bool {
        let n = self.state.len();
        let mut rates = [rate.to_vec(), rate.to_vec(), rate.to_vec()];
        let mut factors: Option<Factors> = None;
        let mut before = f64::INFINITY;
        for _ in 0..40 {
            let stages = [0, 1, 2].map(|i| self.stage(step, &WEIGHTS[i], &rates));
            if factors.is_none() {
                factors = Factors::new(self.jacobian(step, &stages, &rates), STAGES * n);
            }
            let mut change: Vec<f64> = Vec::with_capacity(STAGES * n);
            for (stage, rate) in stages.iter().zip(&rates) {
                self.residual(stage, rate, &mut change);
            }
            let Some(solver) = &factors else { return false };
            solver.solve(&mut change);
            for (rate, change) in rates.iter_mut().flatten().zip(&change) {
                *rate -= change;
            }
            let size = step * change.iter().fold(0.0, |most: f64, change| most.max(change.abs()));
            if size < 1e-12 {
                self.state = self.stage(step, &WEIGHTS[STAGES - 1], &rates);
                rate.copy_from_slice(&rates[STAGES - 1]);
                return true;
            }
            // The matrix is kept while it serves.
            if size > 0.1 * before {
                factors = None;
            }
            before = size;
        }
        false
    }

    fn stage(&self, step: f64, weights: &[f64; STAGES], rates: &[Vec<f64>; STAGES]) -> Vec<f64> {
        let moved = |i: usize| (0..STAGES).map(|j| weights[j] * rates[j][i]).sum::<f64>();
        self.state.iter().enumerate().map(|(i, value)| value + step * moved(i)).collect()
    }

    /// The edge's equation, then one for each point.
    fn residual(&self, state: &[f64], rate: &[f64], out: &mut Vec<f64>) {
        let (a, a_rate) = (state[0], rate[0]);
        let (mean, kappa, g) = (self.basis.mean(a)[0], self.basis.rate(), self.basis.curvature());
        out.push(mean + sum(&self.basis.edge, &state[1..]));
        out.extend(self.points.iter().map(|point| {
            let pressure = mean * point.steep + sum(&point.pressure, &state[1..]);
            a_rate * (2.0 * g * a - sum(&point.moving, &state[1..]))
                - a * sum(&point.depth, &rate[1..])
                - kappa * pressure
        }));
    }

    /// Derivative of all residuals by all rates, row by row: a block by state times step times weight, plus one by rate.
    fn jacobian(&self, step: f64, stages: &[Vec<f64>; STAGES], rates: &[Vec<f64>; STAGES]) -> Vec<f64> {
        let n = self.state.len();
        let (kappa, g) = (self.basis.rate(), self.basis.curvature());
        let mut rows = Vec::with_capacity(STAGES * n * STAGES * n);
        let (mut by_state, mut by_rate) = (vec![0.0; n], vec![0.0; n]);
        for (i, (state, rate)) in stages.iter().zip(rates).enumerate() {
            let (a, a_rate) = (state[0], rate[0]);
            let mean_slope = self.basis.mean(a)[1];
            for row in 0..n {
                if row == 0 {
                    by_state[0] = mean_slope;
                    by_state[1..].copy_from_slice(&self.basis.edge[1..]);
                    by_rate.fill(0.0);
                } else {
                    let point = &self.points[row - 1];
                    by_state[0] = 2.0 * g * a_rate - sum(&point.depth, &rate[1..]) - kappa * mean_slope * point.steep;
                    by_rate[0] = 2.0 * g * a - sum(&point.moving, &state[1..]);
                    for k in 1..n {
                        by_state[k] = -a_rate * point.moving[k] - kappa * point.pressure[k];
                        by_rate[k] = -a * point.depth[k];
                    }
                }
                for (j, weight) in WEIGHTS[i].iter().enumerate() {
                    let own = if i == j { 1.0 } else { 0.0 };
                    let entries = by_state.iter().zip(&by_rate);
                    rows.extend(entries.map(|(state, rate)| step * weight * state + own * rate));
                }
            }
        }
        rows
    }

    /// Pressure and worn depth at a distance from the axis, in units of p0 and a0 p0 / E*.
    pub fn at(&self, distance: f64) -> [f64; 2] {
        let a = self.state[0];
        let part = distance / a;
        if part.is_nan() || part >= 1.0 {
            return [0.0; 2];
        }
        let angle = part.asin();
        let values = self.basis.at(angle);
        let mean = self.basis.mean(a)[0];
        let pressure = (mean + sum(&values.value, &self.state[1..])) / angle.cos();
        [pressure, self.basis.curvature() * (a * a - distance * distance) - a * self.bulge(&values.value)]
    }

    /// Worn volume over that of a rate kappa p; it differs from one by the error of the truncated sum.
    pub fn volume_error(&self, tau: f64) -> f64 {
        let (a, basis) = (self.state[0], &self.basis);
        let whole = basis.moment[0];
        let terms = basis.lambda.iter().zip(basis.moment.iter().zip(&basis.edge)).skip(1).zip(&self.state[1..]);
        let bulge: f64 = terms.map(|((lambda, (moment, edge)), c)| lambda * c * (moment - edge * whole)).sum();
        let (around, unworn) = match basis.indenter {
            Indenter::Line => (2.0 * a, 2.0 / 3.0),
            Indenter::Sphere => (2.0 * PI * a * a, 0.25),
        };
        around * (unworn * basis.curvature() * a * a - a * bulge) / (basis.rate() * basis.load() * tau) - 1.0
    }

    /// Approach, for a line without what the mean pressure and the datum add.
    pub fn approach(&self) -> f64 {
        let a = self.state[0];
        let at_edge = self.bulge(&vec![0.0; self.state.len()]);
        self.basis.curvature() * a * a - a * at_edge + a * self.basis.lambda[0] * self.basis.mean(a)[0]
    }

    /// sum lambda_n c_n (values_n - B_n(0)) over n > 0.
    fn bulge(&self, values: &[f64]) -> f64 {
        let terms = values.iter().zip(&self.basis.edge).zip(&self.basis.lambda).skip(1).zip(&self.state[1..]);
        terms.map(|(((value, edge), lambda), c)| lambda * c * (value - edge)).sum()
    }
}

/// Sum over n > 0 of values_n c_n; `values` starts at n = 0 and `c` at n = 1.
fn sum(values: &[f64], c: &[f64]) -> f64 {
    values[1..].iter().zip(c).map(|(value, c)| value * c).sum()
}
