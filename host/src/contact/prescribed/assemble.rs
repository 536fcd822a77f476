//! Which time row and which point each row of a long-form history belongs to.

use super::HistoryError;
use std::collections::HashMap;
use std::path::Path;

/// Where one row belongs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    /// Time row.
    pub time: usize,
    /// Point, in the order of first appearance.
    pub point: usize,
    /// Whether this is the first row of its point.
    pub is_new: bool,
}

/// Rows of the long form as they come in.
///
/// The n-th row of a point belongs to the n-th time row, so a file may run through the times for
/// each point, through the points at each time, or mix the two; all that counts is that every
/// point runs through the same times in the same order.
#[derive(Default)]
pub(super) struct RowIndex {
    pub times: Vec<f64>,
    ids: Vec<i64>,
    by_id: HashMap<i64, u32>,
    /// Number of rows that each point has had.
    seen: Vec<u32>,
    /// The point that brought each time row.
    first: Vec<u32>,
    rows: usize,
    last: usize,
    /// Slots of all rows, once they are not simply in order of time and point.
    order: Option<Vec<(u32, u32)>>,
}

impl RowIndex {
    /// Takes one row; `line` finds its line if something is wrong with it.
    pub fn push(
        &mut self,
        path: &Path,
        time: f64,
        id: i64,
        line: &dyn Fn() -> u64,
    ) -> Result<Slot, HistoryError> {
        let known = self.find(id);
        let is_new = known.is_none();
        let points_before = self.ids.len();
        let point = known.unwrap_or(points_before);
        let at = if is_new { 0 } else { self.seen[point] as usize };
        if at == self.times.len() {
            self.push_time(path, time, id, point, line)?;
        } else if time != self.times[at] {
            return Err(self.misfit(path, time, id, at, line));
        }
        if is_new {
            self.by_id.insert(id, point as u32);
            self.ids.push(id);
            self.seen.push(0);
        }
        self.seen[point] += 1;
        let slot = Slot {
            time: at,
            point,
            is_new,
        };
        self.note_order(slot, points_before);
        self.rows += 1;
        self.last = point;
        Ok(slot)
    }

    /// Rows come mostly in the order of the rows before: the next point, the same, or the first.
    fn find(&self, id: i64) -> Option<usize> {
        [self.last + 1, self.last, 0]
            .into_iter()
            .find(|at| self.ids.get(*at) == Some(&id))
            .or_else(|| self.by_id.get(&id).map(|at| *at as usize))
    }

    fn push_time(
        &mut self,
        path: &Path,
        time: f64,
        id: i64,
        point: usize,
        line: &dyn Fn() -> u64,
    ) -> Result<(), HistoryError> {
        if let Some(&before) = self.times.last() {
            let twice = self.times.len() > 1 && self.times[self.times.len() - 2] == before;
            if time < before {
                let path = path.into();
                return Err(HistoryError::TimeGoesBack {
                    path,
                    line: line(),
                    before,
                    time,
                    point: id,
                });
            }
            if time == before && twice {
                return Err(HistoryError::TimeRepeated {
                    path: path.into(),
                    line: line(),
                    time,
                    point: id,
                });
            }
        }
        self.times.push(time);
        self.first.push(point as u32);
        Ok(())
    }

    /// The error for a row whose time is not the one that its point should have next.
    fn misfit(
        &self,
        path: &Path,
        time: f64,
        id: i64,
        at: usize,
        line: &dyn Fn() -> u64,
    ) -> HistoryError {
        let path = path.to_path_buf();
        let expected = self.times[at];
        let other = self.ids[self.first[at] as usize];
        let before = at.checked_sub(1).map(|at| self.times[at]);
        match before {
            Some(before) if time < before => HistoryError::TimeGoesBack {
                path,
                line: line(),
                before,
                time,
                point: id,
            },
            Some(before) if time == before => HistoryError::PointTwice {
                path,
                line: line(),
                point: id,
                time,
                other,
            },
            Some(before) if expected == before => HistoryError::PointTwice {
                path,
                line: line(),
                point: other,
                time: before,
                other: id,
            },
            _ if time < expected => HistoryError::PointMissing {
                path,
                point: other,
                time,
                other: id,
            },
            _ => HistoryError::PointMissing {
                path,
                point: id,
                time: expected,
                other,
            },
        }
    }

    fn note_order(&mut self, slot: Slot, points_before: usize) {
        let in_order = if slot.is_new {
            self.times.len() == 1
        } else {
            slot.time * self.ids.len() + slot.point == self.rows
        };
        if !in_order && self.order.is_none() {
            let points = points_before.max(1);
            let before = (0..self.rows).map(|row| ((row / points) as u32, (row % points) as u32));
            self.order = Some(before.collect());
        }
        if let Some(order) = &mut self.order {
            order.push((slot.time as u32, slot.point as u32));
        }
    }

    /// Number of rows so far.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Time row and point of a row that was taken.
    pub fn slot(&self, row: usize) -> (usize, usize) {
        match &self.order {
            Some(order) => (order[row].0 as usize, order[row].1 as usize),
            None => (row / self.ids.len(), row % self.ids.len()),
        }
    }

    /// Checks that every point has every time and fixes the order of the points.
    pub fn finish(self, path: &Path) -> Result<Placement, HistoryError> {
        if self.rows == 0 {
            return Err(HistoryError::NoRows { path: path.into() });
        }
        let short = self
            .seen
            .iter()
            .position(|seen| *seen as usize != self.times.len());
        if let Some(point) = short {
            let at = self.seen[point] as usize;
            let (point, time) = (self.ids[point], self.times[at]);
            let other = self.ids[self.first[at] as usize];
            let path = path.to_path_buf();
            return Err(if at > 0 && self.times[at - 1] == time {
                HistoryError::PointTwice {
                    path,
                    line: 0,
                    point: other,
                    time,
                    other: point,
                }
            } else {
                HistoryError::PointMissing {
                    path,
                    point,
                    time,
                    other,
                }
            });
        }
        let mut sorted: Vec<u32> = (0..self.ids.len() as u32).collect();
        let mut rank = None;
        if !self.ids.is_sorted() {
            sorted.sort_unstable_by_key(|point| self.ids[*point as usize]);
            let mut place = vec![0_u32; sorted.len()];
            for (at, point) in sorted.iter().enumerate() {
                place[*point as usize] = at as u32;
            }
            rank = Some(place);
        }
        let ids = sorted
            .iter()
            .map(|point| self.ids[*point as usize])
            .collect();
        Ok(Placement {
            times: self.times,
            ids,
            order: self.order,
            rank,
        })
    }
}

/// The finished arrangement: times, points by ascending id, and where each row goes.
pub(super) struct Placement {
    pub times: Vec<f64>,
    pub ids: Vec<i64>,
    order: Option<Vec<(u32, u32)>>,
    rank: Option<Vec<u32>>,
}

impl Placement {
    /// Values in the order of the rows, brought into the order of time and point.
    ///
    /// Rows that came in that order already are handed through without a copy.
    pub fn place_rows(&self, rows: Vec<f64>) -> Vec<f64> {
        if self.order.is_none() && self.rank.is_none() {
            return rows;
        }
        let points = self.ids.len();
        let mut grid = vec![0.0; rows.len()];
        for (row, value) in rows.into_iter().enumerate() {
            let (time, point) = match &self.order {
                Some(order) => (order[row].0 as usize, order[row].1 as usize),
                None => (row / points, row % points),
            };
            grid[time * points + self.rank_of(point)] = value;
        }
        grid
    }

    /// Values per point in the order of first appearance, brought into the order of the ids.
    pub fn place_points(&self, values: Vec<f64>) -> Vec<f64> {
        if self.rank.is_none() {
            return values;
        }
        let mut placed = vec![0.0; values.len()];
        for (point, value) in values.into_iter().enumerate() {
            placed[self.rank_of(point)] = value;
        }
        placed
    }

    fn rank_of(&self, point: usize) -> usize {
        self.rank
            .as_ref()
            .map_or(point, |rank| rank[point] as usize)
    }
}
