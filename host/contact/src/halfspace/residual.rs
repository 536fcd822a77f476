//! Minimal residuals (GMRES; Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986) on a set that stays, for operators
//! that are not symmetric: a local compliance that varies and acts on the smoothed pressure.

use super::contact_set::ContactSet;
use super::descend::{Descent, Goal};
use super::passes::{change, dot, sum};
use super::patch::Patch;
use super::stencil::Stencil;

/// Directions that are kept before the search starts anew.
const KEPT: usize = 40;
/// Arrays over the set at most: the basis, and directions with their images.
pub const MOST_ARRAYS: usize = 3 * KEPT + 4;

/// Reduces the residual to the goal's norm; under a load the sum of the pressures stays.
pub fn run(descent: &mut Descent, patch: &mut Patch<'_>, set: &ContactSet, stencil: &mut Stencil, goal: &Goal) -> bool {
    let (threads, count) = (patch.threads, set.len());
    let loaded = patch.sum.is_some();
    if loaded && count < 2 {
        return true;
    }
    let mut unit = vec![0.0; count];
    stencil.apply(patch, set, &vec![1.0; count], &mut unit);
    let unit_sum = sum(threads, count, |i| unit[i]);
    let centre = |values: &mut [f64]| {
        let mean = sum(threads, count, |i| values[i]) / count as f64;
        change(threads, values, |_, value| value - if loaded { mean } else { 0.0 });
    };
    while descent.iterations < goal.most {
        let mut first = descent.residual.clone();
        centre(&mut first);
        let norm = dot(threads, &first, &first).sqrt();
        if norm <= goal.norm || !norm.is_finite() {
            return norm.is_finite();
        }
        change(threads, &mut first, |_, value| value / norm);
        let (mut basis, mut directions, mut images) = (vec![first], Vec::new(), Vec::new());
        let mut triangle = Triangle { columns: Vec::new(), rotations: Vec::new(), right: vec![norm] };
        while directions.len() < KEPT && descent.iterations < goal.most {
            let (mut direction, mut image) = (vec![0.0; count], vec![0.0; count]);
            stencil.apply(patch, set, &basis[basis.len() - 1], &mut direction);
            if loaded {
                let factor = sum(threads, count, |i| direction[i]) / unit_sum;
                change(threads, &mut direction, |i, value| value - factor * unit[i]);
            }
            patch.image(set, &direction, &mut image);
            descent.iterations += 1;
            let mut next = image.clone();
            centre(&mut next);
            let mut column = Vec::with_capacity(basis.len() + 1);
            for other in &basis {
                let part = dot(threads, other, &next);
                change(threads, &mut next, |i, value| value - part * other[i]);
                column.push(part);
            }
            let length = dot(threads, &next, &next).sqrt();
            column.push(length);
            directions.push(direction);
            images.push(image);
            let left = triangle.add(column);
            if left <= goal.norm || length <= 1e-14 * norm || !left.is_finite() {
                break;
            }
            change(threads, &mut next, |_, value| value / length);
            basis.push(next);
        }
        for (factor, (direction, image)) in triangle.solve().into_iter().zip(directions.iter().zip(&images)) {
            change(threads, &mut descent.pressure, |i, p| p - factor * direction[i]);
            change(threads, &mut descent.residual, |i, r| r - factor * image[i]);
        }
        let after = descent.norm(patch, set);
        if after <= goal.norm || after > 0.999 * norm {
            return after <= norm;
        }
    }
    true
}

/// A least-squares problem with one more row than columns, kept triangular by rotations.
struct Triangle {
    columns: Vec<Vec<f64>>,
    rotations: Vec<(f64, f64)>,
    right: Vec<f64>,
}

impl Triangle {
    /// Takes one more column and says what is left of the right side.
    fn add(&mut self, mut column: Vec<f64>) -> f64 {
        for (row, (c, s)) in self.rotations.iter().enumerate() {
            let (above, below) = (column[row], column[row + 1]);
            (column[row], column[row + 1]) = (c * above + s * below, c * below - s * above);
        }
        let row = self.columns.len();
        let length = column[row].hypot(column[row + 1]);
        let (c, s) = if length > 0.0 { (column[row] / length, column[row + 1] / length) } else { (1.0, 0.0) };
        column[row] = length;
        column.truncate(row + 1);
        self.columns.push(column);
        self.rotations.push((c, s));
        let above = self.right[row];
        self.right[row] = c * above;
        self.right.push(-s * above);
        (s * above).abs()
    }

    /// The factors of the columns.
    fn solve(&self) -> Vec<f64> {
        let count = self.columns.len();
        let mut factors = self.right[..count].to_vec();
        for row in (0..count).rev() {
            let known: f64 = (row + 1..count).map(|column| self.columns[column][row] * factors[column]).sum();
            let pivot = self.columns[row][row];
            factors[row] = if pivot == 0.0 { 0.0 } else { (factors[row] - known) / pivot };
        }
        factors
    }
}
