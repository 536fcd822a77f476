//! How far the grid itself is off, whatever the steps in time.

use super::budget::Budget;
use super::cases::Found;
use super::frame::Fields;
use super::lines::Ground;
use super::setup::{How, Outcome, Setup};
use super::yardstick::Gauge;
use crate::law::Evaluator;
use crate::record::Errors;
use crate::reference::NamedReference;
use crate::scene::{Method, Target};

/// What is stated of a grid is so many times its difference to one of half the cells. An error that falls like sqrt(h), as
/// at the edge of a stick zone, differs by 0.41 of itself.
const CAUTION: f64 = 1.5;
/// The half grid needs no smaller tolerance than this.
const TOLERANCE: f64 = 1e-5;

/// The error of the scene's own grid, estimated from a grid of half the cells; `None`: it cannot be halved, or not in time.
pub(super) fn estimated(
    setup: &Setup<'_>,
    law: &dyn Evaluator,
    ground: &Ground<'_>,
    budget: &Budget,
    gauge: &Gauge,
) -> Option<Errors> {
    let mut overrides = ground.method(Method::Auto);
    overrides.push(format!("integrator.tolerance={:e}", gauge.tolerance?.max(TOLERANCE)));
    overrides.push(ground.half_grid()?);
    let Outcome::Ran(ran) = setup.run(law, &overrides, How { budget, until: 0.6, repeated: false, isolated: false })
    else {
        return None;
    };
    let half = super::frame::Frame::of(&ran.scene, &ran.record);
    let whole = gauge.frame.onto(&gauge.fields, &half)?;
    let mut errors = half.errors(&Fields::of(&ran.record), &whole);
    errors.values_mut().for_each(|error| *error *= CAUTION);
    Some(errors)
}

/// Whether the scene names an exact answer of the continuum, which tells what a grid is off by.
fn continuum(ground: &Ground<'_>) -> bool {
    match ground.scene.reference.as_ref().map(|reference| &reference.target) {
        Some(Target::Exact(name)) => NamedReference::from_name(name).is_some_and(|named| !named.is_of_the_points()),
        _ => false,
    }
}

/// Puts the errors of the grids in; says what they are against.
pub(super) fn compare(ground: &Ground<'_>, gauge: &Gauge, found: &mut Found) -> String {
    if continuum(ground) && found.grids.iter().all(|grid| grid.expected.is_some()) {
        for grid in &found.grids {
            if let Some(expected) = &grid.expected {
                found.cases[grid.case].errors = grid.frame.errors(&grid.fields, expected);
            }
        }
        let name = gauge.yardstick.answer.clone().unwrap_or_default();
        return format!("the exact answer {name} at the centres of their cells");
    }
    let finest = found.grids.iter().max_by_key(|grid| grid.fields.wear.len()).map(|grid| grid.case);
    let Some(finest) = finest else { return "nothing: no grid was run".to_owned() };
    let (top, others): (Vec<_>, Vec<_>) = found.grids.iter().partition(|grid| grid.case == finest);
    for grid in others {
        let fine = top.first().and_then(|top| top.frame.onto(&top.fields, &grid.frame));
        if let Some(fine) = fine {
            found.cases[grid.case].errors = grid.frame.errors(&grid.fields, &fine);
        }
    }
    found.cases[finest].note = Some("the other grids are compared with this one".to_owned());
    "the finest of them, interpolated to the centres of their cells, both counted from the apex".to_owned()
}
