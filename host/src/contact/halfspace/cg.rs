//! Conjugate gradients for pressures that must not be negative.

use super::Boundary;
use super::convolve::{Convolution, Dense};
use super::local::smoothed;
use super::scaled::Scaled;
use crate::contact::Cells;

/// Iterations after which a solve is given up.
const MOST_ITERATIONS: u64 = 4000;
/// Iterations without a better state after which it is given up.
const PATIENCE: u64 = 300;

/// The operator A + b of a problem.
pub struct Operator<'a> {
    pub cells: &'a Cells,
    pub boundary: Boundary,
    pub convolution: &'a mut Convolution,
    /// E0 / E*, E0 being the power of two that stiffnesses are counted in.
    pub problem: &'a Scaled,
    pub smoothed: bool,
    pub pairs: u64,
    work: Vec<f64>,
}

impl<'a> Operator<'a> {
    pub fn new(
        cells: &'a Cells,
        boundary: Boundary,
        convolution: &'a mut Convolution,
        problem: &'a Scaled,
        smoothed: bool,
    ) -> Self {
        let work = vec![0.0; if smoothed { cells.count() } else { 0 }];
        Operator { cells, boundary, convolution, problem, smoothed, pairs: 0, work }
    }

    /// out = (A + b) p.
    fn apply(&mut self, pressure: &[f64], out: &mut [f64]) {
        self.convolution.apply(&Dense { width: self.cells.counts[0], input: pressure }, out);
        self.pairs += 1;
        if self.problem.local.is_empty() {
            return;
        }
        let acting = if self.smoothed {
            smoothed(self.cells, self.boundary, pressure, &mut self.work);
            &self.work[..]
        } else {
            pressure
        };
        for (cell, out) in out.iter_mut().enumerate() {
            *out += self.problem.local(cell) * acting[cell];
        }
    }
}

/// How a solve ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Approach beyond the datum of the problem.
    pub approach: f64,
    pub iterations: u64,
    /// The error, over the problem's scale if it has one.
    pub error: f64,
    pub converged: bool,
}

/// Sum in chunks whose bounds do not depend on the number of threads.
fn sum(count: usize, of: impl Fn(usize) -> f64) -> f64 {
    (0..count).step_by(4096).map(|from| (from..count.min(from + 4096)).map(&of).sum::<f64>()).sum()
}

/// Finds the contact and its pressures (Polonsky and Keer, Wear 231, 1999), with one pair of transforms while the
/// contact stays, since the displacement is linear along the direction of search, and two when it changes.
pub fn constrained(operator: &mut Operator<'_>, pressure: &mut [f64]) -> Outcome {
    let problem = operator.problem;
    let count = pressure.len();
    let can = |cell: usize| problem.gap[cell] < f64::INFINITY;
    start(problem, pressure);
    let mut set: Vec<bool> = pressure.iter().map(|p| *p > 0.0).collect();
    let (mut u, mut direction, mut image) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    operator.apply(pressure, &mut u);
    let (mut last, mut restart) = (0.0, true);
    let mut best = (f64::INFINITY, Vec::new(), 0.0, 0);
    let mut iterations = 0;
    loop {
        let touching = (0..count).filter(|cell| set[*cell]).count();
        let total = sum(count, |cell| pressure[cell]);
        let gap = |cell: usize, u: &[f64]| problem.gap[cell] + u[cell];
        let approach = match problem.sum {
            Some(_) if touching == 0 => 0.0,
            Some(_) => sum(count, |cell| if set[cell] { gap(cell, &u) } else { 0.0 }) / touching as f64,
            None => 0.0,
        };
        let lowest = (0..count).map(|cell| gap(cell, &u)).fold(f64::INFINITY, f64::min);
        let largest = (0..count).filter(|c| set[*c]).map(|c| u[c].abs()).fold(0.0, f64::max);
        let scale = if problem.scale > 0.0 { problem.scale } else { largest };
        let weighted = |from: f64| {
            let all = sum(count, |c| if set[c] { pressure[c] * (gap(c, &u) - from).abs() } else { 0.0 });
            if total > 0.0 { all / total } else { 0.0 }
        };
        let (error, answer) = match problem.sum {
            Some(_) => (weighted(lowest), sum(count, |c| if set[c] { pressure[c] * gap(c, &u) } else { 0.0 }) / total),
            None => (weighted(0.0) + (-lowest).max(0.0), 0.0),
        };
        let bar =
            problem.bar.max(if problem.scale > 0.0 { 0.0 } else { 1e-10 * scale }).max(4.0 * f64::EPSILON * largest);
        let over = if scale > 0.0 { scale } else { 1.0 };
        if error <= bar {
            return Outcome { approach: answer, iterations, error: error / over, converged: true };
        }
        if error < best.0 {
            best = (error, pressure.to_vec(), answer, iterations);
        }
        if iterations >= MOST_ITERATIONS || iterations > best.3 + PATIENCE || !error.is_finite() {
            if !best.1.is_empty() {
                pressure.copy_from_slice(&best.1);
            }
            return Outcome { approach: best.2, iterations, error: best.0 / over, converged: false };
        }
        iterations += 1;
        let residual = |cell: usize, u: &[f64]| problem.gap[cell] + u[cell] - approach;
        // Cells that overlap join the search, from no pressure.
        let mut added = false;
        for cell in (0..count).filter(|cell| can(*cell)) {
            if !set[cell] && residual(cell, &u) < 0.0 {
                (set[cell], added) = (true, true);
            }
        }
        let touching = (0..count).filter(|cell| set[*cell]).count();
        let mean = match problem.sum {
            Some(_) => sum(count, |cell| if set[cell] { residual(cell, &u) } else { 0.0 }) / touching.max(1) as f64,
            None => 0.0,
        };
        let square = sum(count, |cell| if set[cell] { (residual(cell, &u) - mean).powi(2) } else { 0.0 });
        let beta = if restart || added || last == 0.0 { 0.0 } else { square / last };
        last = square;
        for cell in 0..count {
            direction[cell] = if set[cell] { residual(cell, &u) - mean + beta * direction[cell] } else { 0.0 };
        }
        operator.apply(&direction, &mut image);
        let curvature = sum(count, |cell| direction[cell] * image[cell]);
        let slope = sum(count, |cell| if set[cell] { residual(cell, &u) * direction[cell] } else { 0.0 });
        let step = if curvature > 0.0 { slope / curvature } else { 0.0 };
        let mut clipped = false;
        for cell in (0..count).filter(|cell| set[*cell]) {
            let value = pressure[cell] - step * direction[cell];
            clipped |= value < 0.0;
            pressure[cell] = value.max(0.0);
        }
        // A restart after every cell that leaves would forget too much.
        restart = false;
        if clipped || added {
            set.iter_mut().zip(pressure.iter()).for_each(|(set, p)| *set = *p > 0.0);
        }
        let mut factor = 1.0;
        if let Some(wanted) = problem.sum {
            let total = sum(count, |cell| pressure[cell]);
            if total > 0.0 {
                factor = wanted / total;
                pressure.iter_mut().for_each(|p| *p *= factor);
            } else {
                start(problem, pressure);
                set.iter_mut().zip(pressure.iter()).for_each(|(set, p)| *set = *p > 0.0);
                (clipped, restart) = (true, true);
            }
        }
        if clipped || added || iterations.is_multiple_of(50) {
            operator.apply(pressure, &mut u);
        } else {
            u.iter_mut().zip(&image).for_each(|(u, image)| *u = (*u - step * image) * factor);
        }
    }
}

/// Makes a start possible: no pressure below zero or where nothing can touch, and the sum that is given.
fn start(problem: &Scaled, pressure: &mut [f64]) {
    for (p, gap) in pressure.iter_mut().zip(&problem.gap) {
        if !(p.is_finite() && *p > 0.0 && gap.is_finite()) {
            *p = 0.0;
        }
    }
    let Some(wanted) = problem.sum else { return };
    let total = sum(pressure.len(), |cell| pressure[cell]);
    if total > 0.0 && (wanted / total).is_finite() {
        pressure.iter_mut().for_each(|p| *p *= wanted / total);
    } else {
        let touching = problem.gap.iter().filter(|gap| gap.is_finite()).count();
        for (p, gap) in pressure.iter_mut().zip(&problem.gap) {
            *p = if gap.is_finite() { wanted / touching as f64 } else { 0.0 };
        }
    }
}

/// Pressures of either sign that close the gap on a set.
pub fn frozen(operator: &mut Operator<'_>, set: &[bool], tolerance: f64, pressure: &mut [f64]) -> Outcome {
    let problem = operator.problem;
    let count = pressure.len();
    let on = |cell: usize| set[cell];
    let touching = (0..count).filter(|cell| on(*cell)).count();
    let mean = |of: &dyn Fn(usize) -> f64| sum(count, |c| if on(c) { of(c) } else { 0.0 }) / touching.max(1) as f64;
    for cell in 0..count {
        if !on(cell) || !pressure[cell].is_finite() {
            pressure[cell] = 0.0;
        }
    }
    if let Some(wanted) = problem.sum {
        let lacking = wanted / touching.max(1) as f64 - mean(&|c| pressure[c]);
        (0..count).filter(|c| on(*c)).for_each(|c| pressure[c] += lacking);
    }
    let (mut u, mut direction, mut image) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
    let mut last = 0.0;
    let mut best = (f64::INFINITY, Vec::new(), 0.0, 0);
    let mut iterations = 0;
    let held = problem.sum.is_none();
    let norm = |of: &dyn Fn(usize) -> f64| sum(count, |c| if on(c) { of(c) * of(c) } else { 0.0 }).sqrt();
    let own = if held { 0.0 } else { mean(&|c| problem.gap[c]) };
    let mut reference = norm(&|c| problem.gap[c] - own);
    operator.apply(pressure, &mut u);
    loop {
        let approach = if held { 0.0 } else { mean(&|c| problem.gap[c] + u[c]) };
        let residual = |c: usize, u: &[f64]| problem.gap[c] + u[c] - approach;
        let square = sum(count, |c| if on(c) { residual(c, &u).powi(2) } else { 0.0 });
        if iterations == 0 && !held {
            reference = reference.max(norm(&|c| u[c] - mean(&|c| u[c])));
        }
        let error = if reference > 0.0 { square.sqrt() / reference } else { 0.0 };
        let done = error <= tolerance.max(4.0 * f64::EPSILON);
        if done {
            return Outcome { approach, iterations, error, converged: true };
        }
        if error < best.0 {
            best = (error, pressure.to_vec(), approach, iterations);
        }
        if iterations >= MOST_ITERATIONS || iterations > best.3 + PATIENCE || !error.is_finite() {
            if !best.1.is_empty() {
                pressure.copy_from_slice(&best.1);
            }
            return Outcome { approach: best.2, iterations, error: best.0, converged: false };
        }
        iterations += 1;
        let beta = if last == 0.0 { 0.0 } else { square / last };
        last = square;
        for c in (0..count).filter(|c| on(*c)) {
            direction[c] = residual(c, &u) + beta * direction[c];
        }
        operator.apply(&direction, &mut image);
        let curvature = sum(count, |c| direction[c] * image[c]);
        let slope = sum(count, |c| if on(c) { residual(c, &u) * direction[c] } else { 0.0 });
        let step = if curvature > 0.0 { slope / curvature } else { 0.0 };
        for c in (0..count).filter(|c| on(*c)) {
            pressure[c] -= step * direction[c];
        }
        if iterations.is_multiple_of(50) {
            operator.apply(pressure, &mut u);
            last = 0.0;
        } else {
            u.iter_mut().zip(&image).for_each(|(u, image)| *u -= step * image);
        }
    }
}
