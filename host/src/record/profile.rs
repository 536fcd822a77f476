//! Profiles along the surface, for plots.

use super::{FieldData, Geometry, Points, Units};

/// Most points without coordinates that are still drawn as a profile over their number: beyond it
/// neighbours in number are rarely neighbours on the surface and the line means nothing.
const MOST_NUMBERED_POINTS: usize = 2000;

/// Pressure and wear along the surface at the start and at the end of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile<'a> {
    /// What `coordinate` is: `x`, `y`, `z` or `point`.
    pub axis: String,
    /// Label of its unit; empty for point numbers.
    pub unit: String,
    /// Position along the surface, increasing, one per point of the profile.
    pub coordinate: FieldData<'a>,
    /// Contact pressure at the start.
    pub pressure_start: FieldData<'a>,
    /// Contact pressure at the end.
    pub pressure_end: FieldData<'a>,
    /// Wear depth at the start.
    pub wear_start: FieldData<'a>,
    /// Wear depth at the end.
    pub wear_end: FieldData<'a>,
}

/// The order in which the points of a geometry form a line along the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    axis: &'static str,
    coordinate: Vec<f64>,
    order: Vec<usize>,
}

impl Line {
    /// Finds the line of a geometry: the row of a grid through its middle, points that differ in
    /// one coordinate (or x in 2-D), or a moderate number of points without coordinates.
    ///
    /// One point, points scattered over an area and very many bare points form none.
    #[must_use]
    pub fn of(geometry: &Geometry<'_>) -> Option<Self> {
        let count = geometry.count();
        if count < 2 {
            return None;
        }
        match geometry {
            Geometry::Grid(grid) => {
                let (nx, ny) = (grid.cells[0], grid.cells[1]);
                let order: Vec<usize> = (0..nx).map(|i| (ny / 2) * nx + i).collect();
                let coordinate = order.iter().map(|&i| grid.centre(i)[0]).collect();
                (nx > 1).then_some(Self { axis: "x", coordinate, order })
            }
            Geometry::Points(points) => match &points.coordinates {
                Some(coordinates) => Self::along_one_axis(points, coordinates),
                None => (count <= MOST_NUMBERED_POINTS).then(|| Self::numbered(points)),
            },
        }
    }

    fn numbered(points: &Points<'_>) -> Self {
        let mut order: Vec<usize> = (0..points.ids.count()).collect();
        order.sort_by_key(|&i| points.ids.id(i));
        let coordinate = order.iter().map(|&i| points.ids.id(i) as f64).collect();
        Self { axis: "point", coordinate, order }
    }

    fn along_one_axis(points: &Points<'_>, coordinates: &[f64]) -> Option<Self> {
        let axes: &[usize] = if points.dimension == 2 { &[0] } else { &[0, 1, 2] };
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for at in coordinates.chunks_exact(3) {
            for &axis in axes {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis]);
            }
        }
        let extent = |axis: usize| high[axis] - low[axis];
        let &along = axes.iter().max_by(|&&a, &&b| extent(a).total_cmp(&extent(b)))?;
        // Rounding in a file of coordinates must not turn a straight line into a scattered set.
        let straight = axes.iter().all(|&axis| axis == along || extent(axis) <= 1e-6 * extent(along));
        if !straight || extent(along) <= 0.0 || !extent(along).is_finite() {
            return None;
        }
        let mut order: Vec<usize> = (0..points.ids.count().min(coordinates.len() / 3)).collect();
        order.sort_by(|&a, &b| coordinates[3 * a + along].total_cmp(&coordinates[3 * b + along]));
        let coordinate = order.iter().map(|&i| coordinates[3 * i + along]).collect();
        Some(Self { axis: ["x", "y", "z"][along], coordinate, order })
    }

    /// The profile of four scalar fields (`[point]`) over this line.
    ///
    /// A field shorter than the geometry gives a shorter profile; the plot draws what is there.
    #[must_use]
    pub fn profile(
        &self,
        units: &Units,
        [pressure_start, pressure_end, wear_start, wear_end]: [&[f64]; 4],
    ) -> Profile<'static> {
        let along = |field: &[f64]| -> FieldData<'static> {
            self.order.iter().filter_map(|&i| field.get(i).copied()).collect()
        };
        Profile {
            axis: self.axis.into(),
            unit: if self.axis == "point" { String::new() } else { units.length.clone() },
            coordinate: self.coordinate.clone().into(),
            pressure_start: along(pressure_start),
            pressure_end: along(pressure_end),
            wear_start: along(wear_start),
            wear_end: along(wear_end),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Grid, PointIds};

    fn placed(coordinates: Vec<f64>, dimension: u8) -> Geometry<'static> {
        Geometry::Points(Points {
            ids: PointIds::Counted { first: 0, count: coordinates.len() / 3 },
            coordinates: Some(coordinates.into()),
            dimension,
        })
    }

    #[test]
    fn points_on_a_line_are_sorted_along_it() {
        let line = Line::of(&placed(vec![0.0, 2.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.5, 1e-9], 3)).unwrap();
        assert_eq!((line.axis, &line.order[..]), ("y", &[1, 2, 0][..]));
        let field = [10.0, 11.0, 12.0];
        let profile = line.profile(&Units::default(), [&field; 4]);
        assert_eq!(&profile.wear_end[..], [11.0, 12.0, 10.0]);
        assert_eq!(&profile.coordinate[..], [-1.0, 0.5, 2.0]);
        assert_eq!(profile.unit, "m");
    }

    #[test]
    fn scattered_points_form_a_line_in_two_dimensions_only() {
        let curved = vec![0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 2.0, 0.0, 0.0];
        assert_eq!(Line::of(&placed(curved.clone(), 3)), None);
        assert_eq!(Line::of(&placed(curved, 2)).unwrap().axis, "x");
        assert_eq!(Line::of(&placed(vec![1.0; 6], 3)), None, "all points in one place");
    }

    #[test]
    fn bare_points_are_drawn_over_their_number_while_they_are_few() {
        let bare = |count| {
            Geometry::Points(Points { ids: PointIds::Counted { first: 5, count }, coordinates: None, dimension: 3 })
        };
        assert_eq!(Line::of(&bare(1)), None);
        assert_eq!(Line::of(&bare(3)).unwrap().coordinate, [5.0, 6.0, 7.0]);
        assert_eq!(Line::of(&bare(MOST_NUMBERED_POINTS + 1)), None);
    }

    #[test]
    fn a_grid_is_cut_through_its_middle() {
        let grid = Grid { cells: [3, 5], size: [3.0, 5.0], origin: [0.0, 0.0] };
        let line = Line::of(&Geometry::Grid(grid)).unwrap();
        assert_eq!(line.order, [6, 7, 8]);
        assert_eq!(line.coordinate, [0.5, 1.5, 2.5]);
    }
}
