//! Nodal tractions of a pressure on cells: averaged to the corners and back.

use super::Cells;

/// M p `[cells]`, M = B^T B: the mean of each corner's cells, then the mean of each cell's corners, on the cells that carry
/// pressure; zero elsewhere. What lies beyond the grid carries none, unless the grid repeats.
///
/// Its symbol is cos^2(q h / 2) in every direction, not negative: implicit wear from it damps every wave, while a one-way
/// average to the corners feeds the chequerboard.
pub fn nodal_traction(cells: &Cells, periodic: bool, pressure: &[f64], out: &mut [f64]) {
    corners_and_back(cells, periodic, pressure, out);
    out.iter_mut().zip(pressure).filter(|(_, pressure)| **pressure == 0.0).for_each(|(out, _)| *out = 0.0);
}

/// M p `[cells]` with the cells next to those that carry pressure: a traction that has no jump where a cell closes.
pub fn corners_and_back(cells: &Cells, periodic: bool, pressure: &[f64], out: &mut [f64]) {
    let [nx, ny] = cells.counts;
    let near = |at: usize, count: usize, by: isize| -> Option<usize> {
        let to = at as isize + by;
        if (0..count as isize).contains(&to) {
            Some(to as usize)
        } else if periodic {
            Some(to.rem_euclid(count as isize) as usize)
        } else {
            None
        }
    };
    // Twice the half-half average of neighbours is the weight 1/4, 1/2, 1/4 along each axis.
    let along_y = if cells.dimension == 2 { &[(0, 1.0)][..] } else { &[(-1, 0.25), (0, 0.5), (1, 0.25)][..] };
    for j in 0..ny {
        for i in 0..nx {
            let mut sum = 0.0;
            for (dj, weight_y) in along_y {
                let Some(row) = near(j, ny, *dj) else { continue };
                for (di, weight_x) in [(-1, 0.25), (0, 0.5), (1, 0.25)] {
                    if let Some(column) = near(i, nx, di) {
                        sum += weight_y * weight_x * pressure[row * nx + column];
                    }
                }
            }
            out[j * nx + i] = sum;
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
        assert_eq!(out, [1.0, 2.0, 1.0, 2.0, 4.0]);
        nodal_traction(&cells, false, &[0.0, 4.0, 0.0, 0.0, 8.0], &mut out);
        assert_eq!(out, [0.0, 2.0, 0.0, 0.0, 4.0]);
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
