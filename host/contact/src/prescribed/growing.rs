//! A column of a long-form history while its rows come in: kept as small as its values allow.

use super::assemble::{Placement, RowIndex, Slot};
use super::samples::{ColumnData, Samples};

/// Values so far: one per time or per point for as long as that says it all, else one per row.
pub(super) enum Growing {
    /// Uniform over the points: a value per time.
    Times(Vec<f64>),
    /// Constant in time: a value per point.
    Points(Vec<f64>),
    /// A value per row.
    Rows(Vec<f64>),
}

impl Growing {
    pub fn new() -> Growing {
        Growing::Times(Vec::new())
    }

    /// Takes the value of the row that `index` has just taken into `slot`.
    ///
    /// `expected` is a guess of the number of rows to come in all: memory is asked for once.
    pub fn push(&mut self, index: &RowIndex, slot: Slot, value: f64, expected: usize) {
        match self {
            Growing::Times(values) if slot.time == values.len() => values.push(value),
            Growing::Times(values) if same(values[slot.time], value) => {}
            Growing::Times(values) => {
                let constant = values.iter().all(|v| same(*v, values[0]));
                if constant && slot.is_new {
                    let mut per_point = vec![values[0]; slot.point];
                    per_point.push(value);
                    *self = Growing::Points(per_point);
                } else {
                    let per_time = std::mem::take(values);
                    let before = (0..index.rows() - 1).map(|row| per_time[index.slot(row).0]);
                    *self = Growing::widen(before, value, expected);
                }
            }
            Growing::Points(values) if slot.is_new => values.push(value),
            Growing::Points(values) if same(values[slot.point], value) => {}
            Growing::Points(values) => {
                let per_point = std::mem::take(values);
                let before = (0..index.rows() - 1).map(|row| per_point[index.slot(row).1]);
                *self = Growing::widen(before, value, expected);
            }
            Growing::Rows(values) => {
                if values.len() == values.capacity() {
                    let missing = expected.saturating_sub(values.len());
                    values.reserve_exact(missing.max(values.len() / 8 + 1024));
                }
                values.push(value);
            }
        }
    }

    fn widen(before: impl Iterator<Item = f64>, value: f64, expected: usize) -> Growing {
        let mut rows = Vec::with_capacity(expected);
        rows.extend(before);
        rows.push(value);
        Growing::Rows(rows)
    }

    /// The finished column.
    pub fn finish(self, placement: &Placement) -> ColumnData {
        let points = placement.ids.len();
        let (mut values, time_step, point_step) = match self {
            Growing::Times(values) if values.iter().all(|v| same(*v, values[0])) => (vec![values[0]], 0, 0),
            Growing::Times(values) => (values, 1, 0),
            Growing::Points(values) => (placement.place_points(values), 0, 1),
            Growing::Rows(values) => (placement.place_rows(values), points, 1),
        };
        values.shrink_to_fit();
        ColumnData { samples: Samples::Owned(values), time_step, point_step }
    }
}

/// A grid of values, time after time, kept as small as they allow.
pub(super) fn fold(mut grid: Vec<f64>, times: usize, points: usize) -> ColumnData {
    let all_same = |row: &[f64]| row.iter().all(|v| same(*v, row[0]));
    let (time_step, point_step) = if grid.chunks_exact(points).all(all_same) {
        grid = grid.into_iter().step_by(points).collect();
        (1, 0)
    } else {
        (points, 1)
    };
    let row = grid.len() / times;
    let repeats = |a: &[f64]| a.iter().zip(&grid[..row]).all(|(a, b)| same(*a, *b));
    let time_step = if grid.chunks_exact(row).all(repeats) { 0 } else { time_step };
    if time_step == 0 {
        grid.truncate(row);
        grid.shrink_to_fit();
    }
    ColumnData { samples: Samples::Owned(grid), time_step, point_step }
}

/// Equal to the bit: a fold must not change the sign of a zero.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits()
}
