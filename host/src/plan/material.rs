//! From what a scene or a deck gives to the law's constants and the host's settings for it.

use serde::Serialize;

use crate::apdl::{Deck, LawOption, ScalingKind as DeckScaling, WearMaterial};
use crate::law::{GivenConstants, LawDescriptor, UnitSizes};
use crate::plan::constants::{ConstantTable, Row};
use crate::plan::{PlanError, PlanProblem};
use crate::scene::documented::{Controls, controls};
use crate::scene::{Basis, Constants, Mode, Scaling, ScalingKind, Scene};

/// Constants of the Archard law proper; what follows by position are settings of the host.
const ARCHARD_CONSTANTS: usize = 4;

/// What the law is driven with and what becomes of its wear.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The law's constants over time and temperature.
    pub constants: ConstantTable,
    /// Contact pressure or nodal stresses.
    pub basis: Basis,
    /// Whether the increment is averaged over the contact area.
    pub average: bool,
    /// Whether wear moves the surface.
    pub mode: Mode,
    /// Unit vector in which material goes; `None`: against the normal, or as the law says.
    pub direction: Option<[f64; 3]>,
    /// Scaling of the wear increment.
    pub scaling: ScalingPlan,
    /// Number of the material, for the law to know.
    pub number: i64,
}

/// Scaling of the wear increment, resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalingPlan {
    /// Which scaling.
    pub kind: ScalingKind,
    /// Safety factor C1, above 0 and below 1.
    pub safety: f64,
    /// Largest factor C2, at least 1.
    pub maximum: f64,
}

impl ScalingPlan {
    /// The factor on wear where one unscaled substep or cycle changes the pressure by the part `change`:
    /// s = clamp(C1 / change, 1, C2), so that a scaled one changes it by at most C1.
    ///
    /// The public documents of TB,WEAR with AUTS and CBCS give the two constants and not the rule; this one is ours.
    pub fn factor(&self, change: f64) -> f64 {
        if change > 0.0 { (self.safety / change).clamp(1.0, self.maximum) } else { self.maximum }
    }
}

struct Given {
    rows: Vec<Row>,
    controls: Controls,
    scaling: Option<Scaling>,
    number: i64,
    place: &'static str,
}

impl Material {
    /// Resolves constants, controls and scaling of a scene for a law.
    ///
    /// # Errors
    /// Constants that the law does not take, settings that contradict each other, a deck that cannot be read.
    pub fn resolve(scene: &Scene, law: &LawDescriptor, units: UnitSizes) -> Result<Material, PlanError> {
        let given = match &scene.law.apdl {
            Some(path) => from_deck(scene, law, units, path)?,
            None => from_scene(scene, law, units)?,
        };
        let documented = given.controls;
        let place = given.place;
        let basis = settle(scene, "law.basis", scene.law.basis, documented.basis, place)?;
        let average = settle(scene, "law.average", scene.law.average, documented.average, place)?;
        let mode = settle(scene, "law.mode", scene.law.mode, documented.mode, place)?;
        let direction =
            settle(scene, "law.direction", scene.law.direction.map(unit), documented.direction.map(unit), place)?;
        let stated = given.scaling.unwrap_or_default();
        let kind = settle(scene, "scaling.kind", scene.scaling.kind, stated.kind, place)?;
        let safety = settle(scene, "scaling.safety", scene.scaling.safety, stated.safety, place)?;
        let maximum = settle(scene, "scaling.maximum", scene.scaling.maximum, stated.maximum, place)?;
        Ok(Material {
            constants: ConstantTable::new(&given.rows),
            basis: basis.unwrap_or_default(),
            average: average.unwrap_or(false),
            mode: mode.unwrap_or_default(),
            direction,
            scaling: ScalingPlan {
                kind: kind.unwrap_or_default(),
                safety: safety.unwrap_or(Scaling::SAFETY),
                maximum: maximum.unwrap_or(Scaling::MAXIMUM),
            },
            number: given.number,
        })
    }
}

/// The one value that the scene and another place agree on.
fn settle<T: PartialEq + Serialize + Copy>(
    scene: &Scene,
    key: &'static str,
    ours: Option<T>,
    theirs: Option<T>,
    place: &'static str,
) -> Result<Option<T>, PlanError> {
    match (ours, theirs) {
        (Some(a), Some(b)) if a != b => {
            let (a, b) = (as_written(&a), as_written(&b));
            Err(scene.error_at(key, PlanProblem::Both { key, scene: a, other: b, place }))
        }
        _ => Ok(ours.or(theirs)),
    }
}

/// A value as a scene would have it.
fn as_written(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// A vector scaled to length 1; already checked not to be zero.
fn unit(given: [f64; 3]) -> [f64; 3] {
    let largest = given.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let scaled = given.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    scaled.map(|x| x / length)
}

fn from_scene(scene: &Scene, law: &LawDescriptor, units: UnitSizes) -> Result<Given, PlanError> {
    let section = &scene.law;
    let place = "C5 to C8 of `law.constants`";
    let mut given = Given { rows: Vec::new(), controls: Controls::default(), scaling: None, number: 1, place };
    let nothing = Constants::ByPosition(Vec::new());
    if section.table.is_empty() {
        let constants = section.constants.as_ref().unwrap_or(&nothing);
        let (values, controls) = row_of(scene, law, units, "law.constants", constants)?;
        given.rows.push(Row { time: None, temperature: None, constants: values });
        given.controls = controls;
    }
    for (index, row) in section.table.iter().enumerate() {
        let key = format!("law.table.{index}.constants");
        let (values, controls) = row_of(scene, law, units, &key, &row.constants)?;
        if index > 0 && !controls.same_meaning(&given.controls) {
            return Err(scene.error_at(&key, PlanProblem::ControlsDiffer { row: index + 1 }));
        }
        given.controls = controls;
        given.rows.push(Row { time: row.time, temperature: row.temperature, constants: values });
    }
    Ok(given)
}

fn row_of(
    scene: &Scene,
    law: &LawDescriptor,
    units: UnitSizes,
    key: &str,
    constants: &Constants,
) -> Result<(Vec<f64>, Controls), PlanError> {
    match constants {
        Constants::ByName(named) => {
            let pairs: Vec<(String, f64)> = named.iter().map(|(name, value)| (name.clone(), *value)).collect();
            let values = law.resolve_constants(GivenConstants::ByName(&pairs), units);
            let values = values.map_err(|problem| {
                let key = problem.constant().map_or_else(|| key.to_owned(), |name| format!("{key}.{name}"));
                scene.error_at(&key, problem.into())
            })?;
            Ok((values, Controls::default()))
        }
        Constants::ByPosition(list) => {
            let list: Vec<Option<f64>> = list.iter().copied().map(Some).collect();
            positioned(scene, law, units, key, &list)
        }
    }
}

/// Constants by position; for `archard` the documented C5 to C8 follow the law's own four.
fn positioned(
    scene: &Scene,
    law: &LawDescriptor,
    units: UnitSizes,
    key: &str,
    list: &[Option<f64>],
) -> Result<(Vec<f64>, Controls), PlanError> {
    let archard = law.name == "archard" && law.constants.len() == ARCHARD_CONSTANTS;
    let (own, settings) = if archard && list.len() > ARCHARD_CONSTANTS {
        let settings = controls(list).map_err(|problem| scene.error_at(key, problem.into()))?;
        (&list[..ARCHARD_CONSTANTS], settings)
    } else {
        (list, Controls::default())
    };
    let values = law.resolve_constants(GivenConstants::ByPosition(own), units);
    Ok((values.map_err(|problem| scene.error_at(key, problem.into()))?, settings))
}

fn from_deck(scene: &Scene, law: &LawDescriptor, units: UnitSizes, path: &std::path::Path) -> Result<Given, PlanError> {
    let at = |problem: PlanProblem| scene.error_at("law.apdl", problem);
    let deck = Deck::read(&scene.resolve(path)).map_err(|problem| at(problem.into()))?;
    let chosen = scene.law.material.map(|number| i64::try_from(number).unwrap_or(i64::MAX));
    let material = deck.material(chosen).map_err(|problem| at(problem.into()))?;
    if material.option == LawOption::Archard && law.name != "archard" {
        return Err(at(PlanProblem::OtherLaw { material: material.id, law: law.name.clone() }));
    }
    let place = "the deck of `law.apdl`";
    let mut given =
        Given { rows: Vec::new(), controls: Controls::default(), scaling: None, number: material.id, place };
    for (index, row) in material.tables.iter().enumerate() {
        let (values, controls) = positioned(scene, law, units, "law.apdl", &row.constants)?;
        if index > 0 && !controls.same_meaning(&given.controls) {
            return Err(at(PlanProblem::ControlsDiffer { row: index + 1 }));
        }
        given.controls = controls;
        given.rows.push(Row { time: row.time, temperature: row.temperature, constants: values });
    }
    if given.rows.is_empty() {
        let (values, _) = positioned(scene, law, units, "law.apdl", &[])?;
        given.rows.push(Row { time: None, temperature: None, constants: values });
    }
    given.scaling = scaling_of(material);
    Ok(given)
}

fn scaling_of(material: &WearMaterial) -> Option<Scaling> {
    material.scaling.as_ref().map(|scaling| Scaling {
        kind: Some(match scaling.kind {
            DeckScaling::Auto => ScalingKind::Auto,
            DeckScaling::Cycle => ScalingKind::Cycle,
        }),
        safety: Some(scaling.safety),
        maximum: Some(scaling.maximum),
    })
}
