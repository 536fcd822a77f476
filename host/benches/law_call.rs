//! What it costs to call a law: loaded against inlined, everything the host does around a call against the memory's own
//! speed, general exponents against libm, and a process of its own against none.
//!
//! `cargo bench -p wearlaw --bench law_call [calls|memory|run|power|isolation ..]`; without `--bench` (as `cargo test
//! --benches` runs it) it only checks that all sides give the same numbers.

mod support;

use std::cell::{RefCell, RefMut};
use std::hint::black_box;

use support::raw::{Columns, RawLaw};
use support::timing::{Placed, Side, Times, columns, filled, in_turns, is_measured, pool, triad_on};
use support::{laws, scenes};
use wearlaw::law::{
    Batch, CallNumbers, Evaluation, Evaluator, Field, IsolateOptions, IsolatedLaw, LawDescriptor, LawInstance, Outputs,
    Source, Values,
};

/// Points from which on the memory decides.
const MANY: usize = 100_000;
const DT: f64 = 0.125;
const K: f64 = 1e-4;
const H: f64 = 2e9;

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wanted = |name: &str| named.is_empty() || named.iter().any(|one| one == name);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let library = laws::archard();
    let archard = laws::load(&library);
    if wanted("calls") {
        calls(&archard, &RawLaw::open(&library), [&laws::in_c(folder.path()), &laws::in_rust(folder.path())]);
    }
    if wanted("memory") {
        memory(&archard);
    }
    if wanted("run") {
        run(&archard, folder.path());
    }
    if wanted("power") {
        power(&archard);
    }
    if wanted("isolation") {
        isolation(&archard);
    }
}

/// The loop that everything is compared with, as a host would write it.
#[inline(always)]
fn inlined(constants: &[f64; 2], p: &[f64], v: &[f64], w: &mut [f64]) {
    let c = constants[0] / constants[1] * DT;
    let n = w.len();
    let (p, v) = (&p[..n], &v[..n]);
    #[allow(clippy::needless_range_loop)] // reason: making a zip is a call, as its code lies in another unit
    for i in 0..n {
        w[i] = c * p[i] * v[i];
    }
}

fn inlined_again(calls: usize, p: &[f64], v: &[f64], w: &mut [f64]) {
    let constants = [K, H];
    for _ in 0..calls {
        inlined(black_box(&constants), black_box(p), black_box(v), black_box(&mut *w));
    }
}

fn batch<'a>(law: &'a LawDescriptor, p: &'a [f64], v: &'a [f64], exponents: (f64, f64)) -> Batch<'a> {
    let all = [K, H, exponents.0, exponents.1];
    Batch::builder(law, p.len())
        .numbers(CallNumbers { dt: DT, ..CallNumbers::default() })
        .constants(&all[..law.constants.len()])
        .field(Field::Pressure, Values::PerPoint(p))
        .field(Field::Velocity, Values::PerPoint(v))
        .build()
        .expect("the columns fit the law")
}

fn evaluate(law: &dyn Evaluator, batch: &Batch<'_>, w: &mut [f64]) {
    let answer = law.evaluate(black_box(batch), &mut Outputs::new(black_box(w)));
    assert_eq!(answer, Ok(Evaluation::Good));
}

fn evaluate_again(calls: usize, law: &dyn Evaluator, batch: &Batch<'_>, w: &mut [f64]) {
    (0..calls).for_each(|_| evaluate(law, batch, w));
}

/// Loaded laws against the loop inlined.
fn calls(archard: &LawInstance, raw_archard: &RawLaw, [c_library, rust_library]: [&std::path::Path; 2]) {
    let (c, raw_c) = (laws::load(c_library), RawLaw::open(c_library));
    let (rust, raw_rust) = (laws::load(rust_library), RawLaw::open(rust_library));
    // A processor keeps one clock for seconds at a time: with so many rounds every side meets the faster one.
    let rounds: usize = if is_measured() { 2001 } else { 1 };
    println!(
        "\nlinear law, loaded against inlined: least ns per point of {rounds} rounds (ratio to inlined); medians from"
    );
    println!("1e5 points on, where what the memory's other users leave of the cache decides a single round");
    println!("raw: through the ABI's function; host: LawInstance::evaluate, with guard and checks");
    let names = ["inlined", "archard raw", "archard host", "C raw", "C host", "Rust point raw", "Rust point host"];
    println!("{:>8} {}", "points", names.map(|name| format!("{name:>17}")).join(" "));
    let sizes: &[usize] = if is_measured() { &[1, 8, 64, 1024, 4096, 1_000_000] } else { &[1, 8, 1025] };
    for &points in sizes {
        let mut place = Placed::new(&[points; 3]);
        let [p, v, answer] = filled(&mut place);
        let (p, v) = (&*p, &*v);
        // One array for all: two that lie differently to what is read can differ by a third in time.
        let w = RefCell::new(answer);
        let w = || RefMut::map(w.borrow_mut(), |w| &mut **w);
        let (mine, theirs) = ([K, H], [K, H, 1.0, 1.0]);
        let given = Columns { pressure: p, velocity: v, constants: &theirs, dt: DT };
        let short = Columns { pressure: p, velocity: v, constants: &mine, dt: DT };
        let batches = [archard, &c, &rust].map(|law| batch(law.descriptor(), p, v, (1.0, 1.0)));
        let mut sides: Vec<Side<'_>> = vec![
            Box::new(|calls| inlined_again(calls, p, v, &mut w())),
            Box::new(|calls| raw_archard.call(calls, &given, &mut w())),
            Box::new(|calls| evaluate_again(calls, archard, &batches[0], &mut w())),
            Box::new(|calls| raw_c.call(calls, &short, &mut w())),
            Box::new(|calls| evaluate_again(calls, &c, &batches[1], &mut w())),
            Box::new(|calls| raw_rust.call(calls, &short, &mut w())),
            Box::new(|calls| evaluate_again(calls, &rust, &batches[2], &mut w())),
        ];
        let effort = if points < 64 { 20_000 * points } else { 1 << 19 };
        let rounds = if points > MANY { (rounds * MANY / 2).div_ceil(points) } else { rounds };
        // Several calls in a row: a side that writes past the caches leaves the next one without its answers there.
        let times = in_turns(rounds, if is_measured() { (effort / points).max(8) } else { 1 }, &mut sides);
        let time = |t: &Times| if points > MANY { t.median() } else { t.least() };
        let base = time(&times[0]);
        let cell = |t: &Times| format!("{:>8.3} ({:>6.3})", time(t) * 1e9 / points as f64, time(t) / base);
        let row: Vec<String> = times.iter().map(cell).collect();
        println!("{points:>8} {}", row.join(" "));
        if points == 1 {
            let more: Vec<String> = times.iter().map(|t| format!("{:>17.1}", (time(t) - base) * 1e9)).collect();
            println!("{:>8} {}", "more, ns", more.join(" "));
        }
        let mut first = Vec::new();
        for (side, name) in sides.iter_mut().zip(names) {
            w().fill(f64::NAN);
            side(1);
            if first.is_empty() {
                first = w().to_vec();
            }
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-15 * a.abs();
            assert!(first.iter().zip(w().iter()).all(near), "{name} differs");
        }
    }
}

/// Everything around a call against the triad.
fn memory(archard: &LawInstance) {
    let (sizes, rounds): (&[usize], usize) =
        if is_measured() { (&[1_000_000, 20_000_000], 41) } else { (&[10_000], 1) };
    println!("\nlinear archard through LawInstance::evaluate against a triad of the same arrays, 24 B per point");
    println!(
        "{:>9} {:>7} {:>12} {:>12} {:>18} {:>18}",
        "points", "threads", "triad, GB/s", "law, GB/s", "triad/law (least)", "triad/law (median)"
    );
    for &points in sizes {
        let (p, v) = columns(points);
        // One array for both: two that lie differently to what is read can differ by a third in time.
        let answer = RefCell::new(vec![0.0; points]);
        let batch = batch(archard.descriptor(), &p, &v, (1.0, 1.0));
        for threads in [1, 2] {
            let pool = pool(threads);
            let part = points.div_ceil(threads);
            let rounds = if points < 5_000_000 { 5 * rounds } else { rounds };
            let mut sides: Vec<Side<'_>> = vec![
                Box::new(|calls| {
                    (0..calls).for_each(|_| triad_on(&pool, &mut answer.borrow_mut(), &p, &v, black_box(3.0)))
                }),
                Box::new(|calls| {
                    let answer = &mut *answer.borrow_mut();
                    for _ in 0..calls {
                        pool.scope(|scope| {
                            for (k, w) in answer.chunks_mut(part).enumerate() {
                                let batch = batch.range(k * part..k * part + w.len());
                                scope.spawn(move |_| evaluate(archard, &batch, w));
                            }
                        });
                    }
                }),
            ];
            let times = in_turns(rounds, 1, &mut sides);
            drop(sides);
            let speed = |t: &Times| 24.0 * points as f64 / t.least() * 1e-9;
            println!(
                "{points:>9} {threads:>7} {:>12.2} {:>12.2} {:>18.3} {:>18.3}",
                speed(&times[0]),
                speed(&times[1]),
                times[0].least() / times[1].least(),
                times[0].median() / times[1].median()
            );
        }
    }
}

/// Whole pieces of a run against the triad.
fn run(archard: &LawInstance, folder: &std::path::Path) {
    let (sizes, steps): (&[usize], usize) = if is_measured() { (&[1_000_000, 20_000_000], 31) } else { (&[20_000], 2) };
    println!(
        "\na substep of solve::Run on a history of one time (linear archard) against a triad on the same threads. Of a"
    );
    println!(
        "point it moves 48 B: pressure and velocity in, depth and sliding distance in and out; a triad moves 32 B, as"
    );
    println!("it reads what it overwrites. Bandwidth: bytes moved a second, as a part of the triad's.");
    println!(
        "{:>9} {:>7} {:>10} {:>10} {:>20} {:>20} {:>18} {:>11}",
        "points",
        "threads",
        "triad, ms",
        "step, ms",
        "triad/step (least)",
        "triad/step (median)",
        "bandwidth (least)",
        "law's part"
    );
    for &points in sizes {
        let steps = if points < 5_000_000 { 5 * steps } else { steps };
        let file = scenes::one_time_history(folder, points);
        let plan = scenes::one_time_plan(&file, steps, archard.descriptor());
        for threads in [1, 2] {
            let row = scenes::substeps_against_triad(&plan, archard, threads, points);
            println!(
                "{points:>9} {threads:>7} {:>10.3} {:>10.3} {:>20.3} {:>20.3} {:>18.3} {:>10.0}%",
                row.triad.least() * 1e3,
                row.step.least() * 1e3,
                row.triad.least() / row.step.least(),
                row.triad.median() / row.step.median(),
                1.5 * row.triad.least() / row.step.least(),
                100.0 * row.law_share
            );
        }
        std::fs::remove_file(file).expect("a file that this program wrote");
    }
}

/// General exponents against two `pow` a point.
fn power(archard: &LawInstance) {
    let points = 1024;
    let (p, v) = columns(points);
    let (mut plain, mut w) = (vec![0.0; points], vec![0.0; points]);
    let batch = batch(archard.descriptor(), &p, &v, (1.5, 0.8));
    let (rounds, calls) = if is_measured() { (201, 200) } else { (1, 1) };
    let mut sides: Vec<Side<'_>> = vec![
        Box::new(|calls| {
            for _ in 0..calls {
                let (m, n, c) = (black_box(1.5), black_box(0.8), black_box(K / H * DT));
                for (w, (p, v)) in plain.iter_mut().zip(p.iter().zip(&v)) {
                    *w = c * p.powf(m) * v.powf(n);
                }
                black_box(&mut plain);
            }
        }),
        Box::new(|calls| (0..calls).for_each(|_| evaluate(archard, &batch, &mut w))),
    ];
    let times = in_turns(rounds, calls, &mut sides);
    drop(sides);
    let [libm, law] = [0, 1].map(|k: usize| times[k].least() * 1e9 / points as f64);
    println!("\nm = 1.5, n = 0.8 at {points} points, ns per point: two libm pow {libm:.2}, archard through");
    println!("LawInstance::evaluate {law:.2}: {:.2} times as fast", libm / law);
    assert!(plain.iter().zip(&w).all(|(a, b)| (a - b).abs() <= 1e-14 * a.abs()));
}

/// A law in a process of its own against the same law here.
fn isolation(archard: &LawInstance) {
    let options = IsolateOptions {
        program: Some(env!("CARGO_BIN_EXE_wearlaw").into()),
        ..IsolateOptions::new(Source::File(laws::archard()))
    };
    let there = IsolatedLaw::open(&options).expect("the law is well formed");
    println!("\na law in a process of its own (linear archard), least and median time of a call");
    println!(
        "{:>9} {:>14} {:>14} {:>15} {:>15} {:>9} {:>9}",
        "points", "here, us", "there, us", "here, med. us", "there, med. us", "more", "more med."
    );
    for points in [1, 1024, 1_000_000] {
        if points > 2000 && !is_measured() {
            continue;
        }
        let (p, v) = columns(points);
        let [mut a, mut b] = [0, 1].map(|_| vec![0.0; points]);
        let batches = [archard as &dyn Evaluator, &there].map(|law| batch(law.descriptor(), &p, &v, (1.0, 1.0)));
        let mut sides: Vec<Side<'_>> = vec![
            Box::new(|calls| (0..calls).for_each(|_| evaluate(archard, &batches[0], &mut a))),
            Box::new(|calls| (0..calls).for_each(|_| evaluate(&there, &batches[1], &mut b))),
        ];
        let times = match is_measured() {
            true => in_turns(101, if points > 2000 { 1 } else { 500 }, &mut sides),
            false => in_turns(1, 1, &mut sides),
        };
        drop(sides);
        let (least, median) = ([0, 1].map(|k: usize| times[k].least()), [0, 1].map(|k: usize| times[k].median()));
        println!(
            "{points:>9} {:>14.3} {:>14.3} {:>15.3} {:>15.3} {:>8.1}% {:>8.1}%",
            least[0] * 1e6,
            least[1] * 1e6,
            median[0] * 1e6,
            median[1] * 1e6,
            100.0 * (least[1] / least[0] - 1.0),
            100.0 * (median[1] / median[0] - 1.0)
        );
        assert!(a == b, "the same bits there and here");
    }
}
