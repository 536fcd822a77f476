//! Increments averaged over the contact area (C5 = 10, 11): all cells in contact wear alike.
//!
//! Worn alike, a contact would lose the cells at its edge, whose gap closes more slowly than that; they would open, wait,
//! close and open again. In time such cells touch without pressure and wear just as fast as their gap is closed (Filippov,
//! Differential Equations with Discontinuous Righthand Sides, 1988). An implicit step can give that answer: in contact a cell
//! wears by x, an open one by what it would overlap without, at most x; together they wear what the law gives to the contact.

use super::segment::Driven;
use super::system::System;
use crate::contact::{Control, Diagonal};
use crate::integrator::Reply;
use crate::solve::PointError;

/// Most contact solves for one averaged increment.
const MOST_SOLVES: usize = 100;
/// Solves after which every other one halves the bracket.
const PATIENCE: usize = 10;

impl System<'_> {
    /// Replaces rates by their mean over the cells in contact at the start of the substep, all cells being equally large.
    pub(super) fn average(&self, rate: &mut [f64]) {
        if self.closed.is_empty() {
            rate.fill(0.0);
            return;
        }
        let mean = self.closed.iter().map(|cell| rate[*cell as usize]).sum::<f64>() / self.closed.len() as f64;
        rate.fill(0.0);
        self.closed.iter().for_each(|cell| rate[*cell as usize] = mean);
    }

    /// The averaged rate at `base + weight * rate`.
    ///
    /// Wear that is alike everywhere changes no pressure under a load: one solve of the contact, and one call of the law, give
    /// what is worn together, and x follows from it. Under an approach the pressure falls with x: the x that gives itself is
    /// bracketed by 0 and by what the unworn surface gives, and found by regula falsi with halved ends (Dowell and Jarratt,
    /// BIT 11, 1971), by halving where that is slow.
    pub(super) fn averaged(
        &mut self,
        driven: Driven,
        weight: f64,
        base: &[f64],
        rate: &mut [f64],
    ) -> Result<Reply, PointError> {
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let (mut at_low, mut at_high) = (0.0, 0.0);
        let mut x = 0.0;
        let mut side = 0;
        for attempt in 0..MOST_SOLVES {
            self.open_gap(base);
            // Wear by x everywhere is an approach that is less by it.
            let control = match driven.control {
                Control::Approach(approach) => Control::Approach(approach - x),
                load @ Control::Load(_) => load,
            };
            self.solve(control, Diagonal::Zero, false, self.solved.contact_tolerance)?;
            let solved = self.solution.approach;
            if let cut @ Reply::Cut(_) = self.own_rate(driven, rate)? {
                return Ok(cut);
            }
            let touching = self.pressure.iter().filter(|pressure| **pressure > 0.0).count();
            let together =
                weight * self.pressure.iter().zip(&*rate).filter(|(p, _)| **p > 0.0).map(|(_, r)| r).sum::<f64>();
            self.measure_openings(base, solved);
            if let Control::Load(_) = driven.control {
                let x = self.shared(touching, together);
                self.wear_alike(x, weight, rate);
                self.solution.approach = solved + x;
                return Ok(Reply::Good);
            }
            self.solution.approach = solved + x;
            let beside: f64 = self.room.displaced.iter().filter(|gap| **gap < x).map(|gap| x - gap.max(0.0)).sum();
            let excess = if touching > 0 { (together - beside) / touching as f64 - x } else { -x };
            // To the accuracy of the contact solve, which is that of a length.
            let near = self.solved.contact_tolerance * self.gap_scale;
            // The mean may fall so steeply, near the end of the contact, that no x gives itself any better.
            if excess.abs() <= near.max(self.solved.contact_tolerance * x)
                || excess.abs() <= 1e-14 * x
                || high - low <= near
            {
                self.wear_alike(x, weight, rate);
                return Ok(Reply::Good);
            }
            if excess > 0.0 {
                (low, at_low) = (x, excess);
                if side == 1 {
                    at_high *= 0.5;
                }
                side = 1;
            } else {
                (high, at_high) = (x, excess);
                if side == -1 {
                    at_low *= 0.5;
                }
                side = -1;
            }
            x = match (high.is_infinite(), attempt >= PATIENCE && attempt % 2 == 0) {
                (true, _) => x + excess,
                (false, true) => low.midpoint(high),
                (false, false) => (low * at_high - high * at_low) / (at_high - at_low),
            };
        }
        Err(PointError::Newton {
            iterations: MOST_SOLVES,
            residual: at_low.abs().min(at_high.abs()) / self.gap_scale,
            tolerance: self.solved.contact_tolerance,
        })
    }

    /// Writes into `room.displaced` how far cells are open that carry no pressure, infinity where there is one.
    fn measure_openings(&mut self, base: &[f64], approach: f64) {
        let mut open = std::mem::take(&mut self.room.displaced);
        open.resize(self.pressure.len(), 0.0);
        self.model.displacement(&self.pressure, &mut open);
        for (cell, open) in open.iter_mut().enumerate() {
            let gap = self.initial_gap[cell] + base[cell] + *open - approach;
            *open = if self.pressure[cell] > 0.0 { f64::INFINITY } else { gap };
        }
        self.room.displaced = open;
    }

    /// The x with `touching` x + sum max(0, x - opening) = `together`.
    fn shared(&self, touching: usize, together: f64) -> f64 {
        if touching == 0 {
            return 0.0;
        }
        let most = together / touching as f64;
        let mut near: Vec<f64> =
            self.room.displaced.iter().filter(|open| **open < most).map(|open| open.max(0.0)).collect();
        near.sort_by(f64::total_cmp);
        let (mut count, mut sum) = (touching as f64, together);
        for open in near {
            if sum <= open * count {
                break;
            }
            (count, sum) = (count + 1.0, sum + open);
        }
        sum / count
    }

    /// The rate of cells in contact that wear by x over a stage, and of those beside it that touch.
    fn wear_alike(&self, x: f64, weight: f64, rate: &mut [f64]) {
        for ((rate, pressure), open) in rate.iter_mut().zip(&self.pressure).zip(&self.room.displaced) {
            let worn = if *pressure > 0.0 { x } else { (x - open.max(0.0)).max(0.0) };
            *rate = if worn > 0.0 { worn / weight } else { 0.0 };
        }
    }
}
