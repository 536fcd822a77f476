use super::*;

fn near(found: f64, expected: f64, tolerance: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(error <= tolerance, "found {found:e}, expected {expected:e}: off by {error:e}");
}

/// Answer 1 of the design's numerics page: t = 0 -> 1, p = 50, v = 0.2.
fn table(last: [f64; 4]) -> Vec<TablePoint> {
    let point = |time, values| TablePoint { time, constants: ArchardConstants::from_array(values) };
    vec![point(0.0, [1e-4, 2e3, 1.0, 1.0]), point(1.0, last)]
}

fn steady(end: f64) -> Vec<Piece> {
    vec![Piece { time: [0.0, end], pressure: [50.0; 2], velocity: [0.2; 2] }]
}

#[test]
fn tables_with_all_constants_linear_in_time() {
    let table = table([3e-4, 1e3, 1.5, 0.8]);
    let cases = [(0.25, 2.3159228768965933e-7), (0.5, 8.89753282874061e-7), (1.0, 7.322799325112124e-6)];
    for (end, expected) in cases {
        near(prescribed(&table, &steady(end)).unwrap(), expected, 1e-14);
    }
    let halves: Vec<Piece> =
        [[0.0, 0.5], [0.5, 1.0]].map(|time| Piece { time, pressure: [50.0; 2], velocity: [-0.2; 2] }).to_vec();
    near(prescribed(&table, &halves).unwrap(), 7.322799325112124e-6, 1e-14);
}

/// Gauss-Legendre with 64 nodes, found by Newton's method: nothing in common with the rule above.
fn gauss_legendre(f: impl Fn(f64) -> f64) -> f64 {
    let count = 64;
    let mut sum = Compensated::default();
    for i in 0..count {
        let mut x = (std::f64::consts::PI * (f64::from(i) + 0.75) / (f64::from(count) + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut p0, mut p1) = (1.0, x);
            for j in 2..=count {
                let j = f64::from(j);
                (p0, p1) = (p1, ((2.0 * j - 1.0) * x * p1 - (j - 1.0) * p0) / j);
            }
            slope = f64::from(count) * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        sum.add(f(0.5 * (1.0 + x)) / ((1.0 - x * x) * slope * slope));
    }
    sum.value()
}

#[test]
fn the_quadrature_agrees_with_gauss_legendre() {
    let w = gauss_legendre(|t| {
        let (k, h) = (1e-4 + 2e-4 * t, 2e3 - 1e3 * t);
        k / h * 50_f64.powf(1.0 + 0.5 * t) * 0.2_f64.powf(1.0 - 0.2 * t)
    });
    near(w, 7.322799325112124e-6, 1e-14);
    near(prescribed(&table([3e-4, 1e3, 1.5, 0.8]), &steady(1.0)).unwrap(), w, 1e-14);
}

#[test]
fn tables_with_unit_exponents_in_closed_form() {
    let closed = |t| linear_tables_unit_exponents([1e-4, 2e-4], [2e3, -1e3], 50.0, 0.2, t).unwrap();
    near(closed(0.5), 4.3841036225890464e-7, 1e-14);
    near(closed(1.0), 1.4657359027997265e-6, 1e-14);
    let table = table([3e-4, 1e3, 1.0, 1.0]);
    near(prescribed(&table, &steady(0.5)).unwrap(), closed(0.5), 1e-14);
    near(prescribed(&table, &steady(1.0)).unwrap(), closed(1.0), 1e-14);
}

#[test]
fn the_closed_form_has_no_pole_where_the_hardness_is_constant() {
    let closed = |h1| linear_tables_unit_exponents([1e-4, 2e-4], [2e3, h1], 50.0, 0.2, 1.0).unwrap();
    near(closed(0.0), 10.0 * 2e-4 / 2e3, 1e-15);
    for h1 in [-300.0, -199.9, -200.1, -1e-3, 1e-9, 1e-3, 199.9, 200.1, 300.0] {
        let table = table([3e-4, 2e3 + h1, 1.0, 1.0]);
        near(closed(h1), prescribed(&table, &steady(1.0)).unwrap(), 4e-15 + 1e-14);
    }
}

#[test]
fn a_constant_rate_overflows_only_where_its_result_does() {
    let rate = |values, p, v| constant_rate(&ArchardConstants::from_array(values), p, v, 1.0);
    near(rate([1e-4, 1e9, 1.0, 1.0], 1e6, -0.5).unwrap(), 5e-8, 1e-15);
    near(rate([1e-300, 1.0, 40.0, 0.0], 1e9, 0.0).unwrap(), 1e60, 1e-12);
    near(rate([1e-200, 1e200, 20.0, 1.0], 1e9, 1.0).unwrap(), 1e-220, 1e-12);
    // K itself is subnormal here: 1e-320 has three digits.
    near(rate([1e-320, 1.0, 34.0, 1.0], 1e9, 1.0).unwrap(), 1e-14, 1e-3);
    assert_eq!(rate([1.0, 1.0, 40.0, 1.0], 1e9, 1.0), Err(ArchardReferenceError::NotFinite));
    assert_eq!(rate([1.0, 1.0, 0.0, 1.0], 0.0, 1.0), Ok(0.0), "an open gap does not wear");
    assert_eq!(rate([1.0, 1.0, 1.0, 1.0], 1.0, 0.0), Ok(0.0));
    assert_eq!(rate([1.0, 1.0, 1.0, 0.0], 3.0, 0.0), Ok(3.0), "published decks carry the speed in K");
    assert_eq!(rate([0.0, 1.0, 1.0, 1.0], 3.0, 1.0), Ok(0.0));
    let n = ArchardReferenceError::VelocityExponent(-1.0);
    assert_eq!(rate([1.0, 1.0, 1.0, -1.0], 3.0, 0.0), Err(n));
    assert_eq!(rate([1.0, 0.0, 1.0, 1.0], 3.0, 1.0), Err(ArchardReferenceError::Hardness(0.0)));
    assert_eq!(rate([-1.0, 1.0, 1.0, 1.0], 3.0, 1.0), Err(ArchardReferenceError::WearCoefficient(-1.0)));
}

#[test]
fn pressure_and_velocity_through_zero_in_closed_form() {
    // p = 4 - 8 t opens at 1/2, v = 1 - 4 t turns at 1/4: w = int_0^1/2 p^m |v|.
    let piece = [Piece { time: [0.0, 1.0], pressure: [4.0, -4.0], velocity: [1.0, -3.0] }];
    // m = 1: with s = 1 - 4t, p = 2 + 2 s: 1/4 int_-1^1 (2 + 2 s) |s| ds = 1/2.
    near(linear_pieces_degree_one(1.0, 1.0, &piece).unwrap(), 0.5, 1e-15);
    // m = 2: 1/4 int (4 + 8 s + 4 s^2) |s| ds = 1/4 (4 + 2) = 3/2.
    near(linear_pieces_degree_two(1.0, 1.0, &piece).unwrap(), 1.5, 1e-15);
    for (m, closed) in [(1.0, 0.5), (2.0, 1.5)] {
        let constants = ArchardConstants::from_array([3.0, 2.0, m, 1.0]);
        let table = [TablePoint { time: 0.0, constants }];
        near(prescribed(&table, &piece).unwrap(), 1.5 * closed, 1e-14);
    }
}

#[test]
fn powers_that_start_from_zero_keep_their_digits() {
    // p = t, v = 1 - t, m = 1/2, n = 1/2 over one unit of time: B(3/2, 3/2) = pi / 8.
    let piece = [Piece { time: [0.0, 1.0], pressure: [0.0, 1.0], velocity: [1.0, 0.0] }];
    let constants = ArchardConstants::from_array([1.0, 1.0, 0.5, 0.5]);
    let table = [TablePoint { time: 0.0, constants }];
    near(prescribed(&table, &piece).unwrap(), std::f64::consts::PI / 8.0, 1e-14);
}

#[test]
fn tables_are_held_outside_their_points_and_jumps_take_no_time() {
    let point = |time, k| TablePoint { time, constants: ArchardConstants::from_array([k, 1.0, 1.0, 1.0]) };
    let table = [point(1.0, 1.0), point(3.0, 5.0)];
    let one = |time| Piece { time, pressure: [1.0; 2], velocity: [1.0; 2] };
    // 1 over [0, 1], 1 -> 5 over [1, 3], 5 over [3, 4], at twice the pressure from 3 on.
    let jump = Piece { time: [3.0; 2], pressure: [1.0, 2.0], velocity: [1.0; 2] };
    let double = Piece { pressure: [2.0; 2], ..one([3.0, 4.0]) };
    near(prescribed(&table, &[one([0.0, 3.0]), jump, double]).unwrap(), 1.0 + 6.0 + 10.0, 1e-15);
    assert_eq!(prescribed(&[], &[]), Err(ArchardReferenceError::EmptyTable));
    let back = ArchardReferenceError::TableOrder { before: 3.0, time: 1.0 };
    assert_eq!(prescribed(&[table[1], table[0]], &[]), Err(back));
}
