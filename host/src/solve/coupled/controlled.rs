//! Steps to a tolerance: a stretch of loading is gone through twice, the second time in more steps, until both agree.
//!
//! A local error estimate is no measure here. The ring of cells that joins a growing contact within a step is worn wrongly
//! by a part that falls slowly with the step, and the next steps mend it: the gap has to close. Estimates of single steps do
//! not see that and were three orders of magnitude above the true error (DESIGN.md, "Why are whole stretches compared?").
//! Two passes see it, for every law and formula alike, and give the error of the pressure on the way.

use super::going::{Going, Leave};
use super::rows::{self, Clock};
use super::run::Coupled;
use super::segment::Segment;
use super::stepper::{Accepted, Moment, Reach};
use super::system::System;
use crate::integrator::{AdvanceError, norm};
use crate::record::{Estimated, HistoryRow};
use crate::scene::{Every, ScalingKind};
use crate::solve::ending::stop_reached;
use crate::solve::{PointError, SolveError};

/// Steps of the first pass over the first stretch.
const FIRST_STEPS: u64 = 4;
/// Passes in a row, each in at least twice as many steps, that may leave the difference above half of the least one
/// before: a wear that depends on the length of the steps never settles.
const MOST_STALLS: u32 = 6;
/// Order at which the difference of two passes is assumed to fall: below the formulas' own, because of moving edges.
const ORDER: f64 = 0.75;
/// Part of the steps of a pass that is spread evenly.
const EVEN: f64 = 0.25;
/// Steps of a pass from which on its last step is cut.
const TAILED: u64 = 4;
/// Where the last step is cut.
const TAIL: [f64; 4] = [0.6, 0.84, 0.94, 0.98];
/// Largest factor between the steps of two passes: a finer pass also knows better where steps are needed.
const MOST_MORE: u64 = 3;
/// Passes that may fail in the contact solve before the run gives up.
const MOST_FAILURES: u32 = 4;

/// What control keeps from stretch to stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Control {
    /// Steps of the first pass.
    pub(super) steps: u64,
    /// Sum of the estimated errors of the wear depth, L2 norms over the cells.
    pub(super) error: f64,
    /// Sum of the estimated errors of the sum of the wear depths.
    pub(super) sum_error: f64,
    /// Estimated error of the pressure at the end, relative in the L2 norm; `None`: not known.
    pub(super) pressure_error: Option<f64>,
}

impl Control {
    pub(super) fn new() -> Control {
        Control { steps: FIRST_STEPS, error: 0.0, sum_error: 0.0, pressure_error: None }
    }

    /// The errors that all stretches together have left in wear depths and pressures.
    pub(super) fn estimated(&self, wear: &[f64]) -> Estimated {
        let (size, sum) = (norm(wear.iter().copied()), wear.iter().sum::<f64>());
        Estimated {
            wear_l2_relative: (size > 0.0).then(|| self.error / size),
            pressure_l2_relative: self.pressure_error,
            volume_relative: (sum > 0.0).then(|| self.sum_error / sum),
        }
    }
}

/// What a pass came to.
struct Pass {
    steps: u64,
    taken: Vec<Taken>,
    wear: Vec<f64>,
    pressure: Vec<f64>,
}

/// A step of a pass.
struct Taken {
    accepted: Accepted,
    reach: Reach,
    clock: Clock,
    row: HistoryRow,
}

/// A step of a pass that stands, to be gone through again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Again {
    /// Simulated time of its end, and its simulated length.
    pub(super) until: f64,
    pub(super) length: f64,
    /// Tries that were thrown away for it.
    pub(super) rejected: u64,
}

impl<'p> Coupled<'p> {
    /// Goes through a stretch of a segment to the plan's tolerance.
    ///
    /// The finer of two passes stands when its estimated error, difference / (r^p - 1) for r times as many steps, is within
    /// the tolerance of what the stretch wears.
    pub(super) fn controlled(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        until: f64,
        cycles_per_time: f64,
    ) -> Result<(), Leave> {
        let (start, number) = (going.place.at, going.place.number);
        let begin = going.stepper.moment(system);
        let clock = going.clock;
        let mut coarse: Option<Pass> = None;
        let mut steps = self.fewest_steps(system, going, &segment, (start, until, number))?.max(going.control.steps);
        let mut failures = 0;
        let (mut least, mut stalls) = (f64::INFINITY, 0);
        loop {
            going.stepper.return_to(system, &begin);
            // Uneven steps could be beyond the limit that their number keeps.
            let guide = coarse.as_ref().filter(|_| !self.has_limit());
            system.trial = coarse.is_none();
            let tried = self.pass(system, going, segment, (start, until, number), (steps, guide, cycles_per_time));
            system.trial = false;
            if tried.is_err() {
                // Nothing of a trial stays.
                going.stepper.return_to(system, &begin);
                going.clock = clock;
            }
            let fine = match tried? {
                Ok(pass) => pass,
                Err(source) => {
                    failures += 1;
                    if failures > MOST_FAILURES || !may_help(&source) {
                        going.stepper.return_to(system, &begin);
                        return Err(failed(&segment, number, start, source).into());
                    }
                    steps = steps.saturating_mul(4);
                    coarse = None;
                    continue;
                }
            };
            let Some(before) = coarse.take() else {
                coarse = Some(fine);
                steps *= 2;
                continue;
            };
            let more = fine.steps as f64 / before.steps as f64;
            let spread = (more.powf(ORDER) - 1.0).recip();
            let error = spread * distance(&before.wear, &fine.wear);
            let pressure_error = spread * distance(&before.pressure, &fine.pressure);
            let budget = self.budget(going, segment, until - start, &begin, &fine);
            if error <= budget {
                going.control.error += error;
                let sum = |pass: &Pass| pass.wear.iter().sum::<f64>();
                going.control.sum_error += spread * (sum(&before) - sum(&fine)).abs();
                let size = norm(fine.pressure.iter().copied());
                going.control.pressure_error = Some(if size > 0.0 { pressure_error / size } else { 0.0 });
                // Far within the tolerance: the next stretch begins with fewer steps.
                going.control.steps = if error < budget / 16.0 { before.steps.div_ceil(2) } else { before.steps };
                going.rejected += before.steps;
                if self.plan.material.scaling.kind == ScalingKind::Cycle {
                    match self.change(system, begin.pressed(), &segment, until) {
                        Ok(change) => going.place.change += change,
                        Err(error) => {
                            going.stepper.return_to(system, &begin);
                            return Err(error.into());
                        }
                    }
                }
                return self.accept(system, going, segment, (&begin, &fine), cycles_per_time);
            }
            going.rejected += before.steps;
            let factor = (1.2 * error / budget).ceil().min(MOST_MORE as f64) as u64;
            steps = fine.steps.saturating_mul(factor.max(2));
            (least, stalls) = if error < 0.5 * least { (error, 0) } else { (least, stalls + 1) };
            if steps > self.plan.most_substeps || stalls >= MOST_STALLS {
                going.stepper.return_to(system, &begin);
                let tolerance = self.plan.tolerance.unwrap_or_default();
                let source = AdvanceError::Stalled {
                    time: segment.represented_at(start),
                    substeps: fine.steps,
                    // Relative to what the tolerance is relative to here.
                    estimate: error / budget * tolerance,
                    tolerance,
                    most: self.plan.most_substeps,
                };
                return Err(failed(&segment, number, start, source).into());
            }
            coarse = Some(fine);
        }
    }

    /// What the error of a stretch may be: the tolerance of what it wears, or of its share of time in what is worn by then.
    fn budget(&self, going: &Going<'_>, segment: Segment<'p>, length: f64, begin: &Moment, fine: &Pass) -> f64 {
        let growth = distance(begin.pressed().0, &fine.wear);
        let size = norm(fine.wear.iter().copied());
        let share = if going.total > 0.0 { (length * segment.scale / going.total).min(1.0) } else { 1.0 };
        // What rounding and the contact tolerance leave of a length is no error of the steps.
        let noise = 16.0 * f64::EPSILON * size;
        (self.plan.tolerance.unwrap_or_default() * growth.max(share * size)).max(noise)
    }

    /// One pass over a stretch; nothing of it is told but that it is going on.
    #[allow(clippy::type_complexity)] // reason: an error of the pass is for the control, one of the run is not
    fn pass(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        (start, until, number): (f64, f64, i64),
        (steps, guide, cycles_per_time): (u64, Option<&Pass>, f64),
    ) -> Result<Result<Pass, AdvanceError<PointError>>, Leave> {
        let ends = ends(start, until, steps, guide.map_or(&[], |guide| &guide.taken));
        let mut taken: Vec<Taken> = Vec::new();
        let before = going.clock;
        let mut at = start;
        for target in ends {
            while at < target {
                let mut reach = Reach { start: at, until: target, number: number + taken.len() as i64 + 1 };
                let accepted = match going.stepper.advance(system, segment, reach) {
                    Ok(accepted) => accepted,
                    Err(error) => {
                        going.clock = before;
                        return Ok(Err(error));
                    }
                };
                at = if accepted.length >= target - at { target } else { at + accepted.length };
                reach.until = at;
                going.moved(&segment, accepted.length, at, cycles_per_time);
                let dt = accepted.length * segment.scale;
                let row = rows::row(system, &going.stepper.wear, &going.clock, dt, segment.scale);
                taken.push(Taken { accepted, reach, clock: going.clock, row });
                let (substeps, most) = (taken.len() as u64, self.plan.most_substeps);
                if substeps > most {
                    going.clock = before;
                    let time = segment.represented_at(at);
                    return Ok(Err(AdvanceError::ManySubsteps { time, substeps, most }));
                }
                going.trial()?;
            }
        }
        going.clock = before;
        let (wear, pressure) = (going.stepper.wear.clone(), system.pressure.clone());
        Ok(Ok(Pass { steps, taken, wear, pressure }))
    }

    /// Tells of the steps of the pass that stands. Only its end was kept; where fields of a step inside are asked for, or
    /// the run stops at one, it is gone through again: the same steps give the same bits.
    fn accept(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        (begin, fine): (&Moment, &Pass),
        cycles_per_time: f64,
    ) -> Result<(), Leave> {
        let stops = fine.taken.iter().any(|taken| stop_reached(&self.plan.stop, &taken.row).is_some());
        let again = stops || matches!(self.plan.output.every, Every::Steps(_)) && !self.plan.output.fields.is_empty();
        if again {
            going.stepper.return_to(system, begin);
            going.again = fine.taken.iter().map(Taken::again).collect();
            let until = fine.taken.last().map_or(going.place.at, |taken| taken.reach.until);
            return self.once_more(system, going, segment, until, cycles_per_time);
        }
        let last = fine.taken.len().saturating_sub(1);
        for (k, taken) in fine.taken.iter().enumerate() {
            going.clock = taken.clock;
            going.tell(system, &segment, &taken.accepted, taken.row, k == last);
            (going.place.at, going.place.number) = (taken.reach.until, taken.reach.number);
        }
        Ok(())
    }

    /// Goes through the steps in `going.again`, of a pass that stands, and tells of them. A run that ends on the way leaves
    /// the others there, to be gone on with; where an event of the scene lies between them by now, they are forgotten.
    pub(super) fn once_more(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        until: f64,
        cycles_per_time: f64,
    ) -> Result<(), Leave> {
        let steps = std::mem::take(&mut going.again);
        if steps.last().is_none_or(|last| last.until > until) {
            return Ok(());
        }
        for (k, step) in steps.iter().enumerate() {
            let (start, number) = (going.place.at, going.place.number);
            let reach = Reach { start, until: step.until, number: number + 1 };
            let mut accepted = going
                .stepper
                .advance(system, segment, reach)
                .map_err(|source| failed(&segment, number, start, source))?;
            accepted.rejected = step.rejected;
            going.moved(&segment, step.length, step.until, cycles_per_time);
            let dt = step.length * segment.scale;
            let row = rows::row(system, &going.stepper.wear, &going.clock, dt, segment.scale);
            going.tell(system, &segment, &accepted, row, k + 1 == steps.len());
            (going.place.at, going.place.number) = (step.until, number + 1);
            if matches!(going.leaving, Some(Leave::Stopped(_) | Leave::Interrupted)) {
                going.again = steps[k + 1..].to_vec();
                break;
            }
        }
        Ok(())
    }
}

impl Taken {
    fn again(&self) -> Again {
        Again { until: self.reach.until, length: self.accepted.length, rejected: self.accepted.rejected }
    }
}

/// Ends of the steps of a pass: equal ones, or such that the wear rate changes alike over each, as an earlier pass saw it
/// change.
///
/// An error of local order 2 is proportional to the change times the step, so steps are as dense as its square root; a part
/// of them is spread evenly, because a coarse pass does not see everything.
fn ends(start: f64, until: f64, steps: u64, seen: &[Taken]) -> Vec<f64> {
    // Over the largest, so that roots do not round differently in other units.
    let changes = seen.iter().map(|taken| taken.accepted.change);
    let most = changes.filter(|change| change.is_finite()).fold(0.0, f64::max);
    let most = if most > 0.0 { most } else { 1.0 };
    let known: Vec<f64> = seen.iter().map(|taken| (taken.accepted.change / most).max(0.0).sqrt()).collect();
    let total: f64 = known.iter().filter(|weight| weight.is_finite()).sum();
    let even = |k: u64| start + (until - start) * (k as f64 / steps as f64);
    let mut ends: Vec<f64> = (1..steps).map(even).collect();
    if total > 0.0 && total.is_finite() {
        let length = until - start;
        let weights: Vec<f64> = seen
            .iter()
            .zip(&known)
            .enumerate()
            .map(|(k, (taken, weight))| {
                // The first step of some formulas does not know the rate that it starts from.
                // And a change from the step before is one within it where the rate belongs to its start.
                let next = known.get(k + 1).copied().filter(|next| next.is_finite()).unwrap_or(0.0);
                let weight = if weight.is_nan() { next } else { weight.max(next) };
                let part = (taken.reach.until - taken.reach.start) / length;
                (1.0 - EVEN) * weight / total + EVEN * part
            })
            .collect();
        let sum: f64 = weights.iter().sum();
        let (mut piece, mut before) = (0, 0.0);
        for (k, end) in ends.iter_mut().enumerate() {
            let wanted = sum * ((k + 1) as f64 / steps as f64);
            while piece + 1 < weights.len() && before + weights[piece] < wanted {
                before += weights[piece];
                piece += 1;
            }
            let reach = seen[piece].reach;
            let part = ((wanted - before) / weights[piece]).clamp(0.0, 1.0);
            *end = reach.start + part * (reach.until - reach.start);
        }
    }
    if steps >= TAILED {
        // What a step leaves wrong at the edge of the contact fades in the next: the last ones are short, so that the
        // pressure at the end is as good as the wear.
        let last = ends.last().copied().unwrap_or(start);
        ends.extend(TAIL.map(|part| last + part * (until - last)));
    }
    ends.push(until);
    ends.dedup_by(|later, earlier| *later <= *earlier);
    ends
}

/// Whether shorter steps may help.
fn may_help(error: &AdvanceError<PointError>) -> bool {
    matches!(error, AdvanceError::Evaluate(PointError::Contact(_) | PointError::Newton { .. }))
}

/// The error of a substep, `number` substeps of the load step being done by the simulated time `at`.
pub(super) fn failed(segment: &Segment<'_>, number: i64, at: f64, source: AdvanceError<PointError>) -> SolveError {
    SolveError::Advance {
        load_step: segment.number,
        substep: number + 1,
        time: segment.represented_at(at),
        source: Box::new(source),
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    norm(a.iter().zip(b).map(|(a, b)| a - b))
}
