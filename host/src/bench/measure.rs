//! Times calls of laws, in turns: here and in a process of their own, on one thread and on several, beside a triad.

use std::cell::RefCell;
use std::hint::black_box;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use rayon::ThreadPool;

use super::laid::Laid;
use super::opened::Opened;
use super::placed::Placed;
use super::timing::{Side, TRIAD_BYTES, Times, in_turns_until, pool, seconds, triad_on};
use super::{BenchError, BenchOptions, Memory, Speed};
use crate::law::{Batch, EvaluateError, Evaluation, Evaluator, Fields, Outputs};

/// Wall time of the calls of one side in one round, s, where a call is shorter: long beside the clock's own.
const BLOCK: f64 = 1e-3;
/// Rounds that make a median, and more than anybody needs.
const ROUNDS: (usize, usize) = (3, 1001);
/// Most points of laws that take turns with each other; larger arrays are made for one law after the other.
const TOGETHER: usize = 100_000;
/// Fewest points for a thread: handing out fewer takes longer than working on them.
const SHARED: usize = 512;

/// Times every law at every number of points.
///
/// # Errors
/// No threads, a fault of this module, or the wish to stop.
pub(super) fn all(
    laws: &mut [Opened],
    options: &BenchOptions,
    on: &mut dyn FnMut(&str),
    stop: &AtomicBool,
) -> Result<(), BenchError> {
    let mut pools = Vec::new();
    for &threads in &options.threads {
        pools.push(pool(threads).map_err(|error| BenchError::Threads { threads, reason: error.to_string() })?);
    }
    let largest = options.points.last().copied().unwrap_or_default();
    let together = |points: usize| if points <= TOGETHER { laws.len().max(1) } else { 1 };
    let groups: Vec<usize> = options.points.iter().map(|&points| laws.len().div_ceil(together(points))).collect();
    let sizes: Vec<usize> = options.points.iter().map(|&points| together(points)).collect();
    let mut left: usize = groups.iter().sum();
    let until = Instant::now() + options.budget;
    for (&points, size) in options.points.iter().zip(sizes) {
        for group in laws.chunks_mut(size) {
            let names: Vec<&str> = group.iter().map(|law| law.report.name.as_str()).collect();
            on(&format!("{points} points, {}", names.join(", ")));
            let share =
                until.saturating_duration_since(Instant::now()) / u32::try_from(left).unwrap_or(u32::MAX).max(1);
            left -= 1;
            let mut able: Vec<&mut Opened> = group.iter_mut().filter_map(|law| able(law, points, options)).collect();
            let setting = Setting { pools: &pools, points, with_triad: points == largest, share, stop };
            time(&mut able, &setting)?;
            if stop.load(Ordering::Relaxed) {
                return Err(BenchError::Interrupted);
            }
        }
    }
    Ok(())
}

/// The law, if it has not failed and is quick enough for so many points.
fn able<'o>(law: &'o mut Opened, points: usize, options: &BenchOptions) -> Option<&'o mut Opened> {
    if law.report.failure.is_some() || law.case.is_none() {
        return None;
    }
    // As long for a point as here with fewer of them, where a call and another process cost more.
    let fewest = options.threads.first();
    let alone = law.report.speeds.iter().rev().find(|speed| !speed.isolated && fewest == Some(&speed.threads));
    let call = 1e-9 * points as f64 * alone.map_or(0.0, |speed| speed.least_ns);
    let ways = 2 * options.threads.len();
    let budget = options.budget.as_secs_f64();
    if (ROUNDS.0 * ways) as f64 * call <= budget {
        return Some(law);
    }
    let note = format!("{points} points left out: a call would take about {call:.2} s, and the budget is {budget} s");
    law.report.notes.push(note);
    None
}

/// How one number of points is timed.
struct Setting<'s> {
    pools: &'s [ThreadPool],
    points: usize,
    with_triad: bool,
    share: Duration,
    stop: &'s AtomicBool,
}

/// What a side is.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Here,
    There,
    Triad,
}

/// A side: which law, on how many threads, and what.
#[derive(Clone, Copy, PartialEq)]
struct Label {
    law: usize,
    threads: usize,
    kind: Kind,
}

/// Times the laws of a group, all in turns.
fn time(laws: &mut Vec<&mut Opened>, setting: &Setting<'_>) -> Result<(), BenchError> {
    let points = setting.points;
    let mut laid = Vec::new();
    for law in laws.iter_mut() {
        let Some(case) = &law.case else { continue };
        let mut arrays = Laid::new(law.here.descriptor(), case, points, Fields::EMPTY, false);
        // What fails does so in a process of its own, if there is one.
        law.report.failure = match arrays.ask(law.safest()) {
            Ok((Evaluation::CutStep { .. }, _)) => Some(BenchError::CutStep { law: law.report.name.clone(), points }),
            Ok((Evaluation::Unreliable { text, .. }, _)) => {
                let note = format!("the law says that answers are unreliable: {text}");
                if !law.report.notes.contains(&note) {
                    law.report.notes.push(note);
                }
                None
            }
            Ok((Evaluation::Good, _)) => None,
            Err(error) => Some(error.into()),
        };
        laid.push(arrays);
    }
    let good: Vec<bool> = laws.iter().map(|law| law.report.failure.is_none()).collect();
    let mut kept = good.iter();
    laid.retain(|_| kept.next() == Some(&true));
    let mut kept = good.iter();
    laws.retain(|_| kept.next() == Some(&true));
    if laws.is_empty() {
        return Ok(());
    }
    let (times, lost) = timed(laws, &mut laid, setting)?;
    for (at, (law, lost)) in laws.iter_mut().zip(lost).enumerate() {
        match lost.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => law.report.failure = Some(error.into()),
            None => law.report.speeds.extend(speeds(at, law.report.bytes_per_point, points, &times)),
        }
        for text in law.here.take_warnings() {
            law.report.notes.push(text);
        }
    }
    Ok(())
}

/// The times of every side.
type Timed = Vec<(Label, Times)>;

/// Why a law failed while it was timed.
type Lost = Mutex<Option<EvaluateError>>;

fn timed(laws: &[&mut Opened], laid: &mut [Laid], setting: &Setting<'_>) -> Result<(Timed, Vec<Lost>), BenchError> {
    let points = setting.points;
    let lost: Vec<Lost> = laws.iter().map(|_| Mutex::default()).collect();
    let mut triads: Vec<Placed> = match setting.with_triad {
        true => laws.iter().map(|law| Placed::new(&[triad_points(law.report.bytes_per_point, points); 3])).collect(),
        false => Vec::new(),
    };
    let mut arrays = Vec::new();
    for triad in &mut triads {
        let mut columns = triad.columns();
        columns.iter_mut().for_each(|column| column.fill(1.0));
        arrays.push(RefCell::new(columns));
    }
    let mut calls = Vec::new();
    for (law, laid) in laws.iter().zip(laid.iter_mut()) {
        let (batch, outputs) = laid.parts(law.here.descriptor())?;
        // One array for all: two that lie differently to what is read can differ by a third in time.
        calls.push((batch, RefCell::new(outputs)));
    }
    let mut labels = Vec::new();
    let mut sides: Vec<Side<'_>> = Vec::new();
    for (at, law) in laws.iter().enumerate() {
        for pool in setting.pools.iter().filter(|pool| pool.current_num_threads() * SHARED <= points || is_one(pool)) {
            let threads = pool.current_num_threads();
            let ((batch, outputs), lost) = (&calls[at], &lost[at]);
            let there = law.there.as_ref().map(|law| (Kind::There, law as &dyn Evaluator));
            for (kind, law) in std::iter::once((Kind::Here, &law.here as &dyn Evaluator)).chain(there) {
                labels.push(Label { law: at, threads, kind });
                sides.push(Box::new(move |calls| call(calls, pool, law, batch, &mut outputs.borrow_mut(), lost)));
            }
            if let Some(columns) = arrays.get(at) {
                labels.push(Label { law: at, threads, kind: Kind::Triad });
                sides.push(Box::new(move |calls| {
                    let mut columns = columns.borrow_mut();
                    let [a, b, c] = &mut columns[..] else { return };
                    (0..calls).for_each(|_| triad_on(pool, a, b, c, black_box(3.0)));
                }));
            }
        }
    }
    let begin = Instant::now();
    let block = BLOCK.min(setting.share.as_secs_f64() / (4 * sides.len()) as f64);
    let counts: Vec<usize> = sides.iter_mut().map(|side| calls_in(block, side)).collect();
    let enough = |done: usize| {
        let late = done >= ROUNDS.0 && begin.elapsed() >= setting.share;
        late || done == ROUNDS.1 || setting.stop.load(Ordering::Relaxed)
    };
    let times = in_turns_until(&counts, &mut sides, enough);
    drop(sides);
    drop(calls);
    Ok((labels.into_iter().zip(times).collect(), lost))
}

fn is_one(pool: &ThreadPool) -> bool {
    pool.current_num_threads() == 1
}

/// Points of a triad that moves as many bytes as a call.
fn triad_points(bytes_per_point: usize, points: usize) -> usize {
    (points * bytes_per_point / TRIAD_BYTES).max(1)
}

/// Calls of a side that take as long as a block, at least one.
fn calls_in(block: f64, side: &mut Side<'_>) -> usize {
    let one = seconds(1, side);
    // The first call may have met cold caches.
    let one = if one < block { seconds(1, side).min(one) } else { one };
    ((block / one.max(1e-9)) as usize).clamp(1, 1 << 20)
}

/// Calls a law, each time with the points shared by the threads of a pool; nothing more once it has failed.
fn call(
    calls: usize,
    pool: &ThreadPool,
    law: &dyn Evaluator,
    batch: &Batch<'_>,
    outputs: &mut Outputs<'_>,
    lost: &Lost,
) {
    let keep = |error: EvaluateError| {
        lost.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    };
    let has_failed = || lost.lock().unwrap_or_else(PoisonError::into_inner).is_some();
    let evaluate = |batch: &Batch<'_>, mut outputs: Outputs<'_>| {
        if let Err(error) = law.evaluate(black_box(batch), black_box(&mut outputs)) {
            keep(error);
        }
    };
    if has_failed() {
        return;
    }
    let threads = pool.current_num_threads();
    if threads == 1 {
        (0..calls).for_each(|_| evaluate(batch, outputs.reborrow()));
        return;
    }
    let (points, variables) = (batch.points(), law.descriptor().state.len());
    let part = points.div_ceil(threads);
    for _ in 0..calls {
        pool.scope(|scope| {
            let mut rest = outputs.reborrow();
            for start in (0..points).step_by(part) {
                let range = start..points.min(start + part);
                let (mine, others) = rest.split_at(range.len(), variables);
                rest = others;
                let (part, evaluate) = (batch.range(range), &evaluate);
                scope.spawn(move |_| evaluate(&part, mine));
            }
        });
    }
}

/// The speeds of one law of a group.
fn speeds(law: usize, bytes_per_point: usize, points: usize, times: &[(Label, Times)]) -> Vec<Speed> {
    let mut speeds = Vec::new();
    for (label, own) in times.iter().filter(|(label, _)| label.law == law && label.kind != Kind::Triad) {
        let triad = times.iter().find(|(other, _)| *other == Label { kind: Kind::Triad, ..*label });
        let memory = triad.map(|(_, triad)| {
            let bytes = TRIAD_BYTES * triad_points(bytes_per_point, points);
            Memory { bytes, triad_gb_per_s: 1e-9 * bytes as f64 / triad.least(), part: triad.least() / own.least() }
        });
        let per_point = 1e9 / points as f64;
        speeds.push(Speed {
            points,
            threads: label.threads,
            isolated: label.kind == Kind::There,
            least_ns: own.least() * per_point,
            median_ns: own.median() * per_point,
            rounds: own.rounds(),
            memory,
        });
    }
    speeds
}
