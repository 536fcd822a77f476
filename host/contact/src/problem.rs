//! What a contact model is asked and what it answers.

use super::{Cells, ContactError};

/// What presses the bodies together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Total load, not negative; per length in 2-D.
    Load(f64),
    /// Rigid-body approach; length.
    Approach(f64),
}

/// The local compliance b that is added to the model's own: how much the gap of a cell grows per pressure on it, because
/// an implicit step wears it; length per pressure, not negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Diagonal<'a> {
    /// None: elastic contact alone.
    Zero,
    /// The same at every cell.
    Uniform(f64),
    /// One for each cell `[cells]`.
    PerPoint(&'a [f64]),
}

impl Diagonal<'_> {
    /// The value at a cell.
    #[inline]
    #[must_use]
    pub fn at(&self, cell: usize) -> f64 {
        match self {
            Diagonal::Zero => 0.0,
            Diagonal::Uniform(value) => *value,
            Diagonal::PerPoint(values) => values[cell],
        }
    }
}

/// Find p >= 0 with gap = `gap` + (A + b) p - approach >= 0 and p . gap = 0, the load or the approach being given;
/// A is the model's compliance (u = A p).
///
/// On a `frozen` contact set the conditions are gap = 0 on the set (p of either sign) and p = 0 elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct Problem<'a> {
    /// Gap without pressure and approach `[cells]`; length. Infinity where the bodies never touch.
    pub gap: &'a [f64],
    /// Local compliance that is added to the model's own.
    pub diagonal: Diagonal<'a>,
    /// Whether the diagonal acts on the smoothed pressure M p instead of p, M = B^T B being the average from cells to
    /// corners and back: wear from nodal stresses. It reaches one cell beyond the contact, and the conditions hold with
    /// it there too; without that some problems had no solution.
    pub smoothed: bool,
    /// What is given.
    pub control: Control,
    /// Largest sum p (gap - smallest gap) / (sum p * scale); under an approach that of
    /// (sum p |gap| / sum p + deepest overlap) / scale. On a frozen set, largest ||gap||2 over that of the start without
    /// pressure or with a uniform one, whichever is larger; under a load their means are subtracted.
    pub tolerance: f64,
    /// Length that the complementarity error is measured with: the standard deviation of the initial gap.
    pub scale: f64,
    /// Cells that are in contact whatever their pressure, all others being open; `None`: the solver finds them.
    pub frozen: Option<&'a [bool]>,
}

/// What a solve came to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Solution {
    /// Rigid-body approach.
    pub approach: f64,
    /// Sum of pressure times cell area.
    pub load: f64,
    /// Iterations.
    pub iterations: u64,
    /// Pairs of transforms.
    pub fft_pairs: u64,
    /// The complementarity error that was reached.
    pub error: f64,
}

/// A model whose pressure follows from the gap.
pub trait ContactModel: Send {
    /// The cells it was made for.
    fn cells(&self) -> &Cells;

    /// Solves a problem. `pressure` `[cells]` is the start on entry (zeros: a cold start) and the solution on return;
    /// after an error it is the best that was found.
    ///
    /// Under a given load the sum of the returned pressures times the cell area is the load to rounding. The same
    /// problem from the same start gives the same bits, whatever the number of threads.
    ///
    /// # Errors
    /// No solution, or none within the iterations allowed.
    fn solve(&mut self, problem: &Problem<'_>, pressure: &mut [f64]) -> Result<Solution, ContactError>;

    /// The displacement u = A p `[cells]`; length.
    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]);

    /// Bytes that it holds.
    fn bytes(&self) -> usize;
}
