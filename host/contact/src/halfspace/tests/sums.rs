//! Kernels against quadrature and convolutions against sums over all pairs of cells.

use std::f64::consts::PI;

use super::*;

/// The displacement of every cell by the definition of the kernels.
pub fn direct(cells: &Cells, boundary: Boundary, datum: f64, pressure: &[f64]) -> Vec<f64> {
    let [nx, ny] = cells.counts;
    let [hx, hy] = cells.spacing;
    let lag = |a: usize, b: usize| [(a % nx).abs_diff(b % nx), (a / nx).abs_diff(b / nx)];
    let kernel = |a: usize, b: usize| {
        let [x, y] = lag(a, b);
        match boundary {
            Boundary::Free if cells.dimension == 2 => influence::strip(x as f64 * hx, hx, datum),
            Boundary::Free => influence::rectangle(x as f64 * hx, y as f64 * hy, hx, hy),
            Boundary::Periodic => {
                let wave = |k: usize, x: usize, n: usize| 2.0 * PI * (k * x) as f64 / n as f64;
                let modes = (0..nx * ny).map(|k| [k % nx, k / nx]);
                modes
                    .map(|k| {
                        influence::mode(k, cells.counts, cells.spacing) * (wave(k[0], x, nx) + wave(k[1], y, ny)).cos()
                    })
                    .sum::<f64>()
                    / (nx * ny) as f64
            }
        }
    };
    let count = cells.count();
    (0..count).map(|a| (0..count).map(|b| kernel(a, b) * pressure[b]).sum::<f64>() / MODULUS).collect()
}

/// Cells of many shapes: odd and even, not square, not cubic.
pub fn shapes() -> Vec<Cells> {
    vec![
        line(1, 0.7),
        line(2, 0.7),
        line(17, 2e-6),
        line(24, 3.0),
        plane([1, 1], [1.0, 1.0]),
        plane([7, 5], [1e-3, 1e-3]),
        plane([5, 8], [2e-3, 7e-3]),
        plane([12, 9], [1.5, 0.4]),
        plane([16, 16], [1e-6, 1e-6]),
        plane([10, 10], [1.0, 0.6]),
        plane([19, 3], [1e-6, 2e-6]),
    ]
}

#[test]
fn a_convolution_is_the_sum_over_all_cells() {
    let mut numbers = Numbers(1);
    for cells in shapes() {
        for boundary in [Boundary::Free, Boundary::Periodic] {
            let pressure = numbers.many(cells.count());
            let datum = 0.5 * cells.counts[0] as f64 * cells.spacing[0];
            let wanted = direct(&cells, boundary, datum, &pressure);
            let mut found = vec![0.0; cells.count()];
            HalfSpace::new(cells, MODULUS, boundary, None, 1).displacement(&pressure, &mut found);
            if cells.count() == 1 && boundary == Boundary::Periodic {
                assert_eq!(found, [0.0]);
                continue;
            }
            assert!(apart(&found, &wanted) < 1e-13, "{cells:?} {boundary:?}: {}", apart(&found, &wanted));
        }
    }
}

/// Integral by the midpoints of many small pieces, which is exact enough away from the singularity.
fn midpoints(count: usize, f: impl Fn(f64) -> f64) -> f64 {
    (0..count).map(|i| f((i as f64 + 0.5) / count as f64 - 0.5)).sum::<f64>() / count as f64
}

#[test]
fn kernels_are_their_integrals() {
    for (x, y, a, b) in [
        (1.0, 0.0, 1.0, 1.0),
        (2.0, 3.0, 1.0, 0.5),
        (5.0, 1.0, 1.0, 1.3),
        (20.0, 9.0, 1.0, 1.0),
        (900.0, 800.0, 0.8, 1.0),
    ] {
        let coarse = |n: usize| midpoints(n, |s| midpoints(n, |t| 1.0 / (x + s * a).hypot(y + t * b)));
        // Richardson: the error of midpoints is of second order, then of fourth.
        let (one, two, four) = (coarse(100), coarse(200), coarse(400));
        let (fine, finer) = ((4.0 * two - one) / 3.0, (4.0 * four - two) / 3.0);
        let wanted = a * b * (16.0 * finer - fine) / 15.0 / PI;
        let found = influence::rectangle(x, y, a, b);
        assert!((found / wanted - 1.0).abs() < 1e-11, "({x}, {y}): {found:e} {wanted:e}");
    }
    for (x, datum) in [(1.0, 3.0), (3.0, 0.5), (6.0, 1.0), (30.0, 7.0), (2000.0, 100.0)] {
        let coarse = |n: usize| midpoints(n, |s| ((x + 0.8 * s) / datum).ln());
        let (one, two, four) = (coarse(1000), coarse(2000), coarse(4000));
        let (fine, finer) = ((4.0 * two - one) / 3.0, (4.0 * four - two) / 3.0);
        let wanted = -2.0 / PI * 0.8 * (16.0 * finer - fine) / 15.0;
        let found = influence::strip(x, 0.8, datum);
        assert!((found / wanted - 1.0).abs() < 1e-11, "{x}: {found:e} {wanted:e}");
    }
    // Closed forms of what a cell does to itself.
    let own = 4.0 * (1.0 + 2.0_f64.sqrt()).ln() / PI;
    assert!((influence::rectangle(0.0, 0.0, 1.0, 1.0) / own - 1.0).abs() < 1e-14);
    let own = 2.0 / PI * (1.0 + 2.0_f64.ln() + 3.0_f64.ln());
    assert!((influence::strip(0.0, 1.0, 3.0) / own - 1.0).abs() < 1e-14);
}

#[test]
fn kernels_go_on_smoothly_where_the_method_changes() {
    for lag in [4.0_f64, 12.0, 40.0, 1000.0] {
        let (below, above) = (lag * (1.0 - 1e-9), lag * (1.0 + 1e-9));
        for (one, two) in [
            (influence::rectangle(below, 0.0, 1.0, 1.0) * below, influence::rectangle(above, 0.0, 1.0, 1.0) * above),
            (
                influence::strip(below, 1.0, 0.5) / (2.0 * below).ln(),
                influence::strip(above, 1.0, 0.5) / (2.0 * above).ln(),
            ),
        ] {
            assert!((one / two - 1.0).abs() < 2e-11, "{lag}: {one:e} {two:e}");
        }
    }
}
