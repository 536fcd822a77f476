//! The half-space against direct sums, a dense solver and closed forms.

mod answers;
mod dense;
mod mirrors;
mod sums;
mod units;
mod windows;

use super::*;
use crate::{Control, Diagonal};

/// Numbers in (0, 1) that look random.
pub struct Numbers(u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    pub fn many(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.next()).collect()
    }
}

pub const MODULUS: f64 = 110e9;

pub fn line(count: usize, spacing: f64) -> Cells {
    Cells { dimension: 2, counts: [count, 1], spacing: [spacing, 1.0] }
}

pub fn plane(counts: [usize; 2], spacing: [f64; 2]) -> Cells {
    Cells { dimension: 3, counts, spacing }
}

/// A problem without diagonal; the scale is the standard deviation of the finite gaps.
pub fn problem(gap: &[f64], control: Control) -> Problem<'_> {
    let finite: Vec<f64> = gap.iter().copied().filter(|gap| gap.is_finite()).collect();
    let mean = finite.iter().sum::<f64>() / finite.len() as f64;
    let scale = (finite.iter().map(|gap| (gap - mean).powi(2)).sum::<f64>() / finite.len() as f64).sqrt();
    Problem { gap, diagonal: Diagonal::Zero, smoothed: false, control, tolerance: 1e-11, scale, frozen: None }
}

/// A bowl x^2 / 2R + y^2 / 2R around the middle cell of a grid.
pub fn bowl(cells: &Cells, radius: f64) -> Vec<f64> {
    let [nx, ny] = cells.counts;
    let from = |i: usize, axis: usize, n: usize| (i as f64 - (n / 2) as f64) * cells.spacing[axis];
    let square =
        |cell: usize| from(cell % nx, 0, nx).powi(2) + if ny > 1 { from(cell / nx, 1, ny).powi(2) } else { 0.0 };
    (0..cells.count()).map(|cell| square(cell) / (2.0 * radius)).collect()
}

/// The largest difference, over the largest number.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    let most = b.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    a.iter().zip(b).fold(0.0, |worst: f64, (a, b)| worst.max((a - b).abs())) / most
}
