//! Mirror symmetry: what is its own mirror image about the centre of cell n/2 is solved on that cell and one side of it.
//!
//! Sums over all cells then count each cell by its images, so that the search takes the steps that it would take on all of
//! them.

use super::{Boundary, HalfSpace};
use crate::{Cells, Control, Diagonal, Problem};

/// Fewest cells along an axis that is worth a mirror.
const FEWEST: usize = 16;
/// Cells between a contact and the end of a surface whose first cells have no image, at which a mirror is given up before it
/// has to be.
const NEAR_END: usize = 2;

/// The cells of a surface that a problem is solved on: all of them, or those on one side of a mirror, with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Half {
    /// Cells of the surface in x and y.
    pub full: [usize; 2],
    /// Along which axes there is a mirror.
    pub mirrored: [bool; 2],
    /// Cells that are solved for, in x and y.
    pub counts: [usize; 2],
}

impl Half {
    /// Of a surface.
    pub fn new(full: [usize; 2], mirrored: [bool; 2], boundary: Boundary) -> Half {
        let along = |axis: usize| match (mirrored[axis], boundary) {
            (false, _) => full[axis],
            (true, Boundary::Free) => full[axis] - full[axis] / 2,
            // The cell half a period away is its own image.
            (true, Boundary::Periodic) => full[axis] / 2 + 1,
        };
        Half { full, mirrored, counts: [along(0), along(1)] }
    }

    /// Whether there is a mirror at all.
    pub fn is_part(&self) -> bool {
        self.mirrored != [false; 2]
    }

    /// Whether every cell of the surface along an axis is among these or an image of one.
    pub fn is_complete(&self, axis: usize) -> bool {
        !self.mirrored[axis] || self.counts[axis] > self.full[axis] / 2
    }

    /// Where the first of them lies along an axis of the surface.
    pub fn base(&self, axis: usize) -> usize {
        if self.mirrored[axis] { self.full[axis] / 2 } else { 0 }
    }

    /// The column and row of the surface.
    #[inline]
    pub fn unfold(&self, at: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|axis| {
            let at = self.base(axis) + at[axis];
            if at < self.full[axis] { at } else { at - self.full[axis] }
        })
    }

    /// The cell of the surface.
    #[inline]
    pub fn cell(&self, at: [usize; 2]) -> usize {
        let [x, y] = self.unfold(at);
        y * self.full[0] + x
    }

    /// Where a column and row of the surface are among these, or their image is; `None`: they have none.
    #[inline]
    pub fn fold(&self, at: [usize; 2]) -> Option<[usize; 2]> {
        let folded = [0, 1].map(|axis| if self.mirrored[axis] { self.base(axis).abs_diff(at[axis]) } else { at[axis] });
        (folded[0] < self.counts[0] && folded[1] < self.counts[1]).then_some(folded)
    }

    /// The image of a column or row of the surface that is among these, or itself.
    pub fn image(&self, axis: usize, at: usize) -> usize {
        if self.mirrored[axis] && at > self.base(axis) { 2 * self.base(axis) - at } else { at }
    }

    /// How many cells of the surface have the value of this one.
    #[inline]
    pub fn weight(&self, at: [usize; 2]) -> f64 {
        let along = |axis: usize| {
            let (at, full) = (at[axis], self.full[axis]);
            if self.mirrored[axis] && at > 0 && 2 * at != full { 2.0 } else { 1.0 }
        };
        along(0) * along(1)
    }
}

/// Along which axes a gap `[cells]` is its own mirror image about the centre of cell n/2, to the bit, so that contact on it is
/// solved on one side of that cell alone, with it.
#[must_use]
pub fn mirrors(cells: &Cells, boundary: Boundary, gap: &[f64]) -> [bool; 2] {
    [0, 1].map(|axis| {
        let count = cells.counts[axis];
        let fits = boundary == Boundary::Free || count.is_multiple_of(2);
        count >= FEWEST && fits && is_mirrored(cells.counts, axis, gap)
    })
}

/// Along which axes a problem and the pressures to start from are their own mirror image, to the bit.
pub fn of(model: &HalfSpace, problem: &Problem<'_>, pressure: &[f64]) -> [bool; 2] {
    let (full, boundary) = (model.cells.counts, model.kernel.boundary);
    if problem.frozen.is_some() || problem.smoothed && problem.diagonal != Diagonal::Zero {
        return [false; 2];
    }
    let mut mirrored = mirrors(&model.cells, boundary, problem.gap);
    for (axis, mirrored) in mirrored.iter_mut().enumerate().filter(|(_, mirrored)| **mirrored) {
        *mirrored = is_mirrored(full, axis, pressure);
        if let Diagonal::PerPoint(values) = problem.diagonal {
            *mirrored &= is_mirrored(full, axis, values);
        }
    }
    for axis in [0, 1] {
        let half = Half::new(full, mirrored, boundary);
        if !half.is_complete(axis) && reaches_far(&half, axis, problem, pressure) {
            mirrored[axis] = false;
        }
    }
    mirrored
}

/// Whether the values of a surface are their own mirror image along an axis; cells without an image count as if they were.
fn is_mirrored([nx, ny]: [usize; 2], axis: usize, values: &[f64]) -> bool {
    let middle = [nx, ny][axis] / 2;
    if axis == 0 {
        return values.chunks_exact(nx).all(|row| {
            let right = &row[middle + 1..];
            row[..middle].iter().rev().zip(right).all(|(a, b)| a == b)
        });
    }
    let row = |y: usize| &values[y * nx..(y + 1) * nx];
    (1..ny - middle).all(|away| row(middle - away) == row(middle + away))
}

/// Whether a contact is about to reach the end of a surface along an axis, as far as its start and approach tell.
fn reaches_far(half: &Half, axis: usize, problem: &Problem<'_>, pressure: &[f64]) -> bool {
    let (nx, far) = (half.full[0], half.counts[axis] - NEAR_END);
    let held = if let Control::Approach(approach) = problem.control { approach } else { f64::NEG_INFINITY };
    let loaded = pressure.iter().zip(problem.gap).enumerate().filter(|(_, (p, gap))| **p > 0.0 || **gap < held);
    loaded.into_iter().any(|(cell, _)| [cell % nx, cell / nx][axis].abs_diff(half.base(axis)) >= far)
}
