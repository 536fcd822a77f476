//! Elastic half-space: the displacement of a cell follows from the pressures of all cells.
//! Here are the displacements that one loaded cell causes (influence, kernel), their convolution with all pressures
//! (convolve), the search for the cells in contact (search, descend, stencil) and what makes it short: a window around the
//! contact (window) and a first guess from coarser cells (levels).
//! Not here: what wears the surface (integrator) and how stiff the contact is against wear (stability).

mod contact_set;
mod convolve;
mod descend;
mod frozen;
mod influence;
mod kernel;
mod levels;
mod mirror;
mod neighbours;
mod passes;
mod patch;
mod residual;
mod room;
mod scaled;
mod search;
mod solve;
mod state;
mod stencil;
mod symbol;
#[cfg(test)]
mod tests;
mod window;

use super::{Cells, ContactError, ContactModel, Instructions, Problem, Solution};
use convolve::{Convolution, Dense};
use kernel::{Kernel, Sizes};
pub use mirror::mirrors;
use room::Room;
use scaled::power_of_two;

/// Convolutions that are kept from one solve to the next: over the window, and where the rest is looked at.
const KEPT: usize = 2;

/// What is beyond the cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// A half-space without pressure.
    Free,
    /// The same cells again and again; the approach is measured from the mean plane.
    Periodic,
}

/// An elastic half-space under equal cells.
pub struct HalfSpace {
    cells: Cells,
    /// Unit of lengths along the surface, a power of two.
    length: f64,
    /// Unit of moduli, a power of two.
    modulus_unit: f64,
    kernel: Kernel,
    threads: usize,
    /// Whether symmetric problems are solved on a half or a quarter of the cells.
    mirrors: bool,
    /// The last used is the last.
    kept: Vec<Convolution>,
    room: Room,
}

impl HalfSpace {
    /// Under `cells`, with the contact modulus E* (pressure), 1/E* = sum (1 - nu^2)/E.
    ///
    /// `datum` is the distance at which the displacement is zero, for a free boundary in 2-D, where it does not go to
    /// zero (length; half the size if there is none; under a given load only the approach depends on it). With `threads`
    /// other than 1, large grids use those of rayon's current pool.
    #[must_use]
    pub fn new(cells: Cells, modulus: f64, boundary: Boundary, datum: Option<f64>, threads: usize) -> HalfSpace {
        let length = power_of_two(cells.spacing[0]);
        let flat = cells.dimension == 2;
        let spacing = [cells.spacing[0] / length, if flat { 1.0 } else { cells.spacing[1] / length }];
        let modulus_unit = power_of_two(modulus);
        let datum = datum.map_or(0.5 * cells.counts[0] as f64 * spacing[0], |datum| datum / length);
        let kernel = Kernel::new(flat, boundary, cells.counts, spacing, modulus_unit / modulus, datum);
        HalfSpace {
            cells,
            length,
            modulus_unit,
            kernel,
            threads,
            mirrors: true,
            kept: Vec::new(),
            room: Room::default(),
        }
    }

    /// The same with transforms by this set of instructions instead of that of the process.
    #[must_use]
    pub fn with_instructions(mut self, set: Instructions) -> HalfSpace {
        self.kernel.instructions = set;
        self
    }

    /// The same without use of mirror symmetry: every problem is solved on all cells.
    #[must_use]
    pub fn without_mirrors(mut self) -> HalfSpace {
        self.mirrors = false;
        self
    }

    /// Bytes that it holds at most during solves: for transforms, over all cells and over a window of them, and in arrays of
    /// a search with all cells in contact. A local compliance that `varies` and acts on smoothed pressures takes more: the
    /// directions that minimal residuals keep.
    #[must_use]
    pub fn most_bytes(&self, varies: bool, smoothed: bool) -> [usize; 2] {
        let (counts, padded) = self.kernel.sizes(self.cells.counts);
        let window = self.kernel.sizes(counts.map(|count| count.div_ceil(2))).1;
        let transforms = [padded, window].map(|padded| Convolution::bytes_for(counts, padded, self.threads));
        let lags = if self.kernel.boundary == Boundary::Periodic { 2 * self.cells.count() } else { 0 };
        let directions = if varies && smoothed { residual::MOST_ARRAYS } else { 0 };
        let arrays = search::MOST_ARRAYS + if varies { 2 } else { 0 } + directions;
        [transforms[0] + transforms[1] + lags, 8 * self.cells.count() * arrays]
    }

    /// The convolution over a window, kept or made; to be given back by [`HalfSpace::keep`].
    fn convolution(&mut self, (counts, padded): Sizes) -> Convolution {
        let mirrored = self.kernel.mirrored;
        match self.kept.iter().position(|kept| kept.is_over(padded, mirrored)) {
            Some(place) => {
                let mut convolution = self.kept.remove(place);
                convolution.turn_to(counts);
                convolution
            }
            None => {
                // Before the new one is made, so that no more than the kept ones are there at a time.
                if self.kept.len() >= KEPT {
                    self.kept.remove(0);
                }
                self.kernel.convolution((counts, padded), self.threads)
            }
        }
    }

    /// Keeps a convolution for later.
    fn keep(&mut self, convolution: Convolution) {
        self.kept.push(convolution);
    }
}

impl ContactModel for HalfSpace {
    fn cells(&self) -> &Cells {
        &self.cells
    }

    fn solve(&mut self, problem: &Problem<'_>, pressure: &mut [f64]) -> Result<Solution, ContactError> {
        solve::solve(self, problem, pressure)
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) {
        self.kernel.mirrored = [false; 2];
        let sizes = self.kernel.sizes(self.cells.counts);
        let mut convolution = self.convolution(sizes);
        convolution.apply(&Dense { width: self.cells.counts[0], input: pressure }, out);
        self.keep(convolution);
        let compliance = self.length / self.modulus_unit;
        out.iter_mut().for_each(|u| *u *= compliance);
    }

    fn bytes(&self) -> usize {
        let kept: usize = self.kept.iter().map(Convolution::bytes).sum();
        size_of::<Self>() + kept + self.kernel.bytes() + self.room.bytes()
    }
}
