//! Whether a scene itself shows why it could not be done, without a look at how the program found out.

use wearlaw::contact::ContactError;
use wearlaw::integrator::AdvanceError;
use wearlaw::plan::{Elastic, Plan, PlanError, PlanProblem};
use wearlaw::record::Record;
use wearlaw::scene::ScalingKind;
use wearlaw::solve::{PointError, SolveError};

use crate::conditions;
use crate::draw::{Drawn, Law};

/// A word for an error that the scene explains; none: it is a fault of the program.
pub fn explained(error: &SolveError, plan: &Plan, record: &Record<SolveError>, drawn: &Drawn) -> Option<&'static str> {
    let time = record.history.last().map_or(0.0, |row| row.time);
    match error {
        SolveError::Advance { source, .. } => match &**source {
            AdvanceError::Evaluate(PointError::Contact(ContactError::NoSolution { .. })) => {
                beyond_full_contact(plan, drawn).then_some("approach beyond full contact")
            }
            AdvanceError::Evaluate(PointError::NotMonotone { .. } | PointError::Law(_)) => {
                (drawn.law == Law::Archard(-0.5)).then_some("a law that falls with pressure")
            }
            AdvanceError::ManySubsteps { .. } | AdvanceError::Stalled { .. } => {
                let limited = drawn.beyond_limit == "substep" || !drawn.fixed && drawn.method == "explicit-euler";
                let limit = if limited { limit_at_least(plan, record, drawn) } else { f64::INFINITY };
                let patience = if drawn.law == Law::Impatient { drawn.patience } else { f64::INFINITY };
                // A pass is followed by one in up to three times as many steps.
                let many = longest(plan) / limit.min(patience) >= plan.most_substeps as f64 / 3.0;
                many.then_some("explicit steps, or those of the law's wishes, too short to be few")
            }
            _ => None,
        },
        SolveError::BeyondLimit { step, .. } => {
            let refuses = drawn.method == "explicit-euler" && drawn.beyond_limit == "refuse";
            (refuses && *step >= limit_at_least(plan, record, drawn)).then_some("an explicit step beyond the limit")
        }
        SolveError::DomainFull { .. } => rim_is_full(plan, record).then_some("contact over all of the rim"),
        _ => None,
    }
    .filter(|_| time.is_finite())
}

/// A plan that is refused for what the scene asks: a second-order method by name for what has no stages, or factors for
/// substeps of no known length.
pub fn refused(error: &PlanError, drawn: &Drawn) -> Option<&'static str> {
    let named = matches!(drawn.method, "tr-bdf2" | "sdirk2");
    let whole = drawn.averaged || drawn.law == Law::RunningIn;
    let text = error.to_string();
    match &*error.problem {
        PlanProblem::ScalingNeedsSubsteps => (!drawn.fixed).then_some("automatic scaling without substeps"),
        _ if text.contains("integrator.method") => (named && whole).then_some("second order without stages"),
        _ => None,
    }
}

/// A periodic surface that an approach brings into full contact: with a mean gap of zero it has moved by no more.
fn beyond_full_contact(plan: &Plan, drawn: &Drawn) -> bool {
    let Some(solved) = &plan.solved else { return false };
    let gap = solved.surface.initial_gap(&solved.cells, drawn.periodic).unwrap_or_default();
    let mean = gap.iter().sum::<f64>() / gap.len() as f64;
    let steps = plan.blocks.iter().flat_map(|block| &block.steps);
    let highest = steps.filter_map(|step| step.approach).fold(0.0, |most: f64, line| most.max(line.from).max(line.to));
    drawn.periodic && highest >= mean * (1.0 - 1e-9)
}

/// Every cell of the rim of a free half-space's grid carries pressure, and the pressures are those of a contact.
fn rim_is_full(plan: &Plan, record: &Record<SolveError>) -> bool {
    let Some(solved) = &plan.solved else { return false };
    let [nx, ny] = solved.cells.counts;
    let rim = |cell: &usize| {
        let (x, y) = (cell % nx, cell / nx);
        x == 0 || x + 1 == nx || (solved.cells.dimension == 3 && (y == 0 || y + 1 == ny))
    };
    let free = matches!(solved.elastic, Elastic::HalfSpace { periodic: false, .. });
    free && (0..nx * ny).filter(rim).all(|cell| record.pressure[cell] > 0.0) && conditions::check(plan, record).is_ok()
}

fn longest(plan: &Plan) -> f64 {
    let steps = plan.blocks.iter().flat_map(|block| &block.steps);
    let longest = steps.filter_map(|step| step.duration).fold(0.0, f64::max);
    // A scaled substep stands for many.
    if plan.material.scaling.kind == ScalingKind::None { longest } else { 1e5 * longest }
}

/// The largest slope of the law in the pressure, per time, at the pressures of the record, and the largest eigenvalue of
/// the inverse compliance over the whole grid: 2 over their product is no more than any limit there.
fn limit_at_least(plan: &Plan, record: &Record<SolveError>, drawn: &Drawn) -> f64 {
    let Some(solved) = &plan.solved else { return 0.0 };
    let h = solved.cells.spacing[0].min(if drawn.flat { f64::INFINITY } else { solved.cells.spacing[1] });
    // Of the shortest waves: spectral, strips and patches of a square grid; oblong ones lie between that and strips.
    let stiffness = match solved.elastic {
        Elastic::Foundation(stiffness) => stiffness,
        Elastic::HalfSpace { modulus, periodic, .. } => {
            let factor = match (drawn.flat, periodic) {
                (true, true) => 1.570_797,
                (false, true) => 2.221_442,
                (true, false) => 1.346_89,
                (false, false) => 1.722_08,
            };
            factor * modulus / h
        }
    };
    2.0 / (slope(record, drawn) * stiffness) * (1.0 - 1e-3)
}

/// The largest slope of the wear rate of the law over the cells in contact, at a sliding speed no less than the scene's.
fn slope(record: &Record<SolveError>, drawn: &Drawn) -> f64 {
    let largest = record.pressure.iter().fold(0.0_f64, |most, p| most.max(*p));
    let smallest = record.pressure.iter().filter(|p| **p > 0.0).fold(largest, |least, p| least.min(*p));
    let k = drawn.coefficient * 1.5 * drawn.units.length / drawn.units.time;
    match drawn.law {
        // Nodal tractions fall below the pressures that they are means of.
        Law::Archard(m) if m < 1.0 => k * m * (0.01 * smallest).powf(m - 1.0),
        Law::Archard(m) => k * m * largest.powf(m - 1.0),
        _ => k,
    }
}
