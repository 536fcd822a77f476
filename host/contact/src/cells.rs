//! The cells that carry pressure.

/// Equal cells over a rectangle, or over a line in 2-D; x varies fastest in every array over them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// 2 (plane strain, loads per length) or 3.
    pub dimension: u8,
    /// Cells in x and y; one in y in 2-D.
    pub counts: [usize; 2],
    /// Lengths of one cell in x and y; 1 in y in 2-D, so that sums are per length.
    pub spacing: [f64; 2],
}

impl Cells {
    /// Number of cells.
    #[must_use]
    pub fn count(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// Area of one cell; its length in 2-D.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.spacing[0] * self.spacing[1]
    }
}
