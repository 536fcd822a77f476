//! The right answers of Archard's law, (K/H) p^m v^n dt, and cases in its constants.

use super::{Expected, Point};

/// Cases in the constants K, H, m, n.
pub(super) fn cases(point: &Point) -> Vec<(String, Point)> {
    let case = |input: &str, change: &dyn Fn(&mut Point)| {
        let mut changed = point.clone();
        change(&mut changed);
        (input.to_owned(), changed)
    };
    let between = |k: f64, h: f64, m: f64, input: &str| {
        let all = Point { constants: vec![k, h, m, 1.0], pressure: 1e9, velocity: 1.0, dt: 1.0 };
        (format!("{input}: overflow only in between"), all)
    };
    vec![
        case("K = 0", &|p| p.constants[0] = 0.0),
        case("K negative", &|p| p.constants[0] = -1e-4),
        case("K NaN", &|p| p.constants[0] = f64::NAN),
        case("H = 0", &|p| p.constants[1] = 0.0),
        case("H negative", &|p| p.constants[1] = -p.constants[1]),
        case("m = 0 and pressure 0", &|p| (p.constants[2], p.pressure) = (0.0, 0.0)),
        case("m = 0 and pressure NaN", &|p| (p.constants[2], p.pressure) = (0.0, f64::NAN)),
        case("m = -2 and pressure 1e-200", &|p| (p.constants[2], p.pressure) = (-2.0, 1e-200)),
        case("n = 0 and velocity 0", &|p| (p.constants[3], p.velocity) = (0.0, 0.0)),
        case("n = -1 and velocity 0", &|p| (p.constants[3], p.velocity) = (-1.0, 0.0)),
        between(1e-300, 1.0, 40.0, "K = 1e-300, pressure 1e9, m = 40"),
        between(1e-200, 1e200, 20.0, "K = 1e-200, H = 1e200, pressure 1e9, m = 20"),
        between(1e-320, 1.0, 34.0, "K = 1e-320, pressure 1e9, m = 34"),
    ]
}

/// The right answer: 0 without pressure whatever m, the size of the velocity, no value that is not finite.
pub(super) fn expected(point: &Point) -> Expected {
    let [k, h, m, n] = [0, 1, 2, 3].map(|c| point.constants[c]);
    let Point { pressure, velocity, dt, .. } = *point;
    let numbers = [k, h, m, n, pressure, velocity, dt];
    if numbers.iter().any(|number| !number.is_finite()) || k < 0.0 || h <= 0.0 || dt < 0.0 {
        return Expected::Refused;
    }
    let speed = velocity.abs();
    if pressure > 0.0 && speed == 0.0 && n < 0.0 {
        return Expected::Refused;
    }
    if pressure <= 0.0 || k == 0.0 || dt == 0.0 || (speed == 0.0 && n > 0.0) {
        return Expected::Value(0.0);
    }
    let moving = if n == 0.0 { 0.0 } else { n * speed.ln() };
    let logarithm = k.ln() - h.ln() + m * pressure.ln() + moving + dt.ln();
    let value = logarithm.exp();
    if value.is_finite() { Expected::Value(value) } else { Expected::Refused }
}
