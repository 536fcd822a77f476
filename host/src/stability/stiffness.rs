//! How fast a contact smooths the unevenness of a worn surface: the largest eigenvalue of the linearised problem.
//!
//! On a fixed contact set the gap is closed, g0 + w + A p = approach, so wear dw changes the pressure by dp = -S dw with
//! S = A^-1 under a given approach, and S = A^-1 - A^-1 1 1^T A^-1 / (1^T A^-1 1) under a given load, which keeps sum p.
//! With the slope D = d(wear rate)/d(pressure) of the law, unevenness decays as dw' = -D S dw. The eigenvalues of D S are
//! those of D^(1/2) S D^(1/2); the largest is found by the method of Lanczos (J. Res. Nat. Bur. Standards 45, 1950), here
//! in the inner product x^T S y, in which D S is symmetric also where D is zero at some cells. Every product with S is one
//! contact solve on a frozen set.

mod tridiagonal;

use crate::contact::{Cells, ContactError, ContactModel, Control, Diagonal, Problem, nodal_traction};
use tridiagonal::Tridiagonal;

/// Relative residual at which the eigenvalue is taken: its error is far below, being of second order.
const RESIDUAL: f64 = 3e-3;
/// Most iterations; from a chequerboard ten to thirty are the rule.
const MOST_ITERATIONS: usize = 60;
/// Relative residual of the contact solves, small against that of the eigenvalue.
const SOLVE: f64 = 1e-6;

/// How the wear rate follows from the pressures of the cells, beside the slope of the law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Basis {
    /// Each cell wears by its own pressure.
    Pressure,
    /// By the nodal traction at it: D^(1/2) M D^(1/2) takes the place of D, M being the average from cells to corners and
    /// back. Where D differs from cell to cell this is not quite D M; the difference is one of neighbours.
    NodalStress {
        /// Whether the grid repeats.
        periodic: bool,
    },
    /// All cells in contact wear by the mean.
    Average,
}

/// A contact and a law at one moment.
#[derive(Clone, Copy, Debug)]
pub struct Linearised<'a> {
    /// Cells in contact `[cells]`.
    pub set: &'a [bool],
    /// d(wear rate)/d(pressure) `[cells]`, not negative; length per time and pressure.
    pub slopes: &'a [f64],
    /// How the rate follows from the pressures.
    pub basis: Basis,
    /// Whether the load is given, and not the approach.
    pub load_given: bool,
}

/// What was measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stiffness {
    /// The largest eigenvalue; per time.
    pub per_time: f64,
    /// Its eigenvector as a wear depth `[cells]`, largest 1; empty unless it was asked for, or where nothing decays.
    pub mode: Vec<f64>,
    /// Contact solves.
    pub solves: u64,
    /// Their iterations.
    pub iterations: u64,
    /// Their pairs of transforms.
    pub fft_pairs: u64,
}

/// Measures the stiffness of a contact against wear.
///
/// # Errors
/// A contact solve on the frozen set that does not converge, such as an approach on a periodic surface in full contact,
/// where the mean pressure is not determined.
pub fn measure(
    model: &mut dyn ContactModel,
    contact: &Linearised<'_>,
    wants_mode: bool,
) -> Result<Stiffness, ContactError> {
    let cells = *model.cells();
    let products = Products { model, contact, cells, found: Stiffness::default() };
    let largest =
        contact.slopes.iter().zip(contact.set).filter(|(_, on)| **on).fold(0.0, |most: f64, (d, _)| most.max(*d));
    if largest == 0.0 {
        return Ok(products.found);
    }
    if contact.basis == Basis::Average {
        return products.mean();
    }
    products.lanczos(wants_mode)
}

/// Products with S and D.
struct Products<'a> {
    model: &'a mut dyn ContactModel,
    contact: &'a Linearised<'a>,
    cells: Cells,
    found: Stiffness,
}

impl Products<'_> {
    /// S x, zero outside the set.
    fn pressed(&mut self, x: &[f64]) -> Result<Vec<f64>, ContactError> {
        let problem = Problem {
            gap: x,
            diagonal: Diagonal::Zero,
            smoothed: false,
            control: if self.contact.load_given { Control::Load(0.0) } else { Control::Approach(0.0) },
            tolerance: SOLVE,
            scale: 0.0,
            frozen: Some(self.contact.set),
        };
        let mut pressure = vec![0.0; x.len()];
        let solution = self.model.solve(&problem, &mut pressure)?;
        self.found.solves += 1;
        self.found.iterations += solution.iterations;
        self.found.fft_pairs += solution.fft_pairs;
        pressure.iter_mut().for_each(|p| *p = -*p);
        Ok(pressure)
    }

    /// D x.
    fn worn(&self, x: &[f64]) -> Vec<f64> {
        let slopes = self.contact.slopes;
        match self.contact.basis {
            Basis::Pressure | Basis::Average => x.iter().zip(slopes).map(|(x, d)| d * x).collect(),
            Basis::NodalStress { periodic } => {
                let rooted: Vec<f64> = x.iter().zip(slopes).map(|(x, d)| d.sqrt() * x).collect();
                let mut out = vec![0.0; x.len()];
                nodal_traction(&self.cells, periodic, &rooted, &mut out);
                out.iter_mut().zip(slopes).for_each(|(out, d)| *out *= d.sqrt());
                out
            }
        }
    }

    /// Wear by the mean, dw' = -1 (1^T D S dw) / n, has one eigenvalue beside zero: 1^T D S 1 / n.
    fn mean(mut self) -> Result<Stiffness, ContactError> {
        let ones: Vec<f64> = self.contact.set.iter().map(|on| f64::from(u8::from(*on))).collect();
        let touching: f64 = ones.iter().sum();
        if !self.contact.load_given {
            let answer = self.pressed(&ones)?;
            self.found.per_time = dot(&answer, self.contact.slopes) / touching;
        }
        Ok(self.found)
    }

    fn lanczos(mut self, wants_mode: bool) -> Result<Stiffness, ContactError> {
        let mut v = self.chequerboard();
        let mut y = self.pressed(&v)?;
        let size = dot(&v, &y).max(0.0).sqrt();
        // One cell under a given load: nothing it wears changes its pressure.
        if size == 0.0 || !size.is_finite() {
            return Ok(self.found);
        }
        scale(&mut v, 1.0 / size);
        scale(&mut y, 1.0 / size);
        let mut before = vec![0.0; v.len()];
        let mut matrix = Tridiagonal::default();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        loop {
            let mut u = self.worn(&y);
            let alpha = dot(&u, &y);
            let beta = matrix.last_off();
            for ((u, v), before) in u.iter_mut().zip(&v).zip(&before) {
                *u -= alpha * v + beta * before;
            }
            let z = self.pressed(&u)?;
            let next = dot(&u, &z).max(0.0).sqrt();
            if wants_mode {
                basis.push(v.clone());
            }
            matrix.push(alpha, next);
            let (value, vector) = matrix.largest();
            let residual = next * vector.last().copied().unwrap_or(0.0).abs();
            self.found.per_time = value;
            if residual <= RESIDUAL * value || matrix.size() >= MOST_ITERATIONS || matrix.size() >= v.len() {
                if wants_mode && value > 0.0 {
                    self.found.mode = self.cleaned(&combined(&basis, &vector))?;
                }
                return Ok(self.found);
            }
            before = std::mem::replace(&mut v, u);
            y = z;
            scale(&mut v, 1.0 / next);
            scale(&mut y, 1.0 / next);
        }
    }

    /// One more product with D S: what S does not see, such as a constant under a given load, is no part of a mode.
    fn cleaned(&mut self, mode: &[f64]) -> Result<Vec<f64>, ContactError> {
        let pressed = self.pressed(mode)?;
        let mut mode = self.worn(&pressed);
        let largest = mode.iter().fold(0.0, |most: f64, x| if x.abs() > most.abs() { *x } else { most });
        if largest != 0.0 {
            scale(&mut mode, 1.0 / largest);
        }
        Ok(mode)
    }

    /// The start: signs that alternate from cell to cell, weighted by the slopes, which is near the mode that decays
    /// fastest; a slight tilt keeps it from missing a mode by symmetry.
    fn chequerboard(&self) -> Vec<f64> {
        let nx = self.cells.counts[0];
        let count = self.contact.set.len() as f64;
        let start = |(cell, slope): (usize, &f64)| {
            let sign = if (cell % nx + cell / nx).is_multiple_of(2) { 1.0 } else { -1.0 };
            if self.contact.set[cell] { slope * sign * (1.0 + 1e-3 * cell as f64 / count) } else { 0.0 }
        };
        self.contact.slopes.iter().enumerate().map(start).collect()
    }
}

/// Sum of vectors by weights.
fn combined(basis: &[Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let mut mode = vec![0.0; basis.first().map_or(0, Vec::len)];
    for (vector, weight) in basis.iter().zip(weights) {
        mode.iter_mut().zip(vector).for_each(|(mode, x)| *mode += weight * x);
    }
    mode
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn scale(values: &mut [f64], by: f64) {
    values.iter_mut().for_each(|value| *value *= by);
}

#[cfg(test)]
mod tests;
