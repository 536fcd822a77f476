//! Where a run is in its loading, and what it saves there to go on from.

use super::controlled::Again;
use super::going::Going;
use super::limit::Watch;
use super::rows::Clock;
use super::system::System;
use crate::contact::{Control as Pressing, Solution};
use crate::integrator::Formula;
use crate::law::Evaluator;
use crate::plan::{Block, FieldKind, Plan};
use crate::record::{Checkpoint, CheckpointError, Event};

/// A place in the loading: everything that the loops over blocks, rounds, load steps and substeps keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) block: usize,
    /// Rounds of the block that are done before this one; represented.
    pub(super) done: f64,
    /// Rounds that this one stands for.
    pub(super) scale: f64,
    /// Represented cycles before this round.
    pub(super) before: f64,
    /// Relative change of pressure by wear, summed over this round.
    pub(super) change: f64,
    /// Index of the load step in the block; behind the last: the round is over.
    pub(super) step: usize,
    /// Whether that load step has begun.
    pub(super) entered: bool,
    /// Simulated and represented time at the start of the load step that began last, and its simulated length.
    pub(super) start: f64,
    pub(super) represented: f64,
    pub(super) length: f64,
    /// Simulated time in it.
    pub(super) at: f64,
    /// Substeps done in it.
    pub(super) number: i64,
    /// Factor of its next substep, where substeps are scaled.
    pub(super) stretch: f64,
}

impl Place {
    pub(super) const START: Place = Place {
        block: 0,
        done: 0.0,
        scale: 1.0,
        before: 0.0,
        change: 0.0,
        step: 0,
        entered: false,
        start: 0.0,
        represented: 0.0,
        length: 0.0,
        at: 0.0,
        number: 0,
        stretch: 1.0,
    };

    const NAMES: [&'static str; 13] = [
        "place.block",
        "place.done",
        "place.scale",
        "place.before",
        "place.change",
        "place.step",
        "place.entered",
        "place.start",
        "place.represented",
        "place.length",
        "place.at",
        "place.number",
        "place.stretch",
    ];

    fn save(&self, to: &mut Checkpoint<'_>) {
        let values = [
            self.block as f64,
            self.done,
            self.scale,
            self.before,
            self.change,
            self.step as f64,
            f64::from(u8::from(self.entered)),
            self.start,
            self.represented,
            self.length,
            self.at,
            self.number as f64,
            self.stretch,
        ];
        Place::NAMES.iter().zip(values).for_each(|(name, value)| to.set(name, value));
    }

    fn load(from: &Checkpoint<'_>, blocks: &[Block]) -> Result<Place, CheckpointError> {
        let mut values = [0.0; 13];
        for (name, value) in Place::NAMES.iter().zip(&mut values) {
            *value = from.number(name)?;
        }
        let [block, done, scale, before, change, step, entered, start, represented, length, at, number, stretch] =
            values;
        let mut place = Place {
            block: block as usize,
            done,
            scale,
            before,
            change,
            step: step as usize,
            entered: entered > 0.0,
            start,
            represented,
            length,
            at,
            number: number as i64,
            stretch,
        };
        let steps = blocks.get(place.block).map(|block| block.steps.len());
        if !steps.is_some_and(|steps| place.step < steps || (place.step == steps && !place.entered)) {
            let found = format!("load step {} of block {}", place.step + 1, place.block + 1);
            return Err(CheckpointError::Place { found });
        }
        // The last load step of a scene may have become longer: then it is not over.
        let block = &blocks[place.block];
        if !block.cycle && !place.entered && place.step > 0 {
            let longer = block.steps[place.step - 1].duration.unwrap_or(0.0) > place.length;
            if longer {
                place.step -= 1;
                place.entered = true;
            }
        }
        Ok(place)
    }
}

/// What is saved of the steps that are still to be gone through again.
type OfAgain = fn(&Again) -> f64;
const AGAIN: [(&str, OfAgain); 3] = [
    ("again.until", |step| step.until),
    ("again.length", |step| step.length),
    ("again.rejected", |step| step.rejected as f64),
];

/// The ways in which the bodies can be pressed together, as numbers.
fn control_numbers(control: Option<Pressing>) -> (f64, f64) {
    match control {
        None => (0.0, 0.0),
        Some(Pressing::Load(load)) => (1.0, load),
        Some(Pressing::Approach(approach)) => (2.0, approach),
    }
}

fn control_of(kind: f64, value: f64) -> Option<Pressing> {
    match kind as u8 {
        1 => Some(Pressing::Load(value)),
        2 => Some(Pressing::Approach(value)),
        _ => None,
    }
}

impl Going<'_> {
    /// Tells of a checkpoint if one is wanted; `last`: the run ends here.
    pub(super) fn offer(&mut self, system: &System<'_>, evaluator: &dyn Evaluator, last: bool) {
        if !self.observer.wants_checkpoint(last) {
            return;
        }
        for aside in evaluator.take_warnings() {
            if !self.asides.contains(&aside) {
                self.asides.push(aside);
            }
        }
        let cost = self.cost(system);
        let mut checkpoint = Checkpoint {
            time: self.clock.represented,
            history: std::borrow::Cow::Borrowed(&self.history),
            warnings: self.warnings[..].into(),
            asides: self.asides[..].into(),
            cost,
            ..Checkpoint::default()
        };
        let to = &mut checkpoint;
        self.place.save(to);
        if system.solved.scheme.formula == Formula::ExplicitEuler {
            self.watch.save(to);
        }
        let flag = |on: bool| f64::from(u8::from(on));
        let Clock { simulated, represented, cycles, temperature } = self.clock;
        let (pressed, pressed_by) = control_numbers(self.pressed);
        let (steady, steady_by) = control_numbers(system.steady);
        let Solution { approach, load, error, .. } = system.solution;
        let numbers = [
            ("clock.simulated", simulated),
            ("clock.represented", represented),
            ("clock.cycles", cycles),
            ("clock.temperature", temperature),
            ("replaced", self.replaced as f64),
            ("control.steps", self.control.steps as f64),
            ("control.error", self.control.error),
            ("control.sum_error", self.control.sum_error),
            ("control.pressure_error", self.control.pressure_error.unwrap_or(-1.0)),
            ("longest", self.longest),
            ("snapshot_told", flag(self.snapshot_told)),
            ("pressed", pressed),
            ("pressed.by", pressed_by),
            ("steady", steady),
            ("steady.by", steady_by),
            ("solution.approach", approach),
            ("solution.load", load),
            ("solution.error", error),
            ("uniform_distance", system.uniform_distance),
            ("newton_iterations", system.work.newton_iterations as f64),
            ("fresh", flag(self.stepper.fresh)),
        ];
        numbers.into_iter().for_each(|(name, value)| to.set(name, value));
        for (name, of) in AGAIN {
            to.put(name, self.again.iter().map(of).collect::<Vec<f64>>());
        }
        to.put("wear", &self.stepper.wear[..]);
        to.put("pressure", &system.pressure[..]);
        to.put("start_pressure", &self.start_pressure[..]);
        if self.stepper.fresh {
            to.put("rate", self.stepper.rate());
        }
        for (name, data) in [("state", &system.state), ("distance", &system.distance)] {
            if !data.is_empty() {
                to.put(name, &data[..]);
            }
        }
        // The directions of the last call, for fields that are written where the run ends.
        if system.plan.output.has(FieldKind::Direction) {
            to.put("direction.cells", system.room.cells.iter().map(|cell| f64::from(*cell)).collect::<Vec<f64>>());
            to.put("direction", &system.law.direction[..]);
        }
        self.observer.observe(Event::Checkpoint { checkpoint: to, last });
    }

    /// Takes up a checkpoint; `system` is as new.
    ///
    /// # Errors
    /// A checkpoint that is not of this plan.
    pub(super) fn take_up(
        &mut self,
        system: &mut System<'_>,
        plan: &Plan,
        from: &Checkpoint<'_>,
    ) -> Result<(), CheckpointError> {
        self.place = Place::load(from, &plan.blocks)?;
        self.clock = Clock {
            simulated: from.number("clock.simulated")?,
            represented: from.number("clock.represented")?,
            cycles: from.number("clock.cycles")?,
            temperature: from.number("clock.temperature")?,
        };
        if system.solved.scheme.formula == Formula::ExplicitEuler {
            self.watch = Watch::load(from, system.pressure.len())?;
        }
        self.history = (*from.history).clone();
        self.warnings = from.warnings.to_vec();
        self.asides = from.asides.to_vec();
        self.replaced = from.number("replaced")? as u64;
        self.control.steps = (from.number("control.steps")? as u64).max(1);
        self.control.error = from.number("control.error")?;
        self.control.sum_error = from.number("control.sum_error")?;
        self.control.pressure_error = Some(from.number("control.pressure_error")?).filter(|error| *error >= 0.0);
        let [until, length, rejected] = AGAIN.map(|(name, _)| from.array(name));
        let (until, length, rejected) = (until?, length?, rejected?);
        self.again = std::iter::zip(until, std::iter::zip(length, rejected))
            .map(|(until, (length, rejected))| Again { until: *until, length: *length, rejected: *rejected as u64 })
            .collect();
        self.longest = from.number("longest")?;
        self.snapshot_told = from.number("snapshot_told")? > 0.0;
        self.pressed = control_of(from.number("pressed")?, from.number("pressed.by")?);
        system.steady = control_of(from.number("steady")?, from.number("steady.by")?);
        system.solution = Solution {
            approach: from.number("solution.approach")?,
            load: from.number("solution.load")?,
            error: from.number("solution.error")?,
            ..Solution::default()
        };
        system.uniform_distance = from.number("uniform_distance")?;
        system.work.newton_iterations = from.number("newton_iterations")? as u64;
        from.copy("wear", &mut self.stepper.wear)?;
        from.copy("pressure", &mut system.pressure)?;
        self.start_pressure = from.array("start_pressure")?.to_vec();
        let fresh = from.number("fresh")? > 0.0;
        if fresh {
            from.copy("rate", self.stepper.rate_mut())?;
        }
        self.stepper.fresh = fresh;
        for (name, data) in [("state", &mut system.state), ("distance", &mut system.distance)] {
            if !data.is_empty() {
                from.copy(name, data)?;
            }
        }
        if plan.output.has(FieldKind::Direction) {
            let cells = from.array("direction.cells")?;
            let inside = |cell: &f64| *cell >= 0.0 && *cell < system.pressure.len() as f64;
            if !cells.iter().all(inside) {
                return Err(CheckpointError::Place { found: "a cell that the grid does not have".to_owned() });
            }
            system.room.cells = cells.iter().map(|cell| *cell as u32).collect();
            system.law.direction = from.array("direction")?.to_vec();
        }
        self.spent = from.cost;
        self.steps = from.cost.steps;
        self.rejected = from.cost.rejected_steps;
        Ok(())
    }
}
