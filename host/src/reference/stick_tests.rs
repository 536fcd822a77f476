//! Tests of the limit of wear around a stick zone.

use super::*;
use crate::reference::quadrature::tanh_sinh;

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() <= tolerance, "{found:e}, expected {expected:e}");
}

fn sphere() -> StickLimit {
    StickLimit::sphere_at_approach(10e-3, 115e9, 1e-6, 0.5e-4).unwrap()
}

fn line() -> StickLimit {
    StickLimit::under_load(Indenter::Line, 6e-3, 110e9, 18.5e3, 1.5e-5).unwrap()
}

#[test]
fn a_sphere_held_at_a_depth() {
    let limit = sphere();
    near(limit.contact_radius / 1e-4, 1.229790575465, 1e-11);
    near(limit.load, 10.54166666667, 1e-11);
    near(limit.largest_wear_depth, 2.965494774432e-7, 1e-11);
}

#[test]
fn a_load_and_the_approach_it_gives_lead_to_the_same_limit() {
    let (held, loaded) = (sphere(), StickLimit::under_load(Indenter::Sphere, 10e-3, 115e9, sphere().load, 0.5e-4));
    let loaded = loaded.unwrap();
    near(loaded.contact_radius, held.contact_radius, 1e-12);
    near(loaded.largest_wear_depth, held.largest_wear_depth, 1e-10);
    let loaded = line();
    let (s, datum) = (loaded.stick_radius, 1.0);
    let [c0, c2] = loaded.coefficients();
    let approach = s * s / 12e-3 + 2.0 * s / 110e9 * (c0 * (2.0 * datum / s).ln() + c2 / 2.0);
    let held = StickLimit::line_at_approach(6e-3, 110e9, approach, s, datum).unwrap();
    near(held.load, loaded.load, 1e-12);
    near(held.contact_radius, loaded.contact_radius, 1e-12);
}

#[test]
fn the_pressure_carries_the_load() {
    // The distance from the edge is kept: the pressure is singular there.
    let integral = |limit: StickLimit, around: fn(f64) -> f64| {
        let s = limit.stick_radius;
        tanh_sinh(s.sqrt(), |left, _| {
            let r = s - left * left;
            if r < s { 2.0 * left * limit.at(r).pressure * around(r) } else { 0.0 }
        })
    };
    near(integral(sphere(), |r| 2.0 * PI * r), sphere().load, 1e-7);
    near(integral(line(), |_| 2.0), 18.5e3, 1e-7);
}

/// What is left between the bodies at a point, by quadrature over the kernel of the half-space.
fn gap(limit: &StickLimit, r: f64) -> f64 {
    let s = limit.stick_radius;
    // With t = s sin(a) the singular pressure times dt is smooth.
    let ring = |t: f64| {
        let (mut x, mut y) = (1.0, ((r - t) / (r + t)).abs());
        for _ in 0..60 {
            (x, y) = (0.5 * (x + y), f64::sqrt(x * y));
        }
        2.0 * t / ((r + t) * x)
    };
    let sum = tanh_sinh(PI / 2.0, |angle, _| {
        let t = s * angle.sin();
        let value = limit.at(t).pressure * s * angle.cos() * ring(t);
        if value.is_finite() { value } else { 0.0 }
    });
    let displacement = sum / limit.start.modulus;
    r * r / (2.0 * limit.start.radius) + limit.at(r).wear_depth + displacement - limit.approach
}

#[test]
fn the_worn_gap_is_closed_up_to_the_contact_radius_and_open_beyond() {
    let limit = sphere();
    for part in [0.55, 0.8, 1.1, 1.22] {
        let gap = gap(&limit, part * 1e-4);
        assert!(gap.abs() < 5e-8 * limit.approach, "{part}: {gap:e}");
    }
    let gap = gap(&limit, 1.3e-4);
    assert!(gap > 0.01 * limit.approach && limit.at(1.3e-4) == PointAnswer::default(), "{gap:e}");
}

#[test]
fn the_gap_of_a_line_is_closed_by_its_displacement() {
    // u(x) - u(y) by the logarithmic kernel at points beyond the stick zone, against the worn profile.
    let limit = line();
    let s = limit.stick_radius;
    let profile = |x: f64| -x * x / 12e-3 - limit.at(x).wear_depth;
    let [x, y] = [1.3 * s, 2.1 * s];
    assert!(y < limit.contact_radius);
    let kernel = |t: f64| -2.0 / (PI * 110e9) * ((x * x - t * t) / (y * y - t * t)).ln();
    let difference = tanh_sinh(PI / 2.0, |angle, _| {
        let value = limit.at(s * angle.sin()).pressure * s * angle.cos() * kernel(s * angle.sin());
        if value.is_finite() { value } else { 0.0 }
    });
    near(difference, profile(x) - profile(y), 1e-8);
}

#[test]
fn no_wear_where_nothing_slips() {
    for indenter in [Indenter::Line, Indenter::Sphere] {
        let start = Hertz::new(indenter, 2.0, 3.0, 0.5).unwrap();
        let limit = StickLimit::under_load(indenter, 2.0, 3.0, 0.5, 1.2 * start.contact_radius).unwrap();
        assert_eq!((limit.largest_wear_depth, limit.contact_radius), (0.0, start.contact_radius));
        assert_eq!(limit.at(0.3), start.at(0.3));
        // Nearly all of it sticks: nearly Hertz.
        let limit = StickLimit::under_load(indenter, 2.0, 3.0, 0.5, 0.999 * start.contact_radius).unwrap();
        near(limit.at(0.0).pressure, start.largest_pressure, 3e-3);
        assert!(limit.largest_wear_depth < 1e-3 * start.contact_radius.powi(2) && limit.largest_wear_depth > 0.0);
    }
    let lifted = StickLimit::line_at_approach(6e-3, 110e9, 1e-12, 1.5e-5, 1.0).unwrap_err().to_string();
    assert!(lifted.starts_with("the approach is 1e-12, expected so much"), "{lifted}");
}
