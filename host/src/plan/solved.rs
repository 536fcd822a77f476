//! What a scene with a contact that answers back comes to: cells, stiffness, surface and the way wear is advanced.

use std::path::PathBuf;

use crate::contact::Cells;
use crate::contact::surface::{Shape, Surface};
use crate::integrator::Formula;
use crate::law::{Claim, Degree, Field, LawDescriptor, OutputItem};
use crate::plan::machine_memory::machine_memory;
use crate::plan::{Material, PlanError, PlanProblem, Skipped};
use crate::scene::{Accuracy, Basis, BeyondLimit, Boundary, Method, Model, Scene};

/// The elastic model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Elastic {
    /// Independent springs of this stiffness; pressure per length.
    Foundation(f64),
    /// Half-space of this contact modulus.
    HalfSpace {
        /// E*; pressure.
        modulus: f64,
        /// Whether the grid repeats.
        periodic: bool,
        /// Distance at which the displacement of a free line contact is zero.
        datum: Option<f64>,
    },
}

/// How an implicit stage learns how the law answers to pressure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slope {
    /// The law is of pressure degree 1: one contact solve, no derivative.
    Proportional,
    /// The law's own derivative.
    Derivative,
    /// Difference quotients.
    Difference,
}

/// How wear is advanced on a contact that answers back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    /// The formula of a step.
    pub formula: Formula,
    /// Whether the law is called as a rate; else every call is one whole substep from the committed state.
    pub rate: bool,
    /// How a stage learns the law's slope.
    pub slope: Slope,
}

/// What a solved scene needs beyond what every scene has; numbers in the scene's units.
#[derive(Clone, Debug, PartialEq)]
pub struct SolvedPlan {
    /// The cells.
    pub cells: Cells,
    /// The elastic model.
    pub elastic: Elastic,
    /// Complementarity error of every contact solve.
    pub contact_tolerance: f64,
    /// The initial gap, its file resolved.
    pub surface: Surface,
    /// Files of velocities, which load steps name by index.
    pub velocity_files: Vec<PathBuf>,
    /// How wear is advanced.
    pub scheme: Scheme,
    /// What an explicit step over the stability limit does.
    pub beyond_limit: BeyondLimit,
}

impl SolvedPlan {
    /// Whether the grid repeats.
    pub fn is_periodic(&self) -> bool {
        matches!(self.elastic, Elastic::HalfSpace { periodic: true, .. })
    }

    /// Resolves the parts of a scene whose contact is solved; `velocity_files` come from its load steps.
    ///
    /// # Errors
    /// A method that the law cannot be advanced with.
    pub(super) fn new(
        scene: &Scene,
        law: &LawDescriptor,
        material: &Material,
        velocity_files: Vec<PathBuf>,
    ) -> Result<(SolvedPlan, String), PlanError> {
        let (elastic, contact_tolerance) = match &scene.contact.model {
            Model::HalfSpace(half_space) => (
                Elastic::HalfSpace {
                    modulus: half_space.elasticity.modulus(),
                    periodic: half_space.boundary == Boundary::Periodic,
                    datum: half_space.datum,
                },
                half_space.tolerance,
            ),
            Model::Foundation(foundation) => (Elastic::Foundation(foundation.stiffness), foundation.tolerance),
            Model::Prescribed(_) => (Elastic::Foundation(f64::INFINITY), Model::TOLERANCE),
        };
        let (scheme, how) = scheme(scene, law, material)?;
        let asked = scene.surface.as_ref();
        let center = asked.and_then(|surface| surface.center.as_ref());
        let center = center.map(|center| [center[0], center.get(1).copied().unwrap_or(0.5)]);
        let shape = asked.map_or(Shape::FlatPunch { width: f64::MAX }, |surface| shape(scene, &surface.shape));
        let plan = SolvedPlan {
            cells: checked_cells(scene)?,
            elastic,
            contact_tolerance,
            surface: Surface { shape, center },
            velocity_files,
            scheme,
            beyond_limit: scene.integrator.beyond_limit.unwrap_or_default(),
        };
        Ok((plan, how))
    }

    /// What is left out of a solved scene, and why.
    pub(super) fn skipped(&self, law: &LawDescriptor, material: &Material, skipped: &mut Vec<Skipped>) {
        match self.scheme.slope {
            Slope::Proportional => {
                skipped
                    .push(Skipped::new("derivatives", "the law is of pressure degree 1: one contact solve per stage"));
            }
            _ if self.scheme.formula == Formula::ExplicitEuler => {
                skipped.push(Skipped::new("derivatives", "explicit steps need none"));
            }
            _ => {}
        }
        if !law.wants_open_points() {
            skipped.push(Skipped::new("points out of contact", "the law does not ask for them: no call, no wear"));
        }
        if material.basis == Basis::Pressure && !law.fields().contains(Field::NodalTraction) {
            skipped.push(Skipped::new("nodal stresses", "wear is based on the contact pressure"));
        }
        if self.scheme.formula != Formula::ExplicitEuler {
            skipped.push(Skipped::new(
                "the stability estimate",
                "implicit steps have no limit (`wearlaw stability` measures it)",
            ));
        }
    }
}

/// Arrays of a number for each cell that any run holds: the gap at first and in a stage, wear and pressure each twice.
const ARRAYS: u64 = 6;

/// The cells, if the machine has memory for them.
fn checked_cells(scene: &Scene) -> Result<Cells, PlanError> {
    let cells = cells(scene);
    let [x, y] = cells.counts.map(|count| count as u64);
    let count = x.saturating_mul(y);
    let least = count.saturating_mul(ARRAYS * size_of::<f64>() as u64);
    match machine_memory() {
        Some(machine) if least > machine => {
            Err(scene.error_at("grid.cells", PlanProblem::TooManyCells { cells: count, least, machine }))
        }
        _ => Ok(cells),
    }
}

fn cells(scene: &Scene) -> Cells {
    let (size, counts) = match &scene.grid {
        Some(grid) => (grid.size.clone(), grid.cells.clone()),
        None => (vec![1.0], vec![1]),
    };
    let at = |axis: usize| (counts.get(axis).copied(), size.get(axis).copied());
    let [x, y] = [0, 1].map(|axis| match at(axis) {
        (Some(count), Some(size)) => (count, size / count as f64),
        _ => (1, 1.0),
    });
    Cells { dimension: scene.contact.dimension, counts: [x.0, y.0], spacing: [x.1, y.1] }
}

fn shape(scene: &Scene, shape: &crate::scene::Shape) -> Shape {
    use crate::scene::Shape as Asked;
    match shape {
        Asked::Sphere { radius } => Shape::Sphere { radius: *radius },
        Asked::Cylinder { radius } => Shape::Cylinder { radius: *radius },
        Asked::Cone { angle } => Shape::Cone { angle: *angle },
        Asked::FlatPunch { width } => Shape::FlatPunch { width: *width },
        Asked::Wavy { amplitude, waves } => Shape::Wavy {
            amplitude: *amplitude,
            waves: [waves.first().copied().unwrap_or(0), waves.get(1).copied().unwrap_or(0)],
        },
        Asked::Rough { hurst, rms_slope, roll_off, cut_off, seed } => {
            Shape::Rough { hurst: *hurst, rms_slope: *rms_slope, roll_off: *roll_off, cut_off: *cut_off, seed: *seed }
        }
        Asked::File { file } => Shape::File { path: scene.resolve(file) },
    }
}

/// Why a law is not a wear rate on a contact that answers back; `None` if it is one.
fn no_rate(law: &LawDescriptor) -> Option<&'static str> {
    super::advance::no_rate(law)
}

/// Whether the claimed pressure degree is this number throughout the table.
fn degree_is(law: &LawDescriptor, material: &Material, degree: f64) -> bool {
    match law.pressure_degree {
        Degree::Unclaimed => false,
        Degree::Value(value) => value == degree,
        Degree::Constant(index) => material.constants.is_always(index, degree),
    }
}

/// Quantities that the host derives from the pressure: a derivative with respect to the pressure alone is not total.
const DERIVED: [Field; 3] = [Field::FrictionStress, Field::FrictionWork, Field::NodalTraction];

fn scheme(scene: &Scene, law: &LawDescriptor, material: &Material) -> Result<(Scheme, String), PlanError> {
    let method = scene.integrator.method;
    let derived = DERIVED.iter().any(|field| law.fields().contains(*field));
    let slope = if degree_is(law, material, 1.0) && !derived {
        Slope::Proportional
    } else if law.writes(OutputItem::DPressure) && !derived {
        Slope::Derivative
    } else {
        Slope::Difference
    };
    let no_rate = no_rate(law);
    let whole = no_rate.or(material.average.then_some("is averaged over the contact, which is of first order"));
    let formula = match (method, whole) {
        (Method::Auto, None) => Formula::TrBdf2,
        (Method::Auto | Method::ImplicitEuler, _) => Formula::ImplicitEuler,
        (Method::ExplicitEuler, _) => Formula::ExplicitEuler,
        (Method::TrBdf2, None) => Formula::TrBdf2,
        (Method::Sdirk2, None) => Formula::Sdirk2,
        (Method::TrBdf2 | Method::Sdirk2, Some(reason)) => {
            let method = if method == Method::TrBdf2 { "tr-bdf2" } else { "sdirk2" };
            let problem = PlanProblem::NeedsRate { method, law: law.name.clone(), reason };
            return Err(scene.error_at("integrator.method", problem));
        }
    };
    let picked = match (method, whole) {
        (Method::Auto, None) => ", picked because the law is a rate: second order, stable at any step".to_owned(),
        (Method::Auto, Some(reason)) => format!(", picked because the law {reason}"),
        (_, Some(reason)) => format!(", in whole substeps because the law {reason}"),
        _ => String::new(),
    };
    let steps = match scene.integrator.accuracy {
        Accuracy::Tolerance(tolerance) => format!("steps of its own to a relative error of {tolerance:e}"),
        Accuracy::Substeps(substeps) => format!("{substeps} substeps per load step"),
    };
    let solves = match (formula, slope) {
        (Formula::ExplicitEuler, _) => "one contact solve per step",
        (_, Slope::Proportional) => "one contact solve per stage, because the law is of pressure degree 1",
        (_, Slope::Derivative) => "Newton's method on the law's derivative in every stage",
        (_, Slope::Difference) => "Newton's method on difference quotients in every stage",
    };
    let text = format!("{}{picked}; {steps}; {solves}", formula.name());
    // A law that is averaged is still asked as it is; what is left of it to the integrator is a whole substep.
    Ok((Scheme { formula, rate: no_rate.is_none() && law.claims(Claim::LinearInDt) && !material.average, slope }, text))
}
