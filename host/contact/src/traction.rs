//! Nodal tractions of a pressure on cells: averaged to the corners and back.

use super::Cells;

/// M p `[cells]`, M = B^T B: the mean of each corner's cells, then the mean of each cell's corners, on the cells that carry
/// pressure; zero elsewhere. A corner on the rim of a grid that does not repeat has fewer cells.
///
/// Its symbol is cos^2(q h / 2) in every direction, not negative: implicit wear from it damps every wave, while a one-way
/// average to the corners feeds the chequerboard.
pub fn nodal_traction(cells: &Cells, periodic: bool, pressure: &[f64], out: &mut [f64]) {
    corners_and_back(cells, periodic, pressure, out);
    out.iter_mut().zip(pressure).filter(|(_, pressure)| **pressure == 0.0).for_each(|(out, _)| *out = 0.0);
}

/// M p `[cells]` with the cells next to those that carry pressure: a traction that has no jump where a cell closes. Its sum
/// is that of the pressures.
pub fn corners_and_back(cells: &Cells, periodic: bool, pressure: &[f64], out: &mut [f64]) {
    averaged_twice(cells.counts, [periodic; 2], pressure, out);
}

/// M p `[counts]` on a rectangle of cells that repeats along some axes.
///
/// M is the product of the like in x and in y, (1, 2, 1) / 4, a neighbour beyond a side that does not repeat being the cell
/// itself; symmetric, with eigenvalues from 0 to 1.
pub fn averaged_twice(counts: [usize; 2], repeats: [bool; 2], pressure: &[f64], out: &mut [f64]) {
    let [nx, ny] = counts;
    let beside = |at: usize, axis: usize| match (counts[axis], repeats[axis]) {
        (count, true) => [(at + count - 1) % count, (at + 1) % count],
        (count, false) => [at.saturating_sub(1), (at + 1).min(count - 1)],
    };
    let mut along = vec![0.0; pressure.len()];
    for (row, along) in pressure.chunks_exact(nx).zip(along.chunks_exact_mut(nx)) {
        for (x, along) in along.iter_mut().enumerate() {
            let [left, right] = beside(x, 0);
            *along = 0.5 * row[x] + 0.25 * (row[left] + row[right]);
        }
    }
    for (y, out) in out.chunks_exact_mut(nx).enumerate().take(ny) {
        let [below, above] = beside(y, 1);
        for (x, out) in out.iter_mut().enumerate() {
            *out = 0.5 * along[y * nx + x] + 0.25 * (along[below * nx + x] + along[above * nx + x]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_uniform_pressure_stays_and_a_chequerboard_vanishes() {
        let cells = Cells { dimension: 3, counts: [4, 6], spacing: [1.0, 1.0] };
        let mut out = vec![0.0; 24];
        nodal_traction(&cells, true, &[3.0; 24], &mut out);
        assert_eq!(out, [3.0; 24]);
        let chequered: Vec<f64> = (0..24).map(|k| if (k % 4 + k / 4) % 2 == 0 { 1.0 } else { -1.0 }).collect();
        nodal_traction(&cells, true, &chequered, &mut out);
        assert_eq!(out, [0.0; 24]);
    }

    #[test]
    fn it_reaches_the_neighbours_of_loaded_cells_where_that_is_asked_for() {
        let cells = Cells { dimension: 2, counts: [5, 1], spacing: [1.0, 1.0] };
        let mut out = vec![9.0; 5];
        corners_and_back(&cells, false, &[0.0, 4.0, 0.0, 0.0, 8.0], &mut out);
        // The last corner has no other cell.
        assert_eq!(out, [1.0, 2.0, 1.0, 2.0, 6.0]);
        nodal_traction(&cells, false, &[0.0, 4.0, 0.0, 0.0, 8.0], &mut out);
        assert_eq!(out, [0.0, 2.0, 0.0, 0.0, 6.0]);
    }

    #[test]
    fn it_is_symmetric_on_the_cells_in_contact() {
        let cells = Cells { dimension: 3, counts: [5, 4], spacing: [1.0, 2.0] };
        let closed = |k: usize| k % 7 != 3;
        let unit = |at: usize| -> Vec<f64> {
            // Tiny elsewhere: in contact, but next to no weight.
            (0..20)
                .map(|k| {
                    if !closed(k) {
                        0.0
                    } else if k == at {
                        1.0
                    } else {
                        1e-300
                    }
                })
                .collect()
        };
        let image = |at: usize| {
            let mut out = vec![0.0; 20];
            nodal_traction(&cells, false, &unit(at), &mut out);
            out
        };
        for (a, b) in [(0, 1), (6, 12), (5, 11), (13, 18)] {
            assert_eq!(image(a)[b], image(b)[a], "{a} {b}");
        }
        assert!(image(6)[12] > 0.0);
    }
}
