//! Quantities over one piece of loading: linear in time, from a history or from a load step.

use std::ops::Range;

use crate::contact::prescribed::{ColumnView, RowView};
use crate::law::Values;
use crate::plan::Linear;

/// A quantity over a piece.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source<'h> {
    /// Nothing gives it.
    Absent,
    /// The same at every point.
    Uniform(Linear),
    /// Between two rows of a history; the piece reaches from fraction `a` to fraction `b` of the way.
    Rows {
        /// Values of all points at the row before.
        from: &'h [f64],
        /// Values of all points at the row after.
        to: &'h [f64],
        /// Fraction at the start of the piece.
        a: f64,
        /// Fraction at the end of the piece.
        b: f64,
    },
}

/// Where a piece lies in a history: between rows `k` and `k1`, from fraction `a` to fraction `b`, the rows `time` apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Between {
    pub(super) k: usize,
    pub(super) k1: usize,
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) time: f64,
}

impl<'h> Source<'h> {
    /// A column of a history over a piece.
    pub(super) fn column(column: Option<ColumnView<'h>>, at: Between) -> Source<'h> {
        let Some(column) = column else { return Source::Absent };
        match (column.row(at.k), column.row(at.k1)) {
            (RowView::PerPoint(from), RowView::PerPoint(to)) => Source::Rows { from, to, a: at.a, b: at.b },
            (RowView::Uniform(from), RowView::Uniform(to)) => {
                let line = Linear { from, to };
                Source::Uniform(Linear { from: line.at(at.a), to: line.at(at.b) })
            }
            // Both rows of one column have the same form.
            _ => Source::Absent,
        }
    }

    /// A column's rate of change over a piece: constant between two rows.
    pub(super) fn rate(column: Option<ColumnView<'h>>, at: Between) -> Rate<'h> {
        match (column.map(|c| c.row(at.k)), column.map(|c| c.row(at.k1))) {
            (Some(RowView::PerPoint(from)), Some(RowView::PerPoint(to))) => Rate::Rows { from, to, time: at.time },
            (Some(RowView::Uniform(from)), Some(RowView::Uniform(to))) if at.time > 0.0 => {
                Rate::Uniform((to - from) / at.time)
            }
            _ => Rate::Uniform(0.0),
        }
    }

    pub(super) fn is_absent(&self) -> bool {
        matches!(self, Source::Absent)
    }

    /// Whether it does not change over the piece.
    pub(super) fn is_constant(&self) -> bool {
        match self {
            Source::Absent => true,
            Source::Uniform(line) => line.from == line.to,
            Source::Rows { from, to, .. } => std::ptr::eq(*from, *to),
        }
    }

    /// Values at a fraction of the piece for the points of `range`; the history's own array where it holds them.
    pub(super) fn at<'b>(&self, part: f64, range: Range<usize>, room: &'b mut Vec<f64>) -> Values<'b>
    where
        'h: 'b,
    {
        match *self {
            Source::Absent => Values::Absent,
            Source::Uniform(line) => Values::Uniform(line.at(part)),
            Source::Rows { from, to, a, b } => {
                let way = a + part * (b - a);
                if way == 0.0 || std::ptr::eq(from, to) {
                    return Values::PerPoint(&from[range]);
                }
                if way == 1.0 {
                    return Values::PerPoint(&to[range]);
                }
                room.clear();
                room.extend(from[range.clone()].iter().zip(&to[range]).map(|(p, q)| p + way * (q - p)));
                Values::PerPoint(room)
            }
        }
    }

    /// Fractions of the piece at which it crosses `level`, at most `most` different ones; `None` if there are more.
    pub(super) fn crossings(&self, level: f64, most: usize) -> Option<Vec<f64>> {
        let root = |from: f64, to: f64| {
            let (p, q) = (from - level, to - level);
            (p * q < 0.0).then(|| p / (p - q))
        };
        match *self {
            Source::Absent => Some(Vec::new()),
            Source::Uniform(line) => Some(root(line.from, line.to).into_iter().collect()),
            Source::Rows { from, to, a, b } => {
                let mut found: Vec<f64> = Vec::new();
                if std::ptr::eq(from, to) {
                    return Some(found);
                }
                for (p, q) in from.iter().zip(to) {
                    let (start, end) = (p + a * (q - p), p + b * (q - p));
                    if let Some(at) = root(start, end)
                        && !found.iter().any(|known| (known - at).abs() < 1e-12)
                    {
                        found.push(at);
                        if found.len() > most {
                            return None;
                        }
                    }
                }
                Some(found)
            }
        }
    }
}

/// A rate of change over a piece.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rate<'h> {
    Uniform(f64),
    Rows { from: &'h [f64], to: &'h [f64], time: f64 },
}

impl Rate<'_> {
    pub(super) fn at<'b>(&self, range: Range<usize>, room: &'b mut Vec<f64>) -> Values<'b> {
        match *self {
            Rate::Uniform(rate) => Values::Uniform(rate),
            Rate::Rows { .. } if matches!(self, Rate::Rows { time, .. } if *time == 0.0) => Values::Uniform(0.0),
            Rate::Rows { from, to, time } => {
                room.clear();
                room.extend(from[range.clone()].iter().zip(&to[range]).map(|(p, q)| (q - p) / time));
                Values::PerPoint(room)
            }
        }
    }

    pub(super) fn is_uniform(&self) -> bool {
        matches!(self, Rate::Uniform(_))
    }
}

/// One number of a column of values; NaN where there is none.
pub(super) fn value(values: &Values<'_>, i: usize) -> f64 {
    match values {
        Values::Uniform(value) => *value,
        Values::PerPoint(all) => all[i],
        _ => f64::NAN,
    }
}

/// A function of one column, point by point.
pub(super) fn map<'b>(a: &Values<'_>, room: &'b mut Vec<f64>, f: impl Fn(f64) -> f64) -> Values<'b> {
    match a {
        Values::Uniform(a) => Values::Uniform(f(*a)),
        Values::PerPoint(a) => {
            room.clear();
            room.extend(a.iter().map(|a| f(*a)));
            Values::PerPoint(room)
        }
        _ => Values::Absent,
    }
}

/// A function of two columns, point by point.
pub(super) fn zip<'b>(
    a: &Values<'_>,
    b: &Values<'_>,
    points: usize,
    room: &'b mut Vec<f64>,
    f: impl Fn(f64, f64) -> f64,
) -> Values<'b> {
    if let (Values::Uniform(a), Values::Uniform(b)) = (a, b) {
        return Values::Uniform(f(*a, *b));
    }
    room.clear();
    room.extend((0..points).map(|i| f(value(a, i), value(b, i))));
    Values::PerPoint(room)
}

/// A vector at every point.
pub(super) fn vectors<'b>(points: usize, room: &'b mut Vec<f64>, f: impl Fn(usize) -> [f64; 3]) -> Values<'b> {
    room.clear();
    room.extend((0..points).flat_map(f));
    Values::PerPoint(room)
}

/// The vector at one point.
pub(super) fn vector(values: &Values<'_>, i: usize) -> [f64; 3] {
    match values {
        Values::UniformVector(vector) => *vector,
        Values::PerPoint(all) => [all[3 * i], all[3 * i + 1], all[3 * i + 2]],
        _ => [f64::NAN; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_linear_and_their_ends_are_not_copied() {
        let (from, to) = ([0.0, 2.0], [4.0, -2.0]);
        let source = Source::Rows { from: &from, to: &to, a: 0.0, b: 0.5 };
        let mut room = Vec::new();
        assert_eq!(source.at(1.0, 0..2, &mut room), Values::PerPoint(&[2.0, 0.0]));
        let Values::PerPoint(start) = source.at(0.0, 0..2, &mut room) else { panic!("rows are per point") };
        assert!(std::ptr::eq(start, &from[..]));
    }

    #[test]
    fn crossings_are_found_once_and_not_without_bound() {
        let (from, to) = ([-1.0, -2.0, 1.0, -1.0], [1.0, 2.0, 3.0, 3.0]);
        let source = Source::Rows { from: &from, to: &to, a: 0.0, b: 1.0 };
        assert_eq!(source.crossings(0.0, 2), Some(vec![0.5, 0.25]));
        assert_eq!(source.crossings(0.0, 1), None);
        let line = Source::Uniform(Linear { from: 1.0, to: -3.0 });
        assert_eq!(line.crossings(0.0, 1), Some(vec![0.25]));
        assert_eq!(line.crossings(-4.0, 1), Some(vec![]));
    }

    #[test]
    fn rates_are_differences_over_the_time_between_rows() {
        let (from, to) = ([0.0, 2.0], [4.0, -2.0]);
        let mut room = Vec::new();
        let rate = Rate::Rows { from: &from, to: &to, time: 2.0 };
        assert_eq!(rate.at(0..2, &mut room), Values::PerPoint(&[2.0, -2.0]));
    }
}
