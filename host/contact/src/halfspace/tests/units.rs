//! The same problem in other units, from other starts, with other threads.

use super::*;

#[test]
fn units_that_are_powers_of_two_change_no_bit() {
    let mut numbers = Numbers(5);
    for (cells, boundary) in [
        (line(40, 0.3), Boundary::Free),
        (plane([14, 12], [0.3, 0.2]), Boundary::Free),
        (plane([12, 15], [0.3, 0.3]), Boundary::Periodic),
    ] {
        let gap: Vec<f64> = bowl(&cells, 3.0).iter().map(|gap| gap + 0.1 * numbers.next()).collect();
        let load = 0.02 * MODULUS * cells.area();
        let one = |along: f64, height: f64, force: f64, approach: Option<f64>| {
            let spacing = [cells.spacing[0] * along, if cells.dimension == 2 { 1.0 } else { cells.spacing[1] * along }];
            let scaled = Cells { spacing, ..cells };
            // u = p length / E*: what pressures and heights demand of the modulus.
            let pressure = force / (if cells.dimension == 2 { along } else { along * along });
            let modulus = MODULUS * pressure * along / height;
            let mut model = HalfSpace::new(scaled, modulus, boundary, None, 1);
            let gap: Vec<f64> = gap.iter().map(|gap| gap * height).collect();
            let control = approach.map_or(Control::Load(load * force), |approach| Control::Approach(approach * height));
            let b = 0.1 / MODULUS * height / pressure;
            let problem = Problem { diagonal: Diagonal::Uniform(b), ..problem(&gap, control) };
            let mut found = vec![0.0; cells.count()];
            let solution = model.solve(&problem, &mut found).unwrap();
            found.iter_mut().for_each(|p| *p /= pressure);
            (found, solution.approach / height, solution.load / force)
        };
        let wanted = one(1.0, 1.0, 1.0, None);
        let held = one(1.0, 1.0, 1.0, Some(wanted.1));
        for (along, height, force) in [(-40, -40, -60), (20, 20, 99), (-10, 3, 0), (0, 7, -99), (19, -30, 90)] {
            let [along, height, force] = [along, height, force].map(|power| 2.0_f64.powi(power));
            assert_eq!(one(along, height, force, None), wanted, "{along} {height} {force}");
            assert_eq!(one(along, height, force, Some(wanted.1)), held, "{along} {height} {force}");
        }
    }
}

#[test]
fn extreme_magnitudes_are_solved() {
    for (modulus, length) in [(1e30, 1e-12), (1e-30, 1e-12), (1e30, 1e6), (1e-30, 1e6), (1e9, 1.0)] {
        for load in [1e-30, 1e30] {
            let cells = plane([11, 11], [length, length]);
            let gap = bowl(&cells, 10.0 * length);
            let mut model = HalfSpace::new(cells, modulus, Boundary::Free, None, 1);
            let mut pressure = vec![0.0; 121];
            let solution = model.solve(&problem(&gap, Control::Load(load)), &mut pressure).unwrap();
            assert!((pressure.iter().sum::<f64>() * cells.area() / load - 1.0).abs() < 1e-13, "{solution:?}");
            let touching = pressure.iter().filter(|p| **p > 0.0).count();
            assert!(touching == 1 || touching == 121 || load == 1e30 || load == 1e-30, "{touching}");
            assert!(solution.approach.is_finite());
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    // Large enough for threads: below that they are not used.
    for (cells, boundary) in
        [(plane([180, 184], [1.0, 1.0]), Boundary::Free), (plane([192, 180], [1.0, 1.0]), Boundary::Periodic)]
    {
        let mut numbers = Numbers(3);
        let wave = |cell: usize| ((cell % 192) as f64 * 0.2).sin() * ((cell / 192) as f64 * 0.3).cos();
        let gap: Vec<f64> = (0..cells.count()).map(|cell| wave(cell) + 0.1 * numbers.next()).collect();
        let one = |threads: usize| {
            let mut model = HalfSpace::new(cells, MODULUS, boundary, None, threads);
            let mut pressure = vec![0.0; cells.count()];
            let load = Control::Load(0.01 * MODULUS * cells.count() as f64);
            let solution = model.solve(&Problem { tolerance: 1e-6, ..problem(&gap, load) }, &mut pressure).unwrap();
            (pressure, solution)
        };
        let wanted = one(1);
        assert_eq!(pool.install(|| one(2)), wanted);
        assert_eq!(pool.install(|| one(3)), wanted);
    }
}
