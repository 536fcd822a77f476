//! The largest eigenvalue of a symmetric tridiagonal matrix that grows, with its eigenvector.

/// Diagonal and the entries beside it.
#[derive(Clone, Debug, Default)]
pub(super) struct Tridiagonal {
    diagonal: Vec<f64>,
    /// `off[k]` couples k and k + 1; the last one leads out of the matrix.
    off: Vec<f64>,
}

impl Tridiagonal {
    pub(super) fn size(&self) -> usize {
        self.diagonal.len()
    }

    /// The entry that leads out of the matrix; 0 of an empty one.
    pub(super) fn last_off(&self) -> f64 {
        self.off.last().copied().unwrap_or(0.0)
    }

    /// Adds a row, and the entry that leads out of it.
    pub(super) fn push(&mut self, diagonal: f64, off: f64) {
        self.diagonal.push(diagonal);
        self.off.push(off);
    }

    /// The largest eigenvalue, by bisection with Sturm's sequence, and its eigenvector of length 1, by inverse iteration
    /// just above it, where elimination needs no pivots.
    pub(super) fn largest(&self) -> (f64, Vec<f64>) {
        let n = self.size();
        let beside = |k: usize| if k + 1 < n { self.off[k].abs() } else { 0.0 };
        let bound = |k: usize| self.diagonal[k] + beside(k) + if k > 0 { beside(k - 1) } else { 0.0 };
        let mut high = (0..n).map(bound).fold(f64::NEG_INFINITY, f64::max);
        let mut low = self.diagonal.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        while high - low > 1e-14 * high.abs() {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.all_below(middle) { high = middle } else { low = middle }
        }
        let shift = high + 1e-13 * high.abs().max(f64::MIN_POSITIVE);
        let mut vector = vec![1.0; n];
        for _ in 0..3 {
            self.solve(shift, &mut vector);
            let size = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            vector.iter_mut().for_each(|x| *x /= size);
        }
        (high, vector)
    }

    /// Whether all eigenvalues are below a number.
    fn all_below(&self, number: f64) -> bool {
        let mut pivot = f64::NEG_INFINITY;
        for (k, diagonal) in self.diagonal.iter().enumerate() {
            let off = if k > 0 { self.off[k - 1] } else { 0.0 };
            pivot = diagonal - number - off * off / pivot;
            if pivot >= 0.0 || pivot.is_nan() {
                return false;
            }
        }
        true
    }

    /// Solves (shift - T) x = b in place, shift above all eigenvalues.
    fn solve(&self, shift: f64, x: &mut [f64]) {
        let n = x.len();
        let mut pivots = Vec::with_capacity(n);
        for k in 0..n {
            let mut pivot = shift - self.diagonal[k];
            if k > 0 {
                let factor = self.off[k - 1] / pivots[k - 1];
                pivot -= factor * self.off[k - 1];
                x[k] += factor * x[k - 1];
            }
            // Rounding may leave nothing of a pivot that is small and positive.
            pivots.push(pivot.max(f64::EPSILON * shift.abs()).max(f64::MIN_POSITIVE));
        }
        for k in (0..n).rev() {
            let behind = if k + 1 < n { self.off[k] * x[k + 1] } else { 0.0 };
            x[k] = (x[k] + behind) / pivots[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_eigenvalue_of_a_chain_is_the_known_one() {
        // Diagonal 2, beside it 1: 2 + 2 cos(k pi / (n + 1)), vector sin(k pi j / (n + 1)).
        let mut chain = Tridiagonal::default();
        (0..9).for_each(|_| chain.push(2.0, 1.0));
        let (value, vector) = chain.largest();
        let angle = std::f64::consts::PI / 10.0;
        assert!((value - 2.0 - 2.0 * angle.cos()).abs() < 1e-12, "{value}");
        let ratio = vector[4] / vector[0];
        assert!((ratio - (5.0 * angle).sin() / angle.sin()).abs() < 1e-6, "{ratio}");
        let mut one = Tridiagonal::default();
        one.push(-3.0, 5.0);
        assert_eq!(one.largest().1, [1.0]);
        assert!((one.largest().0 + 3.0).abs() < 1e-12);
    }
}
