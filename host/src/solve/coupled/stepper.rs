//! Single steps: the law's wishes, and the rule that keeps second-order steps from wearing a gap open.

use super::segment::Segment;
use super::system::{Substep, System};
use crate::contact::{ContactError, Solution};
use crate::integrator::{AdvanceError, Answering, Formula, Reply, Span, Stages, Tried, norm};
use crate::law::{Claim, Field};
use crate::plan::Elastic;
use crate::solve::PointError;

/// Times that a step whose contact is not solved is tried in a shorter one, and how much shorter.
const MOST_FAILURES: u32 = 6;
const SHORTER: f64 = 0.25;
const UNSOLVED: &str =
    "the contact with the law in it could not be solved for some substeps: shorter ones took their place";

/// What an accepted step came to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Accepted {
    /// Simulated length.
    pub(super) length: f64,
    /// Tries that were thrown away.
    pub(super) rejected: u64,
    /// Whether backward Euler stood in for a second-order step.
    pub(super) replaced: bool,
    /// L2 norm over the cells of the change of the wear rate over the step times its length; NaN: not known.
    pub(super) change: f64,
}

/// Takes steps; arrays are over the cells.
pub(super) struct Stepper {
    pub(super) wear: Vec<f64>,
    stages: Stages,
    end: Vec<f64>,
    pub(super) start_pressure: Vec<f64>,
    start_solution: Solution,
    /// Whether `stages.start` is the rate at the start of the next step.
    pub(super) fresh: bool,
    /// Whether `stages.start` is a rate of this stretch of loading at all.
    pub(super) known: bool,
    /// Smallest represented step; 0: whatever numbers can tell apart.
    smallest: f64,
    /// Whether second-order steps are held to the rule below; only a study of what they do alone lifts it.
    pub(super) guards: bool,
    /// Whether a step whose contact is not solved is tried again in shorter ones; only a study of single steps wants to
    /// see it fail.
    pub(super) persists: bool,
}

/// How far a step may go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// Simulated time at its start.
    pub(super) start: f64,
    /// Simulated time at which it ends, unless the law wishes for less.
    pub(super) until: f64,
    /// Number of the substep in the load step, from 1.
    pub(super) number: i64,
}

/// Everything that a step changes, to go back to.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    wear: Vec<f64>,
    rate: Vec<f64>,
    fresh: bool,
    pressure: Vec<f64>,
    solution: Solution,
    state: Vec<f64>,
    distance: Vec<f64>,
    uniform_distance: f64,
}

impl Moment {
    /// Wear and pressure.
    pub(super) fn pressed(&self) -> (&[f64], &[f64]) {
        (&self.wear, &self.pressure)
    }
}

impl Stepper {
    pub(super) fn new(cells: usize, smallest: f64) -> Stepper {
        Stepper {
            wear: vec![0.0; cells],
            stages: Stages::new(cells),
            end: vec![0.0; cells],
            start_pressure: vec![0.0; cells],
            start_solution: Solution::default(),
            fresh: false,
            known: false,
            smallest,
            guards: true,
            persists: true,
        }
    }

    /// The rate at the start of the next step, where it is fresh.
    pub(super) fn rate(&self) -> &[f64] {
        &self.stages.start
    }

    /// The same, to be taken up from elsewhere.
    pub(super) fn rate_mut(&mut self) -> &mut [f64] {
        &mut self.stages.start
    }

    /// The present moment.
    pub(super) fn moment(&self, system: &System<'_>) -> Moment {
        Moment {
            wear: self.wear.clone(),
            rate: if self.fresh { self.stages.start.clone() } else { Vec::new() },
            fresh: self.fresh,
            pressure: system.pressure.clone(),
            solution: system.solution,
            state: system.state.clone(),
            distance: system.distance.clone(),
            uniform_distance: system.uniform_distance,
        }
    }

    /// Goes back to an earlier moment.
    pub(super) fn return_to(&mut self, system: &mut System<'_>, moment: &Moment) {
        self.wear.clone_from(&moment.wear);
        (self.fresh, self.known) = (moment.fresh, moment.fresh);
        if moment.fresh {
            self.stages.start.clone_from(&moment.rate);
        }
        system.go_back(&moment.pressure);
        system.solution = moment.solution;
        system.state.clone_from(&moment.state);
        system.distance.clone_from(&moment.distance);
        system.uniform_distance = moment.uniform_distance;
    }

    /// Takes one step, as far as `reach` tells or the law wishes, and commits wear, state variables and sliding distances
    /// at its end. After an error everything is as at its start.
    ///
    /// # Errors
    /// A law or a contact that fails, a wish for a step that is too short.
    pub(super) fn advance<'s>(
        &mut self,
        system: &mut System<'s>,
        segment: Segment<'s>,
        reach: Reach,
    ) -> Result<Accepted, AdvanceError<PointError>> {
        self.start_pressure.copy_from_slice(&system.pressure);
        self.start_solution = system.solution;
        let advanced = self.attempts(system, segment, reach);
        if advanced.is_err() {
            self.go_back(system);
        }
        advanced
    }

    /// Takes up the contact at the start of the step again.
    fn go_back(&self, system: &mut System<'_>) {
        system.go_back(&self.start_pressure);
        system.solution = self.start_solution;
    }

    /// Tries one step, shorter ones where the law wishes, and commits what it came to.
    fn attempts<'s>(
        &mut self,
        system: &mut System<'s>,
        segment: Segment<'s>,
        reach: Reach,
    ) -> Result<Accepted, AdvanceError<PointError>> {
        System::list(&mut system.closed, &self.start_pressure, false);
        if system.plan.fields.contains(Field::AccumulatedWear) {
            system.remembered_wear.clone_from(&self.wear);
        }
        let mut accepted = Accepted { length: reach.until - reach.start, ..Accepted::default() };
        let mut failures = 0;
        loop {
            let length = accepted.length;
            let dt = length * segment.scale;
            system.substep = Substep { segment, start: reach.start, dt, number: reach.number };
            let span = Span { start: reach.start, length, scale: segment.scale };
            let tried = match self.attempt(system, span, &mut accepted) {
                Err(error) if self.persists && failures < MOST_FAILURES && is_unsolved(&error) => {
                    failures += 1;
                    if failures == 1 {
                        system.law.warnings.push(UNSOLVED.to_owned());
                    }
                    Tried::Cut(SHORTER)
                }
                tried => tried?,
            };
            let Tried::Cut(factor) = tried else { break };
            accepted.rejected += 1;
            accepted.length *= factor;
            let least = (self.smallest / segment.scale).max(16.0 * f64::EPSILON * reach.until.abs());
            if accepted.length < least {
                let law = system.evaluator.descriptor().name.clone();
                let (time, asked) = (segment.represented_at(reach.start), accepted.length * segment.scale);
                return Err(system.law.short_step(&law, time, asked, self.smallest).into());
            }
            self.go_back(system);
        }
        accepted.change = match self.known {
            true => {
                accepted.length
                    * segment.scale
                    * norm(self.stages.end.iter().zip(&self.stages.start).map(|(end, start)| end - start))
            }
            false => f64::NAN,
        };
        self.commit(system, reach.start, accepted.length);
        Ok(accepted)
    }

    /// Tries one step of a span; what it comes to is in `self.end` and the system.
    fn attempt(&mut self, system: &mut System<'_>, span: Span, accepted: &mut Accepted) -> Result<Tried, PointError> {
        let tried = match system.solved.scheme.rate {
            true => self.rate_step(system, span)?,
            false => self.whole_step(system, span)?,
        };
        match tried {
            Tried::Taken => self.guarded(system, span, accepted),
            cut @ Tried::Cut(_) => Ok(cut),
        }
    }

    /// One step of a law that is a rate.
    fn rate_step(&mut self, system: &mut System<'_>, span: Span) -> Result<Tried, PointError> {
        let formula = system.solved.scheme.formula;
        if !self.fresh && matches!(formula, Formula::ExplicitEuler | Formula::TrBdf2) {
            let driven = system.driven(span.start);
            if let Reply::Cut(factor) = system.rate(driven, &mut self.stages.start)? {
                return Ok(Tried::Cut(factor));
            }
            (self.fresh, self.known) = (true, true);
        }
        self.stages.step(system, formula, span, &self.wear, &mut self.end)
    }

    /// One whole substep of a law with a memory, by backward or forward Euler; the wear at its end goes to `self.end`.
    fn whole_step(&mut self, system: &mut System<'_>, span: Span) -> Result<Tried, PointError> {
        let h = span.length * span.scale;
        let to = span.start + span.length;
        let rates = &mut self.stages.end;
        let reply = match system.solved.scheme.formula {
            Formula::ExplicitEuler => system.rate(system.driven(span.start), rates)?,
            _ => system.implicit(to, h, &self.wear, rates)?,
        };
        if let Reply::Cut(factor) = reply {
            return Ok(Tried::Cut(factor));
        }
        for ((end, wear), rate) in self.end.iter_mut().zip(&self.wear).zip(rates.iter()) {
            *end = wear + h * rate;
        }
        if system.solved.scheme.formula == Formula::ExplicitEuler {
            system.press(system.driven(to).control, &self.end)?;
        }
        Ok(Tried::Taken)
    }

    /// A second-order step that leaves open a point which was closed at its start stands only if a backward-Euler step leaves
    /// it open too, and if it has not worn that point deeper than the surfaces reach; otherwise backward Euler takes its
    /// place. The second condition is for laws that wear a point to the end in finite time (m < 1): there both leave it
    /// open, and only one of them where it was.
    ///
    /// No second-order method is positive at any step: at 1e6 times the limit, TR-BDF2 wears 3.5e5 times the gap that there
    /// is to wear.
    fn guarded(&mut self, system: &mut System<'_>, span: Span, accepted: &mut Accepted) -> Result<Tried, PointError> {
        accepted.replaced = false;
        if !self.guards || system.solved.scheme.formula.order() < 2 || !self.opens(system) {
            return Ok(Tried::Taken);
        }
        let second = (self.end.clone(), self.stages.end.clone(), system.pressure.clone(), system.solution);
        system.go_back(&self.start_pressure);
        if let cut @ Tried::Cut(_) =
            self.stages.step(system, Formula::ImplicitEuler, span, &self.wear, &mut self.end)?
        {
            return Ok(cut);
        }
        let lifted = Self::lifted(system);
        let opened = |cell: &usize| self.start_pressure[*cell] > 0.0 && second.2[*cell] <= 0.0;
        let approach = self.start_solution.approach.max(system.solution.approach);
        let stands = |cell: usize| {
            // Nothing wears deeper than the undeformed surface reaches, unless pressure elsewhere lifts it.
            let reach = approach - system.initial_gap[cell] + lifted.get(cell).copied().unwrap_or(0.0);
            system.pressure[cell] <= 0.0 && second.0[cell] <= reach.max(self.end[cell])
        };
        if (0..self.end.len()).filter(opened).all(stands) {
            (self.end, self.stages.end, system.pressure, system.solution) = second;
        } else {
            accepted.replaced = true;
        }
        Ok(Tried::Taken)
    }

    /// How far pressure lifts the surface above its unloaded level `[cells]`; empty where it cannot: on springs, and in 3-D
    /// before a free boundary.
    fn lifted(system: &mut System<'_>) -> Vec<f64> {
        match system.solved.elastic {
            Elastic::HalfSpace { periodic, .. } if periodic || system.solved.cells.dimension == 2 => {
                let mut displaced = vec![0.0; system.pressure.len()];
                system.model.displacement(&system.pressure, &mut displaced);
                displaced.iter_mut().for_each(|u| *u = (-*u).max(0.0));
                displaced
            }
            _ => Vec::new(),
        }
    }

    /// Whether a point that was closed at the start of the step is open at its end.
    fn opens(&self, system: &System<'_>) -> bool {
        self.start_pressure.iter().zip(&system.pressure).any(|(start, end)| *start > 0.0 && *end <= 0.0)
    }

    fn commit(&mut self, system: &mut System<'_>, start: f64, length: f64) {
        std::mem::swap(&mut self.wear, &mut self.end);
        let Stages { start: first, end: last, .. } = &mut self.stages;
        std::mem::swap(first, last);
        self.fresh = system.solved.scheme.rate;
        self.known = true;
        if !system.state.is_empty() {
            system.state.copy_from_slice(&system.end_state);
        }
        system.slide(start, length);
    }

    /// Wear and pressure at the start of the step that was committed last.
    pub(super) fn before(&self) -> (&[f64], &[f64]) {
        (&self.end, &self.start_pressure)
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
            self.start_solution = system.solution;
            if let Err(error) = system.press(to, &self.wear) {
                self.go_back(system);
                return Err(error.into());
            }
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

/// Whether a contact was not solved that a shorter step changes less.
fn is_unsolved(error: &PointError) -> bool {
    matches!(error, PointError::Contact(ContactError::NotConverged { .. }) | PointError::Newton { .. })
}
