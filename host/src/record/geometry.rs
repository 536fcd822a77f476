//! Where the points of a field lie.

use super::FieldData;
use std::borrow::Cow;

/// The points of a run: listed one by one, or the cells of a regular grid.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry<'a> {
    /// Points of a prescribed history.
    Points(Points<'a>),
    /// Cells of a regular grid.
    Grid(Grid),
}

impl Geometry<'_> {
    /// Number of points.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Geometry::Points(points) => points.ids.count(),
            Geometry::Grid(grid) => grid.cells.iter().product(),
        }
    }

    /// Number of the point at `index`, as the input names it; cells count from 0.
    #[must_use]
    pub fn id(&self, index: usize) -> u64 {
        match self {
            Geometry::Points(points) => points.ids.id(index),
            Geometry::Grid(_) => index as u64,
        }
    }

    /// Coordinates of the point at `index` (the centre of a cell), where they are known.
    #[must_use]
    pub fn coordinates(&self, index: usize) -> Option<[f64; 3]> {
        match self {
            Geometry::Points(points) => {
                let at = points.coordinates.as_ref()?.get(3 * index..3 * index + 3)?;
                Some([at[0], at[1], at[2]])
            }
            Geometry::Grid(grid) => Some(grid.centre(index)),
        }
    }
}

/// Points listed one by one.
#[derive(Debug, Clone, PartialEq)]
pub struct Points<'a> {
    /// The numbers by which the input names the points.
    pub ids: PointIds<'a>,
    /// Coordinates `[point][3]` in the scene's length, where the input gives them.
    pub coordinates: Option<FieldData<'a>>,
    /// 2 for plane problems (x along the surface, z normal to it), 3 otherwise.
    pub dimension: u8,
}

/// The numbers of the points, which take no memory where they are consecutive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PointIds<'a> {
    /// `first`, `first + 1`, ..
    Counted {
        /// Number of the first point.
        first: u64,
        /// How many points there are.
        count: usize,
    },
    /// Any numbers, one per point.
    Listed(Cow<'a, [u64]>),
}

impl PointIds<'_> {
    /// How many points there are.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            PointIds::Counted { count, .. } => *count,
            PointIds::Listed(ids) => ids.len(),
        }
    }

    /// Whether the numbers are 0, 1, .., so that a file need not list them.
    #[must_use]
    pub fn are_indices(&self) -> bool {
        matches!(self, PointIds::Counted { first: 0, .. })
    }

    /// Number of the point at `index`, which is below `count`.
    #[must_use]
    pub fn id(&self, index: usize) -> u64 {
        match self {
            PointIds::Counted { first, .. } => first + index as u64,
            PointIds::Listed(ids) => ids[index],
        }
    }
}

/// A regular grid of cells in the plane of contact; x varies fastest in every field over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Cells in x and y; y has one cell in 2-D.
    pub cells: [usize; 2],
    /// Lengths of the whole grid in x and y.
    pub size: [f64; 2],
    /// The corner of the first cell.
    pub origin: [f64; 2],
}

impl Grid {
    /// Lengths of one cell in x and y.
    #[must_use]
    pub fn spacing(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.size[axis] / self.cells[axis].max(1) as f64)
    }

    /// Centre of the cell at `index`, z being 0.
    #[must_use]
    pub fn centre(&self, index: usize) -> [f64; 3] {
        let across = self.cells[0].max(1);
        let spacing = self.spacing();
        let at = |axis: usize, cell: usize| self.origin[axis] + (cell as f64 + 0.5) * spacing[axis];
        [at(0, index % across), at(1, index / across), 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_count_along_x_first() {
        let grid = Grid { cells: [4, 2], size: [8.0, 2.0], origin: [-4.0, 0.0] };
        let geometry = Geometry::Grid(grid);
        assert_eq!(geometry.count(), 8);
        assert_eq!(geometry.coordinates(1), Some([-1.0, 0.5, 0.0]));
        assert_eq!(geometry.coordinates(6), Some([1.0, 1.5, 0.0]));
    }

    #[test]
    fn points_have_coordinates_only_where_given() {
        let mut points = Points { ids: PointIds::Counted { first: 1, count: 2 }, coordinates: None, dimension: 3 };
        let bare = Geometry::Points(points.clone());
        assert_eq!((bare.id(1), bare.coordinates(1)), (2, None));
        points.coordinates = Some(vec![0.0, 1.0, 2.0, 3.0, 4.0, 5.0].into());
        let placed = Geometry::Points(points);
        assert_eq!(placed.coordinates(1), Some([3.0, 4.0, 5.0]));
        assert_eq!(placed.coordinates(2), None);
    }
}
