//! A contact problem on a window of the cells, with the operator A + b on it.

use super::Boundary;
use super::contact_set::{ContactSet, OnSet};
use super::convolve::{Convolution, Dense};
use super::kernel::Kernel;
use super::local::smoothed;

/// A problem on a window, in scaled units, gaps counted from the datum of the problem.
pub struct Patch<'a> {
    /// The compliance of the cells.
    pub kernel: &'a Kernel,
    /// Its convolution over the window.
    pub convolution: &'a mut Convolution,
    /// Cells in x and y.
    pub counts: [usize; 2],
    /// Along which axes it is the whole of a periodic surface.
    pub wraps: [bool; 2],
    /// Gap `[cells]`, infinite where nothing can touch.
    pub gap: Vec<f64>,
    /// Local compliance `[cells]`, or one for all, or none.
    pub local: Vec<f64>,
    /// Whether that acts on the smoothed pressure.
    pub smoothed: bool,
    /// Sum of all pressures; if there is none, the approach is 0.
    pub sum: Option<f64>,
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
            smoothed(self.counts, self.sides(), pressure, &mut smooth);
            out.iter_mut().enumerate().for_each(|(cell, out)| *out += self.local(cell) * smooth[cell]);
        } else {
            out.iter_mut().enumerate().for_each(|(cell, out)| *out += self.local(cell) * pressure[cell]);
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
            set.scatter(values, &mut field);
            smoothed(self.counts, self.sides(), &field, &mut smooth);
            for (out, cell) in out.iter_mut().zip(&set.cells) {
                *out += self.local(*cell as usize) * smooth[*cell as usize];
            }
        } else {
            for ((out, value), cell) in out.iter_mut().zip(values).zip(&set.cells) {
                *out += self.local(*cell as usize) * value;
            }
        }
    }

    /// What is beyond the sides of the window: itself or no pressure.
    fn sides(&self) -> [Boundary; 2] {
        self.wraps.map(|wraps| if wraps { Boundary::Periodic } else { Boundary::Free })
    }
}
