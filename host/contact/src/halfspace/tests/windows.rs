//! A window around the contact against all cells, and starts from everywhere.

use super::*;

/// Solves from nothing, which takes a window, and from pressure on all cells, which does not; the answers have to agree.
fn agree(cells: Cells, boundary: Boundary, gap: &[f64], control: Control, what: &str) -> Solution {
    let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1).without_mirrors();
    let problem = problem(gap, control);
    let mut cold = vec![0.0; cells.count()];
    let solution = model.solve(&problem, &mut cold).unwrap_or_else(|error| panic!("{what}: {error}"));
    let mut whole = HalfSpace::new(cells, MODULUS, boundary, None, 1).without_mirrors();
    let mut wanted = vec![1.0; cells.count()];
    let reference = whole.solve(&problem, &mut wanted).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(apart(&cold, &wanted) < 1e-6, "{what}: {}", apart(&cold, &wanted));
    assert!(
        (solution.approach - reference.approach).abs() < 1e-9 * problem.scale,
        "{what}: {solution:?} {reference:?}"
    );
    assert!((solution.load / reference.load - 1.0).abs() < 1e-8, "{what}");
    // The window was smaller, or this test shows nothing.
    assert!(model.kept.iter().any(|kept| kept.counts != cells.counts), "{what}");
    assert!(whole.kept.iter().all(|kept| kept.counts == cells.counts), "{what}");
    // From the answer a solve is short, and stays there.
    let again = model.solve(&problem, &mut cold).unwrap();
    assert!(again.iterations <= 4 && apart(&cold, &wanted) < 1e-6, "{what}: {again:?}");
    solution
}

/// Lowers a bowl of a radius around a cell into the gaps, across the ends.
fn dig(cells: &Cells, gap: &mut [f64], at: [usize; 2], radius: f64, depth: f64) {
    let [nx, ny] = cells.counts;
    let from = |i: usize, at: usize, n: usize| (i + n - at).rem_euclid(n).min((at + n - i) % n) as f64;
    for (cell, gap) in gap.iter_mut().enumerate() {
        let (x, y) = (from(cell % nx, at[0], nx) * cells.spacing[0], from(cell / nx, at[1], ny) * cells.spacing[1]);
        *gap = gap.min((x * x + y * y) / (2.0 * radius) - depth);
    }
}

#[test]
fn a_window_gives_the_answer_of_all_cells() {
    for boundary in [Boundary::Free, Boundary::Periodic] {
        for (cells, load) in [(line(600, 1e-3), 2.6e-3), (plane([90, 72], [1e-3, 1.2e-3]), 2e-5)] {
            let corner = if boundary == Boundary::Free { [20, 12] } else { [1, 0] };
            for at in [[40, 36], corner] {
                let at = [at[0], at[1] % cells.counts[1]];
                let mut gap = vec![f64::INFINITY; cells.count()];
                dig(&cells, &mut gap, at, 0.03, 0.0);
                let load = Control::Load(load * MODULUS);
                let what = format!("{boundary:?} {cells:?} {at:?}");
                let solution = agree(cells, boundary, &gap, load, &what);
                agree(cells, boundary, &gap, Control::Approach(solution.approach), &format!("held {what}"));
            }
        }
    }
}

#[test]
fn a_contact_that_coarse_cells_do_not_see_is_found() {
    for boundary in [Boundary::Free, Boundary::Periodic] {
        for cells in [line(600, 1e-3), plane([96, 80], [1e-3, 1e-3])] {
            let mut gap = vec![f64::INFINITY; cells.count()];
            let middle = cells.counts[1] / 2;
            dig(&cells, &mut gap, [30, middle], 0.02, 0.0);
            // A needle, far away, one cell wide.
            let needle = middle * cells.counts[0] + 70;
            gap[needle] = 1e-6;
            let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1);
            let problem = problem(&gap, Control::Load(MODULUS * if cells.dimension == 2 { 2e-3 } else { 2e-5 }));
            let mut cold = vec![0.0; cells.count()];
            let solution = model.solve(&problem, &mut cold).unwrap();
            assert!(cold[needle] > 0.0, "{boundary:?} {cells:?}");
            let mut wanted = vec![1.0; cells.count()];
            let reference = model.solve(&problem, &mut wanted).unwrap();
            assert!(apart(&cold, &wanted) < 1e-6, "{boundary:?} {cells:?}: {}", apart(&cold, &wanted));
            assert!((solution.approach - reference.approach).abs() < 1e-9 * problem.scale);
        }
    }
}

#[test]
fn a_contact_that_grows_leaves_its_window() {
    let cells = plane([80, 80], [1e-3, 1e-3]);
    let gap = bowl(&cells, 0.05);
    for boundary in [Boundary::Free, Boundary::Periodic] {
        let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1);
        let mut pressure = vec![0.0; cells.count()];
        for load in [1e-7, 1e-6, 1e-5, 1e-4, 1e-6] {
            let problem = problem(&gap, Control::Load(load * MODULUS));
            let solution = model.solve(&problem, &mut pressure).unwrap();
            let mut wanted = vec![1.0; cells.count()];
            let reference = HalfSpace::new(cells, MODULUS, boundary, None, 1).solve(&problem, &mut wanted).unwrap();
            assert!(apart(&pressure, &wanted) < 1e-6, "{boundary:?} {load}: {}", apart(&pressure, &wanted));
            assert!((solution.approach - reference.approach).abs() < 1e-9 * problem.scale, "{boundary:?} {load}");
        }
    }
}

#[test]
fn a_frozen_contact_in_a_corner_is_solved_on_its_window() {
    let cells = plane([64, 60], [1e-3, 1e-3]);
    for boundary in [Boundary::Free, Boundary::Periodic] {
        // Across the ends of a periodic surface.
        let set: Vec<bool> =
            (0..cells.count()).map(|cell| (cell % 64 + 60) % 64 < 9 && (cell / 64 + 57) % 60 < 7).collect();
        let mut numbers = Numbers(8);
        let gap: Vec<f64> = numbers.many(cells.count());
        for control in [Control::Approach(0.0), Control::Load(0.0)] {
            let problem = Problem { frozen: Some(&set), tolerance: 1e-12, ..problem(&gap, control) };
            let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1);
            let mut pressure = vec![0.0; cells.count()];
            let solution = model.solve(&problem, &mut pressure).unwrap();
            let mut u = vec![0.0; cells.count()];
            model.displacement(&pressure, &mut u);
            let on = |cell: &usize| set[*cell];
            let left = (0..cells.count())
                .filter(on)
                .map(|cell| (gap[cell] + u[cell] - solution.approach).powi(2))
                .sum::<f64>();
            let all = (0..cells.count()).filter(on).map(|cell| gap[cell].powi(2)).sum::<f64>();
            assert!((left / all).sqrt() < 3e-12, "{boundary:?} {control:?}: {:e}", (left / all).sqrt());
            assert!(pressure.iter().zip(&set).all(|(p, on)| *on || *p == 0.0));
        }
    }
}

#[test]
fn a_contact_over_most_of_a_period_is_solved_on_its_window() {
    let cells = plane([96, 80], [1e-3, 1e-3]);
    let gap = bowl(&cells, 0.05);
    let problem = problem(&gap, Control::Load(6e-4 * MODULUS));
    let mut wanted = vec![1.0; cells.count()];
    let reference = HalfSpace::new(cells, MODULUS, Boundary::Periodic, None, 1).solve(&problem, &mut wanted).unwrap();
    let wide = (0..96).filter(|x| wanted[40 * 96 + x] > 0.0).count();
    assert!((50..75).contains(&wide), "{wide} cells");
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Periodic, None, 1);
    let mut pressure: Vec<f64> = wanted.iter().map(|p| p.sqrt()).collect();
    let solution = model.solve(&problem, &mut pressure).unwrap();
    let kept = &model.kept[0];
    assert!(kept.padded[0] == 96 && kept.counts[0] < 96, "{:?} of {:?}", kept.counts, kept.padded);
    assert!(apart(&pressure, &wanted) < 1e-6, "{}", apart(&pressure, &wanted));
    assert!((solution.approach - reference.approach).abs() < 1e-9 * problem.scale);
}

#[test]
fn rounds_on_cells_that_stay_in_contact_cost_no_transforms_of_their_own() {
    let cells = plane([64, 64], [1e-3, 1e-3]);
    let from = |i: usize| i as f64 - 32.0;
    let punch = |cell: usize| if from(cell % 64).hypot(from(cell / 64)) < 20.0 { 0.0 } else { f64::INFINITY };
    let gap: Vec<f64> = (0..cells.count()).map(punch).collect();
    for boundary in [Boundary::Free, Boundary::Periodic] {
        let scale = 1e-6;
        let problem = Problem {
            diagonal: Diagonal::Uniform(2e-2 / MODULUS),
            tolerance: 1e-9,
            scale,
            ..problem(&gap, Control::Load(1e-9 * MODULUS))
        };
        let mut pressure: Vec<f64> = gap.iter().map(|gap| if *gap == 0.0 { 1.0 } else { 0.0 }).collect();
        let solution = HalfSpace::new(cells, MODULUS, boundary, None, 1).solve(&problem, &mut pressure).unwrap();
        // The start takes one, and each search direction.
        assert!(solution.iterations > 4, "{solution:?}");
        assert!(solution.fft_pairs <= solution.iterations + 2, "{boundary:?}: {solution:?}");
    }
}
