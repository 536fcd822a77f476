//! Implicit stages of laws that are proportional to the pressure: one contact problem with the operator A + b.

use super::segment::Driven;
use super::system::System;
use crate::contact::Diagonal;
use crate::integrator::Reply;
use crate::law::{Field, OutputItem};
use crate::solve::PointError;

/// Rings of cells around the contact at which the law is asked for its coefficient too, so that a contact that grows
/// within a step seldom needs a second solve.
const RINGS: usize = 2;
/// Relative difference from proportionality that rounding inside a law may make.
const ROUNDING: f64 = 1e-6;
/// Solves of one stage, while the contact grows beyond the cells that were asked, before all cells are.
const SOLVES: u32 = 4;

/// Fields that may differ from cell to cell of a contact whose cells all slide alike.
const LOCAL: [Field; 5] = [Field::Coordinates, Field::Gap, Field::PointId, Field::AccumulatedWear, Field::ContactState];

impl System<'_> {
    /// Whether the law's coefficient is the same at every cell.
    fn is_uniform(&self) -> bool {
        let law = self.evaluator.descriptor();
        self.slides.is_empty()
            && self.distance.is_empty()
            && law.state.is_empty()
            && !law.writes(OutputItem::Direction)
            && LOCAL.iter().all(|field| !self.plan.fields.contains(*field))
    }

    /// The rate at `base + weight * rate`, from one solve with b = weight * rate / pressure.
    pub(super) fn proportional(
        &mut self,
        driven: Driven,
        weight: f64,
        base: &[f64],
        rate: &mut [f64],
    ) -> Result<Reply, PointError> {
        let smoothed = self.smoothed();
        self.open_gap(base);
        if self.pressure.iter().all(|pressure| *pressure == 0.0) {
            self.solve(driven.control, Diagonal::Zero, false, self.solved.contact_tolerance)?;
        }
        let probe = self.probe_pressure();
        let factor = weight / self.substep.dt / probe;
        if self.is_uniform() {
            let fullest = self.fullest_cell();
            self.room.cells.clear();
            self.room.cells.push(fullest as u32);
            self.room.compact.clear();
            self.room.compact.push(probe);
            if let cut @ Reply::Cut(_) = self.call(driven, false)? {
                return Ok(cut);
            }
            let b = self.law.increment[0] * factor;
            let tolerance = self.stage_tolerance(b * probe);
            self.solve(driven.control, Diagonal::Uniform(b), smoothed, tolerance)?;
            return self.judged(driven, b_of(&Diagonal::Uniform(b)), (weight, base), rate);
        }
        let mut asked = vec![false; self.pressure.len()];
        self.mark_near(&mut asked);
        let mut diagonal = std::mem::take(&mut self.room.diagonal);
        diagonal.clear();
        diagonal.resize(asked.len(), 0.0);
        let mut wanted: Vec<u32> = listed(&asked);
        for solves in 1.. {
            self.room.cells.clone_from(&wanted);
            self.room.compact.clear();
            self.room.compact.resize(wanted.len(), probe);
            if let cut @ Reply::Cut(_) = self.call(driven, false)? {
                self.room.diagonal = diagonal;
                return Ok(cut);
            }
            for (cell, increment) in wanted.iter().zip(&self.law.increment) {
                diagonal[*cell as usize] = increment * factor;
            }
            let most = diagonal.iter().fold(0.0, |most: f64, b| most.max(*b));
            let tolerance = self.stage_tolerance(most * probe);
            let solved = self.solve(driven.control, Diagonal::PerPoint(&diagonal), smoothed, tolerance);
            if let Err(error) = solved {
                self.room.diagonal = diagonal;
                return Err(error);
            }
            wanted.clear();
            for (cell, pressure) in self.pressure.iter().enumerate() {
                if *pressure > 0.0 && !asked[cell] {
                    asked[cell] = true;
                    wanted.push(cell as u32);
                }
            }
            if wanted.is_empty() {
                break;
            }
            if solves >= SOLVES {
                wanted.extend((0..).zip(&asked).filter(|(_, asked)| !**asked).map(|(cell, _)| cell));
                wanted.sort_unstable();
                asked.fill(true);
            }
        }
        let reply = self.judged(driven, b_of(&Diagonal::PerPoint(&diagonal)), (weight, base), rate);
        self.room.diagonal = diagonal;
        reply
    }

    /// A pressure that is typical of the contact: the mean over the load.
    pub(super) fn probe_pressure(&self) -> f64 {
        let largest = self.pressure.iter().fold(0.0, |most: f64, p| most.max(*p));
        if largest == 0.0 {
            return 1.0;
        }
        let (sum, square) = self.pressure.iter().fold((0.0, 0.0), |(sum, square), pressure| {
            let part = pressure / largest;
            (sum + part, square + part * part)
        });
        largest * square / sum
    }

    fn fullest_cell(&self) -> usize {
        let all = self.pressure.iter().enumerate();
        all.fold((0, 0.0), |best, (cell, pressure)| if *pressure > best.1 { (cell, *pressure) } else { best }).0
    }

    /// Marks the cells in contact and a few rings around them.
    fn mark_near(&self, near: &mut [bool]) {
        let [nx, ny] = self.solved.cells.counts;
        for (cell, pressure) in self.pressure.iter().enumerate() {
            if *pressure > 0.0 {
                let (i, j) = (cell % nx, cell / nx);
                for row in j.saturating_sub(RINGS)..ny.min(j + RINGS + 1) {
                    near[row * nx + i.saturating_sub(RINGS)..row * nx + nx.min(i + RINGS + 1)].fill(true);
                }
            }
        }
    }

    /// The law at the pressure that was found: its own answer is what wears, and shows whether its claim holds.
    fn judged(
        &mut self,
        driven: Driven,
        b: impl Fn(usize) -> f64,
        (weight, base): (f64, &[f64]),
        rate: &mut [f64],
    ) -> Result<Reply, PointError> {
        let smoothed = self.smoothed();
        let reply = match smoothed {
            true => self.rate_with_neighbours(driven, weight, base, rate)?,
            false => self.rate(driven, rate)?,
        };
        if let cut @ Reply::Cut(_) = reply {
            return Ok(cut);
        }
        let per_rate = weight / self.substep.dt;
        for (i, cell) in self.room.cells.iter().enumerate() {
            let at = *cell as usize;
            if smoothed && self.pressure[at] == 0.0 {
                continue;
            }
            let pressure = if smoothed { self.room.traction[at] } else { self.pressure[at] };
            let (found, expected) = (self.law.increment[i] * per_rate, b(at) * pressure);
            if (found - expected).abs() > ROUNDING * expected.abs().max(found.abs()) && found.abs() > f64::MIN_POSITIVE
            {
                return Err(PointError::NotProportional {
                    law: self.evaluator.descriptor().name.clone(),
                    point: at,
                    pressure,
                    increment: self.law.increment[i],
                    expected: expected / per_rate,
                });
            }
        }
        Ok(Reply::Good)
    }
}

fn b_of<'d>(diagonal: &'d Diagonal<'_>) -> impl Fn(usize) -> f64 + 'd {
    |cell| diagonal.at(cell)
}

fn listed(marked: &[bool]) -> Vec<u32> {
    marked.iter().enumerate().filter(|(_, marked)| **marked).map(|(cell, _)| cell as u32).collect()
}
