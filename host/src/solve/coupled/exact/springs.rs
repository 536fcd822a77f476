//! The cells of a foundation, followed through the whole loading of a scene.

use super::super::run::Coupled;
use super::asked::{Rate, Reason};
use super::loading::{self, Visit};
use crate::plan::{Linear, LoadStep};
use crate::reference::foundation::discrete::{Pressing, Springs, Stretch, follow};

/// Load steps beyond which the cells are not followed: it would take longer than the run.
const MOST_STEPS: u64 = 100_000;
/// Largest k c v t of a load step that is followed.
const STIFFEST: f64 = 1e5;

/// Checks that the loading can be followed.
pub(super) fn check(run: &Coupled<'_>, stiffness: f64, rate: Rate) -> Result<(), Reason> {
    let count = |block: &crate::plan::Block| block.count.saturating_mul(block.steps.len() as u64);
    let steps = run.plan.blocks.iter().map(count).fold(0, u64::saturating_add);
    if steps > MOST_STEPS {
        return Err(format!("there are {steps} load steps, expected at most {MOST_STEPS}"));
    }
    for step in loading::all_steps(run.plan) {
        let visit = Visit { step, part: 1.0, times: 1.0 };
        if visit.ramps_speed() && [step.load, step.approach].into_iter().flatten().any(|line| line.from != line.to) {
            return Err("in one load step both the velocity and what presses change".to_owned());
        }
        let fastest = slides(run, step, rate.exponent)?.into_iter().fold(0.0, f64::max);
        let found = stiffness * rate.per_slid * fastest * visit.slid(rate.exponent);
        if found.is_nan() || found > STIFFEST {
            return Err(format!("k c v times the duration of a load step is {found:e}, expected at most {STIFFEST:e}"));
        }
    }
    Ok(())
}

/// Wear and pressure of the cells at a represented time.
pub(super) fn answer(run: &Coupled<'_>, stiffness: f64, rate: Rate, until: f64) -> Result<[Vec<f64>; 2], Reason> {
    let mut visits = Vec::new();
    loading::walk(run.plan, until, false, |visit| visits.push(visit));
    let mut wear = vec![0.0; run.points()];
    let mut pressure = vec![0.0; run.points()];
    // Steps in which the same cells slide alike are followed together; the contact at the start of the next follows from
    // what has been worn.
    for alike in visits.chunk_by(|a, b| (a.step.velocity_file, a.step.stick) == (b.step.velocity_file, b.step.stick)) {
        let rates = slides(run, alike[0].step, rate.exponent)?;
        let springs = Springs {
            gap: run.gap.iter().zip(&wear).map(|(gap, wear)| gap + wear).collect(),
            stiffness,
            area: run.solved.cells.area(),
            rate: rates.into_iter().map(|slide| rate.per_slid * slide).collect(),
        };
        let stretches: Vec<Stretch> = alike.iter().map(|visit| stretch(visit, rate.exponent)).collect();
        let end = stretches.iter().map(|stretch| stretch.duration).sum();
        let answers = follow(&springs, &stretches, &[end]).map_err(|error| error.to_string())?;
        if let Some(last) = answers.into_iter().next_back() {
            wear.iter_mut().zip(&last.wear_depth).for_each(|(wear, more)| *wear += more);
            pressure = last.pressure;
        }
    }
    Ok([wear, pressure])
}

/// A visited load step; where only its speed changes, one of the same wear at a constant speed.
fn stretch(visit: &Visit<'_>, exponent: f64) -> Stretch {
    let over = |line: Linear| [line.from, line.at(visit.part)];
    let pressing = match (visit.step.load, visit.step.approach) {
        (Some(load), _) => Pressing::Load(over(load)),
        (None, Some(approach)) => Pressing::Approach(over(approach)),
        (None, None) => Pressing::Load([0.0; 2]),
    };
    let duration = visit.duration();
    let speed = if duration > 0.0 { visit.slid(exponent) / duration } else { 0.0 };
    Stretch { duration, speed, pressing }
}

/// |v / v0|^n of the cells, v0 being the velocity of the load step; a single 1 where all slide alike.
pub(super) fn slides(run: &Coupled<'_>, step: &LoadStep, exponent: f64) -> Result<Vec<f64>, Reason> {
    let slides = run.slides(step).map_err(|error| error.to_string())?;
    let powers: Vec<f64> = slides.into_iter().map(|slide| slide.abs().powf(exponent)).collect();
    Ok(if powers.is_empty() { vec![1.0] } else { powers })
}
