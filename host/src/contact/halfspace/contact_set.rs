//! Cells in contact, as a list: everything on the set is done on short arrays.

use super::convolve::Rows;

/// Neighbours that are looked at together.
const BLOCK: usize = 32;

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

    /// The cells of a window of `width` columns with pressure, and those whose gap and displacement add up to less than
    /// `joins`.
    pub fn touching(width: usize, pressure: &[f64], gap: &[f64], u: &[f64], joins: f64) -> ContactSet {
        let rows = pressure.len() / width;
        let mut set = ContactSet { width, cells: Vec::new(), starts: Vec::with_capacity(rows + 1) };
        for row in 0..rows {
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

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// The values of an array over the window on the set.
    pub fn gather(&self, from: &[f64]) -> Vec<f64> {
        self.cells.iter().map(|cell| from[*cell as usize]).collect()
    }

    /// The same, into an array on the set.
    pub fn gather_into(&self, from: &[f64], to: &mut [f64]) {
        to.iter_mut().zip(&self.cells).for_each(|(to, cell)| *to = from[*cell as usize]);
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
