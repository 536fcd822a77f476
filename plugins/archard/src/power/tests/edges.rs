//! What comes out at zero, below, and where nothing is a number.

use super::{Law, Sequence, power};
use crate::power::Scale;

const KINDS: [f64; 6] = [0.0, 1.0, 1.5, 0.3, -0.5, 130.0];

#[test]
fn open_points_do_not_wear() {
    for m in KINDS {
        for n in KINDS {
            for p in [0.0, -0.0, -1.0, -1e-310, -1e300, -5e-324] {
                for v in [0.5, 0.0, -0.0, 1e-310] {
                    let got = power(m, n).point(p, v);
                    assert_eq!((got.0.to_bits(), got.1.to_bits()), (0, 0), "p {p} v {v} m {m} n {n}");
                }
            }
        }
    }
}

#[test]
fn standstill() {
    for m in KINDS {
        let free = power(m, 0.0);
        assert_eq!(free.point(3.0, 0.0), free.point(3.0, 7.0));
        assert_eq!(free.point(3.0, f64::NAN), free.point(3.0, 7.0), "n = 0 reads no velocity");
        for n in [1.0, 0.3, 1.5, 130.0] {
            assert_eq!(power(m, n).point(3.0, 0.0), (0.0, 0.0));
            assert_eq!(power(m, n).point(3.0, -0.0), (0.0, 0.0));
        }
        assert_eq!(power(m, -0.5).point(3.0, 0.0).0, f64::INFINITY);
    }
}

#[test]
fn a_backward_velocity_wears_as_a_forward_one() {
    for m in KINDS {
        for n in KINDS {
            assert_eq!(power(m, n).point(3.0, -0.7), power(m, n).point(3.0, 0.7));
        }
    }
}

#[test]
fn what_is_not_finite_is_never_hidden() {
    for m in KINDS {
        for n in KINDS {
            for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert!(power(m, n).point(x, 0.5).0.is_nan(), "p {x} m {m} n {n}");
                if n != 0.0 {
                    for p in [2.0, 0.0, -1.0] {
                        assert!(power(m, n).point(p, x).0.is_nan(), "p {p} v {x} m {m} n {n}");
                    }
                }
                assert!(power(x, n).point(2.0, 0.5).0.is_nan());
                assert!(power(m, x).point(2.0, 0.5).0.is_nan());
                assert!(Law { k: x, ..power(m, n) }.point(2.0, 0.5).0.is_nan());
                assert!(Law { h: x, ..power(m, n) }.point(2.0, 0.5).0.is_nan());
                assert!(Law { dt: x, ..power(m, n) }.point(2.0, 0.5).0.is_nan());
            }
            assert!(Law { h: 0.0, ..power(m, n) }.point(2.0, 0.5).0.is_nan());
        }
    }
}

#[test]
fn nothing_wears_without_coefficient_or_time() {
    for m in KINDS {
        for n in KINDS {
            for (p, v) in [(2.0, 0.5), (1e300, 1e300), (1e-300, 1e-300), (5e-324, 3.0)] {
                assert_eq!(Law { k: 0.0, ..power(m, n) }.point(p, v), (0.0, 0.0));
                assert_eq!(Law { dt: 0.0, ..power(m, n) }.point(p, v), (0.0, 0.0));
            }
        }
    }
}

#[test]
fn signs_of_the_factor_pass_through() {
    for m in KINDS {
        for n in KINDS {
            let (w, s) = power(m, n).point(1.7, 0.4);
            assert_eq!(Law { k: -1.0, ..power(m, n) }.point(1.7, 0.4), (-w, -s));
        }
    }
}

#[test]
fn overflow_is_infinite_and_underflow_zero() {
    assert_eq!(power(2.0, 1.0).point(1e300, 1.0).0, f64::INFINITY);
    assert_eq!(power(1.0, 1.0).point(1e300, 1e300).0, f64::INFINITY);
    assert_eq!(power(1e6, 1.0).point(2.0, 1.0).0, f64::INFINITY);
    assert_eq!(power(1e308, -1e308).point(1e300, 1e300).0, 1.0);
    assert_eq!(power(2.0, 1.0).point(1e-300, 1.0).0, 0.0);
    assert_eq!(power(-2.0, 1.0).point(1e-300, 1.0).0, f64::INFINITY);
}

#[test]
fn whole_exponents_of_small_numbers_are_exact() {
    for (m, p, wear) in [(2.0, 3.0, 9.0), (3.0, 5.0, 125.0), (-1.0, 4.0, 0.25), (0.5, 9.0, 3.0)] {
        assert_eq!(power(m, 0.0).point(p, 1.0).0, wear);
    }
    assert_eq!(power(2.0, 2.0).point(10.0, 10.0).0, 1e4);
    assert_eq!(power(2.5, 0.3).point(1.0, 1.0), (1.0, 2.5));
    assert_eq!(power(1.0, 1.0).point(0.1, 0.7), (0.1 * 0.7, 0.7));
}

#[test]
fn the_scale_holds_what_doubles_do_not() {
    assert_eq!(Scale::new(1e-4, 2e3, 0.5).value(), 1e-4 / 2e3 * 0.5);
    assert_eq!(Scale::new(1e-300, 1e300, 1e300).value(), 1e-300);
    assert_eq!(Scale::new(5e-324, 5e-324, 3.0).value(), 3.0);
    assert_eq!(Scale::new(-3.0, 2.0, 1.0).value(), -1.5);
    assert_eq!(Scale::new(1.0, 1.0, 1.0), Scale::ONE);
}

#[test]
fn slopes_follow_differences() {
    let mut r = Sequence(5);
    for _ in 0..300 {
        let law = power(r.within(-3.0, 5.0), r.within(-3.0, 5.0));
        let (p, v) = (r.decade(-6.0, 9.0), r.decade(-6.0, 3.0));
        let h = 1e-5 * p;
        let difference = (law.point(p + h, v).0 - law.point(p - h, v).0) / (2.0 * h);
        let slope = law.point(p, v).1;
        assert!(
            (difference - slope).abs() < 1e-8 * slope.abs() + 1e-10 * (law.point(p, v).0 / p),
            "{law:?} p {p:e} v {v:e}"
        );
    }
}
