mod files;
mod measures;
mod roughness;
mod shapes;

use super::{Shape, Surface, SurfaceError};
use crate::Cells;

fn cells(counts: [usize; 2], spacing: [f64; 2]) -> Cells {
    Cells { dimension: 3, counts, spacing }
}

fn line(count: usize, spacing: f64) -> Cells {
    Cells { dimension: 2, counts: [count, 1], spacing: [spacing, 1.0] }
}

fn gap(shape: Shape, cells: &Cells) -> Result<Vec<f64>, SurfaceError> {
    Surface { shape, center: None }.initial_gap(cells, false)
}

fn gap_at(shape: Shape, center: [f64; 2], cells: &Cells, periodic: bool) -> Result<Vec<f64>, SurfaceError> {
    Surface { shape, center: Some(center) }.initial_gap(cells, periodic)
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(f64::MIN_POSITIVE), "{found:e}, {expected:e}");
}
