//! Cells in contact, as a list: everything on the set is done on short arrays.

use std::ops::Range;

use rayon::prelude::*;

use super::convolve::Rows;
use super::passes::{WORTH, change, dot, sum};

/// Neighbours that are looked at together.
const BLOCK: usize = 32;
/// Rows that one thread does at a time.
pub const GROUP: usize = 16;

/// Cells of a window, in the order of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactSet {
    width: usize,
    /// Cells.
    pub cells: Vec<u32>,
    /// Where each row begins in `cells`, and the end of the last.
    starts: Vec<u32>,
    /// How many cells of the surface have the pressure of each; none: one each.
    weights: Vec<f64>,
}

impl ContactSet {
    /// The cells of a window `counts` that a function picks.
    pub fn of(counts: [usize; 2], mut pick: impl FnMut(usize) -> bool) -> ContactSet {
        let [width, rows] = counts;
        let mut set = ContactSet::with_rows(width, rows);
        for row in 0..rows {
            set.starts.push(set.cells.len() as u32);
            set.cells.extend((row * width..(row + 1) * width).filter(|cell| pick(*cell)).map(|cell| cell as u32));
        }
        set.starts.push(set.cells.len() as u32);
        set
    }

    /// The cells of a window of `width` columns with pressure, and those whose gap and displacement add up to less than
    /// `joins`.
    pub fn touching(threads: usize, width: usize, pressure: &[f64], gap: &[f64], u: &[f64], joins: f64) -> ContactSet {
        let rows = pressure.len() / width;
        let some = |rows: Range<usize>| ContactSet::touching_in(rows, width, pressure, gap, u, joins);
        if threads <= 1 || pressure.len() < WORTH {
            return some(0..rows);
        }
        let groups = (0..rows.div_ceil(GROUP)).into_par_iter();
        let parts: Vec<ContactSet> = groups.map(|group| some(group * GROUP..rows.min((group + 1) * GROUP))).collect();
        let mut set = ContactSet::with_rows(width, rows);
        set.cells.reserve_exact(parts.iter().map(ContactSet::len).sum());
        for part in parts {
            let before = set.cells.len() as u32;
            set.starts.extend(part.starts[..part.starts.len() - 1].iter().map(|start| before + start));
            set.cells.extend(part.cells);
        }
        set.starts.push(set.cells.len() as u32);
        set
    }

    /// Those in some rows.
    fn touching_in(
        rows: Range<usize>,
        width: usize,
        pressure: &[f64],
        gap: &[f64],
        u: &[f64],
        joins: f64,
    ) -> ContactSet {
        let mut set = ContactSet::with_rows(width, rows.len());
        for row in rows {
            set.starts.push(set.cells.len() as u32);
            for first in (0..width).step_by(BLOCK) {
                let cells = row * width + first..row * width + width.min(first + BLOCK);
                let (pressure, gap, u) = (&pressure[cells.clone()], &gap[cells.clone()], &u[cells.clone()]);
                let all = pressure.iter().zip(gap.iter().zip(u));
                let mut all = all.map(|(pressure, (gap, u))| (*pressure > 0.0) | (gap + u < joins));
                // Without a branch for each cell, because most blocks have none.
                if all.clone().fold(false, |any, on| any | on) {
                    set.cells.extend(cells.filter(|_| all.next() == Some(true)).map(|cell| cell as u32));
                }
            }
        }
        set.starts.push(set.cells.len() as u32);
        set
    }

    /// No cells yet, and room for some rows.
    fn with_rows(width: usize, rows: usize) -> ContactSet {
        ContactSet { width, cells: Vec::new(), starts: Vec::with_capacity(rows + 1), weights: Vec::new() }
    }

    /// The same with the weights of the window's cells, where it has some.
    pub fn weighed(mut self, threads: usize, weights: &[f64]) -> ContactSet {
        if !weights.is_empty() {
            self.weights = self.gather(threads, weights);
        }
        self
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// How many cells of the surface have the pressure of one of the set.
    #[inline]
    pub fn weight(&self, at: usize) -> f64 {
        if self.weights.is_empty() { 1.0 } else { self.weights[at] }
    }

    /// Number of cells of the surface.
    pub fn size(&self) -> f64 {
        if self.weights.is_empty() { self.len() as f64 } else { self.weights.iter().sum() }
    }

    /// Sum of a function over the cells of the surface.
    pub fn sum(&self, threads: usize, of: impl Fn(usize) -> f64 + Sync) -> f64 {
        if self.weights.is_empty() {
            sum(threads, self.len(), of)
        } else {
            sum(threads, self.len(), |at| self.weights[at] * of(at))
        }
    }

    /// Sum of products over the cells of the surface.
    pub fn dot(&self, threads: usize, a: &[f64], b: &[f64]) -> f64 {
        if self.weights.is_empty() {
            dot(threads, a, b)
        } else {
            sum(threads, self.len(), |at| self.weights[at] * (a[at] * b[at]))
        }
    }

    /// The values of an array over the window on the set.
    pub fn gather(&self, threads: usize, from: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.len()];
        self.gather_into(threads, from, &mut values);
        values
    }

    /// The same, into an array on the set.
    pub fn gather_into(&self, threads: usize, from: &[f64], to: &mut [f64]) {
        change(threads, to, |at, _| from[self.cells[at] as usize]);
    }

    /// Writes values on the set into an array over the window.
    pub fn scatter(&self, threads: usize, values: &[f64], to: &mut [f64]) {
        self.in_rows(threads, self.width, to, |group, to| {
            let first = group.rows.start * self.width;
            for (cell, value) in self.cells[group.cells.clone()].iter().zip(&values[group.cells]) {
                to[*cell as usize - first] = *value;
            }
        });
    }

    /// Does something with groups of rows and their parts of an array over the set, at the same time where that pays.
    pub fn in_groups<T: Send, R: Send>(
        &self,
        threads: usize,
        of: &mut [T],
        act: impl Fn(Group, &mut [T]) -> R + Sync,
    ) -> Vec<R> {
        let rows = self.starts.len() - 1;
        if threads <= 1 || self.len() < WORTH {
            return vec![act(self.group(0..rows), of)];
        }
        let mut rest = of;
        let mut parts = Vec::with_capacity(rows.div_ceil(GROUP));
        for first in (0..rows).step_by(GROUP) {
            let group = self.group(first..rows.min(first + GROUP));
            let (part, others) = rest.split_at_mut(group.cells.len());
            parts.push((group, part));
            rest = others;
        }
        parts.into_par_iter().map(|(group, part)| act(group, part)).collect()
    }

    /// The same with an array that has so many numbers for each row.
    pub fn in_rows<T: Send>(&self, threads: usize, width: usize, of: &mut [T], act: impl Fn(Group, &mut [T]) + Sync) {
        let rows = self.starts.len() - 1;
        if threads <= 1 || self.len() < WORTH {
            return act(self.group(0..rows), of);
        }
        of.par_chunks_mut(GROUP * width).enumerate().for_each(|(group, part)| {
            act(self.group(group * GROUP..rows.min((group + 1) * GROUP)), part);
        });
    }

    /// Some rows and their cells.
    fn group(&self, rows: Range<usize>) -> Group {
        Group { cells: self.starts[rows.start] as usize..self.starts[rows.end] as usize, rows }
    }

    /// The part of a row: its first place in arrays on the set, and its cells.
    pub fn row(&self, row: usize) -> (usize, &[u32]) {
        let (begin, end) = (self.starts[row] as usize, self.starts[row + 1] as usize);
        (begin, &self.cells[begin..end])
    }
}

/// Rows next to each other.
pub struct Group {
    /// The rows.
    pub rows: Range<usize>,
    /// Places of their cells in arrays on the set.
    pub cells: Range<usize>,
}

/// Values on a set as input of a convolution, which answers on the whole window.
pub struct FromSet<'a>(pub OnSet<'a>);

impl Rows for FromSet<'_> {
    fn start(&self, row: usize) -> usize {
        row * self.0.set.width
    }

    fn read(&self, row: usize, values: &mut [f64]) -> bool {
        self.0.read(row, values)
    }

    fn write(&self, _: usize, values: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&values[..out.len()]);
    }
}

/// Values on a set as input of a convolution, which answers on the set.
pub struct OnSet<'a> {
    /// The set.
    pub set: &'a ContactSet,
    /// Values on it.
    pub values: &'a [f64],
}

impl Rows for OnSet<'_> {
    fn start(&self, row: usize) -> usize {
        self.set.starts[row] as usize
    }

    fn read(&self, row: usize, values: &mut [f64]) -> bool {
        let (begin, cells) = self.set.row(row);
        let first = row * self.set.width;
        for (cell, value) in cells.iter().zip(&self.values[begin..]) {
            values[*cell as usize - first] = *value;
        }
        !cells.is_empty()
    }

    fn write(&self, row: usize, values: &[f64], out: &mut [f64]) {
        let first = row * self.set.width;
        for (out, cell) in out.iter_mut().zip(self.set.row(row).1) {
            *out = values[*cell as usize - first];
        }
    }
}
