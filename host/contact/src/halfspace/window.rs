//! Rectangles of cells that hold the contact.

use std::ops::Range;

use super::Boundary;
use super::kernel::{Kernel, Sizes};
use super::mirror::Half;
use super::passes::sum;
use super::room::Room;

/// A rectangle of the cells; beyond the last column or row of a periodic surface it goes on with the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// First column and row, of those that are solved for.
    pub origin: [usize; 2],
    /// Cells in x and y, and in the grid of its transforms.
    pub sizes: Sizes,
    /// The cells that are solved for.
    pub half: Half,
}

impl Window {
    /// All cells.
    pub fn whole(kernel: &Kernel) -> Window {
        let half = kernel.half();
        Window { origin: [0, 0], sizes: kernel.sizes(half.counts), half }
    }

    /// Around what an extent covers, and a margin; `None`: that is nothing.
    pub fn around(kernel: &Kernel, margin: [usize; 2], extent: &Extent) -> Option<Window> {
        let (first, counts) = extent.range(kernel.boundary)?;
        let sides = kernel.mirrored.map(|mirrored| if mirrored { 1 } else { 2 });
        Some(Window::over(kernel, first, [0, 1].map(|axis| counts[axis] + sides[axis] * margin[axis]), margin))
    }

    /// Around the cells that overlap without pressure at an approach of 0, or else the lowest.
    pub fn lowest(kernel: &Kernel, gap: impl Fn(usize) -> f64) -> Window {
        let cells = kernel.counts[0] * kernel.counts[1];
        let lowest = (0..cells).map(&gap).fold(f64::INFINITY, f64::min);
        let extent = Extent::of(&kernel.half(), |cell| gap(cell) < 0.0 || gap(cell) == lowest);
        Window::around(kernel, [2, 2], &extent).unwrap_or_else(|| Window::whole(kernel))
    }

    /// Over `counts` cells and what makes full use of the transforms, the first `before` cells being margin.
    pub fn over(kernel: &Kernel, first: [usize; 2], counts: [usize; 2], before: [usize; 2]) -> Window {
        let half = kernel.half();
        let (all, sizes) = (half.counts, kernel.sizes(counts));
        let along = |axis: usize| {
            let (count, all) = (sizes.0[axis], all[axis]);
            // What the transforms hold beyond what was asked for goes to both sides.
            let before = before[axis] + count.saturating_sub(counts[axis]) / 2;
            match kernel.boundary {
                _ if count == all || half.mirrored[axis] => 0,
                Boundary::Periodic => (first[axis] + 2 * all - before.min(all)) % all,
                Boundary::Free => first[axis].saturating_sub(before).min(all - count),
            }
        };
        Window { origin: [along(0), along(1)], sizes, half }
    }

    /// Whether it is everything.
    pub fn is_whole(&self) -> bool {
        self.covers_half() && self.half.is_complete(0) && self.half.is_complete(1)
    }

    /// Whether it is all that is solved for.
    pub fn covers_half(&self) -> bool {
        self.sizes.0 == self.half.counts
    }

    /// Along which axes it is the whole of a period, or of half of one.
    pub fn wraps(&self, boundary: Boundary) -> [bool; 2] {
        [0, 1].map(|axis| boundary == Boundary::Periodic && self.sizes.0[axis] == self.half.counts[axis])
    }

    /// On which sides of each axis the surface goes on beyond it.
    pub fn cut(&self, boundary: Boundary) -> [[bool; 2]; 2] {
        [0, 1].map(|axis| {
            let (count, all, first) = (self.sizes.0[axis], self.half.counts[axis], self.origin[axis]);
            let on = boundary == Boundary::Periodic && count < all;
            let before = !self.half.mirrored[axis] && (on || first > 0);
            [before, on || first + count < all || !self.half.is_complete(axis)]
        })
    }

    /// How many cells of the surface have the value of each `[cells]`, where there is a mirror.
    pub fn weights(&self, room: &mut Room) -> Vec<f64> {
        if !self.half.is_part() {
            return Vec::new();
        }
        let [nx, ny] = self.sizes.0;
        let mut weights = room.take(nx * ny);
        for (y, row) in weights.chunks_exact_mut(nx).enumerate() {
            row.iter_mut().enumerate().for_each(|(x, weight)| *weight = self.weight([x, y]));
        }
        weights
    }

    /// How many cells of the surface have the value of the cell in this column and row of the window.
    fn weight(&self, at: [usize; 2]) -> f64 {
        self.half.weight([0, 1].map(|axis| self.origin[axis] + at[axis]))
    }

    /// Sum of values over the cells of the surface.
    pub fn sum(&self, threads: usize, values: &[f64]) -> f64 {
        if self.half.is_part() {
            let nx = self.sizes.0[0];
            sum(threads, values.len(), |place| self.weight([place % nx, place / nx]) * values[place])
        } else {
            sum(threads, values.len(), |place| values[place])
        }
    }

    /// The place in the window of a column and row, of those that are solved for.
    #[inline]
    pub fn place(&self, at: [usize; 2]) -> Option<usize> {
        let along = |axis: usize| {
            let (at, origin) = (at[axis], self.origin[axis]);
            if at >= origin { at - origin } else { at + self.half.counts[axis] - origin }
        };
        let [x, y] = [along(0), along(1)];
        let [nx, ny] = self.sizes.0;
        (x < nx && y < ny).then_some(y * nx + x)
    }

    /// The column and row at a place in the window, of those that are solved for.
    #[inline]
    pub fn at(&self, place: usize) -> [usize; 2] {
        let nx = self.sizes.0[0];
        let along = |at: usize, axis: usize| {
            let at = at + self.origin[axis];
            if at < self.half.counts[axis] { at } else { at - self.half.counts[axis] }
        };
        [along(place % nx, 0), along(place / nx, 1)]
    }

    /// The cells of the surface under the window, in the order of the window, as ranges.
    pub fn ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let ([nx, ny], [all_x, all_y]) = (self.sizes.0, self.half.full);
        let [left, low] = [0, 1].map(|axis| self.origin[axis] + self.half.base(axis));
        let first = nx.min(all_x - left);
        (0..ny).flat_map(move |y| {
            let row = (low + y) % all_y * all_x;
            let begin = row + left;
            [begin..begin + first, row..row + nx - first]
        })
    }

    /// The same, into an array over the window.
    pub fn gather_into<T>(&self, of: impl Fn(usize) -> T, to: &mut [T]) {
        let mut rest = to;
        for range in self.ranges() {
            let (part, others) = std::mem::take(&mut rest).split_at_mut(range.len());
            part.iter_mut().zip(range).for_each(|(to, cell)| *to = of(cell));
            rest = others;
        }
    }

    /// The values of an array over the surface under the window.
    pub fn gather<T>(&self, of: impl Fn(usize) -> T) -> Vec<T> {
        let mut values = Vec::with_capacity(self.sizes.0[0] * self.sizes.0[1]);
        self.ranges().for_each(|range| values.extend(range.map(&of)));
        values
    }
}

/// Which columns and rows something touches.
#[derive(Clone, Debug)]
pub struct Extent {
    columns: Vec<bool>,
    rows: Vec<bool>,
    mirrored: [bool; 2],
}

impl Extent {
    /// Of nothing.
    pub fn empty(half: &Half) -> Extent {
        let [columns, rows] = half.counts.map(|count| vec![false; count]);
        Extent { columns, rows, mirrored: half.mirrored }
    }

    /// Of the cells of the surface that a function picks, among those that are solved for.
    pub fn of(half: &Half, pick: impl Fn(usize) -> bool) -> Extent {
        let mut extent = Extent::empty(half);
        for (y, row) in extent.rows.iter_mut().enumerate() {
            for (x, column) in extent.columns.iter_mut().enumerate() {
                if pick(half.cell([x, y])) {
                    (*column, *row) = (true, true);
                }
            }
        }
        extent
    }

    /// Takes one more cell.
    pub fn mark(&mut self, [x, y]: [usize; 2]) {
        (self.columns[x], self.rows[y]) = (true, true);
    }

    /// Takes the loaded cells of a window.
    pub fn mark_loaded(&mut self, window: &Window, pressure: &[f64]) {
        for (place, _) in pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            self.mark(window.at(place));
        }
    }

    /// The smallest rectangle around it, from a mirror on if there is one: its first column and row, and its size.
    pub fn range(&self, boundary: Boundary) -> Option<([usize; 2], [usize; 2])> {
        let periodic = boundary == Boundary::Periodic;
        let along = |taken: &[bool], mirrored: bool| {
            if mirrored { taken.iter().rposition(|t| *t).map(|last| (0, last + 1)) } else { span(taken, periodic) }
        };
        let (x, y) = (along(&self.columns, self.mirrored[0])?, along(&self.rows, self.mirrored[1])?);
        Some(([x.0, y.0], [x.1, y.1]))
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
