//! The same bits whatever the instructions, the batch, and the steps of columns.

use super::{Instructions, Instructions::Best, Instructions::Portable, Law, Sequence, bits, evaluate};
use crate::power::{Column, Inputs};

/// Points of every sort: usual, far outside, silent, broken.
fn points(r: &mut Sequence, count: usize) -> Vec<f64> {
    let odd = [0.0, -0.0, -3.0, 1.0, 5e-324, 1e-310, f64::MIN_POSITIVE, f64::MAX, f64::INFINITY, f64::NAN];
    (0..count)
        .map(|_| match r.bits() % 8 {
            0 => odd[(r.bits() % 10) as usize],
            1 => r.decade(-300.0, 300.0),
            2 => r.within(0.5, 2.0),
            _ => r.decade(-6.0, 12.0),
        })
        .collect()
}

fn laws(r: &mut Sequence) -> Vec<Law> {
    let mut laws = Vec::new();
    for m in [0.0, 1.0, 2.0, 1.37, -0.4, 90.0, 300.0] {
        for n in [0.0, 1.0, 0.5, 2.81, -1.2, 200.0] {
            let (k, h, dt) = (r.decade(-9.0, 0.0), r.decade(0.0, 10.0), r.decade(-3.0, 3.0));
            laws.push(Law { m, n, k, h, dt });
            laws.push(Law { m, n, k: r.decade(-300.0, 300.0), h, dt });
        }
    }
    laws
}

#[test]
fn instructions_do_not_show() {
    let mut r = Sequence(1);
    for law in laws(&mut r) {
        let (p, v) = (points(&mut r, 300), points(&mut r, 300));
        let (w, s) = law.batch(Best, &p, &v);
        let (w2, s2) = law.batch(Portable, &p, &v);
        assert_eq!(bits(&w), bits(&w2), "{law:?}");
        assert_eq!(bits(&s), bits(&s2), "{law:?}");
    }
}

#[test]
fn batch_sizes_do_not_show() {
    let mut r = Sequence(2);
    for law in laws(&mut r) {
        let (p, v) = (points(&mut r, 140), points(&mut r, 140));
        let (whole, whole_slope) = law.batch(Best, &p, &v);
        for size in (1..=40).chain([63, 64, 65, 127, 128, 129]) {
            let from = (r.bits() % 11) as usize;
            let to = from + size;
            let (w, s) = law.batch(Best, &p[from..to], &v[from..to]);
            assert_eq!(bits(&w), bits(&whole[from..to]), "{size} points, {law:?}");
            assert_eq!(bits(&s), bits(&whole_slope[from..to]), "{size} points, {law:?}");
        }
    }
}

/// The batch of `inputs` against its points one by one, each with uniform columns.
fn like_points(by: Instructions, inputs: &Inputs, at: impl Fn(usize) -> ([f64; 2], Law), count: usize) {
    let (w, s) = evaluate(by, inputs, count);
    for i in 0..count {
        let ([p, v], law) = at(i);
        let (one, one_slope) = law.point(p, v);
        assert_eq!(bits(&[w[i], s[i]]), bits(&[one, one_slope]), "point {i}: p {p:e} v {v:e} {law:?}");
    }
}

#[test]
fn steps_of_columns_do_not_show() {
    let mut r = Sequence(3);
    const COUNT: usize = 300;
    let table: Vec<f64> = (0..COUNT)
        .flat_map(|_| {
            let (p, v) = (points(&mut r, 1)[0], points(&mut r, 1)[0]);
            let odd = [0.0, 1.0, 2.0, -1.0, 150.0];
            let mut exponent = |low| match r.bits() % 3 {
                0 => odd[(r.bits() % 5) as usize],
                _ => r.within(low, 5.0),
            };
            let (m, n) = (exponent(0.1), exponent(-2.0));
            let k = [0.0, 1e-320, 3e-4, r.decade(-300.0, 300.0)][(r.bits() % 4) as usize];
            [p, v, m, n, k, r.decade(-5.0, 12.0)]
        })
        .collect();
    let row = |i: usize| -> [f64; 6] { table[6 * i..6 * i + 6].try_into().unwrap() };
    for mask in 0..64usize {
        // A column is either uniform (its value at point 7) or strided through the table.
        let column = |c: usize| match (mask >> c) & 1 {
            0 => Column::uniform(&table[6 * 7 + c]),
            _ => Column::strided(&table[c..], 6),
        };
        let inputs = Inputs {
            pressure: column(0),
            velocity: column(1),
            m: column(2),
            n: column(3),
            coefficient: column(4),
            hardness: column(5),
            dt: 0.37,
        };
        let at = |i: usize| {
            let x: [f64; 6] = std::array::from_fn(|c| row(if (mask >> c) & 1 == 0 { 7 } else { i })[c]);
            ([x[0], x[1]], Law { m: x[2], n: x[3], k: x[4], h: x[5], dt: 0.37 })
        };
        like_points(Best, &inputs, at, COUNT);
        if mask == 63 {
            like_points(Portable, &inputs, at, COUNT);
        }
    }
}

#[test]
#[should_panic(expected = "a column is shorter than the batch")]
fn a_short_column_is_a_fault_of_the_caller() {
    let law = super::power(1.5, 1.0);
    evaluate(Best, &law.inputs(&[1.0, 2.0], &[1.0]), 2);
}

#[test]
fn no_points_no_work() {
    let law = super::power(1.5, 1.0);
    assert_eq!(law.batch(Best, &[], &[]), (vec![], vec![]));
}
