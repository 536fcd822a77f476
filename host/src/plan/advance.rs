//! How wear is advanced in time, and why that way.

use crate::integrator::Rule;
use crate::integrator::quadrature::Quadrature;
use crate::integrator::substeps::Control;
use crate::law::{Claim, Field, LawDescriptor};
use crate::plan::{PlanError, PlanProblem};
use crate::scene::{Accuracy, Method, Scene};

/// Where in a substep the inputs of a whole-substep call are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// At its start.
    Start,
    /// In its middle: second order, and pressure that does not answer back asks for no more stability.
    Middle,
    /// At its end.
    End,
}

/// How wear is advanced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Advance {
    /// The law is a wear rate: quadrature in time.
    Rate(Quadrature),
    /// The law is called for whole substeps.
    Substeps(Control, Sample),
}

/// Part of the scene's tolerance that one piece may use: estimates of many pieces add up.
const SHARE: f64 = 0.5;

/// Picks how to advance, with a sentence that says what was picked and why.
///
/// # Errors
/// A second-order method asked for by name with a law that is no rate.
pub(super) fn choose(scene: &Scene, law: &LawDescriptor) -> Result<(Advance, String), PlanError> {
    let method = scene.integrator.method;
    let reason = match no_rate(law) {
        None => return Ok(rate(method, scene.integrator.accuracy)),
        Some(reason) => reason,
    };
    let sample = match method {
        Method::Auto => Sample::Middle,
        Method::ExplicitEuler => Sample::Start,
        Method::ImplicitEuler => Sample::End,
        Method::TrBdf2 | Method::Sdirk2 => {
            let method = if method == Method::TrBdf2 { "tr-bdf2" } else { "sdirk2" };
            let problem = PlanProblem::NeedsRate { method, law: law.name.clone(), reason };
            return Err(scene.error_at("integrator.method", problem));
        }
    };
    let (control, how) = match scene.integrator.accuracy {
        Accuracy::Tolerance(tolerance) => {
            (Control::Tolerance(SHARE * tolerance), format!("step doubling to a relative error of {tolerance:e}"))
        }
        Accuracy::Substeps(substeps) => (Control::Fixed, format!("{substeps} substeps per load step")),
    };
    let place = match sample {
        Sample::Start => "start",
        Sample::Middle => "middle",
        Sample::End => "end",
    };
    let text = format!("whole substeps with the inputs at their {place}, {how}, because the law {reason}");
    Ok((Advance::Substeps(control, sample), text))
}

/// Why a law is not a wear rate; `None` if it is one.
pub(super) fn no_rate(law: &LawDescriptor) -> Option<&'static str> {
    let fields = law.fields();
    if !law.state.is_empty() {
        Some("has state variables")
    } else if !law.claims(Claim::LinearInDt) {
        Some("does not claim to be linear in dt")
    } else if fields.contains(Field::AccumulatedWear) {
        Some("reads the accumulated wear")
    } else if fields.contains(Field::AccumulatedSlip) {
        Some("reads the accumulated slip")
    } else {
        None
    }
}

fn rate(method: Method, accuracy: Accuracy) -> (Advance, String) {
    let (name, rule) = match method {
        Method::Auto => ("Gauss-Kronrod quadrature", None),
        Method::ExplicitEuler => ("the rate at the start of each substep", Some(&Rule::EXPLICIT_EULER)),
        Method::ImplicitEuler => ("the rate at the end of each substep", Some(&Rule::IMPLICIT_EULER)),
        Method::TrBdf2 => ("the stages of TR-BDF2", Some(&Rule::TR_BDF2)),
        Method::Sdirk2 => ("the stages of SDIRK2", Some(&Rule::SDIRK2)),
    };
    let why = if rule.is_none() { ", because pressure is given and the law is a rate" } else { "" };
    match accuracy {
        Accuracy::Tolerance(tolerance) => {
            let part = SHARE * tolerance;
            let quadrature = rule.map_or(Quadrature::Adaptive(part), |rule| Quadrature::AdaptiveRule(rule, part));
            (Advance::Rate(quadrature), format!("{name} to a relative error of {tolerance:e}{why}"))
        }
        Accuracy::Substeps(substeps) => {
            let quadrature = rule.map_or(Quadrature::Fixed, Quadrature::FixedRule);
            (Advance::Rate(quadrature), format!("{name}, {substeps} substeps per load step{why}"))
        }
    }
}
