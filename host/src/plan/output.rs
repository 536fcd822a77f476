//! What is written, and what the result is compared with.

use std::path::PathBuf;

use crate::law::{LawDescriptor, OutputItem};
use crate::plan::{PlanError, PlanProblem};
use crate::reference::NamedReference;
use crate::scene::{Every, Format, Scene, Target};

/// A field that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldKind {
    /// Contact pressure, or the traction that stands for it.
    Pressure,
    /// Wear depth.
    Wear,
    /// Sliding distance.
    SlidingDistance,
    /// Temperature.
    Temperature,
    /// Wear direction.
    Direction,
    /// State variable of the law, by its index.
    State(usize),
}

const NAMED: [(&str, FieldKind); 5] = [
    ("pressure", FieldKind::Pressure),
    ("wear", FieldKind::Wear),
    ("sliding_distance", FieldKind::SlidingDistance),
    ("temperature", FieldKind::Temperature),
    ("direction", FieldKind::Direction),
];

/// What is written during and after a run.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputPlan {
    /// Fields by the name the scene uses.
    pub fields: Vec<(String, FieldKind)>,
    /// When they are written.
    pub every: Every,
    /// In which formats.
    pub formats: Vec<Format>,
    /// Wall seconds between checkpoints; `None`: the last one only.
    pub checkpoint: Option<f64>,
    /// Whether the errors of steps and grid are estimated by further runs.
    pub error_estimate: bool,
}

/// What the result is compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferencePlan {
    /// A built-in exact answer.
    Exact(NamedReference),
    /// The same scene to a tighter tolerance.
    Refined,
    /// A table of wear depths.
    File(PathBuf),
}

impl OutputPlan {
    pub(super) fn new(scene: &Scene, law: &LawDescriptor) -> Result<OutputPlan, PlanError> {
        let mut fields = Vec::new();
        for (index, name) in scene.output.fields.iter().enumerate() {
            let named = NAMED.iter().find(|(known, _)| known == name).map(|(_, kind)| *kind);
            let state = law.state.iter().position(|variable| variable.name == *name).map(FieldKind::State);
            let Some(kind) = named.or(state) else {
                return Err(scene.error_at(&format!("output.fields.{index}"), unknown(name, law)));
            };
            if kind == FieldKind::Direction && !law.writes(OutputItem::Direction) {
                let reason = "the law keeps the default direction, or the one that `law.direction` gives";
                let problem = PlanProblem::FieldNotThere { field: name.clone(), reason };
                return Err(scene.error_at(&format!("output.fields.{index}"), problem));
            }
            fields.push((name.clone(), kind));
        }
        Ok(OutputPlan {
            fields,
            every: scene.output.every.clone(),
            formats: scene.output.formats.clone(),
            checkpoint: scene.output.checkpoint,
            error_estimate: scene.output.error_estimate,
        })
    }

    /// Whether a field of this kind is written.
    pub fn has(&self, kind: FieldKind) -> bool {
        self.fields.iter().any(|(_, known)| *known == kind)
    }
}

fn unknown(name: &str, law: &LawDescriptor) -> PlanProblem {
    let states = law.state.iter().map(|variable| variable.name.as_str());
    let known: Vec<&str> = NAMED.iter().map(|(known, _)| *known).chain(states).collect();
    let nearest = known
        .iter()
        .map(|known| (strsim::damerau_levenshtein(known, name), *known))
        .min()
        .filter(|(distance, _)| *distance <= 3)
        .map(|(_, known)| known.to_owned());
    PlanProblem::UnknownField { found: name.to_owned(), known: known.join(", "), nearest }
}

pub(super) fn reference(scene: &Scene) -> Result<Option<ReferencePlan>, PlanError> {
    let Some(reference) = &scene.reference else { return Ok(None) };
    Ok(Some(match &reference.target {
        Target::Refined => ReferencePlan::Refined,
        Target::File(path) => ReferencePlan::File(scene.resolve(path)),
        Target::Exact(kind) => match NamedReference::from_name(kind) {
            Some(named) => ReferencePlan::Exact(named),
            None => {
                let known: Vec<&str> = NamedReference::ALL.iter().map(|named| named.name()).collect();
                let nearest = NamedReference::nearest(kind).map(str::to_owned);
                let problem = PlanProblem::UnknownReference { found: kind.clone(), known: known.join(", "), nearest };
                return Err(scene.error_at("reference.kind", problem));
            }
        },
    }))
}
