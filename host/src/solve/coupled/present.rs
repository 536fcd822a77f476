//! The state of a run at one moment, as the start of studies of what steps do from there.

use super::going::{Going, Leave};
use super::run::Coupled;
use super::segment::Segment;
use crate::contact::{Control, Solution};
use crate::integrator::Formula;
use crate::plan::{Linear, LoadStep, Plan};
use crate::record::{Event, Observer, Wish};
use crate::scene::{BeyondLimit, Every, Stop};
use crate::solve::SolveError;

/// Everything that a step starts from; arrays over the cells.
pub(super) struct Present {
    /// Represented time.
    pub(super) time: f64,
    pub(super) wear: Vec<f64>,
    pub(super) pressure: Vec<f64>,
    pub(super) solution: Solution,
    pub(super) state: Vec<f64>,
    pub(super) distance: Vec<f64>,
    pub(super) uniform_distance: f64,
    /// The loading of that moment, the same throughout.
    pub(super) step: LoadStep,
    /// Number of the load step, from 1.
    pub(super) number: i64,
    /// Number of the cycle, from 1; 0 outside cycles.
    pub(super) cycle: i64,
}

impl Present {
    /// Whether the scene gives the load at that moment, and not the approach.
    pub(super) fn load_given(&self) -> bool {
        self.step.approach.is_none()
    }

    /// What presses as it does, under a control of either kind.
    pub(super) fn control(&self, load_given: bool) -> Control {
        if load_given { Control::Load(self.solution.load) } else { Control::Approach(self.solution.approach) }
    }

    /// The loading of that moment under a control.
    pub(super) fn pressed(&self, control: Control) -> LoadStep {
        let held = |value: f64| Some(Linear { from: value, to: value });
        let (load, approach) = match control {
            Control::Load(load) => (held(load), None),
            Control::Approach(approach) => (None, held(approach)),
        };
        LoadStep { load, approach, ..self.step }
    }
}

/// Stops a run at a time, or when it should end.
struct Until<'w> {
    time: f64,
    goes_on: &'w (dyn Fn() -> bool + Sync),
}

impl Observer for Until<'_> {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        let reached = match event {
            Event::Step { row, .. } => row.time >= self.time * (1.0 - 1e-12),
            _ => false,
        };
        if reached || !(self.goes_on)() { Wish::Stop } else { Wish::GoOn }
    }
}

impl Coupled<'_> {
    /// Runs the scene up to a represented time; at 0 only the contact is solved. `None`: it was interrupted.
    ///
    /// Explicit steps that the scene refuses are cut on the way, so that there is a state to look at.
    ///
    /// # Errors
    /// A time outside the loading; whatever ends the run before.
    pub(super) fn present(&self, at: f64, goes_on: &(dyn Fn() -> bool + Sync)) -> Result<Option<Present>, SolveError> {
        let end = self.plan.blocks.iter().map(|block| block.count as f64 * period(&block.steps)).sum();
        let (step, number, cycle) = loading_at(self.plan, at).ok_or(SolveError::NoSuchTime { at, end })?;
        let (mut plan, mut solved) = (self.plan.clone(), self.solved.clone());
        plan.output.fields.clear();
        plan.output.every = Every::Times(vec![at]);
        plan.stop = Stop::default();
        if solved.scheme.formula == Formula::ExplicitEuler && solved.beyond_limit == BeyondLimit::Refuse {
            solved.beyond_limit = BeyondLimit::Substep;
        }
        let run = self.with(&plan, &solved);
        let mut observer = Until { time: at, goes_on };
        let mut going = Going::new(&plan, run.points(), &mut observer);
        let mut system = run.system(1);
        let left = if at > 0.0 {
            run.blocks(&mut system, &mut going)
        } else {
            let segment = Segment { step: &step, start: 0.0, length: 0.0, represented: 0.0, scale: 1.0, number, cycle };
            run.press_start(&mut system, &mut going, &segment)
        };
        match left {
            Err(Leave::Failed(error)) => return Err(error),
            Err(Leave::Interrupted) if !goes_on() => return Ok(None),
            Ok(()) | Err(Leave::Interrupted | Leave::Stopped(_)) => {}
        }
        Ok(Some(Present {
            time: at,
            wear: going.stepper.wear,
            pressure: system.pressure,
            solution: system.solution,
            state: system.state,
            distance: system.distance,
            uniform_distance: system.uniform_distance,
            step,
            number,
            cycle,
        }))
    }
}

/// Duration of some load steps.
fn period(steps: &[LoadStep]) -> f64 {
    steps.iter().filter_map(|step| step.duration).sum()
}

/// The loading at a represented time, held as it is then, with the numbers of its load step and cycle; where one load step
/// follows another, the one that ends. `None` outside the loading.
fn loading_at(plan: &Plan, at: f64) -> Option<(LoadStep, i64, i64)> {
    let (mut begin, mut first, mut cycles) = (0.0, 0, 0);
    for block in &plan.blocks {
        let (period, count) = (period(&block.steps), block.count as f64);
        let near = 1e-12 * at.abs();
        if at >= 0.0 && at <= begin + count * period + near {
            let round = if period > 0.0 { ((at - begin) / period).ceil() - 1.0 } else { 0.0 };
            let round = round.clamp(0.0, count - 1.0);
            let mut from = begin + round * period;
            for (index, step) in block.steps.iter().enumerate() {
                let step = if round == 0.0 && index == 0 { &block.entry } else { step };
                let length = step.duration.unwrap_or(0.0);
                if at <= from + length + near || index + 1 == block.steps.len() {
                    let part = if length > 0.0 { ((at - from) / length).clamp(0.0, 1.0) } else { 1.0 };
                    let cycle = if block.cycle { cycles + round as i64 + 1 } else { 0 };
                    return Some((held(step, part), first + index as i64 + 1, cycle));
                }
                from += length;
            }
        }
        begin += count * period;
        first += block.steps.len() as i64;
        cycles += if block.cycle { block.count as i64 } else { 0 };
    }
    None
}

/// A load step whose quantities stay as they are at a part of it.
fn held(step: &LoadStep, part: f64) -> LoadStep {
    let hold = |line: Option<Linear>| line.map(|line| Linear { from: line.at(part), to: line.at(part) });
    LoadStep {
        duration: None,
        pressure: hold(step.pressure),
        load: hold(step.load),
        approach: hold(step.approach),
        velocity: hold(step.velocity),
        temperature: hold(step.temperature),
        friction: hold(step.friction),
        ..*step
    }
}
