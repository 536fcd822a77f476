//! What all runs are compared with: an exact answer, a file, or the same scene run until it changes no more, whose own
//! error is estimated and meant to be rather too large.

use super::asked::Compare;
use super::budget::Budget;
use super::error::StudyError;
use super::frame::{Fields, Frame};
use super::lines::Ground;
use super::setup::{How, Outcome, Ran, Setup, effort};
use crate::law::Evaluator;
use crate::record::{Cost, Errors, Rung, Yardstick, YardstickKind};
use crate::reference::NamedReference;
use crate::scene::{Model, ScalingKind, Target};

/// Part of the budget that a yardstick climbs in, and the part at whose end it is cut off.
const CLIMBS: f64 = 0.25;
const ENDS: f64 = 0.5;
/// The first tolerance, by how much each is below the one before, and the last; where contact is solved.
const SOLVED: (f64, f64, f64) = (1e-2, 8.0, 2e-9);
/// The same under a prescribed pressure.
const PRESCRIBED: (f64, f64, f64) = (1e-4, 100.0, 1e-14);
/// By how much contact is solved more exactly with every rung.
const TIGHTER: f64 = 0.3;
/// The most exact contact that numbers allow.
const TIGHTEST: f64 = 1e-13;
/// A finer run that takes fewer times as many steps as this is the same run again, and no measure of the other's error.
const MORE: f64 = 1.25;
/// What is stated is so many times what the convergence lets expect..
const CAUTION: f64 = 3.0;
/// ..and between these parts of the last difference.
const STATED: (f64, f64) = (0.3, 3.0);
/// Rounding of sums over many points.
const ROUNDING: f64 = 1e-14;

/// A yardstick with its fields.
pub(super) struct Gauge {
    pub(super) yardstick: Yardstick,
    pub(super) fields: Fields,
    pub(super) frame: Frame,
    /// Tolerance of a self-converged run.
    pub(super) tolerance: Option<f64>,
    /// Seconds of its cheapest run, and how often it solved the contact; its steps, where none is solved.
    pub(super) cheapest: (f64, f64),
}

/// Contact solves of a run, at least its steps.
fn solves(cost: &Cost) -> f64 {
    cost.contact_solves.max(cost.steps).max(1) as f64
}

/// How the scene's own reference serves.
fn serves(ground: &Ground<'_>) -> Option<YardstickKind> {
    if ground.asked.compare == Compare::SelfConverged {
        return None;
    }
    let prescribed = matches!(ground.scene.contact.model, Model::Prescribed(_));
    match &ground.scene.reference.as_ref()?.target {
        Target::Exact(name) if NamedReference::from_name(name).is_some_and(NamedReference::is_of_the_points) => {
            Some(YardstickKind::Exact)
        }
        // On a grid a file is off by the error of that grid, which no step in time is to blame for.
        Target::File(_) if prescribed => Some(YardstickKind::File),
        _ => None,
    }
}

/// Makes the yardstick of a study.
///
/// # Errors
/// A scene that cannot be run to any tolerance, or not within its part of the budget; an interruption.
pub(super) fn make(
    setup: &Setup<'_>,
    law: &dyn Evaluator,
    ground: &Ground<'_>,
    budget: &Budget,
    tell: &mut dyn FnMut(&str),
) -> Result<Gauge, StudyError> {
    match serves(ground) {
        Some(kind) => of_scene(setup, law, ground, budget, kind),
        None => converged(setup, law, ground, budget, tell),
    }
}

/// The scene's reference, at the time that a run reaches.
fn of_scene(
    setup: &Setup<'_>,
    law: &dyn Evaluator,
    ground: &Ground<'_>,
    budget: &Budget,
    kind: YardstickKind,
) -> Result<Gauge, StudyError> {
    let overrides = rung(ground, 0, 1e-2);
    let ran =
        finished(setup.run(law, &overrides, How { budget, until: ENDS, repeated: false, isolated: false }), budget)?;
    let Ran { scene, record, timing, expected } = *ran;
    let Some(expected) = expected else {
        return Err(StudyError::Yardstick("the scene's reference says nothing of single points".to_owned()));
    };
    let name = match kind {
        YardstickKind::Exact => format!("the exact answer {}", expected.reference),
        _ => format!("the file {}", expected.reference),
    };
    let yardstick =
        Yardstick { kind, name, stated: Errors::new(), rungs: Vec::new(), measured: Errors::new(), answer: None };
    Ok(Gauge {
        yardstick,
        frame: Frame::of(&scene, &record),
        fields: expected.into(),
        tolerance: None,
        cheapest: (effort(&timing, false), solves(&record.cost)),
    })
}

fn finished(outcome: Outcome, budget: &Budget) -> Result<Box<Ran>, StudyError> {
    match outcome {
        Outcome::Ran(ran) => Ok(ran),
        Outcome::Interrupted => Err(StudyError::Interrupted),
        Outcome::Cut => Err(StudyError::Budget { budget_s: budget.whole_s(), allowed_s: ENDS * budget.whole_s() }),
        Outcome::Refused(reason) | Outcome::Failed(reason) => Err(StudyError::Yardstick(reason)),
    }
}

/// The overrides of a rung.
fn rung(ground: &Ground<'_>, index: i32, tolerance: f64) -> Vec<String> {
    let scene = ground.scene;
    let mut overrides = ground.method(crate::scene::Method::Auto);
    overrides.push(format!("integrator.tolerance={tolerance:e}"));
    let contact = match &scene.contact.model {
        Model::HalfSpace(half) => Some(half.tolerance),
        Model::Foundation(foundation) => Some(foundation.tolerance),
        Model::Prescribed(_) => None,
    };
    if let Some(contact) = contact {
        let tighter = (contact * TIGHTER.powi(index)).max(TIGHTEST.min(contact));
        overrides.push(format!("contact.tolerance={tighter:e}"));
    }
    if scene.scaling.kind == Some(ScalingKind::Cycle) {
        let safety = scene.scaling.safety.unwrap_or(crate::scene::Scaling::SAFETY) * 0.5_f64.powi(index);
        overrides.push(format!("scaling.safety={safety}"));
    }
    overrides
}

/// One of the runs that lead to a self-converged answer.
struct Step {
    ran: Box<Ran>,
    fields: Fields,
    overrides: Vec<String>,
    tolerance: f64,
}

/// The same scene to smaller and smaller tolerances, as far as the budget goes.
fn converged(
    setup: &Setup<'_>,
    law: &dyn Evaluator,
    ground: &Ground<'_>,
    budget: &Budget,
    tell: &mut dyn FnMut(&str),
) -> Result<Gauge, StudyError> {
    let prescribed = matches!(ground.scene.contact.model, Model::Prescribed(_));
    let (first, by, last) = if prescribed { PRESCRIBED } else { SOLVED };
    let mut steps: Vec<Step> = Vec::new();
    let (mut runs, mut cheapest, mut exhausted) = (0, None, false);
    loop {
        let tolerance = first * by.powi(-runs);
        if tolerance < last {
            exhausted = true;
            break;
        }
        tell(&format!("yardstick, tolerance {tolerance:.1e}"));
        let overrides = rung(ground, runs, tolerance);
        let outcome = setup.run(law, &overrides, How { budget, until: ENDS, repeated: false, isolated: false });
        let ran = match outcome {
            Outcome::Ran(ran) => ran,
            Outcome::Interrupted => return Err(StudyError::Interrupted),
            // The one before stands.
            _ if !steps.is_empty() => break,
            other => finished(other, budget)?,
        };
        runs += 1;
        let (count, effort_s) = (ran.record.cost.steps as f64, effort(&ran.timing, false));
        cheapest.get_or_insert((effort_s, solves(&ran.record.cost)));
        let before = steps.last().map(|step| (step.ran.record.cost.steps as f64, effort(&step.ran.timing, false)));
        if before.is_some_and(|(before, _)| count < MORE * before) {
            steps.pop();
        }
        let growth = before.map_or(by.sqrt(), |(_, before)| effort_s / before).max(2.0);
        let fields = Fields::of(&ran.record);
        steps.push(Step { ran, fields, overrides, tolerance });
        if budget.spent_s() + 1.2 * growth * effort_s > CLIMBS * budget.whole_s() {
            break;
        }
    }
    let frame = steps.last().map(|step| Frame::of(&step.ran.scene, &step.ran.record)).unwrap_or_default();
    let Some(top) = steps.last() else { return Err(StudyError::Yardstick("no tolerance was tried".to_owned())) };
    let tolerance = top.tolerance;
    let compared: Vec<Errors> = steps.windows(2).map(|pair| frame.errors(&pair[0].fields, &pair[1].fields)).collect();
    let to_the_top: Vec<Errors> =
        steps[..steps.len() - 1].iter().map(|s| frame.errors(&s.fields, &top.fields)).collect();
    let least = least(ground, runs, &frame, &top.fields);
    let stated = match to_the_top.as_slice() {
        // No tolerance down to the last makes a difference to the steps: the answer does not depend on it.
        [] if exhausted => frame.errors(&top.fields, &top.fields).into_keys().map(|name| (name, 0.0)).collect(),
        [] => Errors::new(),
        [one] => stated(one, None),
        [.., before, one] => stated(one, Some(before)),
    };
    let stated = stated.into_iter().map(|(name, error)| {
        let floor = if name == super::frame::RADIUS { least.1 } else { least.0 };
        (name, error.max(floor))
    });
    let rungs = steps.iter().enumerate().map(|(index, step)| Rung {
        overrides: step.overrides.clone(),
        wall_s: step.ran.timing.wall_s,
        steps: step.ran.record.cost.steps,
        to_the_next: compared.get(index).cloned().unwrap_or_default(),
    });
    let expected = top.ran.expected.clone();
    let answer = expected.as_ref().map(|expected| expected.reference.clone());
    let measured = expected.map(|expected| frame.errors(&top.fields, &expected.into())).unwrap_or_default();
    let yardstick = Yardstick {
        kind: YardstickKind::SelfConverged,
        name: format!("the same scene to the tolerance {tolerance:.1e}, {} steps", top.ran.record.cost.steps),
        stated: stated.collect(),
        rungs: rungs.collect(),
        measured,
        answer,
    };
    let fields = top.fields.clone();
    Ok(Gauge { yardstick, fields, frame, tolerance: Some(tolerance), cheapest: cheapest.unwrap_or((0.0, 1.0)) })
}

/// The least errors that are stated: of sums and of a solved contact, and of a radius that is counted in cells.
fn least(ground: &Ground<'_>, runs: i32, frame: &Frame, fields: &Fields) -> (f64, f64) {
    let contact = match &ground.scene.contact.model {
        Model::HalfSpace(half) => half.tolerance,
        Model::Foundation(foundation) => foundation.tolerance,
        Model::Prescribed(_) => 0.0,
    };
    let least = (contact * TIGHTER.powi(runs - 1)).max(ROUNDING);
    (least, frame.cell_of_radius(&fields.wear).unwrap_or(least))
}

/// What is stated of a run, from its difference to the next coarser one and that one's, if there is one, to the same run.
///
/// An error that falls by a factor r from run to run is d / (r - 1), d being the last difference; r is taken from the
/// differences themselves, three times that is stated, and never less than three tenths of d.
fn stated(last: &Errors, before: Option<&Errors>) -> Errors {
    let of = |name: &String, last: f64| {
        let falls = before.and_then(|before| before.get(name)).map_or(0.0, |before| before / last - 1.0);
        let part = if falls > 1.0 { CAUTION / (falls - 1.0) } else { STATED.1 };
        last * part.clamp(STATED.0, STATED.1)
    };
    last.iter().map(|(name, error)| (name.clone(), if *error == 0.0 { 0.0 } else { of(name, *error) })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_stated_is_rather_too_large() {
        let errors = |error: f64| Errors::from([("wear".to_owned(), error)]);
        // Errors 64, 8, 1 of three runs: differences 63 and 7 to the last, whose error is 1.
        let of = |last: f64, before: f64| stated(&errors(last), Some(&errors(before)))["wear"];
        assert!((1.0..=3.5).contains(&of(7.0, 63.0)), "{}", of(7.0, 63.0));
        // One that hardly falls, and one that rises.
        assert_eq!(of(1.0, 1.5), 3.0);
        assert_eq!(of(1.0, 0.5), 3.0);
        assert_eq!(of(1.0, 1e9), 0.3);
        assert_eq!(stated(&errors(2.0), None)["wear"], 6.0);
        assert_eq!(of(0.0, 0.0), 0.0);
    }
}
