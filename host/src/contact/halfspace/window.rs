//! Rectangles of cells that hold the contact.

use super::Boundary;
use super::kernel::{Kernel, Sizes};

/// A rectangle of the cells; beyond the last column or row of a periodic surface it goes on with the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// First column and row.
    pub origin: [usize; 2],
    /// Cells in x and y, and in the grid of its transforms.
    pub sizes: Sizes,
    /// Cells of the whole surface.
    pub all: [usize; 2],
}

impl Window {
    /// All cells.
    pub fn whole(kernel: &Kernel) -> Window {
        Window { origin: [0, 0], sizes: kernel.sizes(kernel.counts), all: kernel.counts }
    }

    /// Around the cells that a function picks, and a margin; `None`: there are none.
    pub fn around(kernel: &Kernel, margin: [usize; 2], pick: impl Fn(usize) -> bool) -> Option<Window> {
        let all = kernel.counts;
        let mut taken = all.map(|count| vec![false; count]);
        let [columns, rows] = &mut taken;
        for (y, row) in rows.iter_mut().enumerate() {
            for (x, column) in columns.iter_mut().enumerate() {
                if pick(y * all[0] + x) {
                    (*column, *row) = (true, true);
                }
            }
        }
        let periodic = kernel.boundary == Boundary::Periodic;
        let mut ranges = [(0, 0); 2];
        for (axis, taken) in taken.iter().enumerate() {
            ranges[axis] = span(taken, periodic)?;
        }
        Some(Window::over(
            kernel,
            ranges.map(|range| range.0),
            [0, 1].map(|axis| ranges[axis].1 + 2 * margin[axis]),
            margin,
        ))
    }

    /// Over `counts` cells and what makes full use of the transforms, the first `before` cells being margin.
    pub fn over(kernel: &Kernel, first: [usize; 2], counts: [usize; 2], before: [usize; 2]) -> Window {
        let all = kernel.counts;
        let sizes = kernel.sizes(counts);
        let along = |axis: usize| {
            let (count, all) = (sizes.0[axis], all[axis]);
            // What the transforms hold beyond what was asked for goes to both sides.
            let before = before[axis] + count.saturating_sub(counts[axis]) / 2;
            match kernel.boundary {
                _ if count == all => 0,
                Boundary::Periodic => (first[axis] + 2 * all - before.min(all)) % all,
                Boundary::Free => first[axis].saturating_sub(before).min(all - count),
            }
        };
        Window { origin: [along(0), along(1)], sizes, all }
    }

    /// Whether it is everything.
    pub fn is_whole(&self) -> bool {
        self.sizes.0 == self.all
    }

    /// Along which axes it is the whole of a period.
    pub fn wraps(&self, boundary: Boundary) -> [bool; 2] {
        [0, 1].map(|axis| boundary == Boundary::Periodic && self.sizes.1[axis] == self.all[axis])
    }

    /// The place in the window of a column and row of the surface.
    pub fn place(&self, at: [usize; 2]) -> Option<usize> {
        let along = |axis: usize| (at[axis] + self.all[axis] - self.origin[axis]) % self.all[axis];
        let [x, y] = [along(0), along(1)];
        let [nx, ny] = self.sizes.0;
        (x < nx && y < ny).then_some(y * nx + x)
    }

    /// The cells of the surface under the window, in the order of the window.
    pub fn cells(&self) -> impl Iterator<Item = usize> + '_ {
        let ([nx, ny], [all_x, all_y]) = (self.sizes.0, self.all);
        (0..ny).flat_map(move |y| {
            let row = (self.origin[1] + y) % all_y * all_x;
            (0..nx).map(move |x| row + (self.origin[0] + x) % all_x)
        })
    }
}

/// The shortest range with all that is taken, across the end if it is periodic: its first and its length.
fn span(taken: &[bool], periodic: bool) -> Option<(usize, usize)> {
    let count = taken.len();
    let (first, last) = (taken.iter().position(|t| *t)?, taken.iter().rposition(|t| *t)?);
    let mut best = (first, last + 1 - first);
    if periodic {
        // The longest gap between two that are taken; the range is the rest.
        let mut from = first;
        for at in (first + 1..=last).filter(|at| taken[*at]) {
            if count - (at - from) + 1 < best.1 {
                best = (at, count - (at - from) + 1);
            }
            from = at;
        }
    }
    Some(best)
}
