//! Implicit stages of any other law: a safeguarded Newton method on the pressure.

use super::segment::Driven;
use super::system::{System, Tractions};
use crate::contact::{Control, Diagonal, RootMean};
use crate::integrator::Reply;
use crate::plan::{Elastic, Slope};
use crate::solve::PointError;

/// Most linearisations of a stage.
const MOST_ITERATIONS: usize = 80;
/// Linearisations without progress after which the point of linearisation moves half the way only.
const PATIENCE: usize = 10;
/// Relative step of difference quotients: the error of the quotient, about 1e-7, only costs iterations.
const DIFFERENCE: f64 = 1e-7;
/// Part of its pressure that a point keeps as its point of linearisation at least, where the law is steeper below: from
/// there the method goes up monotonically, at zero the slope may be infinite.
const KEPT: f64 = 0.05;
/// Part of the contact tolerance that wear at no pressure may be wrong by.
const NEGLIGIBLE: f64 = 1e-3;
/// How far above the mean over the load the root mean square over cells may be that carry next to nothing.
const SOFT: f64 = 8.0;
/// A slope below minus this part of increment / pressure is no rounding: the law falls with pressure.
const FALLING: f64 = 1e-5;

impl System<'_> {
    /// The rate at `base + weight * rate`: the law is linearised at a pressure, the contact solved with its slope as the
    /// local compliance and the rest of the line as gap, and so on from the pressure that this gives.
    ///
    /// It ends when the misfit of J(p) and the line is below the contact tolerance, J being what the stage wears. Under nodal
    /// tractions J reaches the neighbours of the contact, as the solve does ([`crate::contact::Problem`]).
    pub(super) fn newton(
        &mut self,
        driven: Driven,
        weight: f64,
        base: &[f64],
        rate: &mut [f64],
    ) -> Result<Reply, PointError> {
        if self.pressure.iter().all(|pressure| *pressure == 0.0) {
            self.open_gap(base);
            self.solve(driven.control, Diagonal::Zero, false, self.solved.contact_tolerance)?;
        }
        if let Control::Approach(approach) = driven.control
            && self.is_shallow(approach, base)
        {
            self.pressure.fill(0.0);
            (self.solution.approach, self.solution.load) = (approach, 0.0);
            return self.rate(driven, rate);
        }
        let mut point = std::mem::take(&mut self.room.point);
        let mut diagonal = std::mem::take(&mut self.room.diagonal);
        let mut line = std::mem::take(&mut self.room.expected);
        point.clone_from(&self.pressure);
        let reply = self.iterate(driven, weight, base, rate, (&mut point, &mut diagonal, &mut line));
        (self.room.point, self.room.diagonal, self.room.expected) = (point, diagonal, line);
        reply
    }

    /// Whether the surfaces overlap nowhere by more than the contact tolerance: no pressure is then as good an answer as any.
    /// A law that wears a point to the end leaves such overlaps, and they are no more than rounding of the gaps.
    fn is_shallow(&self, approach: f64, base: &[f64]) -> bool {
        let least = approach - self.solved.contact_tolerance * self.gap_scale;
        self.initial_gap.iter().zip(base).all(|(gap, wear)| gap + wear >= least)
    }

    fn iterate(
        &mut self,
        driven: Driven,
        weight: f64,
        base: &[f64],
        rate: &mut [f64],
        (point, diagonal, line): (&mut Vec<f64>, &mut Vec<f64>, &mut Vec<f64>),
    ) -> Result<Reply, PointError> {
        let open = self.evaluator.descriptor().wants_open_points();
        let per_increment = weight / self.substep.dt;
        let mut tolerance = self.solved.contact_tolerance;
        let negligible = NEGLIGIBLE * tolerance * self.gap_scale;
        let (mut best, mut since_best, mut residual) = (f64::INFINITY, 0, f64::INFINITY);
        let cells = point.len();
        for iteration in 0..MOST_ITERATIONS {
            if let cut @ Reply::Cut(_) = self.linearise(driven, point, open)? {
                return Ok(cut);
            }
            if iteration == 0 {
                let (sum, square) = self.law.increment.iter().fold((0.0, 0.0), |(s, q), w| (s + w, q + w * w));
                tolerance = self.stage_tolerance(if sum > 0.0 { per_increment * square / sum } else { 0.0 });
            }
            self.open_gap(base);
            diagonal.clear();
            diagonal.resize(cells, 0.0);
            line.clear();
            line.resize(cells, 0.0);
            for (i, cell) in self.room.cells.iter().enumerate() {
                let at = *cell as usize;
                diagonal[at] = per_increment * self.law.slope[i];
                line[at] = per_increment * self.law.increment[i] - diagonal[at] * driving(&self.room.compact, i);
                self.room.gap[at] += line[at];
            }
            self.work.newton_iterations += 1;
            // Early answers need not be better than the linearisation is.
            let inner = (0.01 * residual).clamp(tolerance, 1e-3_f64.max(tolerance));
            let smoothed = self.smoothed();
            self.solve(driven.control, Diagonal::PerPoint(diagonal), smoothed, inner)?;
            // What the law says at the pressure that was found, against what the line says.
            let pressure = std::mem::take(&mut self.pressure);
            self.list_reached(&pressure, open);
            let reply = self.evaluate(driven, &pressure, Tractions::WithNeighbours, false);
            self.pressure = pressure;
            if let cut @ Reply::Cut(_) = reply? {
                return Ok(cut);
            }
            residual = self.misfit(per_increment, diagonal, line, point);
            if residual <= tolerance && inner <= tolerance {
                if self.smoothed() {
                    return self.rate_with_neighbours(driven, weight, base, rate);
                }
                self.spread(rate);
                return Ok(Reply::Good);
            }
            (best, since_best) = if residual < 0.7 * best { (residual, 0) } else { (best, since_best + 1) };
            let damped = since_best > PATIENCE;
            for (cell, (point, found)) in point.iter_mut().zip(&self.pressure).enumerate() {
                // Concave at this point: the line lies above the law on the way down to zero.
                // A line that wears next to nothing at no pressure, and leaves none, says that the point is open.
                let keep = if line[cell] > negligible { KEPT * *point } else { 0.0 };
                let next = found.max(keep);
                *point = if damped { 0.5 * (*point + next) } else { next };
            }
            if iteration + 1 == MOST_ITERATIONS {
                break;
            }
        }
        Err(PointError::Newton { iterations: MOST_ITERATIONS, residual, tolerance })
    }

    /// Increments and slopes of the law at the points of linearisation, for the cells that wear there.
    fn linearise(&mut self, driven: Driven, point: &[f64], open: bool) -> Result<Reply, PointError> {
        self.list_reached(point, open);
        self.linearise_listed(driven, point, Tractions::WithNeighbours)
    }

    /// Increments and slopes of the law at the cells in `room.cells` under pressures `[cells]`; see [`System::evaluate`].
    pub(super) fn linearise_listed(
        &mut self,
        driven: Driven,
        point: &[f64],
        tractions: Tractions,
    ) -> Result<Reply, PointError> {
        if self.solved.scheme.slope == Slope::Derivative {
            if let cut @ Reply::Cut(_) = self.evaluate(driven, point, tractions, true)? {
                return Ok(cut);
            }
        } else {
            let smallest = DIFFERENCE * 1e-3 * self.probe_pressure();
            if let cut @ Reply::Cut(_) = self.evaluate(driven, point, tractions, false)? {
                return Ok(cut);
            }
            let increment = self.law.increment.clone();
            let compact = self.room.compact.clone();
            for pressure in &mut self.room.compact {
                *pressure += (DIFFERENCE * *pressure).max(smallest);
            }
            if !self.room.compact_traction.is_empty() {
                // Nodal tractions are derived from the pressure: a derivative with respect to it is total.
                self.room.compact_traction.clone_from(&self.room.compact);
            }
            if let cut @ Reply::Cut(_) = self.call(driven, false)? {
                return Ok(cut);
            }
            self.law.slope.clear();
            let steps = self.room.compact.iter().zip(&compact).map(|(raised, pressure)| raised - pressure);
            let rises = self.law.increment.iter().zip(&increment).map(|(raised, increment)| raised - increment);
            self.law.slope.extend(rises.zip(steps).map(|(rise, step)| rise / step));
            self.law.increment = increment;
            self.room.compact = compact;
        }
        self.rising()
    }

    /// Checks that the law grows with pressure; what rounding makes of a slope of zero is zero.
    fn rising(&mut self) -> Result<Reply, PointError> {
        for (i, slope) in self.law.slope.iter_mut().enumerate() {
            if *slope >= 0.0 {
                // An infinite slope is one that no double holds.
                *slope = slope.min(f64::MAX);
                continue;
            }
            let pressure = driving(&self.room.compact, i);
            if pressure > 0.0 && *slope < -FALLING * (self.law.increment[i] / pressure).abs() {
                return Err(PointError::NotMonotone {
                    law: self.evaluator.descriptor().name.clone(),
                    point: self.room.cells[i] as usize,
                    pressure,
                    slope: *slope,
                });
            }
            *slope = 0.0;
        }
        Ok(Reply::Good)
    }

    /// sum p |J(p) - line(p)| / (sum p * scale), plus the deepest overlap that J(p) < line(p) leaves, over the scale: the
    /// units of the complementarity error. Cells whose wear takes up nearly all of what is theirs carry next to nothing; as
    /// in the contact solve, what they wear counts by itself, by its root mean square.
    fn misfit(&self, per_increment: f64, diagonal: &[f64], line: &[f64], point: &[f64]) -> f64 {
        let smoothed = self.smoothed();
        let largest = self.pressure.iter().chain(point).fold(0.0, |most: f64, p| most.max(*p));
        if largest == 0.0 {
            return 0.0;
        }
        let (mut sum, mut weight, mut deepest) = (0.0, 0.0, 0.0_f64);
        let (mut off, own) = (RootMean::default(), self.own_compliance());
        let mut listed = self.room.cells.iter().enumerate().peekable();
        for cell in 0..point.len() {
            let found = listed.next_if(|(_, at)| **at as usize == cell);
            let pressure = self.pressure[cell];
            let driving = if smoothed { self.room.traction[cell] } else { pressure };
            if driving == 0.0 && point[cell] == 0.0 {
                continue;
            }
            let law = found.map_or(0.0, |(i, _)| per_increment * self.law.increment[i]);
            // An open cell is misjudged only by what its line wears at no pressure.
            let line = line[cell] + diagonal[cell] * driving;
            if driving > 0.0 {
                off.add((law - line) / (1.0 + own / diagonal[cell]));
            }
            let share = if pressure > 0.0 { pressure } else { point[cell] } / largest;
            sum += share * (law - line).abs();
            // Cells that their lines left open count too: the line of a concave law lies far above it on the way down to zero,
            // and where it leaves no pressure at all the answer is not that nothing wears.
            weight += share;
            deepest = deepest.max(line - law);
        }
        let soft = off.value() / SOFT;
        (if weight > 0.0 { sum / weight } else { 0.0 } + deepest).max(soft) / self.gap_scale
    }

    /// What pressure on a cell alone displaces it by, per pressure, but for a factor near one.
    fn own_compliance(&self) -> f64 {
        match self.solved.elastic {
            Elastic::Foundation(stiffness) => stiffness.recip(),
            Elastic::HalfSpace { modulus, .. } => self.solved.cells.spacing[0] / modulus,
        }
    }
}

fn driving(compact: &[f64], i: usize) -> f64 {
    compact[i]
}
