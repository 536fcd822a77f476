//! What goes so wrong that no answer comes back: ordinary and provoking inputs, in a thread with a usual stack.

use std::ffi::{CStr, CString};
use std::time::{Duration, Instant};

use wearlaw_plugin_api::abi;

use super::super::harness::call::{Call, Layout};
use super::super::harness::fault_note::note_faults;
use super::super::harness::points::Case;
use super::super::harness::sample::Sampler;
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS};
use super::extremes::is_unit_vector;
use super::options::others;
use wearlaw_law::fields::Shape;
use wearlaw_law::{Field, LawDescriptor};

/// Label of the first stage: what fails here fails always, and other checks say nothing.
pub(crate) const ORDINARY: &str = "ordinary inputs";
/// Label of the second stage.
const PROVOKING: &str = "provoking inputs";
/// The stack that a host's threads have.
const STACK: usize = 2 << 20;

/// Values that laws stumble over.
const ODD: [f64; 9] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, -0.0, 1e300, -1e300, 5e-324];

/// Calls of one point each with an odd value of one field, constant, state variable or input that a host could give,
/// and `wild` points whose values run over all decades.
pub(super) fn odd_cases(sampler: &mut Sampler<'_>, law: &LawDescriptor, wild: usize) -> Vec<Case> {
    let numbers = sampler.numbers();
    let constants = sampler.constants();
    let ordinary = Case::new(numbers, constants, vec![sampler.point(numbers.dt)]);
    let mut cases = odd_points(law, &ordinary);
    for value in ODD {
        for (index, _) in law.constants.iter().enumerate().filter(|(_, constant)| constant.allows(value)) {
            let mut case = ordinary.clone();
            case.constants[index] = value;
            cases.push(case);
        }
        if value >= 0.0 && value.is_finite() {
            let mut case = ordinary.clone();
            case.numbers.dt = value;
            cases.push(case);
        }
    }
    for _ in 0..wild {
        let mut case = wild_point(sampler, law, &ordinary);
        case.constants = law.constants.iter().map(|constant| sampler.wide(constant)).collect();
        cases.push(case);
    }
    cases
}

/// The point of a case with an odd value of one field, state variable or input that a host could give.
pub(super) fn odd_points(law: &LawDescriptor, ordinary: &Case) -> Vec<Case> {
    let mut cases = Vec::new();
    for value in ODD {
        for field in law.fields().iter().filter(|field| !is_unit_vector(*field)) {
            cases.push(ordinary.map(|point| {
                (0..field.shape().width()).for_each(|component| point.set(field, component, value));
                point.set_index(field, value as i64);
            }));
        }
        for (index, _) in law.state.iter().enumerate().filter(|(_, variable)| variable.allows(value)) {
            cases.push(ordinary.map(|point| point.state[index] = value));
        }
        for index in 0..law.inputs.len() {
            cases.push(ordinary.map(|point| point.inputs[index] = value));
        }
    }
    // A product that overflows, of numbers each of which is one.
    cases.push(ordinary.map(|point| {
        law.fields().iter().filter(|field| field.shape() == Shape::Scalar).for_each(|field| point.set(field, 0, 1e300));
    }));
    cases
}

/// The point of a case with fields that run over all decades.
pub(super) fn wild_point(sampler: &mut Sampler<'_>, law: &LawDescriptor, ordinary: &Case) -> Case {
    let random = &mut sampler.random;
    ordinary.map(|point| {
        for field in law.fields().iter().filter(|field| !is_unit_vector(*field)) {
            let sign = if random.unit() < 0.2 { -1.0 } else { 1.0 };
            for component in 0..field.shape().width() {
                point.set(field, component, sign * random.decades(1e-300, 1e300));
            }
        }
    })
}

/// Runs every kind of input through the law in a thread with a usual stack; coming back is all that is asked.
pub(super) fn provoke(bench: &Bench) -> Judged {
    let work = || {
        note_faults(bench.slate);
        bench.with(|law, instance| stages(bench, law, instance))
    };
    std::thread::scope(|scope| {
        let builder = std::thread::Builder::new().stack_size(STACK);
        match builder.spawn_scoped(scope, work) {
            Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(error) => panic!("no thread could be started: {error}"),
        }
    })
}

fn stages(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>) -> Judged {
    let about = &law.about;
    bench.label(ORDINARY);
    let known = bench.known_constants(law);
    let mut sampler = bench.sampler(law, &known);
    let good = sampler.good(instance, POINTS);
    let refused = good.is_none();
    let several = good.unwrap_or_else(|| {
        let (numbers, constants) = (sampler.numbers(), sampler.constants());
        let points = (0..POINTS).map(|_| sampler.point(numbers.dt)).collect();
        Case::new(numbers, constants, points)
    });
    let mut calls = 0;
    // No pointer is NULL, so that a law that follows one which may be is found by its own check.
    let layout = Layout { text: Some(256), ..Layout::everything(about) };
    for case in [several.clone(), several.single(0), several.repeated(5 * POINTS + 3)] {
        Call::new(about, &case, &layout).evaluate(instance);
        calls += 1;
    }
    bench.label(PROVOKING);
    let empty = Case { points: several.points.clone(), count: 0, ..several.clone() };
    Call::new(about, &empty, &layout).evaluate(instance);
    for case in odd_cases(&mut sampler, about, 100) {
        Call::new(about, &case, &layout).evaluate(instance);
        calls += 1;
    }
    let points = search(bench, law, instance, &several, &mut sampler);
    let note = if refused { ", none of the ordinary ones answered" } else { "" };
    Ok(Verdict::Pass(Some(format!("{calls} calls, {points} random points{note}"))))
}

/// Random points that are tried in full, and with `--quick`.
const SEARCHED: usize = 6 << 20;
const SEARCHED_QUICKLY: usize = 1 << 18;
/// Points of a batch of them.
const BATCH: usize = 1 << 16;
/// Time for them: a law that takes more than half a microsecond a point is not searched to the end.
const SEARCH: Duration = Duration::from_secs(3);

/// Looks for a point in a million, in large batches whose scalar fields are different at every point.
fn search(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>, several: &Case, sampler: &mut Sampler<'_>) -> usize {
    let about = &law.about;
    let scalars: Vec<Field> = about.fields().iter().filter(|field| field.shape() == Shape::Scalar).collect();
    let wanted = if bench.task.quick { SEARCHED_QUICKLY } else { SEARCHED };
    let mut call = Call::new(about, &several.single(0).repeated(BATCH), &Layout::everything(about));
    let base = several.point(0).clone();
    let mut done = 0;
    let end = Instant::now() + bench.at_most(SEARCH);
    while done < wanted && Instant::now() < end {
        for field in &scalars {
            let value = base.scalar(*field);
            let values: Vec<f64> = (0..BATCH).map(|_| value * sampler.random.between(0.5, 2.0)).collect();
            call.set_field(*field, values);
        }
        call.evaluate(instance);
        done += BATCH;
    }
    done
}

/// Whether options that make no sense are refused with a text, or of no effect.
pub(super) fn create(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    if law.table.create.is_none() {
        return skip("the law has no create");
    }
    let words = bench.task.options.as_deref().and_then(|words| CString::new(words).ok());
    bench.label("create with the usual options");
    let (usual, wrote) = law.create_in(words.as_deref().map(|words| words.to_bytes_with_nul().to_vec()));
    let usual = usual.map(drop);
    if wrote {
        let finding = Finding::new("create writes to the text of its options, which is the host's");
        return broken(finding.with("other options after the call", "the options as they were"));
    }
    bench.label("create with the usual options once more");
    again(&law, &usual, words.as_deref(), "the second create with the same options is refused")?;
    let others = others(&bench.task);
    let mut refused = 0;
    for options in &others {
        bench.label(&format!("create with the options {}", options.label));
        let Err((status, text)) = law.create(options.words.as_deref()) else { continue };
        refused += 1;
        let known = (abi::WL_UNRELIABLE..=abi::WL_FAILED).contains(&status);
        if text.trim().is_empty() || !known {
            let finding = Finding::new(format!("create refuses the options {}", options.label));
            return broken(finding.with(
                format!("status {status}, text {text:?}"),
                "a status of this version, and a text that says why",
            ));
        }
    }
    // What was refused is none of the business of the next one.
    bench.label("create with the usual options, after others were refused");
    again(&law, &usual, words.as_deref(), "create refuses the usual options once others were refused")?;
    if let Err((status, text)) = usual {
        let how = if words.is_some() { "with the options given" } else { "without options" };
        let finding = Finding::new(format!("create refuses to start {how}, so most checks test nothing"));
        let wanted = "an instance; give the options that it needs with --options";
        return Ok(Verdict::Warn(finding.with(format!("status {status}, text {text:?}"), wanted)));
    }
    Ok(Verdict::Pass(Some(format!("{refused} of {} other options refused, each with a text", others.len()))))
}

/// Holds a create to an earlier one with the same options that went well.
fn again(law: &Law<'_>, usual: &Result<(), (i32, String)>, words: Option<&CStr>, what: &str) -> Judged<()> {
    match (usual, law.create(words)) {
        (Ok(()), Err((status, text))) => {
            broken(Finding::new(what).with(format!("status {status}, text {text:?}"), "an instance, as before"))
        }
        _ => Ok(()),
    }
}
