//! Displacement per pressure: what one loaded cell does to the others.
//!
//! All of it for E* = 1, lengths in one unit of the caller's choice.

use std::f64::consts::PI;

/// Lag, in cells, from which the closed form of [`rectangle`] is left for quadrature, because it loses a digit for each
/// factor of three in distance, and from which fewer nodes are enough. The error of n nodes falls like (4 lag)^(-2n).
const NEAR: f64 = 4.0;
const NODES: [(f64, &[(f64, f64)]); 4] = [(1000.0, &TWO), (40.0, &THREE), (12.0, &FIVE), (NEAR, &EIGHT)];

/// Gauss-Legendre nodes on (0, 1) from the middle to one end, and weights of the pair; the middle one counts once.
const TWO: [(f64, f64); 1] = [(0.577_350_269_189_625_8, 0.5)];
const THREE: [(f64, f64); 2] = [(0.0, 4.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 18.0)];
const FIVE: [(f64, f64); 3] = [
    (0.0, 0.284_444_444_444_444_44),
    (0.538_469_310_105_683_1, 0.239_314_335_249_683_24),
    (0.906_179_845_938_664, 0.118_463_442_528_094_54),
];
const EIGHT: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.181_341_891_689_181),
    (0.525_532_409_916_329, 0.156_853_322_938_943_64),
    (0.796_666_477_413_626_7, 0.111_190_517_226_687_24),
    (0.960_289_856_497_536_3, 0.050_614_268_145_188_13),
];

/// Displacement at (x, y) from the middle of a rectangle with sides `a`, `b` under unit pressure, 3-D:
/// the integral of 1/(pi r) over it (Love, Phil. Trans. R. Soc. A 228, 1929; Johnson, Contact Mechanics, eq. 3.25).
#[must_use]
pub fn rectangle(x: f64, y: f64, a: f64, b: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    let lag = (x * x + y * y).sqrt() / a.max(b);
    let integral = match NODES.iter().find(|(from, _)| lag >= *from) {
        Some((_, nodes)) => {
            a * b * mean(nodes, 0.5 * a, |s| mean(nodes, 0.5 * b, |t| 1.0 / ((x + s).powi(2) + (y + t).powi(2)).sqrt()))
        }
        None => {
            let (x, y) = ([x - 0.5 * a, x + 0.5 * a], [y - 0.5 * b, y + 0.5 * b]);
            corner(x[1], y[1]) - corner(x[0], y[1]) - corner(x[1], y[0]) + corner(x[0], y[0])
        }
    };
    integral / PI
}

/// x asinh(y / |x|) + y asinh(x / |y|), the second integral of 1/r.
fn corner(x: f64, y: f64) -> f64 {
    let part = |x: f64, y: f64| if x == 0.0 { 0.0 } else { x * (y / x.abs()).asinh() };
    part(x, y) + part(y, x)
}

/// Mean of a function over (-half, half).
fn mean(nodes: &[(f64, f64)], half: f64, f: impl Fn(f64) -> f64) -> f64 {
    let pair = |at: f64| if at == 0.0 { f(0.0) } else { f(-half * at) + f(half * at) };
    nodes.iter().map(|(at, weight)| weight * pair(*at)).sum()
}

/// Displacement at x from the middle of a strip of width `a` under unit pressure, 2-D plane strain, zero at about the
/// distance `datum`: the integral of -(2 / pi) ln(|x| / datum) over it (Johnson, Contact Mechanics, eq. 2.30).
#[must_use]
pub fn strip(x: f64, a: f64, datum: f64) -> f64 {
    let x = x.abs();
    let integral = match NODES.iter().find(|(from, _)| x >= from * a) {
        Some((_, nodes)) => a * mean(nodes, 0.5 * a, |s| ((x + s) / datum).ln()),
        None => {
            let end = |s: f64| if s == 0.0 { 0.0 } else { s * (s.abs() / datum).ln() };
            end(x + 0.5 * a) - end(x - 0.5 * a) - a
        }
    };
    -2.0 / PI * integral
}

/// Displacement per pressure of the Fourier mode (kx, ky) on a periodic surface of this many cells: 2 / |q|, no mean
/// mode (Johnson, Contact Mechanics, section 13.2; the same in 2-D).
#[must_use]
pub fn mode(k: [usize; 2], counts: [usize; 2], spacing: [f64; 2]) -> f64 {
    let wave = |axis: usize| {
        let least = k[axis].min(counts[axis] - k[axis]);
        2.0 * PI * least as f64 / (counts[axis] as f64 * spacing[axis])
    };
    let q = wave(0).hypot(wave(1));
    if q == 0.0 { 0.0 } else { 2.0 / q }
}
