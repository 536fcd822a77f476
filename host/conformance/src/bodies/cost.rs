//! Time per point: told, and a warning where subnormal numbers make the law crawl.

use std::time::{Duration, Instant};

use super::super::harness::call::{Asked, Call, Given, Layout};
use super::super::harness::points::Case;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS};
use wearlaw_law::Field;

/// Batch sizes that are told.
const SIZES: [usize; 4] = [1, 64, 1024, 1_000_000];
/// Time for each of them.
const TIME: Duration = Duration::from_millis(60);
/// Times as slow that subnormal numbers may be before it is worth a word.
const SLOW: f64 = 10.0;

/// As a host calls a law that is a rate: the increment, and the state if there is one.
fn layout(law: &Law<'_>) -> Layout {
    let asked = Asked { state: !law.about.state.is_empty(), ..Asked::NOTHING };
    Layout { asked, given: Given::Declared, ..Layout::plain(&law.about) }
}

/// Good points with ordinary constants: those of a table of known values may be made to be difficult.
fn ordinary(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>) -> Judged<Case> {
    match bench.sampler(law, &[]).good(instance, POINTS) {
        Some(case) => Ok(case),
        None => bench.good(law, instance, POINTS),
    }
}

/// Nanoseconds per point, the best of several calls.
fn measured(law: &Law<'_>, instance: &Instance<'_>, case: &Case) -> f64 {
    let mut call = Call::new(&law.about, case, &layout(law));
    call.evaluate(instance);
    // Enough calls between two looks at the clock that the clock does not count.
    let round = (2048 / case.count).max(1);
    let end = Instant::now() + TIME;
    let mut best = f64::INFINITY;
    loop {
        let start = Instant::now();
        for _ in 0..round {
            call.repeat(instance);
        }
        let time = start.elapsed();
        best = best.min(time.as_nanos() as f64 / (round * case.count) as f64);
        if Instant::now() > end {
            return best;
        }
    }
}

fn nanoseconds(time: f64) -> String {
    if time < 10.0 { format!("{time:.2} ns") } else { format!("{time:.0} ns") }
}

/// Time per point by batch size.
pub(super) fn per_point(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = ordinary(bench, law, instance)?;
        let mut words = Vec::new();
        let mut last = 0.0;
        for size in SIZES {
            bench.label(&format!("batches of {size} points, for their time"));
            if last * 1e-9 * size as f64 > 0.25 * bench.budget().as_secs_f64() {
                words.push(format!("not measured at n = {size}, which would take {:.0} s", last * 1e-9 * size as f64));
                continue;
            }
            last = measured(law, instance, &case.repeated(size));
            words.push(format!("{} at n = {size}", nanoseconds(last)));
        }
        Ok(Verdict::Pass(Some(format!("per point {}", words.join(", ")))))
    })
}

/// Time per point with subnormal pressures, slips and products.
pub(super) fn subnormals(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = ordinary(bench, law, instance)?;
        let usual = measured(law, instance, &case.repeated(1024));
        let sets: [&[Field]; 3] = [
            &[Field::Pressure, Field::NodalTraction, Field::FrictionWork],
            &[Field::Slip, Field::Velocity],
            &[Field::Pressure, Field::Slip, Field::Velocity, Field::FrictionWork, Field::NodalTraction],
        ];
        let mut worst: Option<(f64, Case)> = None;
        for fields in sets {
            // The product of two small numbers is subnormal too.
            let size = if fields.len() > 3 { 1e-155 } else { 1e-310 };
            let small = case.map(|point| {
                fields.iter().for_each(|field| {
                    let scaled = if point.scalar(*field) == 0.0 { 0.0 } else { size };
                    point.set(*field, 0, scaled);
                });
            });
            let answers = super::bench::ask(&law.about, instance, &small, &layout(law));
            if !answers.is_good() {
                continue;
            }
            let time = measured(law, instance, &small.repeated(1024));
            if worst.as_ref().is_none_or(|(most, _)| time > *most) {
                worst = Some((time, small));
            }
        }
        let Some((time, small)) = worst else { return skip("the law refuses subnormal inputs") };
        let ratio = time / usual;
        let words = format!("{} per point, {} with ordinary numbers", nanoseconds(time), nanoseconds(usual));
        if ratio > SLOW {
            let finding = Finding::new(format!("subnormal inputs take {ratio:.0} times as long"));
            let finding = finding.with(words, format!("at most {SLOW} times as long")).at(small.named(&law.about, 0));
            return Ok(Verdict::Warn(finding));
        }
        Ok(Verdict::Pass(Some(words)))
    })
}
