//! Load steps and cycles of a scene as plain numbers.

use std::path::PathBuf;

use crate::contact::prescribed::{Column, Header, Motion};
use crate::plan::{PlanError, PlanProblem};
use crate::scene::{Drive, Field, Model, Quantity, Scene, Sliding, Step};

/// A quantity that goes linearly from the start to the end of a load step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Value at the start.
    pub from: f64,
    /// Value at the end.
    pub to: f64,
}

impl Linear {
    /// Value at a fraction of the step.
    pub fn at(&self, part: f64) -> f64 {
        if self.from == self.to { self.from } else { self.from + part * (self.to - self.from) }
    }
}

/// One load step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoadStep {
    /// Its duration; `None`: to the end of the history.
    pub duration: Option<f64>,
    /// Contact pressure, the same at every point.
    pub pressure: Option<Linear>,
    /// Total load; per length in 2-D.
    pub load: Option<Linear>,
    /// Rigid-body approach.
    pub approach: Option<Linear>,
    /// Sliding velocity.
    pub velocity: Option<Linear>,
    /// Sliding velocities of the cells, by the index of their file.
    pub velocity_file: Option<usize>,
    /// Radius around the apex within which nothing slips.
    pub stick: Option<f64>,
    /// Temperature.
    pub temperature: Option<Linear>,
    /// Friction coefficient.
    pub friction: Option<Linear>,
}

impl LoadStep {
    /// A load step in which nothing happens.
    pub const NOTHING: LoadStep = LoadStep {
        duration: None,
        pressure: None,
        load: None,
        approach: None,
        velocity: None,
        velocity_file: None,
        stick: None,
        temperature: None,
        friction: None,
    };
}

/// Load steps that are gone through `count` times.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// How often.
    pub count: u64,
    /// Whether this is a `[[cycle]]`.
    pub cycle: bool,
    /// The first step of the first round: its ramps start from what came before the block.
    pub entry: LoadStep,
    /// The steps of every round; ramps of the first start from the last.
    pub steps: Vec<LoadStep>,
}

/// The blocks of a scene, in order.
///
/// # Errors
/// Loading that a prescribed scene cannot have.
pub(super) fn blocks(scene: &Scene, header: Option<&Header>) -> Result<(Vec<Block>, Vec<PathBuf>), PlanError> {
    if header.is_some() && !scene.cycles.is_empty() && !scene.steps.is_empty() {
        return Err(scene.error_at("cycle.0", PlanProblem::StepsAndCycles));
    }
    if let Some(header) = header {
        if scene.contact.friction.is_some() && header.has_column(Column::Friction) {
            let problem = PlanProblem::GivenTwice { key: "contact.friction".to_owned(), column: "friction" };
            return Err(scene.error_at("contact.friction", problem));
        }
        for (index, step) in scene.steps.iter().enumerate() {
            given_once(scene, header, &format!("step.{index}"), step)?;
        }
        for (outer, cycle) in scene.cycles.iter().enumerate() {
            for (index, step) in cycle.steps.iter().enumerate() {
                given_once(scene, header, &format!("cycle.{outer}.step.{index}"), step)?;
            }
        }
    }
    let mut blocks = Vec::new();
    let mut files = Vec::new();
    let mut before = Step::default();
    if !scene.steps.is_empty() || scene.cycles.is_empty() {
        let (entry, steps) = lower(scene, "step", &scene.steps, &mut before, &mut files)?;
        blocks.push(Block { count: 1, cycle: false, entry, steps });
    }
    for (index, cycle) in scene.cycles.iter().enumerate() {
        let base = format!("cycle.{index}.step");
        let (entry, steps) = lower(scene, &base, &cycle.steps, &mut before, &mut files)?;
        blocks.push(Block { count: cycle.count, cycle: true, entry, steps });
    }
    Ok((blocks, files))
}

/// Refuses a load step that gives what the history gives: one of them would be passed over in silence.
fn given_once(scene: &Scene, header: &Header, base: &str, step: &Step) -> Result<(), PlanError> {
    let motion = match header.motion() {
        Motion::None => None,
        Motion::Velocity => Some("velocity"),
        Motion::Slip => Some("slip"),
        Motion::SlipVector => Some("slip_x"),
    };
    let sliding = step.sliding.as_ref().map(|sliding| match sliding {
        Sliding::Velocity { .. } => "velocity",
        Sliding::Stroke { .. } => "stroke",
    });
    let warm = header.has_column(Column::Temperature).then_some("temperature");
    let rubbed = header.has_column(Column::Friction).then_some("friction");
    let (temperature, friction) = (step.temperature.map(|_| "temperature"), step.friction.map(|_| "friction"));
    for (key, column) in [(sliding, motion), (temperature, warm), (friction, rubbed)] {
        if let (Some(key), Some(column)) = (key, column) {
            let key = format!("{base}.{key}");
            return Err(scene.error_at(&key, PlanProblem::GivenTwice { key: key.clone(), column }));
        }
    }
    Ok(())
}

/// The first step as it follows what came before, and all steps as they follow each other.
fn lower(
    scene: &Scene,
    base: &str,
    steps: &[Step],
    before: &mut Step,
    files: &mut Vec<PathBuf>,
) -> Result<(LoadStep, Vec<LoadStep>), PlanError> {
    let file = |step: &Step| matches!(step.sliding, Some(Sliding::Velocity { velocity: Field::File(_) }));
    let prescribed = matches!(scene.contact.model, Model::Prescribed(_));
    if prescribed && let Some(index) = steps.iter().position(file) {
        return Err(scene.error_at(&format!("{base}.{index}.velocity"), PlanProblem::VelocityFile));
    }
    let (Some(first), Some(last)) = (steps.first(), steps.last()) else {
        return Ok((LoadStep::default(), vec![LoadStep::default()]));
    };
    let mut place = |step: &Step| match &step.sliding {
        Some(Sliding::Velocity { velocity: Field::File(path) }) => {
            let path = scene.resolve(path);
            let known = files.iter().position(|known| *known == path);
            Some(known.unwrap_or_else(|| {
                files.push(path);
                files.len() - 1
            }))
        }
        _ => None,
    };
    let entry = one(first, before, place(first));
    let previous = std::iter::once(last).chain(steps);
    let lowered = steps.iter().zip(previous).map(|(step, previous)| one(step, previous, place(step))).collect();
    *before = last.clone();
    Ok((entry, lowered))
}

/// One step after another; a ramp without a start begins at 0.
fn one(step: &Step, previous: &Step, velocity_file: Option<usize>) -> LoadStep {
    let linear = |quantity: Quantity| {
        let to = value(step, quantity)?;
        let ramped = step.ramp.contains(&quantity);
        Some(Linear { from: if ramped { value(previous, quantity).unwrap_or(0.0) } else { to }, to })
    };
    LoadStep {
        duration: step.duration,
        pressure: linear(Quantity::Pressure),
        load: linear(Quantity::Load),
        approach: linear(Quantity::Approach),
        velocity: linear(Quantity::Velocity),
        velocity_file,
        stick: step.stick,
        temperature: linear(Quantity::Temperature),
        friction: linear(Quantity::Friction),
    }
}

fn value(step: &Step, quantity: Quantity) -> Option<f64> {
    match quantity {
        Quantity::Pressure => match step.drive {
            Some(Drive::Pressure(pressure)) => Some(pressure),
            _ => None,
        },
        Quantity::Velocity => match step.sliding {
            Some(Sliding::Velocity { velocity: Field::Uniform(velocity) }) => Some(velocity),
            Some(Sliding::Stroke { stroke, frequency }) => Some(2.0 * stroke * frequency),
            _ => None,
        },
        Quantity::Temperature => step.temperature,
        Quantity::Friction => step.friction,
        Quantity::Load => match step.drive {
            Some(Drive::Load(load)) => Some(load),
            _ => None,
        },
        Quantity::Approach => match step.drive {
            Some(Drive::Approach(approach)) => Some(approach),
            _ => None,
        },
    }
}
