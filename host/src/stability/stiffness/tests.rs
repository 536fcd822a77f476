use std::f64::consts::{FRAC_PI_2, SQRT_2};

use super::*;
use crate::contact::foundation::Foundation;
use crate::contact::halfspace::{Boundary, HalfSpace};

/// c E* / h = 1 on these grids.
fn line(count: usize) -> Cells {
    Cells { dimension: 2, counts: [count, 1], spacing: [1e-6, 1.0] }
}

fn square(count: usize) -> Cells {
    Cells { dimension: 3, counts: [count, count], spacing: [1e-6, 1e-6] }
}

fn half_space(cells: Cells, boundary: Boundary) -> HalfSpace {
    HalfSpace::new(cells, 1e11, boundary, None, 1)
}

/// A slope that makes c E* / h one per second.
const SLOPE: f64 = 1e-17;

fn uniform(model: &mut dyn ContactModel, set: &[bool], load_given: bool) -> f64 {
    let slopes = vec![SLOPE; set.len()];
    let contact = Linearised { set, slopes: &slopes, basis: Basis::Pressure, load_given };
    let found = measure(model, &contact, false).expect("the frozen contact can be solved");
    assert!(found.solves > 1 && found.solves <= MOST_ITERATIONS as u64 + 1, "{found:?}");
    found.per_time
}

fn within(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found} against {expected}");
}

#[test]
fn spectral_contact_has_the_eigenvalues_of_its_shortest_waves() {
    within(uniform(&mut half_space(line(64), Boundary::Periodic), &[true; 64], true), FRAC_PI_2, 1e-3);
    within(uniform(&mut half_space(square(16), Boundary::Periodic), &[true; 256], true), SQRT_2 * FRAC_PI_2, 1e-3);
}

#[test]
fn large_contacts_of_strips_and_rectangles_come_near_their_limits() {
    let set: Vec<bool> = (0..256).map(|i| (8..248).contains(&i)).collect();
    within(uniform(&mut half_space(line(256), Boundary::Free), &set, true), 1.34689, 0.01);
    let disc = |radius: f64| -> Vec<bool> {
        (0..48 * 48).map(|k| ((k % 48) as f64 - 24.0).hypot((k / 48) as f64 - 24.0) <= radius).collect()
    };
    within(uniform(&mut half_space(square(48), Boundary::Free), &disc(20.0), true), 1.72208, 0.01);
    // Under a given approach one more direction can decay, and for high waves that makes no difference.
    within(uniform(&mut half_space(square(48), Boundary::Free), &disc(20.0), false), 1.72208, 0.01);
}

#[test]
fn half_the_cells_are_twice_as_stiff() {
    let set = vec![true; 64];
    let coarse = uniform(&mut half_space(line(64), Boundary::Periodic), &set, true);
    let fine = Cells { spacing: [5e-7, 1.0], ..line(64) };
    within(uniform(&mut half_space(fine, Boundary::Periodic), &set, true), 2.0 * coarse, 1e-6);
}

#[test]
fn springs_decay_one_by_one_and_a_single_one_under_a_load_not_at_all() {
    let mut springs = Foundation::new(line(5), 1e17);
    within(uniform(&mut springs, &[true; 5], true), 1.0, 1e-9);
    within(uniform(&mut springs, &[true, false, false, false, true], false), 1.0, 1e-9);
    let slopes = [SLOPE; 5];
    let alone = [false, false, true, false, false];
    let contact = Linearised { set: &alone, slopes: &slopes, basis: Basis::Pressure, load_given: true };
    assert_eq!(measure(&mut springs, &contact, true).unwrap().per_time, 0.0);
}

#[test]
fn slopes_that_differ_give_the_eigenvalue_of_a_dense_computation() {
    // Springs under an approach: D S is diagonal, its largest entry the eigenvalue, its mode one cell.
    let mut springs = Foundation::new(line(6), 2.0);
    let slopes = [0.1, 0.4, 0.0, 0.9, 0.3, 5.0];
    let set = [true, true, true, true, true, false];
    let contact = Linearised { set: &set, slopes: &slopes, basis: Basis::Pressure, load_given: false };
    let found = measure(&mut springs, &contact, true).unwrap();
    within(found.per_time, 1.8, 1e-9);
    assert!((found.mode[3] - 1.0).abs() < 1e-9 && found.mode[5] == 0.0, "{:?}", found.mode);
    // Under a load, two springs: S = k/2 [[1, -1], [-1, 1]], and D S has the eigenvalue k (d1 + d2) / 2.
    let set = [true, true, false, false, false, false];
    let contact = Linearised { set: &set, load_given: true, ..contact };
    within(measure(&mut springs, &contact, false).unwrap().per_time, 0.5, 1e-9);
}

#[test]
fn the_mode_is_an_eigenvector() {
    let mut model = half_space(line(40), Boundary::Free);
    let set: Vec<bool> = (0..40).map(|i| (4..36).contains(&i)).collect();
    let slopes: Vec<f64> = (0..40).map(|i| SLOPE * (1.0 + 0.02 * f64::from(i))).collect();
    let contact = Linearised { set: &set, slopes: &slopes, basis: Basis::Pressure, load_given: true };
    let found = measure(&mut model, &contact, true).unwrap();
    let mut products = Products { model: &mut model, contact: &contact, cells: line(40), found: Stiffness::default() };
    let image = products.pressed(&found.mode).unwrap();
    let image = products.worn(&image);
    let miss = image.iter().zip(&found.mode).map(|(a, b)| (a / found.per_time - b).powi(2)).sum::<f64>().sqrt();
    let size = found.mode.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(miss < 0.02 * size, "{miss} of {size}");
}

#[test]
fn nodal_stresses_and_means_decay_more_slowly_than_the_chequerboard() {
    let mut model = half_space(line(64), Boundary::Periodic);
    let (set, slopes) = (vec![true; 64], vec![SLOPE; 64]);
    let contact = Linearised { set: &set, slopes: &slopes, basis: Basis::Pressure, load_given: true };
    // q cos^2(q h / 2) / 2 has its largest value at q h = 1.3065 : 0.4123 with q = 2 pi k / 64.
    let smooth = Linearised { basis: Basis::NodalStress { periodic: true }, ..contact };
    let wave = |k: f64| {
        let q = 2.0 * std::f64::consts::PI * k / 64.0;
        0.5 * q * (0.5 * q).cos().powi(2)
    };
    let expected = (1..32).map(f64::from).map(wave).fold(0.0, f64::max);
    within(measure(&mut model, &smooth, false).unwrap().per_time, expected, 0.01);
    let mean = Linearised { basis: Basis::Average, ..contact };
    assert_eq!(measure(&mut model, &mean, false).unwrap().per_time, 0.0);
    let mut springs = Foundation::new(line(64), 3.0 / SLOPE);
    within(measure(&mut springs, &Linearised { load_given: false, ..mean }, false).unwrap().per_time, 3.0, 1e-9);
}

#[test]
fn an_approach_on_a_periodic_surface_in_full_contact_has_no_stiffness() {
    let mut model = half_space(line(16), Boundary::Periodic);
    let slopes = [SLOPE; 16];
    let contact = Linearised { set: &[true; 16], slopes: &slopes, basis: Basis::Pressure, load_given: false };
    assert!(matches!(measure(&mut model, &contact, false), Err(ContactError::NoSolution { .. })));
}
