//! Accepted steps: error control, the law's wishes, and the rule that keeps second-order steps from wearing a gap open.

use super::segment::Segment;
use super::system::{Substep, System};
use crate::integrator::{AdvanceError, Answering, Formula, Reply, Span, Stages, Tried, norm};
use crate::law::{Claim, Field};
use crate::solve::PointError;

/// Part of the tolerance that the estimates of all steps may add up to.
const SHARE: f64 = 0.5;
/// Steps grow by this factor at most from one to the next.
const GROWTH: f64 = 4.0;
/// What is left of a step that is tried again, at least.
const SHRINK: f64 = 0.1;
/// Times a failed contact solve or stage is tried again with a quarter of the step.
const MOST_RETRIES: u32 = 6;
/// Part of the first deformation that the first step may wear.
const FIRST: f64 = 0.02;

/// What an accepted step came to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Accepted {
    /// Simulated length.
    pub(super) length: f64,
    /// L2 norm of the estimated error of the wear depth.
    pub(super) error: f64,
    /// Tries that were thrown away.
    pub(super) rejected: u64,
    /// Whether backward Euler stood in for a second-order step.
    pub(super) replaced: bool,
}

/// Takes steps; arrays are over the cells.
pub(super) struct Stepper {
    pub(super) wear: Vec<f64>,
    pub(super) stages: Stages,
    end: Vec<f64>,
    pub(super) start_pressure: Vec<f64>,
    /// Simulated length to try next.
    pub(super) hint: f64,
    /// Whether `stages.start` is the rate at the start of the next step.
    pub(super) fresh: bool,
    /// Relative error asked for; `None`: steps are as long as they are told to be.
    pub(super) tolerance: Option<f64>,
    /// Smallest represented step; 0: whatever numbers can tell apart.
    pub(super) smallest: f64,
}

/// How far a step may go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// Simulated time at its start.
    pub(super) start: f64,
    /// Simulated time beyond which it must not go.
    pub(super) until: f64,
    /// Number of the substep in the load step, from 1.
    pub(super) number: i64,
}

impl Stepper {
    pub(super) fn new(cells: usize, tolerance: Option<f64>, smallest: f64) -> Stepper {
        Stepper {
            wear: vec![0.0; cells],
            stages: Stages::new(cells),
            end: vec![0.0; cells],
            start_pressure: vec![0.0; cells],
            hint: 0.0,
            fresh: false,
            tolerance,
            smallest,
        }
    }

    /// Takes one step and commits wear, state variables and sliding distances at its end.
    ///
    /// # Errors
    /// A law or a contact that fails, a step that would get too short.
    pub(super) fn advance<'s>(
        &mut self,
        system: &mut System<'s>,
        segment: Segment<'s>,
        reach: Reach,
    ) -> Result<Accepted, AdvanceError<PointError>> {
        let rest = reach.until - reach.start;
        let adaptive = self.tolerance.is_some();
        self.start_pressure.copy_from_slice(&system.pressure);
        System::list(&mut system.closed, &self.start_pressure, false);
        if system.plan.fields.contains(Field::AccumulatedWear) {
            system.remembered_wear.clone_from(&self.wear);
        }
        let mut accepted = Accepted { length: rest, ..Accepted::default() };
        if adaptive {
            if self.hint <= 0.0 {
                self.hint = self.first_guess(system, segment, reach)?;
            }
            accepted.length = even(rest, self.hint);
        }
        let mut retries = 0;
        loop {
            let length = accepted.length;
            let whole = length >= rest;
            let dt = length * segment.scale;
            system.substep = Substep { segment, start: reach.start, dt, number: reach.number };
            let span = Span { start: reach.start, length, scale: segment.scale };
            let tried = match system.solved.scheme.rate {
                true => self.rate_step(system, span),
                false => self.whole_step(system, span),
            };
            let shorter = match tried {
                Ok(Tried::Taken { error }) => {
                    accepted.error = error;
                    let growth = norm(self.end.iter().zip(&self.wear).map(|(end, wear)| end - wear));
                    let budget = SHARE * self.tolerance.unwrap_or(f64::INFINITY) * growth;
                    let noise = 8.0 * f64::EPSILON * norm(self.end.iter().copied());
                    let good = error <= budget.max(noise) || !adaptive;
                    let factor = if error > 0.0 { 0.9 * (budget / error).sqrt() } else { GROWTH };
                    let factor = factor.clamp(SHRINK, GROWTH);
                    if good && self.holds(system, span, &mut accepted, budget)? {
                        if adaptive {
                            // A step that an event cut short says nothing about the next one being shorter.
                            let next = length * factor;
                            self.hint = if whole { self.hint.max(next) } else { next };
                        }
                        break;
                    }
                    if good { 0.5 } else { factor.min(0.9) }
                }
                Ok(Tried::Cut(factor)) => factor,
                Err(error @ (PointError::Contact(_) | PointError::Newton { .. })) if adaptive => {
                    retries += 1;
                    if retries > MOST_RETRIES {
                        return Err(error.into());
                    }
                    0.25
                }
                Err(error) => return Err(error.into()),
            };
            accepted.rejected += 1;
            self.shorten(system, segment, reach, &mut accepted, shorter)?;
        }
        self.commit(system, segment, reach.start, accepted.length);
        Ok(accepted)
    }

    /// Makes the step shorter and goes back to its start.
    fn shorten<'s>(
        &mut self,
        system: &mut System<'s>,
        segment: Segment<'s>,
        reach: Reach,
        accepted: &mut Accepted,
        factor: f64,
    ) -> Result<(), AdvanceError<PointError>> {
        let asked = accepted.length * factor;
        let least = (self.smallest / segment.scale).max(16.0 * f64::EPSILON * reach.until.abs());
        if asked < least {
            let time = segment.represented_at(reach.start);
            if system.law.wish.is_some() {
                let law = system.evaluator.descriptor().name.clone();
                return Err(system.law.short_step(&law, time, asked * segment.scale, self.smallest).into());
            }
            let size = norm(self.end.iter().copied());
            return Err(AdvanceError::Tolerance {
                time,
                step: accepted.length * segment.scale,
                estimate: if size > 0.0 { accepted.error / size } else { f64::INFINITY },
                tolerance: self.tolerance.unwrap_or(0.0),
            });
        }
        accepted.length = asked;
        system.go_back(&self.start_pressure);
        Ok(())
    }

    /// A first step in which what wears is a small part of the deformation under the load.
    fn first_guess<'s>(
        &mut self,
        system: &mut System<'s>,
        segment: Segment<'s>,
        reach: Reach,
    ) -> Result<f64, AdvanceError<PointError>> {
        let rest = reach.until - reach.start;
        let dt = rest * segment.scale;
        system.substep = Substep { segment, start: reach.start, dt, number: reach.number };
        let mut rate = vec![0.0; self.wear.len()];
        let reply = system.rate(system.driven(reach.start), &mut rate);
        let fastest = rate.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        if reply? != Reply::Good || fastest == 0.0 {
            return Ok(rest);
        }
        let lowest =
            system.initial_gap.iter().zip(&self.wear).fold(f64::INFINITY, |low, (gap, wear)| low.min(gap + wear));
        let pressed = (system.solution.approach - lowest).abs();
        let length = FIRST * pressed / fastest / segment.scale;
        Ok(if length > 0.0 && length.is_finite() { length } else { rest })
    }

    /// One step of a law that is a rate.
    fn rate_step(&mut self, system: &mut System<'_>, span: Span) -> Result<Tried, PointError> {
        let formula = system.solved.scheme.formula;
        let needed = self.tolerance.is_some() || matches!(formula, Formula::ExplicitEuler | Formula::TrBdf2);
        if !self.fresh && needed {
            let driven = system.driven(span.start);
            if let Reply::Cut(factor) = system.rate(driven, &mut self.stages.start)? {
                return Ok(Tried::Cut(factor));
            }
            self.fresh = true;
        }
        let tried = self.stages.step(system, formula, span, &self.wear, &mut self.end)?;
        Ok(match tried {
            Tried::Taken { .. } if !self.fresh => Tried::Taken { error: 0.0 },
            other => other,
        })
    }

    /// One whole substep of a law with a memory; where the error is controlled it is taken in two halves, whose difference
    /// from the one is the estimate.
    fn whole_step(&mut self, system: &mut System<'_>, span: Span) -> Result<Tried, PointError> {
        if self.tolerance.is_none() {
            let wear = std::mem::take(&mut self.wear);
            let tried = self.one_whole(system, span, &wear);
            self.wear = wear;
            return tried;
        }
        let substep = system.substep;
        let wear = std::mem::take(&mut self.wear);
        let result = self.doubled(system, span, &wear);
        self.wear = wear;
        system.substep = substep;
        result
    }

    fn doubled(&mut self, system: &mut System<'_>, span: Span, wear: &[f64]) -> Result<Tried, PointError> {
        let cut = |tried| match tried {
            Tried::Cut(factor) => Some(factor),
            Tried::Taken { .. } => None,
        };
        if let Some(factor) = cut(self.one_whole(system, span, wear)?) {
            return Ok(Tried::Cut(factor));
        }
        let single = self.end.clone();
        let half = Span { length: 0.5 * span.length, ..span };
        let (state, distances) = (system.state.clone(), (system.distance.clone(), system.uniform_distance));
        let remembered = system.remembered_wear.clone();
        system.go_back(&self.start_pressure);
        let result = (|| {
            system.substep.dt = half.length * half.scale;
            if let Some(factor) = cut(self.one_whole(system, half, wear)?) {
                return Ok(Tried::Cut(factor));
            }
            let middle = self.end.clone();
            if !system.state.is_empty() {
                system.state.copy_from_slice(&system.end_state);
            }
            system.slide(half.start, half.length);
            if !remembered.is_empty() {
                system.remembered_wear.copy_from_slice(&middle);
            }
            let second = Span { start: half.start + half.length, ..half };
            system.substep.start = second.start;
            if let Some(factor) = cut(self.one_whole(system, second, &middle)?) {
                return Ok(Tried::Cut(factor));
            }
            Ok(Tried::Taken { error: norm(single.iter().zip(&self.end).map(|(a, b)| a - b)) })
        })();
        system.state = state;
        (system.distance, system.uniform_distance) = distances;
        system.remembered_wear = remembered;
        result
    }

    /// One whole substep by backward or forward Euler; the wear at its end goes to `self.end`.
    fn one_whole(&mut self, system: &mut System<'_>, span: Span, wear: &[f64]) -> Result<Tried, PointError> {
        let h = span.length * span.scale;
        let to = span.start + span.length;
        let rates = &mut self.stages.end;
        let reply = match system.solved.scheme.formula {
            Formula::ExplicitEuler => system.rate(system.driven(span.start), rates)?,
            _ => system.implicit(to, h, wear, rates)?,
        };
        if let Reply::Cut(factor) = reply {
            return Ok(Tried::Cut(factor));
        }
        for ((end, wear), rate) in self.end.iter_mut().zip(wear).zip(rates.iter()) {
            *end = wear + h * rate;
        }
        if system.solved.scheme.formula == Formula::ExplicitEuler {
            system.press(system.driven(to).control, &self.end)?;
        }
        Ok(Tried::Taken { error: 0.0 })
    }

    /// Whether a step may stand: a second-order step that leaves open a point which was closed at its start only if a
    /// backward-Euler step leaves it open too. Otherwise backward Euler takes its place where its own error allows it.
    fn holds(
        &mut self,
        system: &mut System<'_>,
        span: Span,
        accepted: &mut Accepted,
        budget: f64,
    ) -> Result<bool, PointError> {
        accepted.replaced = false;
        let formula = system.solved.scheme.formula;
        if formula.order() < 2 || !self.opens(system) {
            return Ok(true);
        }
        let end = self.end.clone();
        let rate = self.stages.end.clone();
        let pressure = system.pressure.clone();
        let solution = system.solution;
        system.go_back(&self.start_pressure);
        let tried = self.stages.step(system, Formula::ImplicitEuler, span, &self.wear, &mut self.end)?;
        let Tried::Taken { error } = tried else { return Ok(false) };
        let opened = |pressures: &[f64]| {
            let starts = self.start_pressure.iter().zip(pressures);
            starts.map(|(start, end)| *start > 0.0 && *end == 0.0).collect::<Vec<bool>>()
        };
        let (second, first) = (opened(&pressure), opened(&system.pressure));
        if second.iter().zip(&first).all(|(second, first)| !second || *first) {
            (self.end, self.stages.end, system.pressure, system.solution) = (end, rate, pressure, solution);
            return Ok(true);
        }
        accepted.replaced = true;
        if self.tolerance.is_none() {
            accepted.error = if self.fresh { error } else { 0.0 };
            return Ok(true);
        }
        accepted.error = error;
        Ok(error <= budget)
    }

    /// Whether a point that was closed at the start of the step is open at its end.
    fn opens(&self, system: &System<'_>) -> bool {
        self.start_pressure.iter().zip(&system.pressure).any(|(start, end)| *start > 0.0 && *end == 0.0)
    }

    fn commit(&mut self, system: &mut System<'_>, segment: Segment<'_>, start: f64, length: f64) {
        std::mem::swap(&mut self.wear, &mut self.end);
        let Stages { start: first, end: last, .. } = &mut self.stages;
        std::mem::swap(first, last);
        self.fresh = system.solved.scheme.rate;
        if !system.state.is_empty() {
            system.state.copy_from_slice(&system.end_state);
        }
        debug_assert_eq!(segment.scale, system.substep.segment.scale);
        system.slide(start, length);
    }

    /// The wear at the start of the step that was committed last.
    pub(super) fn before(&self) -> &[f64] {
        &self.end
    }

    /// Goes to the end of a stretch in which nothing wears: the contact alone follows what presses.
    ///
    /// # Errors
    /// A contact that fails.
    pub(super) fn rest<'s>(
        &mut self,
        system: &mut System<'s>,
        segment: Segment<'s>,
        reach: Reach,
    ) -> Result<Accepted, AdvanceError<PointError>> {
        let length = reach.until - reach.start;
        self.start_pressure.copy_from_slice(&system.pressure);
        self.end.copy_from_slice(&self.wear);
        system.substep = Substep { segment, start: reach.start, dt: length * segment.scale, number: reach.number };
        let (from, to) = (segment.at(reach.start).control, segment.at(reach.until).control);
        if from != to {
            system.press(to, &self.wear).map_err(PointError::from)?;
        }
        self.fresh = false;
        Ok(Accepted { length, ..Accepted::default() })
    }

    /// Whether a law and a segment wear nothing at all: nothing slides and the law claims that this means no wear.
    pub(super) fn is_idle(system: &System<'_>, segment: &Segment<'_>) -> bool {
        let still = segment.step.velocity.is_none_or(|velocity| velocity.from == 0.0 && velocity.to == 0.0)
            && segment.step.velocity_file.is_none();
        still && system.evaluator.descriptor().claims(Claim::ZeroWithoutSlip) && system.solved.scheme.rate
    }
}

/// A step towards `rest` that leaves no splinter behind it.
fn even(rest: f64, hint: f64) -> f64 {
    if hint >= 0.999 * rest {
        rest
    } else if hint > 0.5 * rest {
        0.5 * rest
    } else {
        hint
    }
}
