//! The half-space contact: cold solves, each in a process of its own so that its peak of memory is its own.
//!
//! `cargo bench -p wearlaw --bench halfspace`; without `--bench` only the small cases run. Further words pick cases by
//! what their line begins with: `-- rough` or `-- "hertz free 1024"`. The sphere of `hertz` is solved on a quarter of the
//! cells, that of `whole` on all of them.

mod support;

use std::f64::consts::PI;
use std::process::Command;
use std::time::Instant;

use support::processor::{peak_megabytes, seconds};
use wearlaw::contact::halfspace::{Boundary, HalfSpace};
use wearlaw::contact::{Cells, ContactModel, Control, Diagonal, Instructions, Problem};
use wearlaw_transforms::{Complex, FftDirection, complex};

const MODULUS: f64 = 110e9;
const TOLERANCE: f64 = 1e-8;
/// Shape, boundary, cells along a side, threads.
type Case = (&'static str, &'static str, usize, usize);

const SMALL: [Case; 3] = [("hertz", "periodic", 64, 1), ("hertz", "free", 64, 1), ("rough", "periodic", 64, 1)];
const MEASURED: [Case; 26] = [
    ("hertz", "periodic", 256, 1),
    ("hertz", "periodic", 512, 1),
    ("hertz", "periodic", 1024, 1),
    ("hertz", "periodic", 2048, 1),
    ("hertz", "free", 256, 1),
    ("hertz", "free", 512, 1),
    ("hertz", "free", 1024, 1),
    ("hertz", "free", 2048, 1),
    ("hertz", "free", 4096, 1),
    ("whole", "periodic", 512, 1),
    ("whole", "periodic", 1024, 1),
    ("whole", "free", 512, 1),
    ("whole", "free", 1024, 1),
    ("rough", "periodic", 256, 1),
    ("rough", "periodic", 512, 1),
    ("rough", "periodic", 1024, 1),
    ("rough", "periodic", 2048, 1),
    ("rough", "periodic", 1024, 2),
    ("rough", "periodic", 2048, 2),
    ("rough", "free", 256, 1),
    ("rough", "free", 512, 1),
    ("rough", "free", 1024, 1),
    ("rough", "free", 1024, 2),
    ("rough", "free", 2048, 1),
    ("rough", "free", 4096, 1),
    ("rough", "free", 4096, 2),
];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    if let [word, shape, boundary, n, threads] = &words[..]
        && word == "one"
    {
        one(shape, boundary, n.parse().expect("a number"), threads.parse().expect("a number"));
        return;
    }
    println!(
        "{:>24} {:>7} {:>10} {:>9} {:>10} {:>9} {:>9} {:>9} {:>9}",
        "case, n", "threads", "iterations", "FFT pairs", "error", "first, s", "cpu, s", "wall, s", "peak, MB"
    );
    let measured = std::env::args().any(|argument| argument == "--bench");
    let cases: &[Case] = if measured { &MEASURED } else { &SMALL };
    for (shape, boundary, n, threads) in cases {
        let name = format!("{shape} {boundary} {n}");
        if !words.is_empty() && !words.iter().any(|word| name.starts_with(word)) {
            continue;
        }
        let program = std::env::current_exe().expect("the path of this program");
        let arguments = ["one", shape, boundary, &n.to_string(), &threads.to_string()];
        let status = Command::new(program).args(arguments).status().expect("this program starts");
        assert!(status.success(), "{name} failed");
    }
}

/// Runs one case and prints its line.
fn one(shape: &str, boundary: &str, n: usize, threads: usize) {
    let (size, gap, load) = if shape == "rough" { rough(n) } else { hertz(n) };
    let mean = gap.iter().sum::<f64>() / gap.len() as f64;
    let scale = (gap.iter().map(|gap| (gap - mean).powi(2)).sum::<f64>() / gap.len() as f64).sqrt();
    let cells = Cells { dimension: 3, counts: [n, n], spacing: [size / n as f64; 2] };
    let problem = Problem {
        gap: &gap,
        diagonal: Diagonal::Zero,
        smoothed: false,
        control: Control::Load(load),
        tolerance: TOLERANCE,
        scale,
        frozen: None,
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let kind = if boundary == "free" { Boundary::Free } else { Boundary::Periodic };
        let mut model = HalfSpace::new(cells, MODULUS, kind, None, threads);
        if shape == "whole" {
            model = model.without_mirrors();
        }
        let mut pressure = vec![0.0; n * n];
        let (mut times, mut walls, mut solution) = (Vec::new(), Vec::new(), None);
        let repeats = if n > 2048 { 2 } else { 4 };
        for _ in 0..repeats {
            pressure.fill(0.0);
            let (begin, clock) = (seconds(), Instant::now());
            solution = Some(model.solve(&problem, &mut pressure).expect("it converges"));
            times.push(seconds() - begin);
            walls.push(clock.elapsed().as_secs_f64());
        }
        let (first, solution) = (times[0], solution.expect("it was solved"));
        for times in [&mut times, &mut walls] {
            times.remove(0);
            times.sort_by(f64::total_cmp);
        }
        println!(
            "{:>24} {threads:>7} {:>10} {:>9} {:>10.1e} {first:>9.3} {:>9.3} {:>9.3} {:>9.0}",
            format!("{shape} {boundary} {n}"),
            solution.iterations,
            solution.fft_pairs,
            solution.error,
            times[times.len() / 2],
            walls[walls.len() / 2],
            peak_megabytes(),
        );
    });
}

/// A sphere of R = 10 mm under 20 N on a square of 10 Hertz radii: its side, gap and load.
fn hertz(n: usize) -> (f64, Vec<f64>, f64) {
    let (radius, load) = (10e-3, 20.0);
    let size = 10.0 * (3.0_f64 * load * radius / (4.0 * MODULUS)).cbrt();
    let at = |i: usize| (i as f64 - (n / 2) as f64) * size / n as f64;
    let gap = (0..n * n).map(|cell| (at(cell % n).powi(2) + at(cell / n).powi(2)) / (2.0 * radius)).collect();
    (size, gap, load)
}

/// A self-affine surface: Hurst exponent 0.8, roll-off at 4 waves, cut-off at n/8, rms slope 0.1, on a square of 1 mm;
/// its side, gap and a load of 0.004 E* on average.
fn rough(n: usize) -> (f64, Vec<f64>, f64) {
    let size = 1e-3;
    let mut state = 1234_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let wave = |k: usize| if k > n / 2 { k as f64 - n as f64 } else { k as f64 };
    let mut field = vec![Complex::new(0.0, 0.0); n * n];
    let mut slopes = 0.0;
    for (cell, value) in field.iter_mut().enumerate() {
        let q = wave(cell % n).hypot(wave(cell / n));
        if (1.0..=n as f64 / 8.0).contains(&q) {
            let amplitude = q.max(4.0).powf(-1.8);
            *value = Complex::from_polar(amplitude, 2.0 * PI * random());
            slopes += 0.5 * (amplitude * 2.0 * PI * q / size).powi(2);
        }
    }
    let plan = complex(Instructions::in_use(), n, FftDirection::Inverse);
    for _ in 0..2 {
        plan.process(&mut field);
        for y in 0..n {
            for x in 0..y {
                field.swap(y * n + x, x * n + y);
            }
        }
    }
    // The real part has half of the power of the complex field.
    let gap = field.iter().map(|value| -value.re * 0.1 / slopes.sqrt()).collect();
    (size, gap, 0.004 * MODULUS * size * size)
}
