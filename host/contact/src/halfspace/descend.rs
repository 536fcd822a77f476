//! Preconditioned conjugate gradients on a set that stays.

use super::contact_set::ContactSet;
use super::passes::{add, change, each_chunk};
use super::patch::Patch;
use super::residual;
use super::stencil::Stencil;

/// How far above the error that is enough the residual may be on average for the error to be looked at.
pub const NEAR: f64 = 8.0;

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

/// The displacement over the whole window, to be kept that of the pressures while they change.
///
/// It is linear in them, so a search direction whose image is known everywhere costs no transform more.
pub struct Followed<'a> {
    /// Displacement `[cells]`.
    pub u: &'a mut [f64],
    /// Iterations for which it is worth that; with more of them one transform at the end is cheaper.
    pub most: u64,
    /// Whether it was kept.
    pub kept: bool,
}

/// The error of pressures with these gaps, those below zero counting as zero.
pub fn error(patch: &Patch<'_>, set: &ContactSet, pressure: &[f64], gap: &[f64]) -> f64 {
    let parts = each_chunk(patch.threads, pressure.len(), |range| {
        let mut lowest = f64::INFINITY;
        let (mut total, mut weighted) = (0.0, 0.0);
        for (at, (p, gap)) in range.clone().zip(pressure[range.clone()].iter().zip(&gap[range])) {
            let p = set.weight(at) * p.max(0.0);
            lowest = lowest.min(*gap);
            total += p;
            weighted += p * if patch.sum.is_some() { *gap } else { gap.abs() };
        }
        (lowest, total, weighted)
    });
    let (lowest, total, weighted) = parts.into_iter().fold((f64::INFINITY, 0.0, 0.0), |all: (f64, f64, f64), part| {
        (all.0.min(part.0), all.1 + part.1, all.2 + part.2)
    });
    let mean = if total > 0.0 { weighted / total } else { 0.0 };
    if patch.sum.is_some() { mean - lowest } else { mean + (-lowest).max(0.0) }
}

impl Descent {
    /// Norm of the residual, without its mean under a load.
    pub fn norm(&self, patch: &Patch<'_>, set: &ContactSet) -> f64 {
        let mean = match patch.sum {
            Some(_) => set.sum(patch.threads, |i| self.residual[i]) / set.size().max(1.0),
            None => 0.0,
        };
        set.sum(patch.threads, |i| (self.residual[i] - mean).powi(2)).sqrt()
    }

    /// One step straight down the gradient, as far as the energy falls.
    pub fn straight(&mut self, patch: &mut Patch<'_>, set: &ContactSet) {
        let (threads, count) = (patch.threads, set.len());
        let mut direction = self.residual.clone();
        if patch.sum.is_some() {
            let mean = set.sum(threads, |i| direction[i]) / set.size().max(1.0);
            change(threads, &mut direction, |_, value| value - mean);
        }
        let mut image = vec![0.0; count];
        patch.image(set, &direction, &mut image);
        self.iterations += 1;
        let step = set.dot(threads, &self.residual, &direction) / set.dot(threads, &direction, &image);
        if step > 0.0 && step.is_finite() {
            change(threads, &mut self.pressure, |i, p| p - step * direction[i]);
        }
    }

    /// Goes down to the goal; under a load the sum of the pressures stays. False: the operator is not positive there.
    ///
    /// A search direction that keeps the sum is the preconditioned residual less that multiple of the preconditioned
    /// unit displacement which has its sum.
    pub fn run(
        &mut self,
        patch: &mut Patch<'_>,
        set: &ContactSet,
        stencil: &mut Stencil,
        goal: &Goal,
        followed: &mut Followed<'_>,
    ) -> bool {
        if !patch.symmetric() {
            followed.kept = false;
            return residual::run(self, patch, set, stencil, goal);
        }
        let arrays = [(); 5].map(|()| patch.room.take(set.len()));
        let over = patch.room.take(if followed.kept { followed.u.len() } else { 0 });
        let mut room = Arrays { arrays, over };
        let positive = self.conjugate(patch, set, stencil, goal, followed, &mut room);
        room.arrays.into_iter().for_each(|array| patch.room.give(array));
        patch.room.give(room.over);
        positive
    }

    fn conjugate(
        &mut self,
        patch: &mut Patch<'_>,
        set: &ContactSet,
        stencil: &mut Stencil,
        goal: &Goal,
        followed: &mut Followed<'_>,
        room: &mut Arrays,
    ) -> bool {
        let Arrays { arrays: [direction, image, steep, unit, ones], over } = room;
        let (threads, count) = (patch.threads, set.len());
        let mut unit_sum = 0.0;
        if patch.sum.is_some() {
            if count < 2 {
                return true;
            }
            ones.fill(1.0);
            stencil.apply(patch, set, ones, unit);
            unit_sum = set.sum(threads, |i| unit[i]);
        }
        let own = stencil.own();
        let mut last = 0.0;
        for iteration in 0..goal.most {
            stencil.apply(patch, set, &self.residual, steep);
            if patch.sum.is_some() {
                let factor = set.sum(threads, |i| steep[i]) / unit_sum;
                add(threads, steep, -factor, unit);
            }
            let square = set.dot(threads, &self.residual, steep);
            if iteration == 0 {
                direction.copy_from_slice(steep);
            } else {
                let beta = square / last;
                change(threads, direction, |i, value| steep[i] + beta * value);
            }
            last = square;
            if square <= 0.0 {
                return iteration > 0 || square == 0.0;
            }
            followed.kept &= iteration < followed.most;
            if followed.kept {
                patch.image_over(set, direction, over);
                set.gather_into(threads, over, image);
            } else {
                patch.image(set, direction, image);
            }
            let curvature = set.dot(threads, direction, image);
            self.iterations += 1;
            if curvature.is_nan() || curvature <= 0.0 {
                followed.kept = false;
                return false;
            }
            let step = set.dot(threads, &self.residual, direction) / curvature;
            add(threads, &mut self.pressure, -step, direction);
            add(threads, &mut self.residual, -step, image);
            if followed.kept {
                add(threads, followed.u, -step, over);
            }
            let norm = self.norm(patch, set);
            if norm <= goal.norm {
                return true;
            }
            if goal.wrong.is_finite() {
                let below = set.sum(threads, |i| self.pressure[i].min(0.0).powi(2)).sqrt();
                // Where the residual is far above the goal on average, the error is not looked at.
                let near = norm <= NEAR * goal.error * set.size().sqrt();
                if norm <= goal.wrong * own * below
                    || near && error(patch, set, &self.pressure, &self.residual) <= goal.error
                {
                    return true;
                }
            }
        }
        true
    }
}

/// Room for a descent: arrays over the set, and one over the window.
struct Arrays {
    arrays: [Vec<f64>; 5],
    over: Vec<f64>,
}
