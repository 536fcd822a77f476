//! The quick path of m = n = 1: the same bits as the general one, and nothing let through that it must not answer.

use super::{Instructions, Law, Sequence, bits};
use crate::power::{Wide, increments, steady};

fn quick(law: &Law, p: &[f64], v: &[f64]) -> (bool, Vec<f64>) {
    let mut out = vec![f64::NAN; p.len()];
    let good = Wide::here().is_some_and(|wide| steady(wide, p, v, (law.k, law.h, law.dt), &mut out));
    (good, out)
}

/// Whether this processor has the quick path.
fn there_is_one() -> bool {
    quick(&Law { m: 1.0, n: 1.0, k: 1.0, h: 1.0, dt: 1.0 }, &[1.0], &[1.0]).0
}

#[test]
fn the_bits_are_those_of_the_general_path() {
    let mut r = Sequence(11);
    let mut answered = 0;
    for round in 0..2000 {
        let law = Law { m: 1.0, n: 1.0, k: r.decade(-60.0, 60.0), h: r.decade(-60.0, 60.0), dt: r.decade(-60.0, 60.0) };
        let p: Vec<f64> = (0..1 + round % 19).map(|_| r.decade(-99.0, 120.0) - r.within(0.0, 1e-3)).collect();
        let v: Vec<f64> =
            p.iter().map(|_| r.decade(-120.0, 3.0) * if r.bits().is_multiple_of(2) { 1.0 } else { -1.0 }).collect();
        let (good, out) = quick(&law, &p, &v);
        if good {
            answered += 1;
            assert_eq!(bits(&out), bits(&law.batch(Instructions::Best, &p, &v).0), "{law:?} {p:?} {v:?}");
        }
    }
    assert!(answered > 1500 || !there_is_one(), "{answered}");
}

#[test]
fn one_odd_number_anywhere_is_left_to_the_general_path() {
    let law = Law { m: 1.0, n: 1.0, k: 1e-4, h: 2e9, dt: 0.5 };
    let signalling = f64::from_bits(0x7ff0_0000_0000_0001);
    for points in [1, 3, 4, 5, 8, 31] {
        for at in 0..points {
            for (p, v) in [
                (f64::NAN, 1.0),
                (signalling, 1.0),
                (-signalling, 1.0),
                (f64::INFINITY, 1.0),
                (f64::INFINITY, 0.0),
                (f64::NEG_INFINITY, 1.0),
                (5e-324, 1.0),
                (1e-310, 1.0),
                (1e6, f64::NAN),
                (1e6, signalling),
                (1e6, f64::INFINITY),
                (0.0, f64::INFINITY),
                (-1.0, f64::NAN),
                (1e300, 1e300),
            ] {
                let (mut ps, mut vs) = (vec![1e6; points], vec![0.3; points]);
                (ps[at], vs[at]) = (p, v);
                assert!(!quick(&law, &ps, &vs).0, "{p} {v} at {at} of {points}");
            }
        }
    }
}

#[test]
fn open_points_do_not_wear_on_the_quick_path() {
    let law = Law { m: 1.0, n: 1.0, k: 1e-4, h: 2e9, dt: 0.5 };
    let p = [1e6, 0.0, -0.0, -3.0, -1e300, 2e6, f64::MAX.sqrt(), 1e-99, 4.0];
    let v = [0.5, 1.0, -1.0, 2.0, 1e200, 0.0, -0.0, -3.0, 1e-310];
    let (good, out) = quick(&law, &p, &v);
    assert_eq!(good, there_is_one());
    let general = law.batch(Instructions::Best, &p, &v).0;
    assert!(!good || bits(&out) == bits(&general), "{out:?} {general:?}");
    assert!(out[1..6].iter().all(|w| !good || w.to_bits() == 0));
}

#[test]
fn unusual_constants_are_left_to_the_general_path() {
    let usual = Law { m: 1.0, n: 1.0, k: 1e-4, h: 2e9, dt: 0.5 };
    for odd in [0.0, -1.0, 1e-61, 1e61, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324] {
        for law in [Law { k: odd, ..usual }, Law { h: odd, ..usual }, Law { dt: odd, ..usual }] {
            assert!(!quick(&law, &[1e6; 5], &[0.1; 5]).0, "{law:?}");
        }
    }
}

#[test]
fn a_batch_called_plain_is_finite() {
    let mut r = Sequence(5);
    for m in [0.0, 1.0, 0.7] {
        for n in [1.0, 1.3] {
            let law = Law { m, n, k: 1e-4, h: 2e9, dt: 1.0 };
            let (p, v): (Vec<f64>, Vec<f64>) = (0..40).map(|_| (r.decade(-3.0, 10.0), r.decade(-6.0, 1.0))).unzip();
            let mut out = vec![f64::NAN; 40];
            let fast = there_is_one() || (m, n) == (1.0, 1.0);
            assert_eq!(increments(&law.inputs(&p, &v), &mut out, None), fast, "{law:?}");
            assert!(out.iter().all(|w| w.is_finite()));
            for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                for at in [0, 17, 39] {
                    let (mut p, mut v) = (p.clone(), v.clone());
                    p[at] = odd;
                    assert!(!increments(&law.inputs(&p, &v), &mut out, None), "{law:?} {odd}");
                    (p[at], v[at]) = (-1.0, odd);
                    assert!(!increments(&law.inputs(&p, &v), &mut out, None), "{law:?} {odd}");
                }
            }
        }
    }
}
