//! Steps of one length from a given state, by any formula, on the contact as it comes or on one that cannot grow.

use super::limit::Measured;
use super::present::Present;
use super::rows::rim_in_contact;
use super::run::Coupled;
use super::segment::Segment;
use super::stepper::{Reach, Stepper};
use super::system::System;
use crate::contact::Control;
use crate::integrator::{AdvanceError, Formula};
use crate::plan::Elastic;
use crate::solve::{PointError, SolveError};
use crate::stability::judge::{Ripple, Seen, interior, roughness};

/// Amplitude of the ripple that steps begin with, over the largest pressure.
const RIPPLE: f64 = 0.01;
/// Part of the largest pressure that stands in for the pressure where there is less.
const FLOOR: f64 = 1e-3;
/// Roughness beyond that of the start after which steps are not worth going on with.
const BROKEN: f64 = 1.5;
/// Part of the largest reach below which a point says nothing of how much of it was worn.
const SHALLOW: f64 = 1e-2;
/// First step of the refined run in units of 1 / stiffness, and the factor from step to step.
const REFINED: (f64, f64) = (0.05, 1.25);

/// How steps are taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct How<'a> {
    pub(super) formula: Formula,
    /// Whether the rule against over-wearing holds.
    pub(super) guards: bool,
    /// Cells outside which nothing touches, whatever comes; `None`: contact as it comes.
    pub(super) held: Option<&'a [bool]>,
    pub(super) control: Control,
}

/// What the steps start from and are judged with.
pub(super) struct Start<'a> {
    pub(super) present: &'a Present,
    /// Cells in contact `[cells]`.
    pub(super) set: Vec<bool>,
    inner: Vec<u32>,
    /// Wear with a ripple of the mode that decays fastest.
    wear: Vec<f64>,
    /// `None`: the contact is too small to tell the mode from its edge.
    ripple: Option<Ripple>,
    largest: f64,
    center: usize,
    stiffness: f64,
}

/// A moment of the refined run.
pub(super) struct Refined {
    wear: Vec<f64>,
    pressure: Vec<f64>,
}

/// What steps came to.
pub(super) enum Came {
    Seen(Seen),
    /// The contact reached the rim of the grid.
    Outside,
    Failed(AdvanceError<PointError>),
}

/// A run of steps.
struct Course<'s> {
    system: System<'s>,
    stepper: Stepper,
    segment: Segment<'s>,
    at: f64,
    number: i64,
    replaced: u64,
    /// Whether the contact may reach the rim.
    rim_counts: bool,
    /// Largest approach so far.
    approach: f64,
}

impl Course<'_> {
    fn step(&mut self, until: f64) -> Result<(), AdvanceError<PointError>> {
        while self.at < until {
            self.number += 1;
            let reach = Reach { start: self.at, until, number: self.number };
            let accepted = self.stepper.advance(&mut self.system, self.segment, reach)?;
            self.at = if accepted.length >= until - self.at { until } else { self.at + accepted.length };
            self.replaced += u64::from(accepted.replaced);
            self.approach = self.approach.max(self.system.solution.approach);
        }
        Ok(())
    }

    fn is_outside(&self) -> bool {
        self.rim_counts && rim_in_contact(&self.system) > 0.0
    }
}

impl<'a> Start<'a> {
    /// From a state and what was measured there.
    pub(super) fn new(run: &Coupled<'_>, present: &'a Present, measured: &Measured) -> Start<'a> {
        let set: Vec<bool> = present.pressure.iter().map(|p| *p > 0.0).collect();
        let largest = present.pressure.iter().fold(0.0, |most: f64, p| most.max(*p));
        let center = present.pressure.iter().position(|p| *p == largest).unwrap_or(0);
        let (stiffness, mode) = (measured.stiffness.per_time, &measured.stiffness.mode);
        // Wear by v changes the pressure by -S v = -stiffness v / D.
        let pattern: Vec<f64> =
            mode.iter().zip(&measured.slopes).map(|(v, d)| if *d > 0.0 { -stiffness * v / d } else { 0.0 }).collect();
        let most = pattern.iter().fold(0.0, |most: f64, p| most.max(p.abs()));
        let amplitude = if most > 0.0 { RIPPLE * largest / most } else { 0.0 };
        let wear = match mode.is_empty() {
            true => present.wear.clone(),
            false => present.wear.iter().zip(mode).map(|(wear, v)| wear + amplitude * v).collect(),
        };
        let pattern: Vec<f64> = pattern.iter().map(|p| amplitude * p).collect();
        let cells = &run.solved.cells;
        let ripple = (!pattern.is_empty()).then(|| Ripple::new(cells, &set, &pattern));
        let ripple = ripple.filter(|ripple| ripple.is_clear(cells, &present.pressure));
        Start { present, inner: interior(cells, &set), set, wear, ripple, largest, center, stiffness }
    }
}

impl<'p> Coupled<'p> {
    /// Prepares steps and hands them to `go`.
    fn course<T>(
        &self,
        start: &Start<'_>,
        how: How<'_>,
        go: impl FnOnce(&mut Course<'_>) -> Result<T, AdvanceError<PointError>>,
    ) -> Result<T, SolveError> {
        let mut solved = self.solved.clone();
        solved.scheme.formula = how.formula;
        let present = start.present;
        let step = present.pressed(how.control);
        let run = self.with(self.plan, &solved);
        let mut system = run.system(1);
        system.slides = run.slides(&step)?;
        if let Some(held) = how.held {
            let outside = system.initial_gap.iter_mut().zip(held).filter(|(_, on)| !**on);
            outside.for_each(|(gap, _)| *gap = f64::INFINITY);
        }
        system.pressure.clone_from(&present.pressure);
        system.solution = present.solution;
        system.state.clone_from(&present.state);
        system.distance.clone_from(&present.distance);
        system.uniform_distance = present.uniform_distance;
        let mut stepper = Stepper::new(start.wear.len(), self.plan.smallest_step);
        stepper.wear.clone_from(&start.wear);
        (stepper.guards, stepper.persists) = (how.guards, false);
        let segment = Segment {
            step: &step,
            start: 0.0,
            length: 0.0,
            represented: present.time,
            scale: 1.0,
            number: present.number,
            cycle: present.cycle,
        };
        let free = matches!(self.solved.elastic, Elastic::HalfSpace { periodic: false, .. });
        let rim_counts = how.held.is_none() && free && rim_in_contact(&system) == 0.0;
        let approach = present.solution.approach;
        let mut course = Course { system, stepper, segment, at: 0.0, number: 0, replaced: 0, rim_counts, approach };
        let begun = course.system.press(how.control, &start.wear).map_err(AdvanceError::from);
        begun.and_then(|()| go(&mut course)).map_err(|source| SolveError::Advance {
            load_step: present.number,
            substep: 1,
            time: present.time,
            source: Box::new(source),
        })
    }

    /// The refined run at the end of each of these spans of time, ascending, and why there are no more of them.
    pub(super) fn moments(
        &self,
        start: &Start<'_>,
        how: How<'_>,
        spans: &[f64],
        goes_on: &dyn Fn() -> bool,
    ) -> Result<(Vec<Refined>, String), SolveError> {
        self.course(start, how, |course| {
            let mut moments = Vec::new();
            let mut dt = REFINED.0 / start.stiffness;
            for span in spans {
                while course.at < *span {
                    // What would leave a sliver goes to the end at once.
                    let until = if course.at + 1.2 * dt >= *span { *span } else { course.at + dt };
                    if let Err(error) = course.step(until) {
                        return Ok((moments, format!("the refined run failed: {error}")));
                    }
                    dt *= REFINED.1;
                    if course.is_outside() || !goes_on() {
                        return Ok((moments, "the contact would reach the rim of the grid".to_owned()));
                    }
                }
                moments.push(Refined { wear: course.stepper.wear.clone(), pressure: course.system.pressure.clone() });
            }
            Ok((moments, String::new()))
        })
    }

    /// Takes `count` steps of one length, and looks at what they leave.
    pub(super) fn trial(
        &self,
        start: &Start<'_>,
        how: How<'_>,
        (dt, count): (f64, u32),
        refined: &Refined,
    ) -> Result<Came, SolveError> {
        let cells = self.solved.cells;
        let floor = FLOOR * start.largest;
        let bends = |pressure: &[f64]| roughness(&cells, &start.inner, pressure, floor);
        let came = self.course(start, how, |course| {
            let before = bends(&course.system.pressure);
            let mut ripple = start.ripple.as_ref().map(|_| 0.0);
            for k in 1..=count {
                course.step(dt * f64::from(k))?;
                if course.is_outside() {
                    return Ok(Came::Outside);
                }
                if let (Some(most), Some(mode)) = (&mut ripple, &start.ripple) {
                    *most = f64::max(*most, mode.amplitude(&cells, &course.system.pressure).abs());
                }
                if bends(&course.system.pressure) > before + BROKEN {
                    break;
                }
            }
            let smooth = before.max(bends(&refined.pressure));
            let rough = (bends(&course.system.pressure) - smooth).max(0.0);
            Ok(Came::Seen(self.look(start, course, how, refined, (rough, ripple))))
        });
        match came {
            Err(SolveError::Advance { source, .. }) => Ok(Came::Failed(*source)),
            other => other,
        }
    }

    fn look(
        &self,
        start: &Start<'_>,
        course: &mut Course<'_>,
        how: How<'_>,
        refined: &Refined,
        (roughness, ripple): (f64, Option<f64>),
    ) -> Seen {
        let system = &mut course.system;
        let (pressure, wear) = (&system.pressure, &course.stepper.wear);
        let floor = FLOOR * start.largest;
        let lowest = pressure.iter().fold(f64::INFINITY, |low: f64, p| low.min(*p));
        let mut displaced = vec![0.0; pressure.len()];
        system.model.displacement(pressure, &mut displaced);
        let gap = |cell: usize| self.gap[cell] + wear[cell] + displaced[cell] - system.solution.approach;
        let can = |cell: &usize| how.held.is_none_or(|held| held[*cell]);
        let overlap = (0..wear.len()).filter(can).map(|cell| -gap(cell)).fold(0.0, f64::max) / system.gap_scale;
        // Pressure can lift the surface elsewhere, before a periodic boundary and in 2-D.
        let reach = |cell: usize| course.approach - self.gap[cell] - start.wear[cell] - displaced[cell].min(0.0);
        let deepest = (0..wear.len()).filter(|cell| start.set[*cell]).map(reach).fold(0.0, f64::max);
        let parts = (0..wear.len())
            .filter(|cell| start.set[*cell] && reach(*cell) > SHALLOW * deepest)
            .map(|cell| (wear[cell] - start.wear[cell]) / reach(cell));
        let part = parts.fold(0.0, |most: f64, part| if part > most || part.is_nan() { part } else { most });
        let distance = |a: &[f64], b: &[f64]| crate::integrator::norm(a.iter().zip(b).map(|(a, b)| a - b));
        let worn = distance(&refined.wear, &start.wear);
        Seen {
            roughness,
            ripple,
            center_pressure: (pressure[start.center] + floor) / (refined.pressure[start.center] + floor),
            lowest_pressure: lowest / start.largest,
            overlap,
            wear_over_reach: part,
            error: if worn > 0.0 { distance(wear, &refined.wear) / worn } else { 0.0 },
            replaced: course.replaced,
        }
    }
}
