//! State variables: read at the start of a substep, written at its end, and nothing remembered beside them.

use super::super::harness::arrays::Room;
use super::super::harness::call::{Answers, Asked, Call, Layout};
use super::super::harness::points::{Case, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, Differences, POINTS, ask, still_good};
use super::faults::odd_cases;
use super::memory::FILLINGS;
use wearlaw_law::{CallNumbers, Field};

/// Good points of a law that has state variables.
fn good(bench: &Bench, law: &Law<'_>, instance: &Instance<'_>) -> Judged<Case> {
    if law.about.state.is_empty() {
        return skip("the law has no state variables");
    }
    bench.good(law, instance, POINTS)
}

/// The state at the start in pages that can only be read, and compared afterwards.
pub(super) fn start(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let case = good(bench, law, instance)?;
        for asked in Asked::ways(&law.about) {
            for (room, state_sealed) in [(Room::Plain, false), (Room::GuardBefore, true)] {
                let layout = Layout { asked, room, state_sealed, ..Layout::plain(&law.about) };
                let mut call = Call::new(&law.about, &case, &layout);
                let before = call.state_at_start();
                call.evaluate(instance);
                let after = call.state_at_start();
                let changed = before.iter().zip(&after).position(|(a, b)| a.to_bits() != b.to_bits());
                if let Some(at) = changed {
                    let (point, variable) = (at / law.about.state.len(), at % law.about.state.len());
                    let name = &law.about.state[variable].name;
                    let finding = Finding::new(format!("the start of {name} at point {point} is written"));
                    let (found, expected) = (number_text(after[at]), number_text(before[at]));
                    return broken(finding.with(found, expected).at(case.named(&law.about, point)));
                }
            }
        }
        Ok(Verdict::Pass(None))
    })
}

/// Every state variable at the end of every point.
pub(super) fn end(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let good = good(bench, law, instance)?;
        let variables = law.about.state.len();
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let odd = odd_cases(&mut sampler, &law.about, 20);
        for case in [1, 2, 7, POINTS, 67].map(|count| good.repeated(count)).into_iter().chain(odd) {
            let count = case.count;
            for asked in Asked::ways(&law.about) {
                let ask =
                    |filling| ask(&law.about, instance, &case, &Layout { asked, filling, ..Layout::plain(&law.about) });
                let [one, other] = FILLINGS.map(ask);
                let untouched =
                    |at: &usize| one.state[*at].to_bits() == FILLINGS[0] && other.state[*at].to_bits() == FILLINGS[1];
                if let Some(at) = (0..one.state.len()).find(untouched).filter(|_| one.is_good()) {
                    let (point, name) = (at / variables, &law.about.state[at % variables].name);
                    let what = format!("the end of {name} at point {point} of {count} is not written");
                    let finding = Finding::new(what).at(case.named(&law.about, point));
                    return broken(finding.with("what the array held before the call", "a value of its own"));
                }
            }
        }
        Ok(Verdict::Pass(None))
    })
}

/// The case whose points start where `answers` ended.
fn following(case: &Case, answers: &Answers, variables: usize) -> Case {
    let mut next = case.clone();
    for (point, end) in next.points.iter_mut().zip(answers.state.chunks(variables)) {
        point.state = end.to_vec();
    }
    next.numbers.time += next.numbers.dt;
    next.numbers.substep += 1;
    next
}

/// A substep and its half, tried in turn and with the next one in between, each against a fresh instance's answer.
pub(super) fn again(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let whole = good(bench, law, instance)?;
        let layout = Layout::plain(about);
        let half = whole.map(|point| {
            [Field::Slip, Field::SlipVector, Field::FrictionWork].iter().for_each(|field| point.scale(*field, 0.5));
        });
        let half = Case { numbers: CallNumbers { dt: 0.5 * whole.numbers.dt, ..whole.numbers }, ..half };
        let alone = |case: &Case| -> Judged<Answers> {
            let answers = ask(about, &law.instance(&bench.task)?, case, &layout);
            still_good(about, case, &answers, "a substep").map(|()| answers)
        };
        let expected = [alone(&whole)?, alone(&half)?];
        let next = following(&whole, &expected[0], about.state.len());
        let mut differences = Differences::default();
        for turn in [0, 1, 1, 0, 2, 0, 2, 1] {
            let Some(case) = [&whole, &half].get(turn).copied() else {
                // As a host goes on, before it comes back to a shorter try.
                ask(about, instance, &next, &layout);
                continue;
            };
            let answers = ask(about, instance, case, &layout);
            still_good(about, case, &answers, "a substep that is tried again")?;
            for point in 0..case.count {
                differences.note(expected[turn].at(point).difference(&answers.at(point)), || {
                    Finding::new("a substep that is tried again ends elsewhere").at(case.named(about, point))
                });
            }
        }
        differences.judge(about)
    })
}

/// Substeps of the run.
const SUBSTEPS: usize = 10;

/// The straight run against one that is stopped, written down and carried on by a new instance.
pub(super) fn restart(bench: &Bench) -> Judged {
    let library = bench.open()?;
    let law = library.law(&bench.task)?;
    let about = &law.about;
    let instance = law.instance(&bench.task)?;
    let start = good(bench, &law, &instance)?;
    let layout = Layout::plain(about);
    let mut straight: Vec<(Case, Answers)> = Vec::new();
    let mut case = start;
    for _ in 0..SUBSTEPS {
        let answers = ask(about, &instance, &case, &layout);
        if !answers.is_good() {
            // The state has run out of what the law can answer.
            break;
        }
        let next = following(&case, &answers, about.state.len());
        straight.push((case, answers));
        case = next;
    }
    drop(instance);
    let Some(stop) = straight.len().checked_sub(1).map(|last| last.div_ceil(2)) else {
        return skip("the law refused the first substep");
    };
    let instance = law.instance(&bench.task)?;
    let mut differences = Differences::default();
    let mut case = straight[stop].0.clone();
    for (substep, (_, expected)) in straight.iter().enumerate().skip(stop) {
        let answers = ask(about, &instance, &case, &layout);
        still_good(about, &case, &answers, "a run that is carried on")?;
        for point in 0..case.count {
            differences.note(expected.at(point).difference(&answers.at(point)), || {
                let what =
                    format!("substep {substep} of a run carried on from substep {stop} differs from the straight run");
                Finding::new(what).at(case.named(about, point))
            });
        }
        case = following(&case, &answers, about.state.len());
    }
    differences.judge(about)
}
