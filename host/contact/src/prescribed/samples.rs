//! The values of one column: owned, or mapped from the file, behind one view per time row.
#![allow(unsafe_code, reason = "an array that lies in the file as doubles is read in place, through a memory map")]

use memmap2::Mmap;
use std::fmt;
use std::fs::File;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Where the values of a column lie.
#[derive(Clone)]
pub enum Samples {
    /// Doubles in the file itself; `offset` in bytes and `len` in doubles.
    Mapped {
        /// The whole file.
        map: Arc<Mmap>,
        /// Start of the array in the file, a multiple of 8.
        offset: usize,
        /// Number of doubles.
        len: usize,
    },
    /// Doubles that were decoded.
    Owned(Vec<f64>),
}

impl Samples {
    /// The doubles of a mapped file, or `None` where they cannot be read in place:
    /// unaligned, past the end of the file, or on a big-endian machine.
    pub(super) fn mapped(map: &Arc<Mmap>, offset: u64, len: usize) -> Option<Samples> {
        let offset = usize::try_from(offset).ok()?;
        let end = len.checked_mul(8)?.checked_add(offset)?;
        let fits = end <= map.len() && (map.as_ptr() as usize + offset).is_multiple_of(8);
        (fits && cfg!(target_endian = "little")).then(|| Samples::Mapped { map: Arc::clone(map), offset, len })
    }

    /// All values.
    pub fn as_slice(&self) -> &[f64] {
        match self {
            Samples::Owned(values) => values,
            Samples::Mapped { map, offset, len } => {
                let bytes = &map[*offset..*offset + *len * 8];
                // SAFETY: every bit pattern is a double; `align_to` itself keeps the promise of
                // alignment, and the borrow of `map` keeps the pages alive.
                let (before, values, _) = unsafe { bytes.align_to::<f64>() };
                debug_assert!(before.is_empty() && values.len() == *len);
                values
            }
        }
    }

    /// Whether the values are read from the file in place.
    pub fn is_mapped(&self) -> bool {
        matches!(self, Samples::Mapped { .. })
    }
}

impl fmt::Debug for Samples {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Samples::Owned(values) => write!(f, "Owned({} values)", values.len()),
            Samples::Mapped { offset, len, .. } => write!(f, "Mapped({len} values at {offset})"),
        }
    }
}

/// Maps a file for reading.
///
/// The file must stay as it is while the history lives: a program that cuts it off meanwhile ends
/// this one (a bus error), as for every reader of mapped files.
pub(super) fn map_file(path: &Path) -> std::io::Result<Arc<Mmap>> {
    let file = File::open(path)?;
    // SAFETY: the map is read-only and private to this process; that nobody changes the file
    // meanwhile is the documented promise of whoever starts the run.
    let map = unsafe { Mmap::map(&file)? };
    Ok(Arc::new(map))
}

/// The values of one column and how they run over times and points.
#[derive(Clone, Debug)]
pub struct ColumnData {
    /// The values; value (k, i) is element `k * time_step + i * point_step`.
    pub samples: Samples,
    /// Doubles from one time row to the next; 0: constant in time.
    pub time_step: usize,
    /// Doubles from one point to the next; 0: uniform over the points.
    pub point_step: usize,
}

impl ColumnData {
    /// One value at every time and point.
    pub fn constant(value: f64) -> ColumnData {
        ColumnData { samples: Samples::Owned(vec![value]), time_step: 0, point_step: 0 }
    }

    /// Bytes of memory that the values take (a map counts as what it can make resident).
    pub fn bytes(&self) -> usize {
        8 * self.samples.as_slice().len()
    }
}

/// A column as the solver sees it: a row of values per time.
#[derive(Clone, Copy, Debug)]
pub struct ColumnView<'a> {
    values: &'a [f64],
    time_step: usize,
    point_step: usize,
    points: usize,
}

/// One time row of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowView<'a> {
    /// The same value at every point.
    Uniform(f64),
    /// A value per point.
    PerPoint(&'a [f64]),
}

impl RowView<'_> {
    /// The value at point `i`.
    pub fn value(&self, i: usize) -> f64 {
        match self {
            RowView::Uniform(value) => *value,
            RowView::PerPoint(values) => values[i],
        }
    }
}

impl<'a> ColumnView<'a> {
    pub(super) fn new(data: &'a ColumnData, points: usize) -> ColumnView<'a> {
        ColumnView { values: data.samples.as_slice(), time_step: data.time_step, point_step: data.point_step, points }
    }

    /// Whether every point has the same value at any one time.
    pub fn is_uniform(&self) -> bool {
        self.point_step == 0
    }

    /// Whether every row holds the same values.
    pub fn is_constant_in_time(&self) -> bool {
        self.time_step == 0
    }

    /// The values at time row `k`, which must be less than the number of times.
    pub fn row(&self, k: usize) -> RowView<'a> {
        let start = k * self.time_step;
        if self.point_step == 0 {
            RowView::Uniform(self.values[start])
        } else {
            RowView::PerPoint(&self.values[start..start + self.points])
        }
    }

    /// The value at time row `k` and point `i`.
    pub fn value(&self, k: usize, i: usize) -> f64 {
        self.values[k * self.time_step + i * self.point_step]
    }

    /// Values of the points in `range` at the fraction `theta` (0 to 1) of the way from row `k` to row `k1`.
    ///
    /// `out` has one element per point of `range`. A value that is equal in both rows comes out
    /// unchanged, and so do both ends: a + theta (b - a), and b itself at theta = 1.
    pub fn interpolate(&self, k: usize, k1: usize, theta: f64, range: Range<usize>, out: &mut [f64]) {
        match (self.row(k), self.row(k1)) {
            (RowView::PerPoint(a), RowView::PerPoint(b)) => {
                let (a, b) = (&a[range.clone()], &b[range]);
                if theta == 0.0 || std::ptr::eq(a, b) {
                    out.copy_from_slice(a);
                } else if theta == 1.0 {
                    out.copy_from_slice(b);
                } else {
                    assert_eq!(out.len(), a.len(), "one value of output per point");
                    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
                        *out = a + theta * (b - a);
                    }
                }
            }
            _ => out.fill(self.uniform_between(k, k1, theta)),
        }
    }

    /// The value of a uniform column at the fraction `theta` of the way from row `k` to row `k1`;
    /// of a column with a value per point, that of the first point.
    pub fn uniform_between(&self, k: usize, k1: usize, theta: f64) -> f64 {
        let (a, b) = (self.value(k, 0), self.value(k1, 0));
        if theta == 1.0 { b } else { a + theta * (b - a) }
    }
}
