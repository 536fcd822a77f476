//! Elastic half-space: the displacement of a cell follows from the pressures of all cells.
//! Here are the displacements that one loaded cell causes (influence), their convolution with all pressures (convolve)
//! and the search for the pressures that keep the bodies from overlapping (cg).
//! Not here: what wears the surface (integrator) and how stiff the contact is against wear (stability).

mod cg;
mod convolve;
mod influence;
mod local;
mod scaled;
mod symbol;
#[cfg(test)]
mod tests;

use super::{Cells, ContactError, ContactModel, Control, Problem, Solution};
use convolve::{Convolution, Dense};
use scaled::{Scaled, power_of_two};
use symbol::Quarter;

/// What is beyond the cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// A half-space without pressure.
    Free,
    /// The same cells again and again; the approach is measured from the mean plane.
    Periodic,
}

/// An elastic half-space under equal cells.
pub struct HalfSpace {
    cells: Cells,
    boundary: Boundary,
    /// Unit of lengths along the surface, a power of two.
    length: f64,
    /// Unit of moduli, a power of two.
    modulus_unit: f64,
    convolution: Convolution,
}

impl HalfSpace {
    /// Under `cells`, with the contact modulus E* (pressure), 1/E* = sum (1 - nu^2)/E.
    ///
    /// `datum` is the distance at which the displacement is zero, for a free boundary in 2-D, where it does not go to
    /// zero (length; half the size if there is none; under a given load only the approach depends on it). With `threads`
    /// other than 1, large grids use those of rayon's current pool.
    #[must_use]
    pub fn new(cells: Cells, modulus: f64, boundary: Boundary, datum: Option<f64>, threads: usize) -> HalfSpace {
        let length = power_of_two(cells.spacing[0]);
        let flat = cells.dimension == 2;
        let spacing = [cells.spacing[0] / length, if flat { 1.0 } else { cells.spacing[1] / length }];
        let modulus_unit = power_of_two(modulus);
        let soft = modulus_unit / modulus;
        let symbol = match boundary {
            Boundary::Periodic => {
                Quarter::from_lags(cells.counts, |x, y| soft * influence::mode([x, y], cells.counts, spacing))
            }
            Boundary::Free => {
                let padded = cells.counts.map(|count| if count == 1 { 1 } else { padded(2 * count - 1) });
                let datum = datum.map_or(0.5 * cells.counts[0] as f64 * spacing[0], |datum| datum / length);
                let lag = |x: usize, y: usize| {
                    let (x, y) = (x as f64 * spacing[0], y as f64 * spacing[1]);
                    let one = if flat {
                        influence::strip(x, spacing[0], datum)
                    } else {
                        influence::rectangle(x, y, spacing[0], spacing[1])
                    };
                    soft * one
                };
                Quarter::from_lags(padded, lag).transformed()
            }
        };
        let convolution = Convolution::new(cells.counts, symbol, threads);
        HalfSpace { cells, boundary, length, modulus_unit, convolution }
    }
}

impl HalfSpace {
    /// Refuses an approach that a periodic surface has no answer to: the mean gap of a surface in full contact, or more.
    fn hold(&self, scaled: &Scaled, problem: &Problem<'_>, approach: f64) -> Result<(), ContactError> {
        let all = problem.frozen.is_none_or(|set| set.iter().all(|on| *on));
        let soft = scaled.local.iter().any(|b| *b > 0.0);
        if self.boundary == Boundary::Free || !all || soft {
            return Ok(());
        }
        let mean = scaled.gap.iter().sum::<f64>() / scaled.gap.len() as f64;
        let largest = scaled.gap.iter().fold(0.0, |most: f64, gap| most.max(gap.abs()));
        let rounding = 8.0 * f64::EPSILON * largest;
        let refused = if problem.frozen.is_some() { mean.abs() > rounding } else { mean <= rounding };
        if refused {
            return Err(ContactError::NoSolution { approach, most: approach + mean * scaled.units.gap });
        }
        Ok(())
    }
}

/// The next even size at least as large that transforms go fast with.
fn padded(least: usize) -> usize {
    let good = |size: usize| {
        let mut rest = size;
        for factor in [2, 3, 5] {
            while rest.is_multiple_of(factor) {
                rest /= factor;
            }
        }
        rest == 1 && size.is_multiple_of(2)
    };
    (least..).find(|size| good(*size)).unwrap_or(least)
}

impl ContactModel for HalfSpace {
    fn cells(&self) -> &Cells {
        &self.cells
    }

    fn solve(&mut self, problem: &Problem<'_>, pressure: &mut [f64]) -> Result<Solution, ContactError> {
        let scaled = Scaled::new(problem, &self.cells, self.modulus_unit / self.length)?;
        let units = scaled.units;
        if problem.frozen.is_none() && scaled.sum.is_some_and(|sum| sum <= 0.0) {
            pressure.fill(0.0);
            return Ok(Solution { approach: scaled.datum, ..Solution::default() });
        }
        if let Control::Approach(approach) = problem.control {
            self.hold(&scaled, problem, approach)?;
        }
        pressure.iter_mut().for_each(|p| *p /= units.pressure);
        let mut operator =
            cg::Operator::new(&self.cells, self.boundary, &mut self.convolution, &scaled, problem.smoothed);
        let outcome = match problem.frozen {
            Some(set) => cg::frozen(&mut operator, set, problem.tolerance, pressure),
            None => cg::constrained(&mut operator, pressure),
        };
        let fft_pairs = operator.pairs;
        let total: f64 = pressure.iter().sum();
        let mut load = total * units.pressure * self.cells.area();
        let mut factor = units.pressure;
        if let (Control::Load(wanted), Some(sum)) = (problem.control, scaled.sum)
            && problem.frozen.is_none()
        {
            factor *= sum / total;
            load = wanted;
        }
        pressure.iter_mut().for_each(|p| *p *= factor);
        let approach = match problem.control {
            Control::Load(_) => scaled.datum + outcome.approach * units.gap,
            Control::Approach(approach) => approach,
        };
        if !outcome.converged {
            return Err(ContactError::NotConverged {
                iterations: outcome.iterations,
                error: outcome.error,
                tolerance: problem.tolerance,
            });
        }
        Ok(Solution { approach, load, iterations: outcome.iterations, fft_pairs, error: outcome.error })
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) {
        self.convolution.apply(&Dense { width: self.cells.counts[0], input: pressure }, out);
        let compliance = self.length / self.modulus_unit;
        out.iter_mut().for_each(|u| *u *= compliance);
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.convolution.bytes()
    }
}
