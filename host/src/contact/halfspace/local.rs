//! The smoothed pressure, which a local compliance may act on instead of the pressure of a cell.

use super::Boundary;

/// The smoothed pressure M p `[counts]`, M = B^T B: corners get the mean of the cells around them, cells the mean of
/// their corners. A corner at a free boundary has fewer cells around it.
///
/// M is symmetric with eigenvalues from 0 to 1; it keeps a uniform pressure, and the sum of any. It is the product of
/// the like in x and in y, (1, 2, 1) / 4, a neighbour beyond a free boundary being the cell itself.
pub fn smoothed(counts: [usize; 2], sides: [Boundary; 2], pressure: &[f64], out: &mut [f64]) {
    let [nx, ny] = counts;
    let beside = |at: usize, axis: usize, count: usize| match sides[axis] {
        Boundary::Periodic => [(at + count - 1) % count, (at + 1) % count],
        Boundary::Free => [at.saturating_sub(1), (at + 1).min(count - 1)],
    };
    let mut along = vec![0.0; pressure.len()];
    for (row, along) in pressure.chunks_exact(nx).zip(along.chunks_exact_mut(nx)) {
        for (x, along) in along.iter_mut().enumerate() {
            let [left, right] = beside(x, 0, nx);
            *along = 0.5 * row[x] + 0.25 * (row[left] + row[right]);
        }
    }
    for (y, out) in out.chunks_exact_mut(nx).enumerate() {
        let [below, above] = beside(y, 1, ny);
        for (x, out) in out.iter_mut().enumerate() {
            *out = 0.5 * along[y * nx + x] + 0.25 * (along[below * nx + x] + along[above * nx + x]);
        }
    }
}
