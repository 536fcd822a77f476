//! Preconditioned conjugate gradients on a set that stays.

use super::contact_set::ContactSet;
use super::passes::{change, dot, sum};
use super::patch::Patch;
use super::residual;
use super::stencil::Stencil;

/// When a descent has done enough.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// Norm of the residual.
    pub norm: f64,
    /// Complementarity error.
    pub error: f64,
    /// The norm of the pressures below zero, as displacements, beyond this times that of the residual says that the set is
    /// wrong and need not be finished; infinity: either sign is right.
    pub wrong: f64,
    /// Iterations.
    pub most: u64,
}

/// Pressures on a set and what is left of their gap.
pub struct Descent {
    /// Pressures on the set.
    pub pressure: Vec<f64>,
    /// Gap less the approach on the set; under a load its mean means nothing.
    pub residual: Vec<f64>,
    /// Iterations so far.
    pub iterations: u64,
}

/// The error of pressures with these gaps, those below zero counting as zero.
pub fn error(patch: &Patch<'_>, pressure: &[f64], gap: &[f64]) -> f64 {
    let mut lowest = f64::INFINITY;
    let (mut total, mut weighted) = (0.0, 0.0);
    for (p, gap) in pressure.iter().zip(gap) {
        let p = p.max(0.0);
        lowest = lowest.min(*gap);
        total += p;
        weighted += p * if patch.sum.is_some() { *gap } else { gap.abs() };
    }
    let mean = if total > 0.0 { weighted / total } else { 0.0 };
    if patch.sum.is_some() { mean - lowest } else { mean + (-lowest).max(0.0) }
}

impl Descent {
    /// Norm of the residual, without its mean under a load.
    pub fn norm(&self, patch: &Patch<'_>) -> f64 {
        let (threads, count) = (patch.threads, self.residual.len());
        let mean = match patch.sum {
            Some(_) => sum(threads, count, |i| self.residual[i]) / count.max(1) as f64,
            None => 0.0,
        };
        sum(threads, count, |i| (self.residual[i] - mean).powi(2)).sqrt()
    }

    /// Goes down to the goal; under a load the sum of the pressures stays. False: the operator is not positive there.
    ///
    /// A search direction that keeps the sum is the preconditioned residual less that multiple of the preconditioned
    /// unit displacement which has its sum.
    pub fn run(&mut self, patch: &mut Patch<'_>, set: &ContactSet, stencil: &mut Stencil, goal: &Goal) -> bool {
        if !patch.symmetric() {
            return residual::run(self, patch, set, stencil, goal);
        }
        let (threads, count) = (patch.threads, set.len());
        let mut unit = Vec::new();
        let mut unit_sum = 0.0;
        if patch.sum.is_some() {
            if count < 2 {
                return true;
            }
            unit = vec![0.0; count];
            stencil.apply(patch, &vec![1.0; count], &mut unit);
            unit_sum = sum(threads, count, |i| unit[i]);
        }
        let own = 1.0 / stencil.diagonal();
        let (mut direction, mut image, mut steep) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        let mut last = 0.0;
        for iteration in 0..goal.most {
            stencil.apply(patch, &self.residual, &mut steep);
            if patch.sum.is_some() {
                let factor = sum(threads, count, |i| steep[i]) / unit_sum;
                change(threads, &mut steep, |i, value| value - factor * unit[i]);
            }
            let square = dot(threads, &self.residual, &steep);
            let beta = if iteration == 0 { 0.0 } else { square / last };
            last = square;
            change(threads, &mut direction, |i, value| steep[i] + beta * value);
            if square <= 0.0 {
                return iteration > 0 || square == 0.0;
            }
            patch.image(set, &direction, &mut image);
            let curvature = dot(threads, &direction, &image);
            self.iterations += 1;
            if curvature.is_nan() || curvature <= 0.0 {
                return false;
            }
            let step = dot(threads, &self.residual, &direction) / curvature;
            change(threads, &mut self.pressure, |i, p| p - step * direction[i]);
            change(threads, &mut self.residual, |i, r| r - step * image[i]);
            let norm = self.norm(patch);
            if norm <= goal.norm {
                return true;
            }
            if goal.wrong.is_finite() {
                let below = sum(threads, count, |i| self.pressure[i].min(0.0).powi(2)).sqrt();
                if norm <= goal.wrong * own * below || error(patch, &self.pressure, &self.residual) <= goal.error {
                    return true;
                }
            }
        }
        true
    }
}
