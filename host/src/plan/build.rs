//! From a scene and a law to a plan.

use serde::Serialize;

use crate::contact::prescribed::{Column, Header, Motion, Needs};
use crate::integrator::quadrature::Quadrature;
use crate::law::{Fields, LawDescriptor, UnitSizes};
use crate::plan::needs::Setting;
use crate::plan::output::{self, OutputPlan, ReferencePlan};
use crate::plan::{Advance, Block, Material, PlanError, PlanProblem, SolvedPlan, advance, loading};
use crate::scene::{Accuracy, Integrator, Model, ScalingKind, Scene, Stop, Units};

/// Something that is left out, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Skipped {
    /// What.
    pub what: String,
    /// Why.
    pub why: String,
}

impl Skipped {
    pub(super) fn new(what: &str, why: &str) -> Skipped {
        Skipped { what: what.to_owned(), why: why.to_owned() }
    }
}

/// Everything that a run needs to know, resolved; numbers in the scene's units.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Title of the scene.
    pub title: Option<String>,
    /// 2 or 3.
    pub dimension: u8,
    /// Labels and sizes of the units.
    pub units: Units,
    /// SI sizes of the units, as laws see them.
    pub sizes: UnitSizes,
    /// Constants and the settings that C5 to C8 document.
    pub material: Material,
    /// Shares of wear of the wearing body and the counterbody, where they are asked for.
    pub share: Option<[f64; 2]>,
    /// Fields that are computed and passed to the law.
    pub fields: Fields,
    /// Column of every further input of the law; `None`: its default.
    pub inputs: Vec<Option<Column>>,
    /// Columns that are read from the history.
    pub columns: Needs,
    /// How the motion is given.
    pub motion: Motion,
    /// Whether temperatures are computed.
    pub temperature: bool,
    /// The history, if there is one.
    pub history: Option<std::path::PathBuf>,
    /// Friction coefficient that holds throughout, unless a load step gives another.
    pub friction: Option<f64>,
    /// The loading.
    pub blocks: Vec<Block>,
    /// The contact that answers back; `None`: pressure is prescribed.
    pub solved: Option<SolvedPlan>,
    /// How wear is advanced under a prescribed pressure.
    pub advance: Advance,
    /// Fixed substeps per load step, if they are fixed.
    pub substeps: Option<u64>,
    /// Relative error asked for, if it is.
    pub tolerance: Option<f64>,
    /// A law's wish for less than this is an error; 0: no limit.
    pub smallest_step: f64,
    /// Most substeps between two events of the loading.
    pub most_substeps: u64,
    /// Initial values of the state variables.
    pub initial_state: Vec<f64>,
    /// When to end early.
    pub stop: Stop,
    /// What is written.
    pub output: OutputPlan,
    /// What the result is compared with.
    pub reference: Option<ReferencePlan>,
    /// Largest error that passes, where the scene sets a bar.
    pub bar: Option<f64>,
    /// What will be computed, a line each.
    pub computed: Vec<String>,
    /// What will not, and why.
    pub skipped: Vec<Skipped>,
}

impl Plan {
    /// Resolves a scene for a law.
    ///
    /// # Errors
    /// Whatever the scene asks for and cannot have, with the place of the key.
    pub fn new(scene: &Scene, law: &LawDescriptor) -> Result<Plan, PlanError> {
        let sizes = scene.units.sizes();
        let sizes =
            UnitSizes { metre: sizes.metre, kilogram: sizes.kilogram, second: sizes.second, kelvin: sizes.kelvin };
        let material = Material::resolve(scene, law, sizes)?;
        check_scaling(scene, &material)?;
        let is_prescribed = matches!(scene.contact.model, Model::Prescribed(_));
        let history = match &scene.contact.model {
            Model::Prescribed(prescribed) => prescribed.history.as_ref().map(|path| scene.resolve(path)),
            Model::Foundation(_) | Model::HalfSpace(_) => None,
        };
        let header = history.as_ref().map(|path| Header::read(path)).transpose();
        let header = header.map_err(|problem| scene.error_at("contact.history", problem.into()))?;
        if let Some(header) = &header {
            // A misspelt name is the cause, a quantity that the law misses only what follows from it.
            let mut known = Needs::none();
            law.inputs.iter().for_each(|input| known.allow(&input.name));
            header.check_names(&known).map_err(|problem| scene.error_at("contact.history", problem.into()))?;
        }
        let (blocks, velocity_files) = loading::blocks(scene, header.as_ref())?;
        let output = OutputPlan::new(scene, law)?;
        let mut skipped = Vec::new();
        let (solved, advance, how) = if is_prescribed {
            let (advance, how) = advance::choose(scene, law)?;
            (None, advance, how)
        } else {
            let (solved, how) = SolvedPlan::new(scene, law, &material, velocity_files)?;
            solved.skipped(law, &material, &mut skipped);
            (Some(solved), Advance::Rate(Quadrature::Fixed), how)
        };
        let setting =
            Setting { scene, law, header: header.as_ref(), blocks: &blocks, material: &material, output: &output };
        let needed = match is_prescribed {
            true => setting.resolve(&mut skipped)?,
            false => setting.resolve_solved(&mut skipped)?,
        };
        if let Some(header) = &header {
            header.check(&needed.columns).map_err(|problem| scene.error_at("contact.history", problem.into()))?;
        }
        if material.direction.is_some() && law.writes(crate::law::OutputItem::Direction) {
            let problem = PlanProblem::DirectionTwice { law: law.name.clone() };
            return Err(scene.error_at("law.direction", problem));
        }
        let computed = computed(law, &material, &needed.fields, how, scene);
        let (substeps, tolerance) = match scene.integrator.accuracy {
            Accuracy::Substeps(substeps) => (Some(substeps), None),
            Accuracy::Tolerance(tolerance) => (None, Some(tolerance)),
        };
        Ok(Plan {
            title: scene.title.clone(),
            dimension: scene.contact.dimension,
            units: scene.units.clone(),
            sizes,
            share: scene.law.share,
            fields: needed.fields,
            inputs: needed.inputs,
            columns: needed.columns,
            motion: needed.motion,
            temperature: needed.temperature,
            history,
            friction: scene.contact.friction,
            blocks,
            solved,
            advance,
            substeps,
            tolerance,
            smallest_step: scene.integrator.smallest_step.unwrap_or(0.0),
            most_substeps: scene.integrator.most_substeps.unwrap_or(Integrator::MOST_SUBSTEPS),
            initial_state: initial_state(scene, law, sizes)?,
            stop: scene.stop.clone(),
            reference: output::reference(scene)?,
            bar: scene.reference.as_ref().and_then(|reference| reference.bar),
            output,
            material,
            computed,
            skipped,
        })
    }
}

/// Refuses scaling where it has no meaning.
fn check_scaling(scene: &Scene, material: &Material) -> Result<(), PlanError> {
    if material.scaling.kind != ScalingKind::Auto {
        return Ok(());
    }
    if matches!(scene.contact.model, Model::Prescribed(_)) {
        return Err(scene.error_at("scaling.kind", PlanProblem::ScalingOfPrescribed));
    }
    if matches!(scene.integrator.accuracy, Accuracy::Tolerance(_)) {
        return Err(scene.error_at("scaling.kind", PlanProblem::ScalingNeedsSubsteps));
    }
    let steps = scene.steps.iter().chain(scene.cycles.iter().flat_map(|cycle| &cycle.steps));
    if steps.into_iter().any(|step| !step.ramp.is_empty()) {
        return Err(scene.error_at("scaling.kind", PlanProblem::ScalingOfRamp));
    }
    Ok(())
}

fn initial_state(scene: &Scene, law: &LawDescriptor, sizes: UnitSizes) -> Result<Vec<f64>, PlanError> {
    let of = |variable: &crate::law::Quantity| match variable.default {
        Some(value) => Ok(value / sizes.factor(variable.exponents)),
        None => {
            let problem = PlanProblem::NoInitialState { law: law.name.clone(), name: variable.name.clone() };
            Err(scene.error_at("law.use", problem))
        }
    };
    law.state.iter().map(of).collect()
}

fn computed(law: &LawDescriptor, material: &Material, fields: &Fields, how: String, scene: &Scene) -> Vec<String> {
    let mut lines = vec![format!("wear depth by law `{}`: {}", law.name, law.summary)];
    let names: Vec<String> = fields.iter().map(|field| format!("`{}`", field.name())).collect();
    lines.push(format!("passed to the law at every point: {}", names.join(", ")));
    lines.push(format!("time: {how}"));
    let table = &material.constants;
    match (table.varies_in_time(), table.varies_in_temperature()) {
        (false, false) => {}
        (true, false) => lines.push("constants: interpolated in time at every evaluation".to_owned()),
        (false, true) => lines.push("constants: interpolated in temperature at every point".to_owned()),
        (true, true) => lines.push("constants: interpolated in time and temperature at every point".to_owned()),
    }
    if material.basis == crate::scene::Basis::NodalStress {
        lines.push("pressure: the normal traction of nodal stresses, max(0, -n.sigma.n)".to_owned());
    }
    if material.average {
        lines.push("wear increment: averaged over the points in contact, by area where areas are given".to_owned());
    }
    if material.mode == crate::scene::Mode::Post {
        lines.push("wear for postprocessing only (a prescribed pressure never moves anyway)".to_owned());
    }
    if let Some([x, y, z]) = material.direction {
        lines.push(format!("wear direction: ({x}, {y}, {z}) for every point"));
    }
    if let Some([own, other]) = scene.law.share {
        lines.push(format!("wear is shared: {own} on the wearing body, {other} on the counterbody"));
    }
    if !law.state.is_empty() {
        lines.push(format!("state variables: {} at every point", law.state.len()));
    }
    lines
}
