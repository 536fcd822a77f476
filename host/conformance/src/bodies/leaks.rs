//! Memory and files in use before and after many calls, and many instances.
#![allow(unsafe_code)] // reason: asks the C library how much is allocated.

use std::io::Read;

use super::super::harness::call::{Call, Layout, good};
use super::super::harness::subject::{Instance, Law};
use super::super::harness::surroundings::open_files;
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::Bench;
use super::faults::odd_cases;
use super::options::{Strange, altered, senseless};

/// Calls that are made.
const CALLS: usize = 100_000;
/// Points of a refused batch, and of how many calls it is one.
const REFUSED: usize = 2000;
const SELDOM: usize = 32;
/// Calls before anything is measured: what a law sets up once is no leak.
const WARM: usize = 2_000;
/// Instances that are made, and those before anything is measured.
const INSTANCES: usize = 1_000;
const WARM_INSTANCES: usize = 50;
/// How many times fewer for each of the altered options.
const FEWER: usize = 4;
/// Bytes a call or an instance that are told: less than the smallest piece of the heap.
const LEAST: f64 = 8.0;
/// Growth of the heap between two marks that may be pieces which the C library keeps for later.
const NOISE: f64 = 4096.0;
/// Growth of the whole process that is told, for a law that takes its memory from the system itself.
const LEAST_SYSTEM: f64 = 1_048_576.0;

/// What is in use at one time, in bytes.
#[derive(Clone, Copy, Debug)]
struct InUse {
    heap: f64,
    system: f64,
    files: f64,
}

impl InUse {
    fn now() -> Self {
        Self { heap: heap(), system: system(), files: open_files() as f64 }
    }
}

/// Bytes that the C library has handed out and not got back.
#[cfg(target_env = "gnu")]
fn heap() -> f64 {
    // SAFETY: takes nothing and gives a struct of numbers.
    let found = unsafe { libc::mallinfo2() };
    found.uordblks as f64 + found.hblkhd as f64
}

#[cfg(not(target_env = "gnu"))]
fn heap() -> f64 {
    0.0
}

/// Bytes of address space; read into a place on the stack, because what is measured must not change by measuring.
fn system() -> f64 {
    let mut text = [0; 128];
    let read = std::fs::File::open("/proc/self/statm").and_then(|mut file| file.read(&mut text));
    let digits = text[..read.unwrap_or(0)].iter().take_while(|byte| byte.is_ascii_digit());
    4096.0 * digits.fold(0.0, |pages, digit| 10.0 * pages + f64::from(digit - b'0'))
}

/// Growth that goes on: both halves have to show it.
fn growing(marks: [InUse; 3], times: f64, what: &str) -> Option<Finding> {
    let per = |pick: fn(&InUse) -> f64| {
        let [first, middle, last] = marks.map(|mark| pick(&mark));
        (middle - first).min(last - middle).max(0.0) / (0.5 * times)
    };
    let (heap, system, files) = (per(|mark| mark.heap), per(|mark| mark.system), per(|mark| mark.files));
    if heap >= LEAST && heap * 0.5 * times >= NOISE {
        let finding = Finding::new(format!("memory is taken and not given back by {what}"));
        return Some(finding.with(format!("{heap:.0} bytes each, over {times}"), "no more memory in use"));
    }
    if files * times >= 4.0 {
        let finding = Finding::new(format!("files are opened and not closed by {what}"));
        return Some(finding.with(format!("{:.0} more files open after {times}", files * times), "no more open files"));
    }
    if system * 0.5 * times >= LEAST_SYSTEM {
        let finding = Finding::new(format!("memory is taken from the system and not given back by {what}"));
        return Some(finding.with(format!("{system:.0} bytes each, over {times}"), "no more memory in use"));
    }
    None
}

/// Many calls, good and refused in turn.
pub(super) fn calls(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let case = bench.good(law, instance, 4)?;
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let mut calls = vec![Call::new(about, &case, &Layout::plain(about))];
        // One that is refused, if there is any: a text that is made for it is a way to lose memory.
        let refused = odd_cases(&mut sampler, about, 0).into_iter().find_map(|case| {
            let mut call = Call::new(about, &case, &Layout { text: Some(128), ..Layout::plain(about) });
            let status = call.evaluate(instance);
            (!good(status)).then_some((case, call))
        });
        // And a batch of that: some take room for their points, and give it back at the end only.
        let mut batch = refused.as_ref().map(|(case, _)| {
            let layout = Layout { text: Some(128), ..Layout::everything(about) };
            Call::new(about, &case.repeated(REFUSED), &layout)
        });
        calls.extend(refused.map(|(_, call)| call));
        bench.label("many calls");
        let made = measured(bench, WARM, CALLS, "calls", |at| {
            match batch.as_mut().filter(|_| at % SELDOM == 0) {
                Some(batch) => batch.repeat(instance),
                None => {
                    let pick = at % calls.len();
                    calls[pick].repeat(instance)
                }
            };
        })?;
        Ok(Verdict::Pass(Some(format!("{made} calls"))))
    })
}

/// Makes `count` times `work` between three marks, fewer if time is up.
fn measured(bench: &Bench, warm: usize, count: usize, what: &str, mut work: impl FnMut(usize)) -> Judged<usize> {
    (0..warm).take_while(|_| bench.has_time()).for_each(&mut work);
    // Twice, so that looking takes nothing more the next time.
    InUse::now();
    let first = InUse::now();
    let mut half = 0;
    while half < count / 2 && (half % 64 != 0 || bench.has_time() || half == 0) {
        work(half);
        half += 1;
    }
    let middle = InUse::now();
    (0..half).for_each(&mut work);
    let last = InUse::now();
    match growing([first, middle, last], 2.0 * half as f64, what) {
        Some(finding) => broken(finding),
        None => Ok(2 * half),
    }
}

/// Many instances, each evaluated once.
pub(super) fn instances(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    if law.table.create.is_none() {
        return skip("the law has no create");
    }
    let first = law.instance(&bench.task)?;
    let case = bench.good(&law, &first, 4)?;
    drop(first);
    let mut call = Call::new(&law.about, &case, &Layout::plain(&law.about));
    let mut made = Ok(());
    let count = measured(bench, WARM_INSTANCES, INSTANCES, "instances", |at| match law.instance(&bench.task) {
        Ok(instance) => {
            evaluate(&mut call, &instance, at);
        }
        Err(verdict) => made = Err(verdict),
    })?;
    made?;
    refusals(bench, &law)?;
    Ok(Verdict::Pass(Some(format!("{count} instances"))))
}

fn evaluate(call: &mut Call, instance: &Instance<'_>, at: usize) {
    // An instance that is never used must not be lost either.
    if !at.is_multiple_of(3) {
        call.repeat(instance);
    }
}

/// Creates that are refused must give back what they took until then, wherever they are refused.
fn refusals(bench: &Bench, law: &Law<'_>) -> Judged<()> {
    let senseless = senseless();
    let first = senseless.iter().filter(|options| options.words.is_some()).take(1);
    let altered = altered(&bench.task);
    let others: Vec<&Strange> = first.chain(&altered).collect();
    for (place, options) in others.iter().enumerate() {
        if law.create(options.words.as_deref()).is_ok() {
            continue;
        }
        bench.label(&format!("create with the options {}", options.label));
        let count = if place == 0 { INSTANCES } else { INSTANCES / FEWER };
        let what = format!("refused creates, with the options {}", options.label);
        measured(bench, WARM_INSTANCES, count, &what, |_| drop(law.create(options.words.as_deref())))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(heap: f64, system: f64, files: f64) -> InUse {
        InUse { heap, system, files }
    }

    #[test]
    fn growth_that_goes_on_is_told_and_a_single_step_is_not() {
        let still = mark(1e6, 1e7, 3.0);
        assert!(growing([still; 3], 1e5, "calls").is_none());
        let once = mark(9e6, 9e7, 9.0);
        assert!(growing([still, once, once], 1e5, "calls").is_none());
        let [half, whole] = [mark(1e6 + 3.2e6, 1e7, 3.0), mark(1e6 + 6.4e6, 1e7, 3.0)];
        let finding = growing([still, half, whole], 1e5, "calls").unwrap();
        assert!(finding.found.unwrap().starts_with("64 bytes each"));
        let files = growing([still, mark(1e6, 1e7, 503.0), mark(1e6, 1e7, 1003.0)], 1e3, "instances").unwrap();
        assert!(files.what.contains("files"));
        let system = growing([still, mark(1e6, 3e7, 3.0), mark(1e6, 5e7, 3.0)], 1e5, "calls").unwrap();
        assert!(system.what.contains("from the system"));
    }

    #[test]
    fn what_this_process_has_in_use_can_be_measured() {
        let before = InUse::now();
        let taken = std::hint::black_box(vec![1_u8; 50_000]);
        let after = InUse::now();
        assert!(before.system > 0.0 && before.files >= 3.0);
        assert!(!cfg!(target_env = "gnu") || after.heap - before.heap > 40_000.0, "{before:?} {after:?}");
        drop(taken);
    }
}
