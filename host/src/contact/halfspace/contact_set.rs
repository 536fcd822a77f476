//! Cells in contact, as a list: everything on the set is done on short arrays.

use super::convolve::Rows;

/// Cells of a window, in the order of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactSet {
    width: usize,
    /// Cells.
    pub cells: Vec<u32>,
    /// Where each row begins in `cells`, and the end of the last.
    starts: Vec<u32>,
}

impl ContactSet {
    /// The cells of a window `counts` that a function picks.
    pub fn of(counts: [usize; 2], mut pick: impl FnMut(usize) -> bool) -> ContactSet {
        let [width, rows] = counts;
        let mut set = ContactSet { width, cells: Vec::new(), starts: Vec::with_capacity(rows + 1) };
        for row in 0..rows {
            set.starts.push(set.cells.len() as u32);
            set.cells.extend((row * width..(row + 1) * width).filter(|cell| pick(*cell)).map(|cell| cell as u32));
        }
        set.starts.push(set.cells.len() as u32);
        set
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// The values of an array over the window on the set.
    pub fn gather(&self, from: &[f64]) -> Vec<f64> {
        self.cells.iter().map(|cell| from[*cell as usize]).collect()
    }

    /// Writes values on the set into an array over the window.
    pub fn scatter(&self, values: &[f64], to: &mut [f64]) {
        for (cell, value) in self.cells.iter().zip(values) {
            to[*cell as usize] = *value;
        }
    }

    /// The part of a row: its first place in arrays on the set, and its cells.
    pub fn row(&self, row: usize) -> (usize, &[u32]) {
        let (begin, end) = (self.starts[row] as usize, self.starts[row + 1] as usize);
        (begin, &self.cells[begin..end])
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
