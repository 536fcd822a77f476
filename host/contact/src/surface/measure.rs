//! What is measured on a gap: its spread and its mirrors.

use super::super::Cells;

/// Standard deviation of the gap over the cells where it is finite: the length that complementarity errors of the contact
/// solve are measured with.
///
/// Where all finite gaps are equal it is the largest of them, and where that is zero the length of one cell, so that it
/// is always above zero.
#[must_use]
pub fn std_of_gap(cells: &Cells, gap: &[f64]) -> f64 {
    let finite = || gap.iter().copied().filter(|gap| gap.is_finite());
    let largest = finite().fold(0.0, |most: f64, gap| most.max(gap.abs()));
    if largest == 0.0 {
        return cells.spacing[0];
    }
    // Relative to the largest, so that no square leaves the range of doubles.
    let (sum, count) = finite().fold((0.0, 0.0), |(sum, count), gap| (sum + gap / largest, count + 1.0));
    let mean = sum / count;
    let variance = finite().map(|gap| (gap / largest - mean).powi(2)).sum::<f64>() / count;
    // What rounding of the mean alone can leave is no spread.
    if variance.sqrt() <= 4.0 * f64::EPSILON { largest } else { variance.sqrt() * largest }
}

/// A mirror of the cells along one axis: cell i and cell `sum` - i have the same gap, bit by bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mirror {
    /// Sum of the numbers of two cells that are images of each other; on a periodic grid modulo the number of cells.
    pub sum: usize,
    /// Rows of cells whose image lies beyond the grid. A gap has to stay open there if half of the cells are to stand for
    /// all; zero on a periodic grid.
    pub without_image: usize,
}

/// The mirrors of a gap in x and in y, about the cell with the smallest gap or about the middle of the grid, whichever
/// leaves fewer cells without an image; `None` where there is none, and in y in 2-D.
#[must_use]
pub fn mirrors(cells: &Cells, gap: &[f64], periodic: bool) -> [Option<Mirror>; 2] {
    let lowest = gap.iter().enumerate().fold(0, |best, (at, value)| if *value < gap[best] { at } else { best });
    let nx = cells.counts[0];
    let apex = [lowest % nx, lowest / nx];
    let find = |axis: usize| {
        let count = cells.counts[axis];
        // The lowest cell may be one of two on both sides of an edge.
        let sums = [count - 1, 2 * (count / 2), 2 * apex[axis], 2 * apex[axis] + 1];
        let candidates = sums.into_iter().map(|sum| {
            let without_image = if periodic { 0 } else { (sum + 1).abs_diff(count) };
            Mirror { sum: if periodic { sum % count } else { sum }, without_image }
        });
        let holds = |mirror: &Mirror| mirror.without_image < count && is_mirror(cells, gap, axis, mirror.sum, periodic);
        candidates.filter(holds).min_by_key(|mirror| mirror.without_image)
    };
    [find(0), if cells.dimension == 2 { None } else { find(1) }]
}

fn is_mirror(cells: &Cells, gap: &[f64], axis: usize, sum: usize, periodic: bool) -> bool {
    let [nx, ny] = cells.counts;
    let count = cells.counts[axis];
    let image = |cell: usize| {
        if periodic { Some((sum + count - cell) % count) } else { sum.checked_sub(cell).filter(|image| *image < count) }
    };
    let same = |a: usize, b: usize| gap[a].to_bits() == gap[b].to_bits();
    (0..count).all(|cell| match image(cell) {
        Some(other) if other > cell && axis == 0 => (0..ny).all(|y| same(y * nx + cell, y * nx + other)),
        Some(other) if other > cell => (0..nx).all(|x| same(cell * nx + x, other * nx + x)),
        _ => true,
    })
}
