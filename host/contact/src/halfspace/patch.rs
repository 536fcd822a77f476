//! A contact problem on a window of the cells, with the operator A + b on it.

use super::contact_set::{ContactSet, FromSet, OnSet};
use super::convolve::{Convolution, Dense};
use super::kernel::Kernel;
use super::passes::{add, change};
use super::room::Room;
use crate::averaged_twice;

/// A problem on a window, in scaled units, gaps counted from the datum of the problem.
pub struct Patch<'a> {
    /// The compliance of the cells.
    pub kernel: &'a Kernel,
    /// Its convolution over the window.
    pub convolution: &'a mut Convolution,
    /// Cells in x and y.
    pub counts: [usize; 2],
    /// Along which axes it is the whole of a periodic surface, or of half of one.
    pub wraps: [bool; 2],
    /// Gap `[cells]`, infinite where nothing can touch.
    pub gap: Vec<f64>,
    /// Local compliance `[cells]`, or one for all, or none.
    pub local: Vec<f64>,
    /// How many cells of the surface have the pressure of a cell `[cells]`; none: one each.
    pub weights: Vec<f64>,
    /// Whether the local compliance acts on the smoothed pressure.
    pub smoothed: bool,
    /// Sum of all pressures; if there is none, the approach is 0.
    pub sum: Option<f64>,
    /// Along which axes, and there on which side, the surface goes on beyond it.
    pub cut: [[bool; 2]; 2],
    /// Arrays to work with.
    pub room: Room,
    /// Threads.
    pub threads: usize,
    /// Pairs of transforms so far.
    pub pairs: u64,
}

impl Patch<'_> {
    /// Local compliance of a cell.
    #[inline]
    pub fn local(&self, cell: usize) -> f64 {
        match self.local[..] {
            [] => 0.0,
            [one] => one,
            _ => self.local[cell],
        }
    }

    /// How many cells of the surface have the pressure of a cell.
    #[inline]
    pub fn weight(&self, cell: usize) -> f64 {
        if self.weights.is_empty() { 1.0 } else { self.weights[cell] }
    }

    /// Whether the local compliance is not the same everywhere.
    pub fn varies(&self) -> bool {
        self.local.len() > 1
    }

    /// Whether A + b is symmetric.
    pub fn symmetric(&self) -> bool {
        !(self.smoothed && self.varies())
    }

    /// out = (A + b) p over the window.
    pub fn evaluate(&mut self, pressure: &[f64], out: &mut [f64]) {
        self.convolution.apply(&Dense { width: self.counts[0], input: pressure }, out);
        self.pairs += 1;
        if self.local.is_empty() {
            return;
        }
        if self.smoothed {
            let mut smooth = vec![0.0; pressure.len()];
            averaged_twice(self.counts, self.wraps, pressure, &mut smooth);
            out.iter_mut().enumerate().for_each(|(cell, out)| *out += self.local(cell) * smooth[cell]);
        } else if let [uniform] = self.local[..] {
            add(self.threads, out, uniform, pressure);
        } else {
            change(self.threads, out, |cell, out| out + self.local[cell] * pressure[cell]);
        }
    }

    /// out = (A + b) times values on a set, on the set.
    pub fn image(&mut self, set: &ContactSet, values: &[f64], out: &mut [f64]) {
        self.convolution.apply(&OnSet { set, values }, out);
        self.pairs += 1;
        if self.local.is_empty() {
            return;
        }
        if self.smoothed {
            let (mut field, mut smooth) = (vec![0.0; self.gap.len()], vec![0.0; self.gap.len()]);
            set.scatter(self.threads, values, &mut field);
            averaged_twice(self.counts, self.wraps, &field, &mut smooth);
            for (out, cell) in out.iter_mut().zip(&set.cells) {
                *out += self.local(*cell as usize) * smooth[*cell as usize];
            }
        } else {
            change(self.threads, out, |at, out| out + self.local(set.cells[at] as usize) * values[at]);
        }
    }

    /// out = (A + b) times values on a set, over the window.
    pub fn image_over(&mut self, set: &ContactSet, values: &[f64], out: &mut [f64]) {
        self.convolution.apply(&FromSet(OnSet { set, values }), out);
        self.pairs += 1;
        if self.local.is_empty() {
            return;
        }
        if self.smoothed {
            let (mut field, mut smooth) = (vec![0.0; out.len()], vec![0.0; out.len()]);
            set.scatter(self.threads, values, &mut field);
            averaged_twice(self.counts, self.wraps, &field, &mut smooth);
            out.iter_mut().enumerate().for_each(|(cell, out)| *out += self.local(cell) * smooth[cell]);
        } else {
            set.in_rows(self.threads, self.counts[0], out, |group, out| {
                let first = group.rows.start * self.counts[0];
                for (cell, value) in set.cells[group.cells.clone()].iter().zip(&values[group.cells]) {
                    let cell = *cell as usize;
                    out[cell - first] += self.local(cell) * value;
                }
            });
        }
    }

    /// Whether there is pressure where the surface goes on beyond the window.
    pub fn is_outgrown(&self, pressure: &[f64]) -> bool {
        let [nx, ny] = self.counts;
        let column = |x: usize| (0..ny).any(|y| pressure[y * nx + x] > 0.0);
        let row = |y: usize| pressure[y * nx..(y + 1) * nx].iter().any(|p| *p > 0.0);
        let [x, y] = self.cut;
        x[0] && column(0) || x[1] && column(nx - 1) || y[0] && row(0) || y[1] && row(ny - 1)
    }
}
