//! Largest errors over seeded random points, and increments known to the last bit.

use super::known::KNOWN;
use super::reference::Wide;
use super::{Instructions::Best, Law, Sequence, power};

/// The largest error in last places, of increments and of slopes.
fn worst(batches: usize, points: usize, mut draw: impl FnMut(&mut Sequence) -> Law) -> (f64, f64) {
    let mut r = Sequence(20_240_607);
    let (mut wear, mut slope) = (0f64, 0f64);
    for _ in 0..batches {
        let law = draw(&mut r);
        let p: Vec<f64> = (0..points).map(|_| r.decade(-6.0, 12.0)).collect();
        let v: Vec<f64> = (0..points).map(|_| r.decade(-9.0, 3.0)).collect();
        let (w, s) = law.batch(Best, &p, &v);
        let factor = Wide::new(law.k).times(Wide::new(law.dt)).over(law.h);
        for i in 0..points {
            let exact = factor.by_powers(p[i], v[i], law.m, law.n);
            wear = wear.max(exact.ulps(w[i]));
            slope = slope.max(exact.times(Wide::new(law.m)).over(p[i]).ulps(s[i]));
        }
    }
    println!("largest error {wear:.3} ulp, of a slope {slope:.3} ulp");
    (wear, slope)
}

#[test]
fn powers_within_two_units_in_the_last_place() {
    let (w, s) = worst(2000, 60, |r| power(r.within(0.1, 5.0), r.within(0.1, 5.0)));
    assert!(w < 1.0, "{w} ulp");
    assert!(s < 3.0, "{s} ulp");
}

#[test]
fn one_general_exponent_beside_one_of_1() {
    let (w, _) = worst(500, 40, |r| power(r.within(0.1, 5.0), 1.0));
    assert!(w < 1.5, "{w} ulp");
    let (w, _) = worst(500, 40, |r| power(1.0, r.within(0.1, 5.0)));
    assert!(w < 1.5, "{w} ulp");
}

#[test]
fn increments_within_four_units_in_the_last_place() {
    let law =
        |r: &mut Sequence, m, n| Law { m, n, k: r.decade(-9.0, -1.0), h: r.decade(0.0, 12.0), dt: r.decade(-6.0, 6.0) };
    let (w, s) = worst(1000, 40, |r| {
        let (m, n) = (r.within(0.1, 5.0), r.within(0.1, 5.0));
        law(r, m, n)
    });
    assert!(w < 1.5, "{w} ulp");
    assert!(s < 4.0, "{s} ulp");
    let (w, _) = worst(500, 40, |r| law(r, 1.0, 1.0));
    assert!(w < 3.0, "{w} ulp");
}

#[test]
fn known_increments_of_any_size() {
    let mut finite = 0;
    for row in &KNOWN {
        let [k, h, dt, p, v, m, n, known] = row.map(f64::from_bits);
        let got = Law { m, n, k, h, dt }.point(p, v).0;
        // Doubles of one sign are ordered as their bits; infinity follows the largest.
        let off = got.to_bits().abs_diff(known.to_bits());
        assert!(off <= 2, "{got:e} for {known:e}: K {k:e} H {h:e} dt {dt:e} p {p:e} v {v:e} m {m} n {n}");
        finite += usize::from(known.is_finite() && known != 0.0);
    }
    assert!(finite > 200);
}

#[test]
fn no_overflow_only_in_between() {
    let at = |k, h, m, p| Law { m, n: 1.0, k, h, dt: 1.0 }.point(p, 1.0).0;
    let near = |x: f64, y: f64| assert!((x / y - 1.0).abs() < 3e-15, "{x:e} for {y:e}");
    near(at(1e-300, 1.0, 40.0, 1e9), 1e60);
    near(at(1e-200, 1e200, 20.0, 1e9), 1e-220);
    // K is the subnormal nearest to 1e-320.
    near(at(1e-320, 1.0, 34.0, 1e9), 9.99988867182683e-15);
    assert_eq!(at(1e-3, 1.0, 40.0, 1e9), f64::INFINITY);
    assert_eq!(at(1e-300, 1e300, 1.0, 1e9), 0.0);
}
