//! Increments averaged over the contact area (C5 = 10, 11): the cells in contact at the start of the substep wear alike.

use super::segment::Driven;
use super::system::System;
use crate::contact::Diagonal;
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
    /// The mean increment x that the law gives on the surface worn by x falls with x (more wear, less pressure), so the
    /// x that gives itself is bracketed by 0 and by what the unworn surface gives; it is found by regula falsi with
    /// halved ends (Dowell and Jarratt, BIT 11, 1971), and by halving where that is slow.
    pub(super) fn averaged(
        &mut self,
        driven: Driven,
        weight: f64,
        base: &[f64],
        rate: &mut [f64],
    ) -> Result<Reply, PointError> {
        if self.closed.is_empty() {
            self.open_gap(base);
            self.solve(driven.control, Diagonal::Zero, false, self.solved.contact_tolerance)?;
            rate.fill(0.0);
            return Ok(Reply::Good);
        }
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let (mut at_low, mut at_high) = (0.0, 0.0);
        let mut x = 0.0;
        let mut side = 0;
        for attempt in 0..MOST_SOLVES {
            self.open_gap(base);
            for cell in &self.closed {
                self.room.gap[*cell as usize] += x;
            }
            self.solve(driven.control, Diagonal::Zero, false, self.solved.contact_tolerance)?;
            if let cut @ Reply::Cut(_) = self.rate(driven, rate)? {
                return Ok(cut);
            }
            let mean = weight * rate[self.closed[0] as usize];
            let excess = mean - x;
            // To the accuracy of the contact solve, which is that of a length.
            if excess.abs() <= self.solved.contact_tolerance * self.gap_scale.max(x) || excess.abs() <= 1e-14 * x {
                return Ok(Reply::Good);
            }
            if high - low <= self.solved.contact_tolerance * self.gap_scale {
                // The mean may fall so steeply, near the end of the contact, that no x gives itself any better.
                self.closed.iter().for_each(|cell| rate[*cell as usize] = x / weight);
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
                (true, _) => mean,
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
}
