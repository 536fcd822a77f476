//! Symmetric problems on a half or a quarter of the cells against the same on all of them.

use super::*;

/// Which axes the gaps are made symmetric along, about the middle cell.
fn gaps(cells: &Cells, symmetric: [bool; 2], periodic: bool, numbers: &mut Numbers) -> Vec<f64> {
    let [nx, ny] = cells.counts;
    let mut gap: Vec<f64> = bowl(cells, 0.05);
    let rough = numbers.many(cells.count());
    let image = |at: usize, n: usize, on: bool| {
        let middle = n / 2;
        match on {
            true if periodic || at > 0 || !n.is_multiple_of(2) => at.min((2 * middle - at.min(2 * middle)) % n),
            _ => at,
        }
    };
    for y in 0..ny {
        for x in 0..nx {
            let at = image(y, ny, symmetric[1]) * nx + image(x, nx, symmetric[0]);
            gap[y * nx + x] += 2e-5 * rough[at];
        }
    }
    gap
}

/// Solves with and without mirrors, from nothing and from there; the answers have to agree, and the steps that lead to them.
fn agree(cells: Cells, boundary: Boundary, problem: &Problem<'_>, mirrored: [bool; 2], what: &str) {
    let start = vec![0.0; cells.count()];
    let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1);
    let mut whole = HalfSpace::new(cells, MODULUS, boundary, None, 1).without_mirrors();
    let (mut found, mut wanted) = (start.clone(), start);
    let solution = model.solve(problem, &mut found).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert_eq!(model.kernel.mirrored, mirrored, "{what}");
    let reference = whole.solve(problem, &mut wanted).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(apart(&found, &wanted) < 1e-7, "{what}: {}", apart(&found, &wanted));
    assert!(
        (solution.approach - reference.approach).abs() < 1e-10 * problem.scale,
        "{what}: {solution:?} {reference:?}"
    );
    assert!((solution.load / reference.load - 1.0).abs() < 1e-8, "{what}: {solution:?} {reference:?}");
    assert!(solution.error <= problem.tolerance, "{what}");
    // The same search: not more work than rounding and other windows make.
    let most = reference.iterations + 2 + reference.iterations / 10;
    assert!(solution.iterations <= most, "{what}: {solution:?} {reference:?}");
    if let Control::Load(load) = problem.control {
        let sum = found.iter().sum::<f64>() * cells.area();
        assert!((sum / load - 1.0).abs() < 1e-12, "{what}: {sum} {load}");
    }
    let again = model.solve(problem, &mut found).unwrap();
    assert_eq!(model.kernel.mirrored, mirrored, "{what}, from the answer");
    assert!(again.iterations <= 4 && apart(&found, &wanted) < 1e-7, "{what}: {again:?}");
    let cell = |x: usize, y: usize| found[y * cells.counts[0] + x];
    let [middle, row] = cells.counts.map(|count| count / 2);
    for away in 1..cells.counts[0] - middle {
        if mirrored[0] {
            assert_eq!(cell(middle - away, row).to_bits(), cell(middle + away, row).to_bits(), "{what}");
        }
    }
}

#[test]
fn a_half_and_a_quarter_give_the_answer_of_all_cells() {
    let mut numbers = Numbers(7);
    for boundary in [Boundary::Free, Boundary::Periodic] {
        let periodic = boundary == Boundary::Periodic;
        for cells in [line(128, 1e-3), plane([40, 32], [1e-3, 1.2e-3]), plane([96, 90], [1e-3, 1e-3])] {
            for symmetric in [[true, true], [true, false], [false, true]] {
                let flat = cells.dimension == 2;
                if flat && symmetric != [true, true] {
                    continue;
                }
                let gap = gaps(&cells, symmetric, periodic, &mut numbers);
                let mirrored = [symmetric[0], symmetric[1] && !flat];
                let load = if flat { 6e-3 } else { 1.2e-4 } * MODULUS / 100.0;
                for diagonal in [0.0, 1e-13] {
                    let local: Vec<f64> = gap.iter().map(|gap| 1e-14 + 1e-10 * gap.min(1e-3)).collect();
                    for local in [Diagonal::Uniform(diagonal), Diagonal::PerPoint(&local)] {
                        let problem = Problem { diagonal: local, ..problem(&gap, Control::Load(load)) };
                        let what = format!("{boundary:?} {cells:?} {symmetric:?} {diagonal}");
                        agree(cells, boundary, &problem, mirrored, &what);
                        let held = Problem { control: Control::Approach(2e-5), ..problem };
                        agree(cells, boundary, &held, mirrored, &format!("held {what}"));
                    }
                }
            }
        }
    }
}

#[test]
fn an_odd_count_has_its_mirror_in_the_middle_cell() {
    for cells in [line(91, 1e-3), plane([45, 33], [1e-3, 1e-3])] {
        let gap = bowl(&cells, 0.05);
        let load = if cells.dimension == 2 { 6e-5 } else { 1.2e-6 } * MODULUS;
        let mirrored = [true, cells.dimension == 3];
        agree(cells, Boundary::Free, &problem(&gap, Control::Load(load)), mirrored, &format!("{cells:?}"));
        let mut model = HalfSpace::new(cells, MODULUS, Boundary::Periodic, None, 1);
        model.solve(&problem(&gap, Control::Load(load)), &mut vec![0.0; cells.count()]).unwrap();
        assert_eq!(model.kernel.mirrored, [false; 2], "a period has no second mirror through cells");
    }
}

#[test]
fn a_contact_that_comes_to_cells_without_image_is_solved_on_all() {
    // Waves with crests at the ends: row 0 of the free grid touches, and nothing mirrors it.
    let cells = plane([48, 48], [1e-3, 1e-3]);
    let wave = |i: usize| (2.0 * std::f64::consts::PI * (i as f64 - 24.0) / 24.0).cos();
    let gap: Vec<f64> = (0..cells.count()).map(|cell| 1e-4 * (2.0 - wave(cell % 48) - wave(cell / 48))).collect();
    let problem = problem(&gap, Control::Load(2e-6 * MODULUS));
    let (mut found, mut wanted) = (vec![0.0; cells.count()], vec![0.0; cells.count()]);
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
    model.solve(&problem, &mut found).unwrap();
    assert_eq!(mirror::of(&model, &problem, &vec![0.0; cells.count()]), [true; 2], "it looks symmetric");
    assert_eq!(model.kernel.mirrored, [false; 2]);
    assert!(found[0] > 0.0);
    HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1).without_mirrors().solve(&problem, &mut wanted).unwrap();
    assert!(apart(&found, &wanted) < 1e-7);
}

#[test]
fn a_needle_on_the_row_without_image_is_found() {
    let cells = plane([40, 40], [1e-3, 1e-3]);
    let mut gap = bowl(&cells, 0.05);
    // On the middle column: the image of itself in x, and of nothing in y.
    gap[20] = 1e-7;
    let problem = problem(&gap, Control::Load(2e-5 * MODULUS / 10.0));
    let (mut found, mut wanted) = (vec![0.0; cells.count()], vec![0.0; cells.count()]);
    let mut model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
    assert_eq!(mirror::of(&model, &problem, &found), [true; 2], "it looks symmetric");
    model.solve(&problem, &mut found).unwrap();
    assert!(found[20] > 0.0);
    HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1).without_mirrors().solve(&problem, &mut wanted).unwrap();
    assert!(apart(&found, &wanted) < 1e-7, "{}", apart(&found, &wanted));
}

#[test]
fn what_is_not_symmetric_to_the_bit_is_solved_on_all() {
    let cells = plane([40, 40], [1e-3, 1e-3]);
    let gap = bowl(&cells, 0.05);
    let even = problem(&gap, Control::Load(1.2e-6 * MODULUS));
    let nothing = vec![0.0; cells.count()];
    let model = HalfSpace::new(cells, MODULUS, Boundary::Free, None, 1);
    assert_eq!(mirror::of(&model, &even, &nothing), [true; 2]);
    let mut other = gap.clone();
    other[25 * 40 + 27] = f64::from_bits(other[25 * 40 + 27].to_bits() + 1);
    assert_eq!(mirror::of(&model, &Problem { gap: &other, ..even }, &nothing), [false; 2]);
    // On a mirror's own line it is symmetric about that one still.
    let mut on_line = gap.clone();
    on_line[25 * 40 + 20] *= 1.5;
    assert_eq!(mirror::of(&model, &Problem { gap: &on_line, ..even }, &nothing), [true, false]);
    let mut start = nothing.clone();
    start[20 * 40 + 22] = 1.0;
    assert_eq!(mirror::of(&model, &even, &start), [false, true]);
    let local: Vec<f64> = (0..cells.count()).map(|cell| 1e-14 * (1 + cell % 40) as f64).collect();
    assert_eq!(mirror::of(&model, &Problem { diagonal: Diagonal::PerPoint(&local), ..even }, &nothing), [false, true]);
    let smooth = Problem { diagonal: Diagonal::Uniform(1e-14), smoothed: true, ..even };
    assert_eq!(mirror::of(&model, &smooth, &nothing), [false; 2]);
    let set = vec![true; cells.count()];
    assert_eq!(mirror::of(&model, &Problem { frozen: Some(&set), ..even }, &nothing), [false; 2]);
    // A contact that has come near the first row, which has no image.
    let mut wide = nothing;
    wide[20 * 40 + 2] = 1.0;
    wide[20 * 40 + 38] = 1.0;
    assert_eq!(mirror::of(&model, &even, &wide), [false, true]);
}

#[test]
fn a_row_without_image_that_does_not_touch_is_no_reason_to_solve_on_all_cells() {
    // The contact fills most of the grid: a look at the gap of its first row does not tell that it stays open.
    let cells = plane([32, 32], [1e-3, 1e-3]);
    let gap = bowl(&cells, 0.2);
    let load = Control::Load(MODULUS * 4.0 / 3.0 * 0.0137_f64.powi(3) / 0.2);
    agree(cells, Boundary::Free, &problem(&gap, load), [true; 2], "a wide contact");
}
