//! The contact with the law in it at one moment: explicit and implicit rates of wear.

use std::time::{Duration, Instant};

use super::law_points::{Call, LawPoints, Remembered};
use super::segment::{Driven, Segment};
use crate::contact::{Cells, ContactModel, Control, Diagonal, Problem, Solution, corners_and_back, nodal_traction};
use crate::integrator::{Answering, Reply};
use crate::law::{Evaluator, Field};
use crate::plan::{Elastic, Plan, Slope, SolvedPlan};
use crate::scene::{Basis, Mode};
use crate::solve::PointError;
use crate::solve::kinematics::path;

/// Work of contact solves.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    pub(super) solves: u64,
    pub(super) iterations: u64,
    pub(super) fft_pairs: u64,
    pub(super) time: Duration,
    pub(super) newton_iterations: u64,
}

/// What a step is asked with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Substep<'p> {
    pub(super) segment: Segment<'p>,
    /// Simulated time at its start.
    pub(super) start: f64,
    /// Represented length of it.
    pub(super) dt: f64,
    /// Its number in the load step, from 1.
    pub(super) number: i64,
}

/// The contact, the law and what both remember.
pub(super) struct System<'s> {
    pub(super) plan: &'s Plan,
    pub(super) solved: &'s SolvedPlan,
    pub(super) evaluator: &'s dyn Evaluator,
    pub(super) model: Box<dyn ContactModel>,
    /// Initial gap `[cells]`.
    pub(super) initial_gap: Vec<f64>,
    /// Length that complementarity errors are measured with.
    pub(super) gap_scale: f64,
    /// Contact pressure of the last solve `[cells]`.
    pub(super) pressure: Vec<f64>,
    pub(super) solution: Solution,
    /// Cells in contact at the start of the substep, ascending.
    pub(super) closed: Vec<u32>,
    pub(super) law: LawPoints,
    pub(super) substep: Substep<'s>,
    /// Relative velocities of the segment's cells; empty where all slide alike.
    pub(super) slides: Vec<f64>,
    /// Wear at the start of the substep; empty unless the law reads it.
    pub(super) remembered_wear: Vec<f64>,
    pub(super) distance: Vec<f64>,
    pub(super) uniform_distance: f64,
    /// State variables at the start of the substep, and at the end of the last call.
    pub(super) state: Vec<f64>,
    pub(super) end_state: Vec<f64>,
    pub(super) work: Work,
    pub(super) room: Room,
    /// Under `post`: what the pressure was last solved for.
    pub(super) steady: Option<Control>,
    /// Whether the steps are those of a pass that others are compared with and that does not stand itself.
    pub(super) trial: bool,
    /// Whether the pressure of the present stage stands, or only its wear is used.
    pub(super) stands: bool,
}

/// Cells that nodal tractions drive the law at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tractions {
    /// Those in contact.
    OfContact,
    /// Their neighbours too, as in a stage: see [`System::list_reached`].
    WithNeighbours,
}

/// Part of the wear of a stage, times the tolerance of the run, that the contact of the stage may be wrong by where only its
/// wear is used.
const LOOSE: f64 = 0.1;

/// Arrays over the cells that are made anew in every stage.
#[derive(Default)]
pub(super) struct Room {
    pub(super) gap: Vec<f64>,
    pub(super) diagonal: Vec<f64>,
    pub(super) point: Vec<f64>,
    pub(super) traction: Vec<f64>,
    pub(super) cells: Vec<u32>,
    pub(super) compact: Vec<f64>,
    pub(super) compact_traction: Vec<f64>,
    pub(super) expected: Vec<f64>,
    pub(super) law_gap: Vec<f64>,
    pub(super) displaced: Vec<f64>,
}

impl System<'_> {
    pub(super) fn cells(&self) -> Cells {
        self.solved.cells
    }

    pub(super) fn is_post(&self) -> bool {
        self.plan.material.mode == Mode::Post
    }

    /// Whether wear is driven by nodal tractions, which differ from the pressure on a half-space only: springs have no
    /// stress between them.
    pub(super) fn smoothed(&self) -> bool {
        self.plan.material.basis == Basis::NodalStress && matches!(self.solved.elastic, Elastic::HalfSpace { .. })
    }

    fn periodic(&self) -> bool {
        matches!(self.solved.elastic, Elastic::HalfSpace { periodic: true, .. })
    }

    /// Solves the contact for the gap in `room.gap` and a local compliance; the pressure is the start and the answer.
    pub(super) fn solve(
        &mut self,
        control: Control,
        diagonal: Diagonal<'_>,
        smoothed: bool,
        tolerance: f64,
    ) -> Result<(), PointError> {
        let problem = Problem {
            gap: &self.room.gap,
            diagonal,
            smoothed,
            control,
            tolerance,
            scale: self.gap_scale,
            frozen: None,
        };
        let begin = Instant::now();
        let answer = self.model.solve(&problem, &mut self.pressure);
        self.work.time += begin.elapsed();
        self.work.solves += 1;
        self.solution = answer?;
        self.work.iterations += self.solution.iterations;
        self.work.fft_pairs += self.solution.fft_pairs;
        Ok(())
    }

    /// The contact tolerance of a stage that wears about `depth`.
    ///
    /// Where a run keeps to a tolerance, stages inside of steps, and steps of a pass that does not stand, need not be more
    /// exact than that asks for.
    pub(super) fn stage_tolerance(&self, depth: f64) -> f64 {
        let exact = self.solved.contact_tolerance;
        match self.plan.tolerance {
            Some(tolerance) if !self.stands => {
                let loose = LOOSE * tolerance * depth / self.gap_scale;
                if loose > exact && loose.is_finite() { loose } else { exact }
            }
            _ => exact,
        }
    }

    /// Writes the gap of a surface worn by `wear` into `room.gap`; `post` wears nothing away.
    pub(super) fn open_gap(&mut self, wear: &[f64]) {
        let post = self.is_post();
        self.room.gap.clear();
        match post {
            true => self.room.gap.extend_from_slice(&self.initial_gap),
            false => self.room.gap.extend(self.initial_gap.iter().zip(wear).map(|(gap, wear)| gap + wear)),
        }
    }

    /// What drives the contact at a simulated time; a law that is called for whole substeps sees the mean speed over it.
    pub(super) fn driven(&self, at: f64) -> Driven {
        let Substep { segment, start, dt, .. } = self.substep;
        let driven = segment.at(at);
        if self.solved.scheme.rate || dt <= 0.0 {
            return driven;
        }
        let (from, to) = (segment.at(start).velocity, segment.at(start + dt / segment.scale).velocity);
        if from == to {
            return driven;
        }
        let speed = path(from, to, dt) / dt;
        Driven { velocity: if from + to < 0.0 { -speed } else { speed }, ..driven }
    }

    /// Adds to the sliding distances what a stretch of the segment slides.
    pub(super) fn slide(&mut self, start: f64, length: f64) {
        let segment = self.substep.segment;
        let (from, to) = (segment.at(start).velocity, segment.at(start + length).velocity);
        let way = path(from, to, length * segment.scale);
        self.uniform_distance += way;
        if self.distance.is_empty() {
            return;
        }
        if self.slides.is_empty() {
            self.distance.iter_mut().for_each(|distance| *distance += way);
        } else {
            self.distance.iter_mut().zip(&self.slides).for_each(|(distance, slide)| *distance += way * slide.abs());
        }
    }

    /// Takes up an earlier pressure again.
    pub(super) fn go_back(&mut self, pressure: &[f64]) {
        self.pressure.copy_from_slice(pressure);
        self.steady = None;
    }

    /// Solves the elastic contact of a surface worn by `wear`.
    pub(super) fn press(&mut self, control: Control, wear: &[f64]) -> Result<(), PointError> {
        if self.is_post() && self.steady == Some(control) {
            return Ok(());
        }
        self.open_gap(wear);
        self.solve(control, Diagonal::Zero, false, self.solved.contact_tolerance)?;
        self.steady = self.is_post().then_some(control);
        Ok(())
    }

    /// The cells that the law is asked for under `pressure`, all of them if it wants open ones.
    pub(super) fn list(cells: &mut Vec<u32>, pressure: &[f64], open: bool) {
        cells.clear();
        let all = pressure.iter().enumerate();
        cells.extend(all.filter(|(_, pressure)| open || **pressure > 0.0).map(|(cell, _)| cell as u32));
    }

    /// Writes into `room.cells` those that wear in a stage under `pressure`: the cells in contact and, where nodal tractions
    /// drive the law, their neighbours. Without those the law would jump where a cell closes, and some stages would have
    /// no answer.
    pub(super) fn list_reached(&mut self, pressure: &[f64], open: bool) {
        if !self.smoothed() {
            Self::list(&mut self.room.cells, pressure, open);
            return;
        }
        let mut traction = std::mem::take(&mut self.room.traction);
        traction.resize(pressure.len(), 0.0);
        corners_and_back(&self.solved.cells, self.periodic(), pressure, &mut traction);
        Self::list(&mut self.room.cells, &traction, open);
        self.room.traction = traction;
    }

    /// Evaluates the law at the cells in `room.cells` under pressures `[cells]` for the substep's duration.
    pub(super) fn evaluate(
        &mut self,
        driven: Driven,
        pressure: &[f64],
        tractions: Tractions,
        slope: bool,
    ) -> Result<Reply, PointError> {
        let reads_traction = self.plan.fields.contains(Field::NodalTraction);
        let smoothed = self.smoothed();
        let mut traction = std::mem::take(&mut self.room.traction);
        if smoothed || reads_traction {
            traction.resize(pressure.len(), 0.0);
            let (cells, periodic) = (&self.solved.cells, self.periodic());
            match (self.solved.elastic, tractions) {
                (Elastic::Foundation(_), _) => traction.copy_from_slice(pressure),
                (_, Tractions::WithNeighbours) => corners_and_back(cells, periodic, pressure, &mut traction),
                (_, Tractions::OfContact) => nodal_traction(cells, periodic, pressure, &mut traction),
            }
        }
        let driving = if smoothed { &traction[..] } else { pressure };
        self.room.compact.clear();
        self.room.compact.extend(self.room.cells.iter().map(|cell| driving[*cell as usize]));
        self.room.compact_traction.clear();
        if reads_traction {
            self.room.compact_traction.extend(self.room.cells.iter().map(|cell| traction[*cell as usize]));
        }
        self.room.traction = traction;
        self.call(driven, slope)
    }

    /// Evaluates the law at the cells in `room.cells` under the pressures in `room.compact`.
    pub(super) fn call(&mut self, driven: Driven, slope: bool) -> Result<Reply, PointError> {
        let whole = !self.solved.scheme.rate;
        let call = Call {
            driven,
            time: if whole { self.substep.segment.represented_at(self.substep.start) } else { driven.time },
            dt: self.substep.dt,
            load_step: self.substep.segment.number,
            substep: self.substep.number,
            cycle: self.substep.segment.cycle,
            cells: &self.room.cells,
            pressure: &self.room.compact,
            traction: &self.room.compact_traction,
            slope,
        };
        let remembered = Remembered {
            wear: &self.remembered_wear,
            distance: &self.distance,
            uniform_distance: self.uniform_distance,
            state: &self.state,
            gap: &self.room.law_gap,
            slides: &self.slides,
        };
        self.law.evaluate(self.plan, &self.solved.cells, self.evaluator, &call, &remembered)
    }

    /// Prepares the gap that a law reads: that of the pressure of the last solve.
    pub(super) fn measure_gap(&mut self, wear: &[f64]) {
        if !self.plan.fields.contains(Field::Gap) {
            return;
        }
        self.open_gap(wear);
        let mut out = std::mem::take(&mut self.room.law_gap);
        out.resize(self.pressure.len(), 0.0);
        self.model.displacement(&self.pressure, &mut out);
        for (out, gap) in out.iter_mut().zip(&self.room.gap) {
            *out = (*out + gap - self.solution.approach).min(f64::MAX);
        }
        self.room.law_gap = out;
    }

    /// Spreads the law's increments at `room.cells` over the cells as rates, and its state variables.
    pub(super) fn spread(&mut self, rate: &mut [f64]) {
        rate.fill(0.0);
        let dt = self.substep.dt;
        let states = self.plan.initial_state.len();
        if states > 0 {
            self.end_state.copy_from_slice(&self.state);
        }
        for (i, cell) in self.room.cells.iter().enumerate() {
            let cell = *cell as usize;
            rate[cell] = if dt > 0.0 { self.law.increment[i] / dt } else { 0.0 };
            if states > 0 {
                self.end_state[cell * states..(cell + 1) * states]
                    .copy_from_slice(&self.law.state[i * states..(i + 1) * states]);
            }
        }
    }

    /// The rate under the pressure of the last solve.
    pub(super) fn rate(&mut self, driven: Driven, rate: &mut [f64]) -> Result<Reply, PointError> {
        let reply = self.own_rate(driven, rate)?;
        if reply == Reply::Good && self.plan.material.average {
            self.average(rate);
        }
        Ok(reply)
    }

    /// The same before any averaging.
    pub(super) fn own_rate(&mut self, driven: Driven, rate: &mut [f64]) -> Result<Reply, PointError> {
        let open = self.evaluator.descriptor().wants_open_points();
        Self::list(&mut self.room.cells, &self.pressure, open);
        let pressure = std::mem::take(&mut self.pressure);
        let reply = self.evaluate(driven, &pressure, Tractions::OfContact, false);
        self.pressure = pressure;
        let reply = reply?;
        if reply == Reply::Good {
            self.spread(rate);
        }
        Ok(reply)
    }
}

impl Answering for System<'_> {
    type Error = PointError;

    fn explicit(&mut self, at: f64, wear: &[f64], rate: &mut [f64]) -> Result<Reply, PointError> {
        let driven = self.driven(at);
        self.press(driven.control, wear)?;
        self.measure_gap(wear);
        self.rate(driven, rate)
    }

    fn implicit(&mut self, at: f64, weight: f64, base: &[f64], rate: &mut [f64]) -> Result<Reply, PointError> {
        let driven = self.driven(at);
        // The last stage lies at the end of the step.
        let Substep { segment, start, dt, .. } = self.substep;
        self.stands = !self.trial && (at - start) * segment.scale >= 0.999 * dt;
        self.measure_gap(base);
        if self.is_post() {
            self.press(driven.control, base)?;
            return self.rate(driven, rate);
        }
        if self.plan.material.average {
            return self.averaged(driven, weight, base, rate);
        }
        match self.solved.scheme.slope {
            Slope::Proportional => self.proportional(driven, weight, base, rate),
            Slope::Derivative | Slope::Difference => self.newton(driven, weight, base, rate),
        }
    }
}
