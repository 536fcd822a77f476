//! Random small problems against a dense solver that changes one cell at a time.

use super::*;
use crate::corners_and_back;

/// Solves a square system by elimination with the largest pivot of each column.
fn eliminate(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for column in 0..n {
        let pivot = (column..n).max_by(|a, b| matrix[*a][column].abs().total_cmp(&matrix[*b][column].abs())).unwrap();
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        for row in column + 1..n {
            let factor = matrix[row][column] / matrix[column][column];
            let (above, below) = matrix.split_at_mut(row);
            below[0].iter_mut().zip(&above[column]).for_each(|(value, pivot)| *value -= factor * pivot);
            right[row] -= factor * right[column];
        }
    }
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|k| matrix[row][k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}

/// A dense problem: the columns of A + b come from the model.
pub struct Dense {
    cells: Cells,
    boundary: Boundary,
    compliance: Vec<Vec<f64>>,
}

impl Dense {
    pub fn new(model: &mut HalfSpace) -> Dense {
        let count = model.cells.count();
        let mut compliance = vec![vec![0.0; count]; count];
        for from in 0..count {
            let (mut one, mut u) = (vec![0.0; count], vec![0.0; count]);
            one[from] = 1.0;
            model.displacement(&one, &mut u);
            u.iter().enumerate().for_each(|(to, u)| compliance[to][from] = *u);
        }
        Dense { cells: model.cells, boundary: model.kernel.boundary, compliance }
    }

    /// A + b over a set.
    fn matrix(&self, problem: &Problem<'_>) -> Vec<Vec<f64>> {
        let count = self.compliance.len();
        let mut matrix = self.compliance.clone();
        for from in 0..count {
            let (mut one, mut acting) = (vec![0.0; count], vec![0.0; count]);
            one[from] = 1.0;
            if problem.smoothed {
                corners_and_back(&self.cells, self.boundary == Boundary::Periodic, &one, &mut acting)
            } else {
                acting = one
            }
            for to in 0..count {
                matrix[to][from] += problem.diagonal.at(to) * acting[to];
            }
        }
        matrix
    }

    /// Pressures and approach on a set.
    pub fn on(&self, problem: &Problem<'_>, set: &[bool]) -> (Vec<f64>, f64) {
        let cells: Vec<usize> = (0..set.len()).filter(|cell| set[*cell]).collect();
        let whole = self.matrix(problem);
        let mut matrix: Vec<Vec<f64>> =
            cells.iter().map(|to| cells.iter().map(|from| whole[*to][*from]).collect()).collect();
        let mut right: Vec<f64> = cells.iter().map(|cell| -problem.gap[*cell]).collect();
        let unit = whole[cells[0]][cells[0]].abs();
        match problem.control {
            Control::Load(load) => {
                matrix.iter_mut().for_each(|row| row.push(-unit));
                matrix.push(cells.iter().map(|_| 1.0).chain([0.0]).collect());
                right.push(load / self.cells.area());
            }
            Control::Approach(approach) => right.iter_mut().for_each(|right| *right += approach),
        }
        let found = eliminate(matrix, right);
        let mut pressure = vec![0.0; set.len()];
        cells.iter().zip(&found).for_each(|(cell, p)| pressure[*cell] = *p);
        let approach = match problem.control {
            Control::Load(_) => found[cells.len()] * unit,
            Control::Approach(approach) => approach,
        };
        (pressure, approach)
    }

    /// Pressures, gaps and approach of the contact that is consistent with itself.
    pub fn solve(&self, problem: &Problem<'_>) -> (Vec<f64>, f64) {
        let count = problem.gap.len();
        let lowest = (0..count).min_by(|a, b| problem.gap[*a].total_cmp(&problem.gap[*b])).unwrap();
        let mut set = vec![false; count];
        set[lowest] = true;
        for _ in 0..100 * count {
            let (pressure, approach) = self.on(problem, &set);
            if let Some(worst) =
                (0..count).filter(|c| pressure[*c] < 0.0).min_by(|a, b| pressure[*a].total_cmp(&pressure[*b]))
            {
                set[worst] = false;
                continue;
            }
            let matrix = self.matrix(problem);
            let gap =
                |c: usize| problem.gap[c] - approach + (0..count).map(|k| matrix[c][k] * pressure[k]).sum::<f64>();
            let open = (0..count).filter(|c| !set[*c]);
            let Some((worst, gap)) = open.map(|c| (c, gap(c))).min_by(|a, b| a.1.total_cmp(&b.1)) else {
                return (pressure, approach);
            };
            if gap >= -1e-14 * problem.scale {
                return (pressure, approach);
            }
            set[worst] = true;
        }
        panic!("the dense solver goes round in circles");
    }
}

/// Shapes that are small enough, their random gaps, and a compliance to compare diagonals with.
fn cases() -> impl Iterator<Item = (Cells, Boundary, Vec<f64>, Numbers)> {
    let cells =
        [line(14, 0.5), line(21, 2.0), plane([6, 5], [1.0, 1.0]), plane([5, 7], [0.5, 0.8]), plane([8, 8], [3.0, 3.0])];
    let cases = cells.into_iter().flat_map(|cells| [(cells, Boundary::Free), (cells, Boundary::Periodic)]);
    cases.enumerate().flat_map(|(index, (cells, boundary))| {
        (0..4).map(move |round| {
            let mut numbers = Numbers(1 + 10 * index as u64 + round);
            // Smooth enough that not only single cells touch.
            let rough = numbers.many(cells.count());
            let gap = bowl(&cells, 3.0 * cells.counts[0] as f64 * cells.spacing[0]);
            let gap = gap.iter().zip(rough).map(|(gap, rough)| gap + 0.2 * rough * cells.spacing[0]).collect();
            (cells, boundary, gap, numbers)
        })
    })
}

/// A load that brings about half of the cells into contact, and the like for single cells.
fn load(cells: &Cells, numbers: &mut Numbers) -> f64 {
    MODULUS * 0.3 * numbers.next() * numbers.next() * cells.area() * cells.count() as f64 / cells.counts[0] as f64
}

fn agrees(model: &mut HalfSpace, problem: &Problem<'_>, what: &str) {
    let (wanted, approach) = Dense::new(model).solve(problem);
    let mut pressure = vec![0.0; wanted.len()];
    let solution = model.solve(problem, &mut pressure).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(apart(&pressure, &wanted) < 1e-6, "{what}: {}\n{pressure:?}\n{wanted:?}", apart(&pressure, &wanted));
    assert!((solution.approach - approach).abs() < 1e-8 * problem.scale, "{what}: {} {approach}", solution.approach);
    let sum = wanted.iter().sum::<f64>() * model.cells.area();
    assert!((solution.load / sum - 1.0).abs() < 1e-8, "{what}: {} {sum}", solution.load);
    // From the answer nothing is left to do.
    let again = model.solve(problem, &mut pressure).unwrap();
    assert!(again.iterations <= 3 + solution.iterations / 3, "{what}: {again:?}");
}

#[test]
fn random_problems_have_the_dense_answer() {
    for (cells, boundary, gap, mut numbers) in cases() {
        let mut model =
            HalfSpace::new(cells, MODULUS, boundary, Some(9.0 * cells.counts[0] as f64 * cells.spacing[0]), 1);
        let load = load(&cells, &mut numbers);
        let per_point: Vec<f64> =
            numbers.many(cells.count()).iter().map(|r| 3.0 * r * cells.spacing[0] / MODULUS).collect();
        for diagonal in
            [Diagonal::Zero, Diagonal::Uniform(2.0 * cells.spacing[0] / MODULUS), Diagonal::PerPoint(&per_point)]
        {
            let what = format!("{cells:?} {boundary:?} {diagonal:?}");
            let under_load = Problem { diagonal, ..problem(&gap, Control::Load(load)) };
            agrees(&mut model, &under_load, &what);
            let mut pressure = vec![0.0; cells.count()];
            let approach = model.solve(&under_load, &mut pressure).unwrap().approach;
            if boundary == Boundary::Periodic && diagonal == Diagonal::Zero && pressure.iter().all(|p| *p > 0.0) {
                continue;
            }
            agrees(
                &mut model,
                &Problem { diagonal, ..problem(&gap, Control::Approach(approach)) },
                &format!("held, {what}"),
            );
        }
    }
}

#[test]
fn a_large_diagonal_is_solved_quickly() {
    for (cells, boundary, gap, mut numbers) in cases() {
        let mut model = HalfSpace::new(cells, MODULUS, boundary, None, 1);
        let b = 1e6 * cells.counts[0] as f64 * cells.spacing[0] / MODULUS;
        let problem = Problem {
            diagonal: Diagonal::Uniform(b),
            ..problem(&gap, Control::Load(1e-5 * load(&cells, &mut numbers)))
        };
        agrees(&mut model, &problem, "large diagonal");
        let mut pressure = vec![0.0; cells.count()];
        let solution = model.solve(&problem, &mut pressure).unwrap();
        assert!(solution.iterations <= 25, "{cells:?} {boundary:?} {solution:?}");
    }
}

#[test]
fn a_smoothed_diagonal_acts_on_the_smoothed_pressure() {
    for (cells, boundary, gap, mut numbers) in cases() {
        let datum = Some(9.0 * cells.counts[0] as f64 * cells.spacing[0]);
        let mut model = HalfSpace::new(cells, MODULUS, boundary, datum, 1);
        let load = load(&cells, &mut numbers);
        let compliance = 0.8 * cells.spacing[0] / MODULUS;
        let per_point: Vec<f64> =
            numbers.many(cells.count()).iter().map(|r| (2.0 * r - 0.8).max(0.0) * compliance).collect();
        for diagonal in [Diagonal::Uniform(compliance), Diagonal::PerPoint(&per_point)] {
            let under_load = Problem { diagonal, smoothed: true, ..problem(&gap, Control::Load(load)) };
            let what = format!("smoothed {cells:?} {boundary:?} {diagonal:?}");
            agrees(&mut model, &under_load, &what);
            let approach = model.solve(&under_load, &mut vec![0.0; cells.count()]).unwrap().approach;
            agrees(
                &mut model,
                &Problem { control: Control::Approach(approach), ..under_load },
                &format!("held, {what}"),
            );
        }
    }
}

#[test]
fn a_frozen_contact_is_bilateral() {
    for (cells, boundary, gap, mut numbers) in cases() {
        let mut model =
            HalfSpace::new(cells, MODULUS, boundary, Some(9.0 * cells.counts[0] as f64 * cells.spacing[0]), 1);
        let mut set: Vec<bool> = numbers.many(cells.count()).iter().map(|r| *r < 0.7).collect();
        (set[0], set[1]) = (true, false);
        for control in [Control::Approach(0.0), Control::Load(0.0), Control::Load(load(&cells, &mut numbers))] {
            let problem = Problem { frozen: Some(&set), ..problem(&gap, control) };
            let (wanted, approach) = Dense::new(&mut model).on(&problem, &set);
            let mut pressure = vec![0.0; cells.count()];
            let solution = model.solve(&problem, &mut pressure).unwrap();
            assert!(
                apart(&pressure, &wanted) < 1e-9,
                "{cells:?} {boundary:?} {control:?}: {}",
                apart(&pressure, &wanted)
            );
            assert!((solution.approach - approach).abs() < 1e-9 * problem.scale);
            assert!(pressure.iter().zip(&set).all(|(p, on)| *on || *p == 0.0));
            if let Control::Load(load) = control {
                let sum: f64 = pressure.iter().sum();
                let size: f64 = pressure.iter().map(|p| p.abs()).sum();
                assert!((sum - load / cells.area()).abs() < 1e-13 * size, "{sum:e} {load:e}");
            }
        }
    }
}
