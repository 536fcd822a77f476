//! Instances side by side, and one instance from several threads at once.
#![allow(unsafe_code)] // reason: a forked process gives the answers of an instance that is alone.

use std::io::{Read, Seek, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Barrier;
use std::time::{Duration, Instant};

use super::super::harness::call::{Answers, Asked, Call, Layout};
use super::super::harness::closeness::AtPoint;
use super::super::harness::points::Case;
use super::super::harness::sample::Sampler;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::super::slate::memory_file;
use super::bench::{Bench, Differences, POINTS, ask};
use wearlaw_law::LawDescriptor;

/// Cases with different constants, each answered with good values.
fn cases(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>, count: usize) -> Judged<Vec<Case>> {
    let known = bench.known_constants(law);
    let mut sampler = Sampler::new(&law.about, bench.task.seed, "threads, cases", &known);
    let mut cases: Vec<Case> = Vec::new();
    for _ in 0..4 * count {
        let Some(case) = sampler.good(instance, POINTS) else { break };
        let fresh = law.about.constants.is_empty() || cases.iter().all(|other| other.constants != case.constants);
        if fresh {
            cases.push(case);
        }
        if cases.len() == count {
            return Ok(cases);
        }
    }
    skip("the law refused most ordinary inputs that were tried")
}

fn layout(law: &LawDescriptor) -> Layout {
    Layout { asked: Asked::values(law), ..Layout::plain(law) }
}

/// What `work` gives in a process of its own, forked off before the library is loaded here; empty if it gives nothing.
///
/// It is left in a file: a pipe would stay open as long as a process that the law starts.
fn in_child(work: impl FnOnce() -> Vec<u8>) -> Vec<u8> {
    let mut file = match memory_file() {
        Ok(file) => file,
        Err(error) => panic!("no file in memory could be made: {error}"),
    };
    // SAFETY: this process has one thread here, so the child may do whatever the parent may.
    let child = unsafe { libc::fork() };
    if child == 0 {
        // A panic must not unwind into the parent's code.
        let bytes = catch_unwind(AssertUnwindSafe(work)).unwrap_or_default();
        let _ = file.write_all(&bytes);
        // SAFETY: ends the child at once; what it shares with the parent is left alone.
        unsafe { libc::_exit(0) };
    }
    // SAFETY: waits for the child made above; the status is not wanted.
    unsafe { libc::waitpid(child, std::ptr::null_mut(), 0) };
    let mut bytes = Vec::new();
    let read = file.rewind().and_then(|()| file.read_to_end(&mut bytes));
    if read.is_ok() { bytes } else { Vec::new() }
}

/// The increments that a fresh process gets for a case, before any other has been asked.
fn alone(bench: &Bench, case: &Case) -> Judged<Vec<f64>> {
    let bytes = in_child(|| {
        let answered = bench.with(|law, instance| Ok(ask(&law.about, instance, case, &layout(&law.about)).increment));
        answered.unwrap_or_default().iter().flat_map(|value| value.to_ne_bytes()).collect()
    });
    let (words, _) = bytes.as_chunks::<8>();
    if words.len() != case.count {
        return broken(Finding::new("an instance that is alone in a fresh process gives no answer"));
    }
    Ok(words.iter().map(|word| f64::from_ne_bytes(*word)).collect())
}

/// Two cases with different constants, found in a child too: a law that remembers would remember the search.
fn two_cases(bench: &Bench) -> Judged<[Case; 2]> {
    let text = in_child(|| match bench.with(|law, instance| cases(bench, law, instance, 2)) {
        Ok(cases) => serde_json::to_vec(&cases).unwrap_or_default(),
        Err(verdict) => serde_json::to_vec(&*verdict).unwrap_or_default(),
    });
    if let Ok(cases) = serde_json::from_slice::<[Case; 2]>(&text) {
        return Ok(cases);
    }
    match serde_json::from_slice::<Verdict>(&text) {
        Ok(verdict) => Err(Box::new(verdict)),
        Err(_) => broken(Finding::new("the process that looked for good inputs gives no answer")),
    }
}

/// Two instances with different constants, called in turn, against each alone in a process of its own.
pub(super) fn interleaved(bench: &Bench) -> Judged {
    let cases = two_cases(bench)?;
    let expected: Vec<Vec<f64>> = cases.iter().map(|case| alone(bench, case)).collect::<Judged<_>>()?;
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    let instances = [law.instance(&bench.task)?, law.instance(&bench.task)?];
    let mut differences = Differences::default();
    for turn in 0..12 {
        let at = turn % cases.len();
        let answers = ask(&law.about, &instances[at], &cases[at], &layout(&law.about));
        for (point, expected) in expected[at].iter().enumerate() {
            let [found, expected] = [answers.increment[point], *expected].map(AtPoint::of_increment);
            differences.note(expected.difference(&found), || {
                let what = "an instance answers otherwise when one with other constants is called in between: \
                            something is kept in a static variable, or in the instance";
                Finding::new(what).at(cases[at].named(&law.about, point))
            });
        }
    }
    differences.judge(&law.about)
}

/// Threads that call at once.
const THREADS: usize = 4;
/// Calls of each thread at least, unless time is up.
const ROUNDS: usize = 400;

/// One instance from several threads at once, against the answers from one.
pub(super) fn concurrent(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        if law.about.is_serial() {
            return skip("the law has the flag WL_FLAG_SERIAL");
        }
        // Enough points that calls overlap.
        let cases: Vec<Case> =
            cases(bench, law, instance, THREADS)?.into_iter().map(|case| case.repeated(64 * POINTS)).collect();
        let expected: Vec<Answers> =
            cases.iter().map(|case| ask(&law.about, instance, case, &layout(&law.about))).collect();
        let barrier = Barrier::new(THREADS);
        let end = Instant::now() + Duration::from_millis(800).min(bench.budget());
        let found: Vec<Differences> = std::thread::scope(|scope| {
            let threads: Vec<_> = cases
                .iter()
                .zip(&expected)
                .map(|(case, expected)| scope.spawn(|| hammer(law, instance, (case, expected), &barrier, end)))
                .collect();
            let join = |thread: std::thread::ScopedJoinHandle<'_, Differences>| {
                thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            };
            threads.into_iter().map(join).collect()
        });
        let mut verdict = Ok(Verdict::Pass(None));
        for differences in found {
            match differences.judge(&law.about) {
                Ok(Verdict::Pass(_)) => {}
                Ok(other) => verdict = Ok(other),
                Err(broken) => return Err(broken),
            }
        }
        verdict
    })
}

fn hammer(
    law: &Law<'_>,
    instance: &Instance<'_>,
    (case, expected): (&Case, &Answers),
    barrier: &Barrier,
    end: Instant,
) -> Differences {
    let mut differences = Differences::default();
    let mut call = Call::new(&law.about, case, &layout(&law.about));
    barrier.wait();
    for _ in 0..ROUNDS {
        let status = call.repeat(instance);
        let answers = call.read(status);
        if Instant::now() > end {
            break;
        }
        if answers == *expected {
            continue;
        }
        for point in 0..case.count {
            differences.note(expected.at(point).difference(&answers.at(point)), || {
                let what = "one instance answers otherwise when several threads call it at once: something is shared \
                            between calls (or declare WL_FLAG_SERIAL)";
                Finding::new(what).at(case.named(&law.about, point))
            });
        }
    }
    differences
}
