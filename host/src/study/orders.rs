//! Observed orders: how fast the error of a line falls with its step.

use crate::record::{Case, Errors, Kind, Order, Status};

/// An order is taken from errors so many times as large as the yardstick's own, which then changes it by a fiftieth at most.
const CLEAR: f64 = 30.0;
/// From the finest so many cases.
const CASES: usize = 3;

/// The orders of all lines of fixed substeps with two cases or more that the yardstick tells clearly.
pub(super) fn orders(cases: &[Case], norm: &str, stated: &Errors) -> Vec<Order> {
    let least = CLEAR * stated.get(norm).copied().unwrap_or(0.0);
    let mut lines: Vec<&str> = Vec::new();
    for case in cases.iter().filter(|case| case.kind == Kind::Substeps) {
        if !lines.contains(&case.line.as_str()) {
            lines.push(&case.line);
        }
    }
    let of = |line: &str| {
        let mine = cases.iter().filter(|case| case.line == line && case.status == Status::Done);
        let seen = mine.filter_map(|case| Some((case.value, case.resolved(norm)?)));
        let mut points: Vec<(f64, f64)> = seen.filter(|(_, error)| *error > least && *error > 0.0).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let points = &points[points.len().saturating_sub(CASES)..];
        let (from, to) = (points.first()?.0, points.last()?.0);
        (points.len() > 1).then(|| Order {
            line: line.to_owned(),
            order: -slope(points),
            cases: points.len(),
            from,
            to,
        })
    };
    lines.into_iter().filter_map(of).collect()
}

/// Slope of log error over log value, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(value, error)| (value.ln(), error.ln())).collect();
    let count = logs.len() as f64;
    let mean = logs.iter().fold((0.0, 0.0), |sum, at| (sum.0 + at.0 / count, sum.1 + at.1 / count));
    let across: f64 = logs.iter().map(|at| (at.0 - mean.0).powi(2)).sum();
    let both: f64 = logs.iter().map(|at| (at.0 - mean.0) * (at.1 - mean.1)).sum();
    both / across
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_that_of_a_line_through_the_points() {
        let points: Vec<(f64, f64)> = [4.0, 8.0, 16.0].iter().map(|n: &f64| (*n, 3.0 * n.powf(-2.0))).collect();
        assert!((slope(&points) + 2.0).abs() < 1e-12);
        assert!((slope(&points[..2]) + 2.0).abs() < 1e-12);
    }
}
