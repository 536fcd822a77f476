//! Time per point of the power kernel and of two libm `powf`, interleaved in one process.
//!
//! `cargo bench -p wearlaw-archard --bench power`; without `--bench` (as `cargo test` runs it) it
//! only checks that both agree. `slope` asks for the derivative too, `varying` gives K, H, m and n
//! point by point.

use std::hint::black_box;
use std::time::Instant;

use wearlaw_archard::power::{Column, Inputs, increments};

/// Points of the batch that fits the first-level cache.
const POINTS: usize = 1024;

/// A repeatable sequence of numbers in 0..1 (SplitMix64).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Nanoseconds per point of one call after the other, `calls` times.
fn time(calls: usize, points: usize, mut work: impl FnMut()) -> f64 {
    let start = Instant::now();
    for _ in 0..calls {
        work();
    }
    start.elapsed().as_nanos() as f64 / (calls * points) as f64
}

fn main() {
    let measured = std::env::args().any(|a| a == "--bench");
    let (rounds, effort) = if measured { (101, 200_000) } else { (1, 1_000) };
    println!("ns per point, medians of {rounds} interleaved rounds; (K/H) p^m v^n dt");
    println!("{:>7} {:>6} {:>6} {:>8} {:>8} {:>8} {:>7}", "points", "m", "n", "what", "libm", "kernel", "ratio");
    for points in [1, 3, 8, 64, POINTS, 1_000_000] {
        if !measured && points > POINTS {
            continue;
        }
        let all: &[(f64, f64, &str)] = if points == POINTS {
            &[
                (1.5, 0.8, "power"),
                (1.5, 0.8, "slope"),
                (1.5, 0.8, "varying"),
                (1.5, 1.0, "power"),
                (1.0, 0.8, "power"),
                (1.0, 1.0, "power"),
            ]
        } else {
            &[(1.5, 0.8, "power")]
        };
        for &(m, n, what) in all {
            row(points, m, n, what, rounds, effort);
        }
    }
}

/// Constants of one point each, or one for all.
fn column(values: &[f64], each: bool) -> Column<'_> {
    if each { Column::each(values) } else { Column::uniform(&values[0]) }
}

fn row(points: usize, m: f64, n: f64, what: &str, rounds: usize, effort: usize) {
    let mut r = Sequence(7);
    let p: Vec<f64> = (0..points).map(|_| 10f64.powf(18.0 * r.next() - 6.0)).collect();
    let v: Vec<f64> = (0..points).map(|_| 10f64.powf(12.0 * r.next() - 9.0)).collect();
    let (k, h, dt) = (1e-4, 2e9, 0.1);
    let [ms, ns, ks, hs] = [m, n, k, h].map(|x| vec![x; points]);
    let mut plain = vec![0.0; points];
    let mut out = vec![0.0; points];
    let mut slope = vec![0.0; points];
    let calls = (effort / points).max(1);
    let each = what == "varying";
    let (mut libm, mut kernel) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        libm.push(time(calls, points, || {
            let (m, n, c) = (black_box(m), black_box(n), black_box(k / h * dt));
            for (w, (p, v)) in plain.iter_mut().zip(p.iter().zip(&v)) {
                *w = c * p.powf(m) * v.powf(n);
            }
            black_box(&mut plain);
        }));
        kernel.push(time(calls, points, || {
            let inputs = Inputs {
                pressure: Column::each(&p),
                velocity: Column::each(&v),
                m: column(&ms, each),
                n: column(&ns, each),
                coefficient: column(&ks, each),
                hardness: column(&hs, each),
                dt,
            };
            increments(&inputs, &mut out, (what == "slope").then_some(&mut slope[..]));
            black_box((&mut out, &mut slope));
        }));
    }
    for (a, b) in plain.iter().zip(&out) {
        assert!((a - b).abs() <= 1e-14 * a.abs(), "libm {a:e}, kernel {b:e}");
    }
    let mut ratio: Vec<f64> = libm.iter().zip(&kernel).map(|(a, b)| a / b).collect();
    let (libm, kernel, ratio) = (median(&mut libm), median(&mut kernel), median(&mut ratio));
    println!("{points:>7} {m:>6} {n:>6} {what:>8} {libm:>8.2} {kernel:>8.2} {:>7.2}", ratio);
}
