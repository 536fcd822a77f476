//! Shapes with a formula: sphere, cylinder, cone, flat punch and waves.
//!
//! Every formula is even in the distances from the apex, bit by bit, so that a gap is exactly as symmetric as its grid.

use std::f64::consts::TAU;

use super::super::Cells;
use super::SurfaceError;

/// Distances of the centres of the cells from the apex.
pub(super) struct Offsets {
    dimension: u8,
    /// Numbers of cells.
    counts: [usize; 2],
    /// Lengths of a cell.
    spacing: [f64; 2],
    /// In cells, along x and y.
    steps: [Vec<f64>; 2],
}

impl Offsets {
    pub(super) fn new(cells: &Cells, center: Option<[f64; 2]>, periodic: bool) -> Result<Offsets, SurfaceError> {
        let mut steps = [Vec::new(), vec![0.0; cells.counts[1]]];
        for axis in 0..usize::from(cells.dimension - 1) {
            let count = cells.counts[axis];
            let apex = match center {
                Some(center) => place(center[axis], cells.spacing[axis], count)?,
                None => (count / 2) as f64,
            };
            let n = count as f64;
            let step = |cell: usize| {
                let step = cell as f64 - apex;
                if periodic { step - n * (step / n).round() } else { step }
            };
            steps[axis] = (0..count).map(step).collect();
        }
        Ok(Offsets { dimension: cells.dimension, counts: cells.counts, spacing: cells.spacing, steps })
    }

    /// Distances from the apex.
    pub(super) fn distances(&self) -> Vec<f64> {
        self.map(f64::hypot)
    }

    /// One value for each cell, from its distances in x and y.
    fn map(&self, value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let [xs, ys] = [0, 1].map(|axis| self.steps[axis].iter().map(move |step| step * self.spacing[axis]));
        let xs: Vec<f64> = xs.collect();
        let mut values = Vec::with_capacity(xs.len() * ys.len());
        for y in ys {
            values.extend(xs.iter().map(|x| value(*x, y)));
        }
        values
    }
}

/// A position as a number of cells; one that is a centre or an edge of a cell to rounding is made so exactly, because
/// symmetry hangs on it.
fn place(center: f64, spacing: f64, count: usize) -> Result<f64, SurfaceError> {
    if !center.is_finite() {
        return Err(SurfaceError::Number { key: "center", found: center, expected: "a finite number" });
    }
    let halves = 2.0 * (center / spacing);
    let whole = halves.round();
    let near = (halves - whole).abs() <= 8.0 * f64::EPSILON * whole.abs().max(count as f64);
    Ok((if near { whole } else { halves } - 1.0) / 2.0)
}

fn positive(key: &'static str, found: f64) -> Result<f64, SurfaceError> {
    if found > 0.0 && found.is_finite() {
        return Ok(found);
    }
    Err(SurfaceError::Number { key, found, expected: "a finite number above 0" })
}

/// gap = r^2 / 2R.
pub(super) fn sphere(offsets: &Offsets, radius: f64) -> Result<Vec<f64>, SurfaceError> {
    let radius = positive("radius", radius)?;
    // Divided first: squares of lengths may leave the range of doubles where the gap does not.
    Ok(offsets.map(|x, y| x * (x / radius) / 2.0 + y * (y / radius) / 2.0))
}

/// gap = x^2 / 2R.
pub(super) fn cylinder(offsets: &Offsets, radius: f64) -> Result<Vec<f64>, SurfaceError> {
    let radius = positive("radius", radius)?;
    Ok(offsets.map(|x, _| x * (x / radius) / 2.0))
}

/// gap = r tan(angle), the angle in degrees.
pub(super) fn cone(offsets: &Offsets, angle: f64) -> Result<Vec<f64>, SurfaceError> {
    if !(angle > 0.0 && angle < 90.0) {
        return Err(SurfaceError::Number { key: "angle", found: angle, expected: "degrees between 0 and 90" });
    }
    let slope = angle.to_radians().tan();
    Ok(offsets.map(|x, y| x.hypot(y) * slope))
}

/// No gap where r <= width/2; a centre that lies on the edge to rounding is inside.
pub(super) fn flat_punch(offsets: &Offsets, width: f64) -> Result<Vec<f64>, SurfaceError> {
    let edge = positive("width", width)? / 2.0 * (1.0 + 8.0 * f64::EPSILON);
    let gap = offsets.map(|x, y| if x.hypot(y) <= edge { 0.0 } else { f64::INFINITY });
    if gap.iter().all(|gap| *gap > 0.0) {
        let nearest = offsets.map(f64::hypot).into_iter().fold(f64::INFINITY, f64::min);
        return Err(SurfaceError::NoCell { width, needed: 2.0 * nearest });
    }
    Ok(gap)
}

/// gap = amplitude (1 - cos X cos Y), with 1 - cos X cos Y = a + b - a b for a = 2 sin^2(X/2) and b = 2 sin^2(Y/2), which
/// keeps the digits of a small gap.
pub(super) fn wavy(offsets: &Offsets, amplitude: f64, waves: [u64; 2]) -> Result<Vec<f64>, SurfaceError> {
    if !(amplitude >= 0.0 && amplitude.is_finite()) {
        let expected = "a finite number of 0 or more";
        return Err(SurfaceError::Number { key: "amplitude", found: amplitude, expected });
    }
    let mut factors = [Vec::new(), vec![0.0; offsets.counts[1]]];
    for axis in 0..usize::from(offsets.dimension - 1) {
        let (count, found) = (offsets.counts[axis], waves[axis] as f64);
        let (cells, most) = (count as f64, count as f64 / 2.0);
        if found > most {
            let axis = ['x', 'y'][axis];
            return Err(SurfaceError::TooManyWaves { key: "waves", found, axis, cells: count, most });
        }
        // Whole turns are taken off before the division, which is exact.
        let turn = |step: &f64| found * step % cells / cells;
        factors[axis] = offsets.steps[axis].iter().map(|step| 2.0 * (TAU / 2.0 * turn(step)).sin().powi(2)).collect();
    }
    let [a, b] = &factors;
    let row = |b: f64| a.iter().map(move |a| amplitude * (a + b - a * b).max(0.0));
    Ok(b.iter().flat_map(|b| row(*b)).collect())
}
