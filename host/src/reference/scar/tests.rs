use super::super::quadrature::tanh_sinh;
use super::*;

fn sphere() -> Hertz {
    Hertz::new(Indenter::Sphere, 5e-3, 115e9, 10.0).unwrap()
}

fn line() -> Hertz {
    Hertz::new(Indenter::Line, 6e-3, 109.89011e9, 18.5e3).unwrap()
}

fn within(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found}, expected {expected} within {tolerance:e}");
}

#[test]
fn scars_of_spheres_and_lines_at_two_ages() {
    let cases = [
        (sphere(), 1.0, [0.719996, 0.501204, 1.812351]),
        (sphere(), 10.0, [0.218182, 2.357775, 3.109923]),
        (line(), 1.0, [0.773111, 0.745136, f64::NAN]),
        (line(), 10.0, [0.366102, 4.431662, f64::NAN]),
    ];
    for (start, tau, [pressure, depth, approach]) in cases {
        let scar = Scar::after(start, tau).unwrap();
        within(scar.central_pressure / start.largest_pressure, pressure, 5e-6);
        within(scar.central_wear_depth / start.depth_unit(), depth, 5e-6);
        if approach.is_finite() {
            within(scar.approach(f64::NAN) / start.depth_unit(), approach, 5e-6);
        }
    }
}

#[test]
fn time_counts_as_worn_volume() {
    within(time_unit(&sphere()) / 1e-14, 0.0352558438123, 1e-12);
    within(time_unit(&line()) / 4.8e-15, 0.0577106890096, 1e-10);
    let scar = Scar::new(Indenter::Sphere, 5e-3, 115e9, 10.0, 1e-14 * 0.352558438123).unwrap();
    within(scar.tau, 10.0, 1e-10);
    within(scar.worn_volume / (10.0 * 0.352558438123e-14), 1.0, 1e-12);
}

#[test]
fn the_pressure_carries_the_load_and_the_depth_holds_the_volume() {
    for tau in [1e-3, 0.3, 30.0] {
        let scar = Scar::after(sphere(), tau).unwrap();
        let over =
            |of: fn(PointAnswer) -> f64| tanh_sinh(1.01 * scar.contact_radius, |r, _| 2.0 * PI * r * of(scar.at(r)));
        within(over(|at| at.pressure) / 10.0, 1.0, 1e-5);
        within(over(|at| at.wear_depth) / scar.worn_volume, 1.0, 1e-5);
        let scar = Scar::after(line(), tau).unwrap();
        let over = |of: fn(PointAnswer) -> f64| 2.0 * tanh_sinh(1.01 * scar.contact_radius, |x, _| of(scar.at(x)));
        within(over(|at| at.pressure) / 18.5e3, 1.0, 1e-5);
        within(over(|at| at.wear_depth) / scar.worn_volume, 1.0, 1e-5);
    }
}

#[test]
fn before_any_wear_it_is_hertz_and_little_wear_follows_its_pressure() {
    for start in [sphere(), line()] {
        let scar = Scar::after(start, 0.0).unwrap();
        let half = 0.5 * start.contact_radius;
        assert_eq!(scar.at(half), start.at(half));
        within(scar.contact_radius / start.contact_radius, 1.0, 1e-14);
        within(scar.approach(1.0) / start.approach(1.0), 1.0, 1e-13);
        let young = Scar::after(start, 1e-6).unwrap();
        let first = time_unit(&start) * 1e-6 * start.pressure(half);
        within(young.at(half).wear_depth / first, 1.0, 2e-4);
    }
}

/// The displacement of a half-space under a pressure, by quadrature over its kernel: rings of a sphere by complete
/// elliptic integrals (arithmetic-geometric mean), logarithms for a line.
fn displacement(scar: &Scar, distance: f64) -> f64 {
    let a = scar.contact_radius;
    let kernel = |s: f64| match scar.start.indenter {
        Indenter::Sphere => {
            // u = (4 / pi E*) int p s K(k) / (r + s) ds with k^2 = 4 r s / (r + s)^2, and K = pi / 2 agm(1, k').
            let (mut x, mut y) = (1.0, ((distance - s) / (distance + s)).abs());
            for _ in 0..60 {
                (x, y) = (0.5 * (x + y), f64::sqrt(x * y));
            }
            2.0 * s / ((distance + s) * x)
        }
        Indenter::Line => 2.0 / PI * ((1e3 * a / (distance - s).abs()).ln() + (1e3 * a / (distance + s)).ln()),
    };
    let part = |from: f64, to: f64| {
        tanh_sinh(to - from, |left, right| {
            // Distances from the singularity are kept, whichever end it is.
            let s = if from == distance { from + left } else { to - right };
            if s == distance { 0.0 } else { scar.at(s).pressure * kernel(s) }
        })
    };
    (part(0.0, distance) + part(distance, a)) / scar.start.modulus
}

#[test]
fn the_worn_gap_is_closed_by_the_displacement() {
    for (start, tau) in [(sphere(), 3.0), (line(), 3.0)] {
        let scar = Scar::after(start, tau).unwrap();
        let datum = 1e3 * scar.contact_radius;
        for part in [0.2, 0.6, 0.9] {
            let r = part * scar.contact_radius;
            let gap = r * r / (2.0 * start.radius) + scar.at(r).wear_depth - scar.approach(datum);
            let gap = gap + displacement(&scar, r);
            assert!(gap.abs() < 1e-5 * start.depth_unit(), "{part}: {}", gap / start.depth_unit());
        }
    }
}

#[test]
fn wear_follows_the_pressure() {
    // (w(tau + d) - w(tau - d)) / 2 d against kappa p, in Hertz's units.
    let (tau, d) = (2.0, 0.01);
    for start in [sphere(), line()] {
        let [before, now, after] = [tau - d, tau, tau + d].map(|tau| Scar::with([24, 48], start, tau).unwrap());
        for part in [0.0, 0.4, 0.8] {
            let r = part * now.contact_radius;
            let rate = (after.at(r).wear_depth - before.at(r).wear_depth) / (2.0 * d * time_unit(&start));
            within(rate / now.at(r).pressure, 1.0, 1e-4);
        }
    }
}

#[test]
fn more_functions_change_little() {
    for start in [sphere(), line()] {
        let of = |orders: [usize; 2], tau: f64| {
            let scar = Scar::with(orders, start, tau).unwrap();
            let inside = scar.at(0.6 * scar.contact_radius);
            let inside = [inside.pressure / start.largest_pressure, inside.wear_depth / start.depth_unit()];
            [inside[0], inside[1], scar.central_pressure, scar.central_wear_depth, scar.contact_radius]
        };
        for tau in [1.0, 1000.0] {
            let (few, many) = (of([24, 48], tau), of(ORDERS, tau));
            few.iter().zip(many).for_each(|(few, many)| within(few / many, 1.0, 1e-4));
        }
    }
}

#[test]
fn old_scars_follow_the_long_time_laws() {
    for start in [sphere(), line()] {
        let errors = [10.0, 1000.0].map(|tau| {
            let law = long_time_radius(start.indenter, tau).unwrap();
            Scar::after(start, tau).unwrap().contact_radius / start.contact_radius / law - 1.0
        });
        assert!(errors[1].abs() < 0.003 && errors[0].abs() < 0.05 && errors[1].abs() < errors[0].abs(), "{errors:?}");
    }
}

#[test]
fn ages_without_an_answer_are_refused() {
    for tau in [-1.0, 2e4, f64::NAN] {
        assert!(Scar::after(sphere(), tau).is_err(), "{tau}");
    }
    let error = Scar::new(Indenter::Line, 1.0, 1.0, 1.0, -1.0).err().unwrap();
    assert_eq!(error.to_string(), "the wear per pressure is -1e0, expected a finite number of 0 or more");
}
