//! Closed forms, and problems at the edge of what there is.

use std::f64::consts::PI;

use super::*;

#[test]
fn a_sphere_meets_hertz() {
    let (radius, load) = (10e-3, 20.0_f64);
    let a: f64 = (3.0 * load * radius / (4.0 * MODULUS)).cbrt();
    let cells = plane([48, 48], [a / 12.0, a / 12.0]);
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
    let gap = bowl(&cells, radius);
    let mut pressure = vec![0.0; cells.count()];
    let solution = model.solve(&problem(&gap, Control::Load(load)), &mut pressure).unwrap();
    let peak = 1.5 * load / (PI * a * a);
    assert!((pressure[24 * 48 + 24] / peak - 1.0).abs() < 0.01, "{}", pressure[24 * 48 + 24] / peak);
    assert!((solution.approach / (a * a / radius) - 1.0).abs() < 0.01, "{solution:?}");
    assert_eq!(solution.load, load);
    assert!((pressure.iter().sum::<f64>() * cells.area() / load - 1.0).abs() < 1e-14);
    let radius_found = (pressure.iter().filter(|p| **p > 0.0).count() as f64 * cells.area() / PI).sqrt();
    assert!((radius_found / a - 1.0).abs() < 0.03, "{}", radius_found / a);
}

#[test]
fn a_cylinder_meets_hertz() {
    let (radius, load) = (6e-3, 18.5e3_f64);
    let a = (4.0 * load * radius / (PI * MODULUS)).sqrt();
    let cells = line(100, a / 20.0);
    let datum = 1.0;
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, Some(datum), 1);
    let gap = bowl(&cells, radius);
    let mut pressure = vec![0.0; 100];
    let solution = model.solve(&problem(&gap, Control::Load(load)), &mut pressure).unwrap();
    let peak = 2.0 * load / (PI * a);
    assert!((pressure[50] / peak - 1.0).abs() < 0.01, "{}", pressure[50] / peak);
    // Under the middle: 2 P / (pi E*) (ln(2 d / a) + 1/2) (Johnson, section 5.6).
    let approach = 2.0 * load / (PI * MODULUS) * ((2.0 * datum / a).ln() + 0.5);
    assert!((solution.approach / approach - 1.0).abs() < 1e-3, "{} {approach}", solution.approach);
    // The approach that was found gives the load back.
    let held = problem(&gap, Control::Approach(solution.approach));
    let again = model.solve(&held, &mut vec![0.0; 100]).unwrap();
    assert!((again.load / load - 1.0).abs() < 1e-8, "{again:?}");
}

#[test]
fn a_wave_in_full_contact_is_a_mode() {
    for cells in [line(40, 0.1), plane([20, 30], [0.2, 0.1])] {
        let wave = |cell: usize| (2.0 * PI * (cell % cells.counts[0]) as f64 / cells.counts[0] as f64).cos();
        let height = 1e-3;
        let gap: Vec<f64> = (0..cells.count()).map(|cell| 7.0 - height * wave(cell)).collect();
        let q = 2.0 * PI / (cells.counts[0] as f64 * cells.spacing[0]);
        let amplitude = 0.5 * MODULUS * q * height;
        let mut model = HalfSpace::new(cells, MODULUS, Boundary::Periodic, None, 1);
        let load = 1.2 * amplitude * cells.area() * cells.count() as f64;
        let mut pressure = vec![0.0; cells.count()];
        let problem = Problem { tolerance: 1e-13, ..problem(&gap, Control::Load(load)) };
        let solution = model.solve(&problem, &mut pressure).unwrap();
        let wanted: Vec<f64> = (0..cells.count()).map(|cell| amplitude * (1.2 + wave(cell))).collect();
        assert!(apart(&pressure, &wanted) < 1e-10, "{}", apart(&pressure, &wanted));
        assert!((solution.approach - 7.0).abs() < 1e-11, "{solution:?}");
        // The mean pressure of full contact does not follow from the approach, but with a diagonal it does.
        for beyond in [0.0, 1.0] {
            let held = Problem { control: Control::Approach(7.0 + beyond + 1e-12), ..problem };
            let refused = model.solve(&held, &mut pressure);
            assert!(
                matches!(refused, Err(ContactError::NoSolution { most, .. }) if (most - 7.0).abs() < 1e-9),
                "{refused:?}"
            );
        }
        let soft =
            Problem { diagonal: Diagonal::Uniform(1e-3 / amplitude), control: Control::Approach(7.002), ..problem };
        let solution = model.solve(&soft, &mut pressure).unwrap();
        let mean = solution.load / cells.area() / cells.count() as f64;
        assert!((mean / (2.0 * amplitude) - 1.0).abs() < 1e-9, "{}", mean / amplitude);
    }
}

#[test]
fn nothing_or_one_cell_touches() {
    let cells = plane([9, 9], [1e-3, 1e-3]);
    let gap = bowl(&cells, 1e-4);
    for boundary in [Boundary::Free, Boundary::Periodic] {
        let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1);
        let mut pressure = vec![1.0; 81];
        let solution = model.solve(&problem(&gap, Control::Load(0.0)), &mut pressure).unwrap();
        assert!(pressure.iter().all(|p| *p == 0.0) && solution.load == 0.0 && solution.approach == 0.0);
        let solution = model.solve(&problem(&gap, Control::Approach(-1e-6)), &mut pressure).unwrap();
        assert!(pressure.iter().all(|p| *p == 0.0) && solution.load == 0.0, "{solution:?}");
        let load = 1e-3;
        let solution = model.solve(&problem(&gap, Control::Load(load)), &mut pressure).unwrap();
        assert!((pressure[40] * cells.area() / load - 1.0).abs() < 1e-15, "{pressure:?}");
        assert_eq!(pressure.iter().filter(|p| **p > 0.0).count(), 1);
        let mut u = vec![0.0; 81];
        model.displacement(&pressure, &mut u);
        assert!((solution.approach / u[40] - 1.0).abs() < 1e-12);
        let again = model.solve(&problem(&gap, Control::Approach(solution.approach)), &mut vec![0.0; 81]).unwrap();
        assert!((again.load / load - 1.0).abs() < 1e-9, "{again:?}");
    }
}

#[test]
fn a_flat_punch_carries_its_edge() {
    // Gaps that are infinite beyond a line of cells: p = P / (pi sqrt(a^2 - x^2)), averaged over a cell.
    let cells = line(200, 0.1);
    let a = 5.0;
    let at = |cell: usize| (cell as f64 - 99.5) * 0.1;
    let gap: Vec<f64> = (0..200).map(|cell| if at(cell).abs() < a { 3.0 } else { f64::INFINITY }).collect();
    let mut model = HalfSpace::new(cells, 1.0, Boundary::Free, None, 1);
    let mut pressure = vec![0.0; 200];
    let solution = model.solve(&problem(&gap, Control::Load(2.0)), &mut pressure).unwrap();
    assert_eq!(pressure.iter().filter(|p| **p > 0.0).count(), 100);
    let punch = |x: f64| 2.0 / PI * (x / a).asin();
    let middle = (punch(at(100) + 0.05) - punch(at(100) - 0.05)) / 0.1;
    assert!((pressure[100] / middle - 1.0).abs() < 0.01, "{solution:?} {}", pressure[100] / middle);
    // A load that no cell could carry.
    let refused = model.solve(&problem(&[f64::INFINITY; 200], Control::Load(1.0)), &mut pressure);
    assert!(matches!(refused, Err(ContactError::NowhereToTouch { .. })), "{refused:?}");
}

#[test]
fn contact_may_reach_a_free_boundary() {
    let cells = plane([12, 10], [1.0, 1.0]);
    let gap = bowl(&cells, 1000.0);
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
    let mut pressure = vec![0.0; 120];
    let solution = model.solve(&problem(&gap, Control::Load(MODULUS * 10.0)), &mut pressure).unwrap();
    assert!(pressure.iter().all(|p| *p > 0.0));
    let mut u = vec![0.0; 120];
    model.displacement(&pressure, &mut u);
    assert!(u.iter().zip(&gap).all(|(u, gap)| (u + gap - solution.approach).abs() < 1e-8), "{solution:?}");
}

#[test]
fn what_is_not_finite_is_refused() {
    let cells = line(4, 1.0);
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
    let refused = |model: &mut HalfSpace, gap: [f64; 4], control, diagonal| {
        let problem = Problem { diagonal, scale: 1.0, ..problem(&gap, control) };
        let result = model.solve(&problem, &mut [0.0; 4]);
        assert!(matches!(result, Err(ContactError::NotFinite { .. })), "{result:?}");
    };
    let load = Control::Load(1.0);
    refused(&mut model, [0.0, f64::NAN, 1.0, 2.0], load, Diagonal::Zero);
    refused(&mut model, [0.0, f64::NEG_INFINITY, 1.0, 2.0], load, Diagonal::Zero);
    refused(&mut model, [0.0; 4], Control::Load(f64::NAN), Diagonal::Zero);
    refused(&mut model, [0.0; 4], Control::Approach(f64::INFINITY), Diagonal::Zero);
    refused(&mut model, [0.0; 4], load, Diagonal::Uniform(f64::NAN));
    refused(&mut model, [0.0; 4], load, Diagonal::PerPoint(&[0.0, -1.0, 0.0, 0.0]));
}

#[test]
fn an_approach_short_of_the_surface_leaves_everything_open() {
    for cells in [line(9, 1e-6), plane([5, 4], [1e-6, 1e-6])] {
        let gap: Vec<f64> = bowl(&cells, 1e-2).iter().map(|gap| gap + 1e-6).collect();
        let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
        for (approach, start) in [(1e-6, 0.0), (1e-6, 1e9), (-2.0, 1e9), (0.0, 0.0)] {
            let mut pressure = vec![start; gap.len()];
            let asked = Problem { diagonal: Diagonal::Uniform(1e-12), ..problem(&gap, Control::Approach(approach)) };
            let solution = model.solve(&asked, &mut pressure).unwrap();
            assert!(pressure.iter().all(|p| *p == 0.0), "{approach} {start}: {pressure:?}");
            assert_eq!((solution.load, solution.approach), (0.0, approach));
        }
    }
}
