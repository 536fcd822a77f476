//! What changes from step to step of a run, and what is told of it.

use std::time::Instant;

use super::controlled::{Again, Control};
use super::limit::Watch;
use super::place::Place;
use super::rows::{self, Clock};
use super::segment::Segment;
use super::stepper::{Accepted, Stepper};
use super::system::System;
use crate::contact::Control as Pressing;
use crate::law::Evaluator;
use crate::plan::{Block, Plan};
use crate::record::{self, Cost, Event, HistoryRow, Observer, Wish};
use crate::scene::Every;
use crate::solve::ending::{peak_memory, stop_reached};
use crate::solve::{SolveError, fields};

/// What changes from step to step.
pub(super) struct Going<'o> {
    pub(super) stepper: Stepper,
    pub(super) clock: Clock,
    pub(super) history: record::History,
    pub(super) steps: u64,
    pub(super) rejected: u64,
    pub(super) replaced: u64,
    pub(super) control: Control,
    /// Steps of a pass that stands which have not been gone through again yet.
    pub(super) again: Vec<Again>,
    pub(super) longest: f64,
    pub(super) warnings: Vec<String>,
    pub(super) observer: &'o mut (dyn Observer + Send),
    pub(super) units: record::Units,
    pub(super) total: f64,
    pub(super) start_pressure: Vec<f64>,
    pub(super) snapshot_told: bool,
    /// What presses at the end of the last step.
    pub(super) pressed: Option<Pressing>,
    pub(super) place: Place,
    /// What the evaluator warned of by the last checkpoint; told at the end.
    pub(super) asides: Vec<String>,
    /// What the part before the checkpoint has cost that the run went on from.
    pub(super) spent: Cost,
    pub(super) begin: Instant,
    /// Why the run ends where it can be gone on from next.
    pub(super) leaving: Option<Leave>,
    /// The stability limit of explicit steps.
    pub(super) watch: Watch,
}

/// Why the loop ends early.
pub(super) enum Leave {
    Failed(SolveError),
    Stopped(String),
    Interrupted,
}

impl From<SolveError> for Leave {
    fn from(error: SolveError) -> Leave {
        Leave::Failed(error)
    }
}

impl<'o> Going<'o> {
    /// Before the first step of a plan over this many cells.
    pub(super) fn new(plan: &Plan, cells: usize, observer: &'o mut (dyn Observer + Send)) -> Going<'o> {
        let count = |block: &Block| block.count as f64 * block.steps.iter().filter_map(|s| s.duration).sum::<f64>();
        Going {
            stepper: Stepper::new(cells, plan.smallest_step),
            clock: Clock::default(),
            history: record::History::default(),
            steps: 0,
            rejected: 0,
            replaced: 0,
            control: Control::new(),
            again: Vec::new(),
            longest: 0.0,
            warnings: Vec::new(),
            observer,
            units: fields::units(plan),
            total: plan.blocks.iter().map(count).sum(),
            start_pressure: Vec::new(),
            snapshot_told: false,
            pressed: None,
            place: Place::START,
            asides: Vec::new(),
            spent: Cost::default(),
            begin: Instant::now(),
            leaving: None,
            watch: Watch::default(),
        }
    }

    pub(super) fn warn(&mut self, warning: String) {
        if !self.warnings.contains(&warning) {
            self.observer.observe(Event::Warning(&warning));
            self.warnings.push(warning);
        }
    }

    /// Moves the clocks to the end of a step; `cycles_per_time` is per represented time.
    pub(super) fn moved(&mut self, segment: &Segment<'_>, length: f64, at: f64, cycles_per_time: f64) {
        self.clock.simulated = at;
        self.clock.represented = segment.represented_at(at);
        let cycles = self.clock.cycles + length * segment.scale * cycles_per_time;
        // Sums of parts of cycles round; at their ends the cycles are whole.
        let whole = cycles.round();
        self.clock.cycles = if (cycles - whole).abs() <= 1e-9 { whole } else { cycles };
        self.clock.temperature = segment.at(at).temperature;
    }

    /// Part of the represented time that is done.
    fn done(&self) -> f64 {
        if self.total > 0.0 { self.clock.represented / self.total } else { 1.0 }
    }

    /// Tells of a step that may not stand, and hears whether to go on.
    pub(super) fn trial(&mut self) -> Result<(), Leave> {
        let event = Event::Trial { time: self.clock.represented, done: self.done() };
        if self.observer.observe(event) == Wish::Stop { Err(Leave::Interrupted) } else { Ok(()) }
    }

    /// What the run has cost by now, with the part before a checkpoint that it went on from.
    pub(super) fn cost(&self, system: &System<'_>) -> Cost {
        let (law, work, spent) = (&system.law, &system.work, &self.spent);
        Cost {
            run_time_s: spent.run_time_s + self.begin.elapsed().as_secs_f64(),
            law_time_s: spent.law_time_s + law.law_time.as_secs_f64(),
            contact_time_s: spent.contact_time_s + work.time.as_secs_f64(),
            limit_time_s: spent.limit_time_s + self.watch.spent.as_secs_f64(),
            steps: self.steps,
            rejected_steps: self.rejected,
            law_calls: spent.law_calls + law.law_calls,
            points_evaluated: spent.points_evaluated + law.points_evaluated,
            contact_solves: spent.contact_solves + work.solves,
            contact_iterations: spent.contact_iterations + work.iterations,
            fft_pairs: spent.fft_pairs + work.fft_pairs,
            peak_memory_bytes: peak_memory(),
        }
    }

    /// At a place that can be gone on from: ends the run if there is a reason to, else tells of a checkpoint if one is
    /// wanted.
    pub(super) fn settle(&mut self, system: &System<'_>, evaluator: &dyn Evaluator) -> Result<(), Leave> {
        if let Some(leave) = self.leaving.take() {
            return Err(leave);
        }
        self.offer(system, evaluator, false);
        Ok(())
    }

    /// Tells of a step; what it gives reason to end for is left for the next place that can be gone on from.
    pub(super) fn tell(
        &mut self,
        system: &mut System<'_>,
        segment: &Segment<'_>,
        accepted: &Accepted,
        row: HistoryRow,
        at_cut: bool,
    ) {
        self.steps += 1;
        self.rejected += accepted.rejected;
        self.replaced += u64::from(accepted.replaced);
        self.longest = self.longest.max(row.dt);
        self.pressed = Some(segment.at(self.clock.simulated).control);
        for warning in std::mem::take(&mut system.law.warnings) {
            self.warn(warning);
        }
        let mut full = None;
        match rows::check_rim(system, segment, &self.clock) {
            Ok(None) => {}
            Ok(Some(warning)) => {
                let kind = warning.split(',').next().unwrap_or_default().to_owned();
                if !self.warnings.iter().any(|known| known.starts_with(&kind)) {
                    self.warn(warning);
                }
            }
            Err(error) => full = Some(Leave::Failed(error)),
        }
        let done = self.done();
        let wish = self.observer.observe(Event::Step { row: &row, steps: self.steps, done });
        self.history.rows.push(row);
        let asked = match &system.plan.output.every {
            Every::End => false,
            Every::Steps(every) => self.steps.is_multiple_of(*every),
            Every::Times(times) => {
                let near = 1e-9 * row.dt.max(self.clock.represented.abs());
                at_cut && times.iter().any(|time| (time - self.clock.represented).abs() <= near)
            }
        };
        self.snapshot_told = asked && !system.plan.output.fields.is_empty();
        if self.snapshot_told {
            let snapshot = rows::snapshot(system, &self.stepper, &self.clock, self.steps, &self.units);
            self.observer.observe(Event::Snapshot(&snapshot));
        }
        let stopped = || stop_reached(&system.plan.stop, &row).map(Leave::Stopped);
        let interrupted = || (wish == Wish::Stop).then_some(Leave::Interrupted);
        self.leaving = self.leaving.take().or(full).or_else(stopped).or_else(interrupted);
    }

    /// What is left to tell when a run ends, for whatever reason.
    pub(super) fn finish(&mut self, system: &mut System<'_>) {
        if self.steps > 0 && !system.plan.output.fields.is_empty() && !self.snapshot_told {
            let snapshot = rows::snapshot(system, &self.stepper, &self.clock, self.steps, &self.units);
            self.observer.observe(Event::Snapshot(&snapshot));
        }
    }
}
