//! Independent springs (Winkler): u = p / k, each cell by itself.

use super::{Cells, ContactError, ContactModel, Control, Diagonal, Problem, Solution};

/// An elastic foundation.
#[derive(Clone, Debug)]
pub struct Foundation {
    cells: Cells,
    stiffness: f64,
}

impl Foundation {
    /// Springs of `stiffness` (pressure per length) under these cells.
    #[must_use]
    pub fn new(cells: Cells, stiffness: f64) -> Foundation {
        Foundation { cells, stiffness }
    }

    /// Pressure of a cell at an approach.
    fn pressure(&self, problem: &Problem<'_>, cell: usize, approach: f64) -> f64 {
        let free = match problem.frozen {
            Some(set) if !set[cell] => return 0.0,
            Some(_) => true,
            None => false,
        };
        let pressing = approach - problem.gap[cell];
        if pressing <= 0.0 && !free {
            return 0.0;
        }
        pressing * self.slope(&problem.diagonal, cell)
    }

    /// Pressure per approach of a cell in contact: 1 / (1/k + b) without leaving the range of doubles.
    fn slope(&self, diagonal: &Diagonal<'_>, cell: usize) -> f64 {
        let b = diagonal.at(cell);
        if b == 0.0 { self.stiffness } else { 1.0 / (1.0 / self.stiffness + b) }
    }

    /// The approach at which the pressures carry a load: that of the set of cells with the smallest gaps which is
    /// consistent with itself.
    ///
    /// The load over the approach is convex and piecewise linear, so Newton's method from the right end of it goes down
    /// monotonically and ends after finitely many steps; every step is one pass over the cells.
    fn approach(&self, problem: &Problem<'_>, load: f64) -> Result<(f64, u64), ContactError> {
        let area = self.cells.area();
        let mean = load / area;
        // Relative to the lowest gap, so that a large offset of all gaps costs no digits.
        let lowest = self.lowest(problem);
        if !lowest.is_finite() {
            return Err(ContactError::NowhereToTouch { load });
        }
        // From below: with the lowest cells alone the approach is too large.
        let mut above = f64::INFINITY;
        let mut iterations = 0;
        loop {
            let (mut slopes, mut moments) = (0.0, 0.0);
            for (cell, gap) in problem.gap.iter().enumerate() {
                let touches = match problem.frozen {
                    Some(set) => set[cell],
                    None if above.is_infinite() => *gap == lowest,
                    None => gap - lowest < above,
                };
                if touches && gap.is_finite() {
                    let slope = self.slope(&problem.diagonal, cell);
                    slopes += slope;
                    moments += slope * (gap - lowest);
                }
            }
            iterations += 1;
            let next = (mean + moments) / slopes;
            if !next.is_finite() {
                return Err(self.not_finite(problem, load));
            }
            if problem.frozen.is_some() || next >= above || iterations > 10_000 {
                return Ok((lowest + if problem.frozen.is_some() { next } else { next.min(above) }, iterations));
            }
            above = next;
        }
    }

    fn lowest(&self, problem: &Problem<'_>) -> f64 {
        let among = |cell: usize| problem.frozen.is_none_or(|set| set[cell]);
        let gaps = problem.gap.iter().enumerate().filter(|(cell, _)| among(*cell));
        gaps.map(|(_, gap)| *gap).fold(f64::INFINITY, f64::min)
    }

    fn not_finite(&self, problem: &Problem<'_>, given: f64) -> ContactError {
        let gap =
            problem.gap.iter().copied().filter(|gap| gap.is_finite()).fold(0.0, |most: f64, gap| most.max(gap.abs()));
        ContactError::NotFinite { what: "a pressure", gap, given }
    }
}

impl ContactModel for Foundation {
    fn cells(&self) -> &Cells {
        &self.cells
    }

    fn solve(&mut self, problem: &Problem<'_>, pressure: &mut [f64]) -> Result<Solution, ContactError> {
        let (approach, iterations) = match problem.control {
            Control::Approach(approach) => (approach, 1),
            Control::Load(load) if load > 0.0 || problem.frozen.is_some() => self.approach(problem, load)?,
            Control::Load(_) => (self.lowest(problem), 1),
        };
        let mut sum = 0.0;
        for (cell, value) in pressure.iter_mut().enumerate() {
            *value = self.pressure(problem, cell, approach);
            sum += *value;
        }
        let area = self.cells.area();
        if !sum.is_finite() {
            return Err(self.not_finite(problem, approach));
        }
        let mut load = sum * area;
        if let Control::Load(wanted) = problem.control
            && problem.frozen.is_none()
            && sum > 0.0
        {
            // What rounding left of the load, so that worn volumes balance. It is the approach that was rounded: where a
            // local compliance makes a cell soft, next to nothing of it belongs there, and a factor would wear it away.
            let on =
                |(cell, value): (usize, &f64)| if *value > 0.0 { self.slope(&problem.diagonal, cell) } else { 0.0 };
            let slopes: f64 = pressure.iter().enumerate().map(on).sum();
            let shift = (wanted / area - sum) / slopes;
            if shift.is_finite() {
                sum = 0.0;
                for (cell, value) in pressure.iter_mut().enumerate().filter(|(_, value)| **value > 0.0) {
                    *value = (*value + shift * self.slope(&problem.diagonal, cell)).max(0.0);
                    sum += *value;
                }
            }
            let factor = wanted / area / sum;
            pressure.iter_mut().for_each(|value| *value *= factor);
            load = wanted;
        }
        Ok(Solution { approach, load, iterations, fft_pairs: 0, error: 0.0 })
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) {
        for (out, pressure) in out.iter_mut().zip(pressure) {
            *out = pressure / self.stiffness;
        }
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}
