//! Which time row and which point each row of a long-form history belongs to.

use super::{HistoryError, PointIds};
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
/// point runs through the same times in the same order. Rows in order of time and of ascending or
/// counted ids cost no memory here, which matters for millions of points.
#[derive(Default)]
pub(super) struct RowIndex {
    pub times: Vec<f64>,
    points: Points,
    /// The point that brought each time row.
    first: Vec<u32>,
    rows: usize,
    last: usize,
    /// What rows out of the order of time and point need, once there are such.
    disorder: Option<Disorder>,
}

struct Disorder {
    /// Time row and point of each row.
    slots: Vec<(u32, u32)>,
    /// Number of rows that each point has had.
    seen: Vec<u32>,
}

impl RowIndex {
    /// Takes one row; `line` finds its line if something is wrong with it.
    pub fn push(&mut self, path: &Path, time: f64, id: i64, line: &dyn Fn() -> u64) -> Result<Slot, HistoryError> {
        let known = self.points.find(id, self.last);
        let is_new = known.is_none();
        let point = known.unwrap_or(self.points.len());
        let at = if is_new { 0 } else { self.seen(point) };
        if at == self.times.len() {
            self.push_time(path, time, id, point, line)?;
        } else if time != self.times[at] {
            return Err(self.misfit(path, time, id, at, line));
        }
        let slot = Slot { time: at, point, is_new };
        self.note_order(slot);
        if is_new {
            self.points.push(id);
        }
        self.rows += 1;
        self.last = point;
        Ok(slot)
    }

    /// Number of rows that a known point has had.
    fn seen(&self, point: usize) -> usize {
        let points = self.points.len();
        match &self.disorder {
            Some(disorder) => disorder.seen[point] as usize,
            None => self.rows / points + usize::from(point < self.rows % points),
        }
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
                return Err(HistoryError::TimeGoesBack { path, line: line(), before, time, point: id });
            }
            if time == before && twice {
                return Err(HistoryError::TimeRepeated { path: path.into(), line: line(), time, point: id });
            }
        }
        self.times.push(time);
        self.first.push(point as u32);
        Ok(())
    }

    /// The error for a row whose time is not the one that its point should have next.
    fn misfit(&self, path: &Path, time: f64, id: i64, at: usize, line: &dyn Fn() -> u64) -> HistoryError {
        let path = path.to_path_buf();
        let expected = self.times[at];
        let other = self.points.id(self.first[at] as usize);
        let before = at.checked_sub(1).map(|at| self.times[at]);
        match before {
            Some(before) if time < before => HistoryError::TimeGoesBack { path, line: line(), before, time, point: id },
            Some(before) if time == before => HistoryError::PointTwice { path, line: line(), point: id, time, other },
            Some(before) if expected == before => {
                HistoryError::PointTwice { path, line: line(), point: other, time: before, other: id }
            }
            _ if time < expected => HistoryError::PointMissing { path, point: other, time, other: id },
            _ => HistoryError::PointMissing { path, point: id, time: expected, other },
        }
    }

    /// Takes note of a row that is about to be added, its point not yet.
    fn note_order(&mut self, slot: Slot) {
        let in_order =
            if slot.is_new { self.times.len() == 1 } else { slot.time * self.points.len() + slot.point == self.rows };
        if !in_order && self.disorder.is_none() {
            let points = self.points.len();
            let before = (0..self.rows).map(|row| ((row / points) as u32, (row % points) as u32));
            let seen = (0..points).map(|point| self.seen(point) as u32);
            self.disorder = Some(Disorder { slots: before.collect(), seen: seen.collect() });
        }
        if let Some(disorder) = &mut self.disorder {
            if slot.is_new {
                disorder.seen.push(0);
            }
            disorder.seen[slot.point] += 1;
            disorder.slots.push((slot.time as u32, slot.point as u32));
        }
    }

    /// Number of rows so far.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Time row and point of a row that was taken.
    pub fn slot(&self, row: usize) -> (usize, usize) {
        let points = self.points.len();
        match &self.disorder {
            Some(Disorder { slots, .. }) => (slots[row].0 as usize, slots[row].1 as usize),
            None => (row / points, row % points),
        }
    }

    /// Checks that every point has every time and fixes the order of the points.
    pub fn finish(self, path: &Path) -> Result<Placement, HistoryError> {
        if self.rows == 0 {
            return Err(HistoryError::NoRows { path: path.into() });
        }
        let points = self.points.len();
        let short = (0..points).find(|point| self.seen(*point) != self.times.len());
        if let Some(point) = short {
            let at = self.seen(point);
            let (point, time) = (self.points.id(point), self.times[at]);
            let other = self.points.id(self.first[at] as usize);
            let path = path.to_path_buf();
            return Err(if at > 0 && self.times[at - 1] == time {
                HistoryError::PointTwice { path, line: 0, point: other, time, other: point }
            } else {
                HistoryError::PointMissing { path, point, time, other }
            });
        }
        let (ids, rank) = self.points.sorted();
        let slots = self.disorder.map(|disorder| disorder.slots);
        Ok(Placement { times: self.times, ids, slots, rank })
    }
}

/// The ids in the order of first appearance.
enum Points {
    /// 0, 1, 2 and so on.
    Counted(usize),
    /// Ascending.
    Ascending(Vec<i64>),
    /// Any, with the place of each.
    Mixed(Vec<i64>, HashMap<i64, u32>),
}

impl Default for Points {
    fn default() -> Points {
        Points::Counted(0)
    }
}

impl Points {
    fn len(&self) -> usize {
        match self {
            Points::Counted(points) => *points,
            Points::Ascending(ids) | Points::Mixed(ids, _) => ids.len(),
        }
    }

    fn id(&self, point: usize) -> i64 {
        match self {
            Points::Counted(_) => point as i64,
            Points::Ascending(ids) | Points::Mixed(ids, _) => ids[point],
        }
    }

    /// The place of an id; mostly the one after the last, the last itself, or the first.
    fn find(&self, id: i64, last: usize) -> Option<usize> {
        let usual = |ids: &[i64]| [last + 1, last, 0].into_iter().find(|at| ids.get(*at) == Some(&id));
        match self {
            Points::Counted(points) => usize::try_from(id).ok().filter(|at| at < points),
            Points::Ascending(ids) if ids.last().is_none_or(|greatest| id > *greatest) => None,
            Points::Ascending(ids) => usual(ids).or_else(|| ids.binary_search(&id).ok()),
            Points::Mixed(ids, places) => usual(ids).or_else(|| places.get(&id).map(|at| *at as usize)),
        }
    }

    fn push(&mut self, id: i64) {
        if let Points::Counted(points) = self {
            if id == *points as i64 {
                *points += 1;
                return;
            }
            *self = Points::Ascending((0..*points as i64).collect());
        }
        if let Points::Ascending(ids) = self {
            if ids.last().is_none_or(|greatest| id > *greatest) {
                ids.push(id);
                return;
            }
            let places = ids.iter().enumerate().map(|(at, id)| (*id, at as u32)).collect();
            *self = Points::Mixed(std::mem::take(ids), places);
        }
        if let Points::Mixed(ids, places) = self {
            places.insert(id, ids.len() as u32);
            ids.push(id);
        }
    }

    /// The ids in ascending order and, if that is another one, the new place of each.
    fn sorted(self) -> (PointIds, Option<Vec<u32>>) {
        let ids = match self {
            Points::Counted(points) => return (PointIds::Counted(points), None),
            Points::Ascending(ids) => return (PointIds::from_list(ids), None),
            Points::Mixed(ids, _) => ids,
        };
        let mut order: Vec<u32> = (0..ids.len() as u32).collect();
        order.sort_unstable_by_key(|point| ids[*point as usize]);
        let mut rank = vec![0_u32; ids.len()];
        for (at, point) in order.iter().enumerate() {
            rank[*point as usize] = at as u32;
        }
        let ascending = order.iter().map(|point| ids[*point as usize]).collect();
        (PointIds::from_list(ascending), Some(rank))
    }
}

/// The finished arrangement: times, points by ascending id, and where each row goes.
pub(super) struct Placement {
    pub times: Vec<f64>,
    pub ids: PointIds,
    slots: Option<Vec<(u32, u32)>>,
    rank: Option<Vec<u32>>,
}

impl Placement {
    /// Values in the order of the rows, brought into the order of time and point.
    ///
    /// Rows that came in that order already are handed through without a copy.
    pub fn place_rows(&self, rows: Vec<f64>) -> Vec<f64> {
        if self.slots.is_none() && self.rank.is_none() {
            return rows;
        }
        let points = self.ids.len();
        let mut grid = vec![0.0; rows.len()];
        for (row, value) in rows.into_iter().enumerate() {
            let (time, point) = match &self.slots {
                Some(slots) => (slots[row].0 as usize, slots[row].1 as usize),
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
        self.rank.as_ref().map_or(point, |rank| rank[point] as usize)
    }
}
