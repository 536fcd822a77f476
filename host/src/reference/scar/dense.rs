//! Systems of linear equations with full matrices.

/// A matrix as a product of triangles, rows exchanged so that the pivots are the largest of their columns.
pub(super) struct Factors {
    rows: Vec<f64>,
    size: usize,
    order: Vec<usize>,
}

impl Factors {
    /// Factors a matrix given row by row; `None` where it is singular.
    pub fn new(mut rows: Vec<f64>, size: usize) -> Option<Factors> {
        let mut order: Vec<usize> = (0..size).collect();
        for k in 0..size {
            let largest = |best: usize, i: usize| {
                if rows[i * size + k].abs() > rows[best * size + k].abs() { i } else { best }
            };
            let pivot = (k..size).fold(k, largest);
            if rows[pivot * size + k] == 0.0 || rows[pivot * size + k].is_nan() {
                return None;
            }
            if pivot != k {
                order.swap(pivot, k);
                let (above, below) = rows.split_at_mut(pivot * size);
                above[k * size..(k + 1) * size].swap_with_slice(&mut below[..size]);
            }
            let (above, below) = rows.split_at_mut((k + 1) * size);
            let top = &above[k * size + k..];
            for row in below.chunks_exact_mut(size) {
                let factor = row[k] / top[0];
                row[k] = factor;
                if factor != 0.0 {
                    row[k + 1..].iter_mut().zip(&top[1..]).for_each(|(entry, top)| *entry -= factor * top);
                }
            }
        }
        Some(Factors { rows, size, order })
    }

    /// Replaces a right side by the solution.
    pub fn solve(&self, side: &mut Vec<f64>) {
        let mut solution: Vec<f64> = self.order.iter().map(|row| side[*row]).collect();
        let row = |i: usize| &self.rows[i * self.size..(i + 1) * self.size];
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        for i in 1..self.size {
            solution[i] -= dot(&row(i)[..i], &solution[..i]);
        }
        for i in (0..self.size).rev() {
            let rest = dot(&row(i)[i + 1..], &solution[i + 1..]);
            solution[i] = (solution[i] - rest) / row(i)[i];
        }
        *side = solution;
    }
}

#[cfg(test)]
mod tests {
    use super::Factors;

    #[test]
    fn a_system_that_needs_its_rows_exchanged_is_solved() {
        let rows = vec![0.0, 2.0, 1.0, 1.0, 1.0, 1.0, 4.0, -1.0, 2.0];
        let mut side = vec![7.0, 6.0, 8.0];
        Factors::new(rows, 3).unwrap().solve(&mut side);
        side.iter().zip([1.0, 2.0, 3.0]).for_each(|(found, x)| assert!((found - x).abs() < 1e-14, "{side:?}"));
        assert!(Factors::new(vec![1.0, 2.0, 2.0, 4.0], 2).is_none());
    }
}
