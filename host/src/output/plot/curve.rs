//! Curves: what a panel draws, thinned to what its pixels can show.

/// Columns of a panel that are told apart when a curve is thinned.
const COLUMNS: usize = 800;
/// Up to this many points a curve shows each of them as a dot.
const MOST_DOTS: usize = 12;

/// How a curve is drawn; curves differ in dash as well as in colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// The only curve, or the state at the end: solid.
    End,
    /// The state at the start: dashed.
    Start,
}

/// A curve over the coordinates of its panel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    /// The word in the legend; empty for the only curve of a panel.
    pub name: &'static str,
    pub look: Look,
    pub points: Vec<(f64, f64)>,
    /// Whether the points are single instants worth a dot each.
    pub dots: bool,
}

impl Curve {
    /// A curve through the points; points beyond the shorter of both are not drawn.
    pub fn new(name: &'static str, look: Look, points: impl Iterator<Item = (f64, f64)>) -> Self {
        Self { name, look, points: points.collect(), dots: true }
    }

    /// Whether every point is shown as a dot.
    pub fn has_dots(&self) -> bool {
        self.dots && self.points.len() <= MOST_DOTS
    }

    /// The runs of finite points, each thinned to at most four points per column: the first, the
    /// lowest, the highest and the last keep the drawn line the same.
    pub fn lines(&self, fraction: impl Fn(f64) -> f64) -> Vec<Vec<(f64, f64)>> {
        self.points
            .split(|(x, y)| !(x.is_finite() && y.is_finite()))
            .filter(|run| !run.is_empty())
            .map(|run| {
                if run.len() <= 4 * COLUMNS {
                    return run.to_vec();
                }
                let column = |x: f64| (fraction(x) * COLUMNS as f64).floor();
                run.chunk_by(|a, b| column(a.0) == column(b.0)).flat_map(outline).collect()
            })
            .collect()
    }
}

fn outline(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let by_height = |a: &&usize, b: &&usize| points[**a].1.total_cmp(&points[**b].1);
    let all: Vec<usize> = (0..points.len()).collect();
    let mut kept = vec![0, points.len() - 1];
    kept.extend(all.iter().min_by(by_height));
    kept.extend(all.iter().max_by(by_height));
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| points[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_ends_and_peaks() {
        let mut points: Vec<(f64, f64)> = (0..100_000).map(|i| (f64::from(i), (f64::from(i) * 0.7).sin())).collect();
        points[54_321].1 = 9.0;
        points[54_322].1 = -9.0;
        let curve = Curve::new("", Look::End, points.iter().copied());
        let lines = curve.lines(|x| x / 99_999.0);
        assert_eq!(lines.len(), 1);
        let line = &lines[0];
        assert!(line.len() <= 4 * (COLUMNS + 1) && line.len() > COLUMNS);
        assert_eq!((line[0], line[line.len() - 1]), (points[0], points[99_999]));
        assert!(line.contains(&points[54_321]) && line.contains(&points[54_322]));
        assert!(line.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn a_number_that_is_none_leaves_a_gap() {
        let heights = [1.0, 2.0, f64::NAN, 3.0];
        let points = heights.iter().enumerate().map(|(i, &y)| (i as f64, y));
        let lines = Curve::new("", Look::End, points).lines(|x| x);
        assert_eq!(lines, [vec![(0.0, 1.0), (1.0, 2.0)], vec![(3.0, 3.0)]]);
    }
}
