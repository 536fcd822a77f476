//! The compliance of a grid of cells, ready to be convolved over windows of it.

use super::Boundary;
use super::convolve::Convolution;
use super::influence;
use super::mirror::Half;
use super::symbol::Quarter;
use crate::Instructions;

/// The compliance of equal cells in scaled units.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// Whether it is 2-D.
    pub flat: bool,
    /// What is beyond the cells.
    pub boundary: Boundary,
    /// Cells in x and y.
    pub counts: [usize; 2],
    /// Lengths of a cell.
    pub spacing: [f64; 2],
    /// The unit of moduli over the modulus.
    pub soft: f64,
    /// Distance at which the displacement is zero; 2-D with a free boundary only.
    pub datum: f64,
    /// Along which axes only one side of a mirror is solved for; see [`mirror`](super::mirror).
    pub mirrored: [bool; 2],
    /// What transforms are made with.
    pub instructions: Instructions,
    /// The compliance at all lags, once it was needed; periodic only.
    lags: Option<Quarter>,
    /// The least of all, once it was needed.
    least: Option<f64>,
}

/// Windows that share the transforms of a period come in multiples of this many cells.
const SHARE: usize = 8;

/// Cells of a window and of the grid that its transforms are made on.
pub type Sizes = ([usize; 2], [usize; 2]);

impl Kernel {
    /// Of cells in these units.
    pub fn new(flat: bool, boundary: Boundary, counts: [usize; 2], spacing: [f64; 2], soft: f64, datum: f64) -> Kernel {
        let instructions = Instructions::in_use();
        let mirrored = [false; 2];
        Kernel { flat, boundary, counts, spacing, soft, datum, mirrored, instructions, lags: None, least: None }
    }

    /// Displacement per pressure of a mode of a periodic surface with this many cells.
    pub fn mode(&self, k: [usize; 2], counts: [usize; 2]) -> f64 {
        self.soft * influence::mode(k, counts, self.spacing)
    }

    /// Displacement per pressure at a lag on a free boundary.
    fn free(&self, lag: [usize; 2]) -> f64 {
        let [x, y] = [lag[0] as f64 * self.spacing[0], lag[1] as f64 * self.spacing[1]];
        let one = if self.flat {
            influence::strip(x, self.spacing[0], self.datum)
        } else {
            influence::rectangle(x, y, self.spacing[0], self.spacing[1])
        };
        self.soft * one
    }

    /// Least displacement per pressure of any cell on any other.
    pub fn least(&mut self) -> f64 {
        if let Some(least) = self.least {
            return least;
        }
        let least = match self.boundary {
            Boundary::Free => self.free(self.counts.map(|count| count - 1)),
            Boundary::Periodic => self.lags().values.iter().copied().fold(f64::INFINITY, f64::min),
        };
        *self.least.insert(least)
    }

    /// The compliance at all lags of a period.
    fn lags(&mut self) -> &Quarter {
        let (counts, spacing, soft, set) = (self.counts, self.spacing, self.soft, self.instructions);
        self.lags.get_or_insert_with(|| {
            let cells = (counts[0] * counts[1]) as f64;
            Quarter::from_lags(counts, |x, y| soft / cells * influence::mode([x, y], counts, spacing)).transformed(set)
        })
    }

    /// The cells that are solved for.
    pub fn half(&self) -> Half {
        Half::new(self.counts, self.mirrored, self.boundary)
    }

    /// The sizes of a window that holds `least` cells along each axis, of those that are solved for, and makes full use of
    /// its transforms.
    pub fn sizes(&self, least: [usize; 2]) -> Sizes {
        let half = self.half();
        let along = |axis: usize| {
            let (all, period, mirrored) = (half.counts[axis], self.counts[axis], self.mirrored[axis]);
            let least = least[axis].clamp(1, all);
            // With the images of all but the first.
            let span = |count: usize| if mirrored { 2 * count - 1 } else { count };
            let padded = good(2 * span(least) - 1);
            let most = if mirrored { padded.div_ceil(4) } else { padded.div_ceil(2) };
            match self.boundary {
                // Over the whole period, with as many cells of it as are needed.
                Boundary::Periodic if padded >= period => {
                    let count = least.next_multiple_of(if mirrored { SHARE / 2 } else { SHARE });
                    (if 8 * count > 7 * all { all } else { count }, period)
                }
                _ if most >= all => (all, good(2 * span(all) - 1)),
                _ => (most, padded),
            }
        };
        let (x, y) = (along(0), along(1));
        ([x.0, y.0], [x.1, y.1])
    }

    /// The convolution over a window.
    pub fn convolution(&mut self, sizes: Sizes, threads: usize) -> Convolution {
        let ((counts, padded), set) = (sizes, self.instructions);
        let whole = self.boundary == Boundary::Periodic && padded == self.counts;
        let symbol = if whole {
            Quarter::from_lags(padded, |x, y| self.mode([x, y], padded))
        } else if self.boundary == Boundary::Periodic {
            let lags = self.lags();
            Quarter::from_lags(padded, |x, y| lags.at(x, y)).transformed(set)
        } else if !self.flat && padded[0] == padded[1] && self.spacing[0] == self.spacing[1] {
            Quarter::from_equal_lags(padded[0], |x, y| self.free([x, y])).transformed(set)
        } else {
            Quarter::from_lags(padded, |x, y| self.free([x, y])).transformed(set)
        };
        Convolution::new(counts, self.mirrored, symbol, set, threads)
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        self.lags.as_ref().map_or(0, |lags| 8 * lags.values.len())
    }
}

/// The next size, even from 2 on, that transforms go fast with.
fn good(least: usize) -> usize {
    let goes = |size: usize| {
        let rest = [2, 3, 5].into_iter().fold(size, |mut rest, factor| {
            while rest.is_multiple_of(factor) {
                rest /= factor;
            }
            rest
        });
        rest == 1 && (size.is_multiple_of(2) || size == 1)
    };
    (least..).find(|size| goes(*size)).unwrap_or(least)
}
