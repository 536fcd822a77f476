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
        let (first, counts) = range(kernel, pick)?;
        Some(Window::over(kernel, first, [0, 1].map(|axis| counts[axis] + 2 * margin[axis]), margin))
    }

    /// Around the cells that overlap without pressure at an approach of 0, or else the lowest.
    pub fn lowest(kernel: &Kernel, gap: impl Fn(usize) -> f64) -> Window {
        let cells = kernel.counts[0] * kernel.counts[1];
        let lowest = (0..cells).map(&gap).fold(f64::INFINITY, f64::min);
        Window::around(kernel, [2, 2], |cell| gap(cell) < 0.0 || gap(cell) == lowest)
            .unwrap_or_else(|| Window::whole(kernel))
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

/// The smallest rectangle with all cells that a function picks: its first column and row, and its size.
pub fn range(kernel: &Kernel, pick: impl Fn(usize) -> bool) -> Option<([usize; 2], [usize; 2])> {
    let [nx, ny] = kernel.counts;
    let (mut columns, mut rows) = (vec![false; nx], vec![false; ny]);
    for (y, row) in rows.iter_mut().enumerate() {
        for (x, column) in columns.iter_mut().enumerate() {
            if pick(y * nx + x) {
                (*column, *row) = (true, true);
            }
        }
    }
    let periodic = kernel.boundary == Boundary::Periodic;
    let (x, y) = (span(&columns, periodic)?, span(&rows, periodic)?);
    Some(([x.0, y.0], [x.1, y.1]))
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
