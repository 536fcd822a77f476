//! What has to hold of a contact, whatever solved it.

use wearlaw::contact::foundation::Foundation;
use wearlaw::contact::halfspace::{Boundary, HalfSpace};
use wearlaw::contact::surface::std_of_gap;
use wearlaw::contact::{ContactModel, Control};
use wearlaw::plan::{Elastic, Plan};
use wearlaw::record::{End, Event, Observer, Record, Wish};
use wearlaw::scene::Mode;
use wearlaw::solve::SolveError;

/// Holds every wear field against the one before.
#[derive(Default)]
pub struct Growing {
    wear: Vec<f64>,
    /// The step in which a depth fell.
    pub fell: Option<u64>,
    seen: u64,
}

/// Steps, tried ones counting, after which a run is called endless.
const ENDLESS: u64 = 200_000;

impl Observer for Growing {
    fn observe(&mut self, event: Event<'_>) -> Wish {
        match event {
            Event::Snapshot(snapshot) => {
                let now = &snapshot.fields[0].data;
                if self.wear.iter().zip(now.iter()).any(|(before, now)| now < before) {
                    self.fell = Some(snapshot.step_index);
                }
                self.wear = now.to_vec();
            }
            Event::Step { .. } | Event::Trial { .. } => self.seen += 1,
            _ => {}
        }
        if self.seen > ENDLESS { Wish::Stop } else { Wish::GoOn }
    }
}

/// The contact of a plan, made anew.
fn model(plan: &Plan) -> Option<Box<dyn ContactModel>> {
    let solved = plan.solved.as_ref()?;
    Some(match solved.elastic {
        Elastic::Foundation(stiffness) => Box::new(Foundation::new(solved.cells, stiffness)),
        Elastic::HalfSpace { modulus, periodic, datum } => {
            let boundary = if periodic { Boundary::Periodic } else { Boundary::Free };
            Box::new(HalfSpace::new(solved.cells, modulus, boundary, datum, 1))
        }
    })
}

/// What presses at the end of a plan.
fn last_control(plan: &Plan) -> Option<Control> {
    let step = plan.blocks.last()?.steps.last()?;
    match (step.load, step.approach) {
        (Some(load), _) => Some(Control::Load(load.to)),
        (None, Some(approach)) => Some(Control::Approach(approach.to)),
        (None, None) => None,
    }
}

/// Pressures not below zero that balance the load to the contact tolerance, gaps not below minus that tolerance times the
/// standard deviation of the initial gap, numbers that are finite.
pub fn check(plan: &Plan, record: &Record<SolveError>) -> Result<(), String> {
    let solved = plan.solved.as_ref().ok_or("no solved contact")?;
    let cells = solved.cells;
    let last = record.history.last().ok_or("no rows")?;
    let (pressure, tolerance) = (&record.pressure, solved.contact_tolerance);
    let sum = pressure.iter().sum::<f64>() * cells.area();
    if pressure.iter().any(|p| !(*p >= 0.0 && p.is_finite())) {
        return Err("a pressure below zero, or one that is not finite".into());
    }
    if record.wear.iter().any(|w| !(*w >= 0.0 && w.is_finite())) {
        return Err("a wear depth below zero, or one that is not finite".into());
    }
    let approach = last.approach.ok_or("no approach")?;
    if matches!(record.end, End::Done) {
        match last_control(plan).ok_or("nothing presses")? {
            Control::Load(load) if (sum - load).abs() > tolerance * load => {
                return Err(format!("a load of {sum:e}, expected {load:e}"));
            }
            // Times of a later cycle round, and what ramps with them.
            Control::Approach(given) if (given - approach).abs() > 1e-12 * given => {
                return Err(format!("an approach of {approach:e}, expected {given:e}"));
            }
            _ => {}
        }
    }
    let initial = solved.surface.initial_gap(&cells, solved.is_periodic()).map_err(|error| error.to_string())?;
    let mut gap = vec![0.0; initial.len()];
    model(plan).ok_or("no model")?.displacement(pressure, &mut gap);
    let worn = plan.material.mode != Mode::Post;
    let mut largest = approach.abs();
    for (cell, gap) in gap.iter_mut().enumerate() {
        largest = if initial[cell].is_finite() { largest.max(initial[cell]).max(gap.abs()) } else { largest };
        *gap += initial[cell] + if worn { record.wear[cell] } else { 0.0 } - approach;
    }
    let lowest = gap.iter().copied().fold(f64::INFINITY, f64::min);
    // A solve and what wears by it each have the tolerance; a punch without any roughness is measured by what it displaces.
    let scale = match std_of_gap(&cells, &initial) {
        scale if scale.is_finite() && scale > 0.0 => scale,
        _ => largest,
    };
    let least = 2.0 * tolerance * scale + 64.0 * f64::EPSILON * largest;
    if lowest < -least { Err(format!("a gap of {lowest:e}, expected at least {:e}", -least)) } else { Ok(()) }
}
