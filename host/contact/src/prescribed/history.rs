//! A history in memory: times, points and the columns that were asked for.

use super::samples::{ColumnData, ColumnView};
use super::{Column, Header, HistoryError, Layout, Needs, RowView, csv_file, npz_file};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Pressure, motion and other data at points, given at times and linear in between.
///
/// Two rows of the same time are a jump: the values before it and after it. A slip that jumps is
/// counted anew from its value after the jump: no path is run in no time. Units are the scene's.
/// Values are as in the file: nothing is clipped (a pressure of zero or less means open) and
/// normals keep the length that they have.
#[derive(Debug)]
pub struct History {
    pub(super) path: PathBuf,
    pub(super) times: Vec<f64>,
    pub(super) point_ids: PointIds,
    pub(super) columns: BTreeMap<Column, ColumnData>,
}

/// The ids of the points, in the order of the columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PointIds {
    /// 0, 1, 2 and so on: this many points, no memory.
    Counted(usize),
    /// Any ids.
    Listed(Vec<i64>),
}

impl PointIds {
    /// Drops a list that only counts.
    pub(super) fn from_list(ids: Vec<i64>) -> PointIds {
        let counts = ids.iter().enumerate().all(|(at, id)| *id == at as i64);
        if counts { PointIds::Counted(ids.len()) } else { PointIds::Listed(ids) }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        match self {
            PointIds::Counted(points) => *points,
            PointIds::Listed(ids) => ids.len(),
        }
    }

    /// Whether there are none; a history has at least one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The id of point `i`, counted from 0 in the order of the columns.
    pub fn get(&self, i: usize) -> i64 {
        match self {
            PointIds::Counted(_) => i as i64,
            PointIds::Listed(ids) => ids[i],
        }
    }
}

/// The stretch of time between two neighbouring rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Row at its start; the row at its end is the next.
    pub row: usize,
    /// Time at its start.
    pub start: f64,
    /// Time at its end, not before the start.
    pub end: f64,
}

impl Interval {
    /// Whether the values jump here: no time passes.
    pub fn is_jump(&self) -> bool {
        self.start == self.end
    }
}

impl History {
    /// Reads the columns that are needed from a CSV or NPZ file.
    ///
    /// Other columns are passed over: their values are neither checked nor kept. Rows of a CSV may
    /// come in any order that keeps the times of each point in order; the points come out by
    /// ascending id (in the grid form of NPZ: in the order of the file).
    ///
    /// # Errors
    /// Whatever is wrong with the file, its names, its numbers or their order, with the place.
    pub fn read(path: &Path, needs: &Needs) -> Result<History, HistoryError> {
        let header = Header::read(path)?;
        header.check(needs)?;
        let mut history = match header.layout {
            Layout::Csv => csv_file::read(&header, needs)?,
            Layout::NpzLong | Layout::NpzGrid => npz_file::read(&header, needs)?,
        };
        for column in needs.columns().filter(|column| header.reads_as_zero(*column)) {
            history.columns.insert(column, ColumnData::constant(0.0));
        }
        history.check_signs()?;
        Ok(history)
    }

    /// What a file holds, without reading its values.
    ///
    /// # Errors
    /// As [`Header::read`].
    pub fn header(path: &Path) -> Result<Header, HistoryError> {
        Header::read(path)
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The times of the rows, never decreasing; one time only means constant in time.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The stretches between the rows, jumps included.
    pub fn intervals(&self) -> impl Iterator<Item = Interval> + '_ {
        let pairs = self.times.windows(2).enumerate();
        pairs.map(|(row, t)| Interval { row, start: t[0], end: t[1] })
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.point_ids.len()
    }

    /// Ids of the points, in the order of the columns.
    pub fn point_ids(&self) -> &PointIds {
        &self.point_ids
    }

    /// The values of a column, if it was asked for.
    pub fn column(&self, column: Column) -> Option<ColumnView<'_>> {
        let data = self.columns.get(&column)?;
        Some(ColumnView::new(data, self.points()))
    }

    /// Where the values of a column lie, if it was asked for.
    pub fn data(&self, column: Column) -> Option<&ColumnData> {
        self.columns.get(&column)
    }

    /// Bytes that times, ids and columns take.
    pub fn bytes(&self) -> usize {
        let ids = match &self.point_ids {
            PointIds::Counted(_) => 0,
            PointIds::Listed(ids) => ids.len(),
        };
        let columns: usize = self.columns.values().map(ColumnData::bytes).sum();
        8 * (self.times.len() + ids) + columns
    }

    /// Rows and points that can differ in one of the columns.
    fn distinct(&self, views: &[ColumnView<'_>]) -> (usize, usize) {
        let rows = if views.iter().all(ColumnView::is_constant_in_time) { 1 } else { self.times.len() };
        let points = if views.iter().all(ColumnView::is_uniform) { 1 } else { self.points() };
        (rows, points)
    }

    fn check_values(&self, column: Column, name: &'static str, view: ColumnView<'_>) -> Result<(), HistoryError> {
        let (rows, points) = self.distinct(&[view]);
        for k in 0..rows {
            let bad = match view.row(k) {
                RowView::Uniform(value) => column.refusal(value).map(|expected| (0, expected)),
                RowView::PerPoint(values) => {
                    let refusals = values[..points].iter().map(|value| column.refusal(*value));
                    refusals.enumerate().find_map(|(i, refusal)| refusal.map(|expected| (i, expected)))
                }
            };
            if let Some((i, expected)) = bad {
                let (point, time, value) = (self.point_ids.get(i), self.times[k], view.value(k, i));
                return Err(HistoryError::Value {
                    path: self.path.clone(),
                    line: 0,
                    column: name,
                    value,
                    point,
                    time,
                    expected,
                });
            }
        }
        Ok(())
    }

    /// Areas are greater than zero, coefficients of friction not below it, and normals not zero.
    fn check_signs(&self) -> Result<(), HistoryError> {
        for (column, name) in Column::NAMED {
            if let Some(view) = self.column(column) {
                self.check_values(column, name, view)?;
            }
        }
        let normal: Vec<ColumnView<'_>> = Column::NORMAL.iter().filter_map(|column| self.column(*column)).collect();
        if normal.len() == 3 {
            let (rows, points) = self.distinct(&normal);
            for k in 0..rows {
                let zero = (0..points).find(|i| normal.iter().all(|c| c.value(k, *i) == 0.0));
                if let Some(i) = zero {
                    return Err(HistoryError::ZeroNormal {
                        path: self.path.clone(),
                        line: 0,
                        point: self.point_ids.get(i),
                        time: self.times[k],
                    });
                }
            }
        }
        Ok(())
    }
}
