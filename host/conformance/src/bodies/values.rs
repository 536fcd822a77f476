//! The numbers at random inputs within the bounds, and where something is zero or negative.

use super::super::harness::call::{Answers, Asked, Layout};
use super::super::harness::points::{Case, Point, number_text};
use super::super::harness::subject::{Instance, Law};
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::{Bench, POINTS, ask, finite_or_status};
use super::extremes::is_unit_vector;
use wearlaw_law::Field;

/// Ordinary and wide calls each.
const CALLS: usize = 150;
/// A law that answers fewer than one ordinary call in so many is hardly tested.
const FEW: usize = 20;

/// Random inputs: ordinary ones, then all decades.
pub(super) fn finite(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let known = bench.known_constants(law);
        let mut sampler = bench.sampler(law, &known);
        let mut good = [0; 2];
        for call in 0..2 * CALLS {
            let wide = call >= CALLS;
            let mut case = {
                let numbers = sampler.numbers();
                Case::new(numbers, sampler.constants(), vec![sampler.point(numbers.dt)])
            };
            if wide {
                case.constants = about.constants.iter().map(|constant| sampler.wide(constant)).collect();
                let state: Vec<f64> = about.state.iter().map(|variable| sampler.wide(variable)).collect();
                let inputs: Vec<f64> = about.inputs.iter().map(|input| sampler.wide(input)).collect();
                let random = &mut sampler.random;
                case = case.map(|point| {
                    (point.state, point.inputs) = (state.clone(), inputs.clone());
                    for field in about.fields().iter().filter(|field| !is_unit_vector(*field)) {
                        let factor = random.decades(1e-20, 1e20);
                        point.scale(field, factor);
                    }
                });
            }
            for asked in Asked::ways(about) {
                let answers = ask(about, instance, &case, &Layout { asked, ..Layout::plain(about) });
                finite_or_status(about, &case, &answers, "an input within the bounds has no answer and no status")?;
                good[usize::from(wide)] += usize::from(answers.is_good());
            }
        }
        let calls = CALLS * Asked::ways(about).len();
        if good[0] * FEW < calls {
            let what = match good[0] {
                0 => "the law refuses every ordinary input that was tried, so most checks test nothing",
                _ => {
                    "the law refuses nearly every ordinary input that was tried, so most checks test little or nothing"
                }
            };
            let expected = "some answers: rows in expected.csv beside the law give constants to try, and a field that \
                            is read without being declared is no number";
            return Ok(Verdict::Warn(Finding::new(what).with(format!("{} of {calls} answered", good[0]), expected)));
        }
        Ok(Verdict::Pass(Some(format!(
            "{} of {calls} ordinary and {} of {calls} wide calls answered",
            good[0], good[1]
        ))))
    })
}

/// No pressure, nor what comes of it.
pub(super) fn without_pressure(point: &mut Point, pressure: f64) {
    point.set(Field::Pressure, 0, pressure);
    point.set(Field::NodalTraction, 0, 0.0);
    point.set(Field::FrictionWork, 0, 0.0);
    point.set_vector(Field::FrictionStress, [0.0; 3]);
}

/// No slip, nor what comes of it.
pub(super) fn without_slip(point: &mut Point) {
    for field in [Field::Slip, Field::Velocity, Field::FrictionWork] {
        point.set(field, 0, 0.0);
    }
    point.set_vector(Field::SlipVector, [0.0; 3]);
}

/// True if the law reads what tells the load.
pub(super) fn reads_pressure(law: &Law<'_>) -> bool {
    [Field::Pressure, Field::NodalTraction].iter().any(|field| law.about.fields().contains(*field))
}

/// Goes through good points changed in one way; each must be answered with finite values or a status, and `keeps` may
/// want more of the answer.
pub(super) fn changed(
    bench: &Bench,
    law: &Law<'_>,
    instance: &Instance<'_>,
    change: impl Fn(&mut Case),
    what: &str,
    keeps: impl Fn(&Case, &Answers) -> Option<Finding>,
) -> Judged {
    let about = &law.about;
    let good = bench.good(law, instance, POINTS)?;
    let mut answered = 0;
    for point in 0..good.count {
        let mut case = good.single(point);
        change(&mut case);
        for asked in Asked::ways(about) {
            let answers = ask(about, instance, &case, &Layout { asked, ..Layout::plain(about) });
            finite_or_status(about, &case, &answers, what)?;
            if !answers.is_good() {
                continue;
            }
            answered += 1;
            if let Some(finding) = keeps(&case, &answers) {
                return broken(finding.at(case.named(about, 0)));
            }
        }
    }
    Ok(Verdict::Pass((answered == 0).then(|| "refused with a status".to_owned())))
}

/// Wear where there must be none.
pub(super) fn no_wear(what: &'static str) -> impl Fn(&Case, &Answers) -> Option<Finding> {
    move |_, answers| {
        let increment = answers.increment[0];
        (increment != 0.0).then(|| {
            Finding::new(what).with(format!("increment {}", number_text(increment)), "increment 0, or a status")
        })
    }
}

/// Zero pressure.
pub(super) fn zero_pressure(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let change = |case: &mut Case| *case = case.map(|point| without_pressure(point, 0.0));
        changed(bench, law, instance, change, "zero pressure has no answer and no status", |_, _| None)
    })
}

/// Zero slip.
pub(super) fn zero_slip(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let change = |case: &mut Case| *case = case.map(without_slip);
        changed(bench, law, instance, change, "zero slip has no answer and no status", |_, _| None)
    })
}

/// A substep of no length.
pub(super) fn zero_dt(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let change = |case: &mut Case| {
            case.numbers.dt = 0.0;
            *case = case.map(|point| {
                // The speed is what it was; nothing has been travelled yet.
                let velocity = point.scalar(Field::Velocity);
                without_slip(point);
                point.set(Field::Velocity, 0, velocity);
            });
        };
        changed(bench, law, instance, change, "a substep of no length has no answer and no status", |case, answers| {
            if answers.increment[0] != 0.0 {
                return no_wear("a substep of no length wears")(case, answers);
            }
            let start = &case.point(0).state;
            let moved = start.iter().zip(&answers.state).position(|(start, end)| start.to_bits() != end.to_bits())?;
            let finding = Finding::new("a substep of no length changes the state");
            let name = &law.about.state[moved].name;
            let text = |value: f64| format!("{name} {}", number_text(value));
            Some(finding.with(text(answers.state[moved]), text(start[moved])))
        })
    })
}

/// Negative pressure.
pub(super) fn negative_pressure(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        if !reads_pressure(law) {
            return skip("the law reads no pressure");
        }
        if law.about.wants_open_points() {
            return skip("the law wants points out of contact, and may wear there (WL_FLAG_OPEN_POINTS)");
        }
        for factor in [1.0, 1e-12, 1e3] {
            let change = |case: &mut Case| {
                *case = case.map(|point| {
                    let pressure = point.scalar(Field::Pressure);
                    without_pressure(point, -factor * pressure);
                });
            };
            let what = "negative pressure has no answer and no status";
            changed(bench, law, instance, change, what, no_wear("negative pressure wears"))?;
        }
        Ok(Verdict::Pass(None))
    })
}
