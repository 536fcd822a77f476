//! One run on a contact that answers back: prepared, then gone through.

use std::time::Instant;

use super::controlled::Control;
use super::going::{Going, Leave};
use super::rows::{self, Clock};
use super::segment::Segment;
use super::stepper::{Reach, Stepper};
use super::system::{Room, Substep, System, Work};
use crate::contact::foundation::Foundation;
use crate::contact::halfspace::{Boundary, HalfSpace};
use crate::contact::surface::{height_map, std_of_gap};
use crate::contact::{ContactModel, Solution};
use crate::integrator::{Formula, Stages, norm};
use crate::law::{Evaluator, Field};
use crate::plan::{Block, Elastic, LoadStep, Plan, SolvedPlan};
use crate::record::{self, Cost, End, Line, MemoryLine, Observer, Record};
use crate::scene::ScalingKind;
use crate::solve::ending::peak_memory;
use crate::solve::{SolveError, fields};

/// Cells below which more threads than one cost more than they give.
const SHARED: usize = 512 * 512;

/// A plan with its surface made and its velocities read, ready to go.
pub(in crate::solve) struct Coupled<'p> {
    pub(in crate::solve) plan: &'p Plan,
    pub(in crate::solve) solved: &'p SolvedPlan,
    pub(in crate::solve) evaluator: &'p dyn Evaluator,
    pub(super) gap: Vec<f64>,
    velocities: Vec<Vec<f64>>,
}

impl<'p> Coupled<'p> {
    /// Makes the surface and reads the velocities of a plan.
    ///
    /// # Errors
    /// A surface that cannot be made, a file that cannot be read or is of another size than the grid.
    pub(in crate::solve) fn prepare(
        plan: &'p Plan,
        solved: &'p SolvedPlan,
        evaluator: &'p dyn Evaluator,
    ) -> Result<Coupled<'p>, SolveError> {
        let gap = solved.surface.initial_gap(&solved.cells, solved.is_periodic())?;
        let read = |path: &std::path::PathBuf| height_map::read(path, &solved.cells);
        let velocities = solved.velocity_files.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Coupled { plan, solved, evaluator, gap, velocities })
    }

    pub(in crate::solve) fn points(&self) -> usize {
        self.gap.len()
    }

    pub(in crate::solve) fn geometry(&self) -> record::Geometry<'static> {
        let cells = self.solved.cells;
        let size = [0, 1].map(|axis| cells.spacing[axis] * cells.counts[axis] as f64);
        // A line has no width: its one row of cells lies on y = 0.
        let origin = if cells.dimension == 2 { [0.0, -0.5 * size[1]] } else { [0.0, 0.0] };
        record::Geometry::Grid(record::Grid { cells: cells.counts, size, origin })
    }

    /// Whether points of one scene slide over different distances.
    fn distances(&self) -> bool {
        let steps = self.plan.blocks.iter().flat_map(|block| &block.steps);
        steps.into_iter().any(|step| step.velocity_file.is_some() || step.stick.is_some_and(|stick| stick > 0.0))
    }

    pub(in crate::solve) fn memory(&self) -> Vec<MemoryLine> {
        let cells = self.gap.len();
        let line = |what: &str, bytes: usize| MemoryLine { what: what.to_owned(), bytes: bytes as u64 };
        let mut lines = vec![
            line("initial gap", 8 * cells),
            line("wear depth, at the start and the end of a step", 16 * cells),
            line("contact pressure, now and at the start of a step", 16 * cells),
            line("wear rates of the stages", Stages::bytes(self.solved.scheme.formula, cells)),
            line("gap of a stage", 8 * cells),
        ];
        if self.solved.scheme.slope != crate::plan::Slope::Proportional
            && self.solved.scheme.formula != Formula::ExplicitEuler
        {
            lines.push(line("linearisation of the law", 24 * cells));
        }
        let states = self.plan.initial_state.len();
        if states > 0 {
            lines.push(line("state variables, at the start and the end of a step", 16 * cells * states));
        }
        if self.distances() {
            lines.push(line("sliding distances and velocities", 16 * cells));
        }
        lines
    }

    pub(in crate::solve) fn segments_planned(&self) -> u64 {
        let substeps = self.plan.substeps.unwrap_or(1);
        self.plan.blocks.iter().map(|block| block.count * block.steps.len() as u64 * substeps).sum()
    }

    fn model(&self, threads: usize) -> Box<dyn ContactModel> {
        match self.solved.elastic {
            Elastic::Foundation(stiffness) => Box::new(Foundation::new(self.solved.cells, stiffness)),
            Elastic::HalfSpace { modulus, periodic, datum } => {
                let boundary = if periodic { Boundary::Periodic } else { Boundary::Free };
                Box::new(HalfSpace::new(self.solved.cells, modulus, boundary, datum, threads))
            }
        }
    }

    fn system(&self, threads: usize) -> System<'p> {
        let cells = self.gap.len();
        let first = self.plan.blocks.first().and_then(|block| block.steps.first());
        let segment = Segment {
            step: first.unwrap_or(const { &LoadStep::NOTHING }),
            start: 0.0,
            length: 0.0,
            represented: 0.0,
            scale: 1.0,
            number: 1,
            cycle: 0,
        };
        let reads_wear = self.plan.fields.contains(Field::AccumulatedWear);
        System {
            plan: self.plan,
            solved: self.solved,
            evaluator: self.evaluator,
            model: self.model(threads),
            gap_scale: std_of_gap(&self.solved.cells, &self.gap),
            initial_gap: self.gap.clone(),
            pressure: vec![0.0; cells],
            solution: Solution::default(),
            closed: Vec::new(),
            law: Default::default(),
            substep: Substep { segment, start: 0.0, dt: 0.0, number: 1 },
            slides: Vec::new(),
            remembered_wear: if reads_wear { vec![0.0; cells] } else { Vec::new() },
            distance: if self.distances() { vec![0.0; cells] } else { Vec::new() },
            uniform_distance: 0.0,
            state: self.plan.initial_state.repeat(cells),
            end_state: self.plan.initial_state.repeat(cells),
            work: Work::default(),
            room: Room::default(),
            steady: None,
        }
    }

    /// Relative velocities of the cells in a load step; empty where all slide alike.
    pub(super) fn slides(&self, step: &LoadStep) -> Result<Vec<f64>, SolveError> {
        let stick = step.stick.filter(|stick| *stick > 0.0);
        let mut slides = match (step.velocity_file, stick) {
            (Some(file), _) => self.velocities[file].clone(),
            (None, Some(_)) => vec![1.0; self.gap.len()],
            (None, None) => Vec::new(),
        };
        if let Some(stick) = stick {
            let radii = self.solved.surface.distances(&self.solved.cells, self.solved.is_periodic())?;
            for (slide, radius) in slides.iter_mut().zip(radii) {
                if radius < stick {
                    *slide = 0.0;
                }
            }
        }
        Ok(slides)
    }

    /// Goes through the plan on at most `threads` threads (0: as many as the machine has).
    pub(in crate::solve) fn go(&self, threads: usize, observer: &mut (dyn Observer + Send)) -> Record<SolveError> {
        let begin = Instant::now();
        let threads = if self.gap.len() < SHARED { 1 } else { threads };
        let geometry = self.geometry();
        let line = Line::of(&geometry);
        let count = |block: &Block| block.count as f64 * block.steps.iter().filter_map(|s| s.duration).sum::<f64>();
        let mut going = Going {
            stepper: Stepper::new(self.gap.len(), self.plan.smallest_step),
            clock: Clock::default(),
            history: record::History::default(),
            steps: 0,
            rejected: 0,
            replaced: 0,
            control: Control::new(),
            longest: 0.0,
            warnings: Vec::new(),
            observer,
            units: fields::units(self.plan),
            total: self.plan.blocks.iter().map(count).sum(),
            start_pressure: Vec::new(),
            snapshot_told: false,
            pressed: None,
        };
        let mut system = None;
        let end = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(|| {
                let system = system.insert(self.system(pool.current_num_threads()));
                let left = self.blocks(system, &mut going);
                going.finish(system);
                match left {
                    Ok(()) => End::Done,
                    Err(Leave::Failed(error)) => End::Failed(error),
                    Err(Leave::Stopped(reason)) => End::Stopped(reason),
                    Err(Leave::Interrupted) => End::Interrupted,
                }
            }),
            Err(error) => End::Failed(SolveError::Threads { threads, text: error.to_string() }),
        };
        for warning in self.evaluator.take_warnings() {
            going.warn(warning);
        }
        if going.replaced > 0 {
            going.warn(format!(
                "in {} of {} steps the second-order method would have worn a closed point open: backward Euler took them",
                going.replaced, going.steps
            ));
        }
        let mut system = system.unwrap_or_else(|| self.system(1));
        let size = norm(going.stepper.wear.iter().copied());
        let Going { stepper, history, warnings, units, start_pressure, .. } = going;
        let none = vec![0.0; self.gap.len()];
        let profile = line.map(|line| {
            line.profile(&units, [&start_pressure[..], &system.pressure[..], &none[..], &stepper.wear[..]])
        });
        let estimated = self.plan.tolerance.is_some();
        Record {
            estimated_error: (estimated && size > 0.0).then(|| going.control.error / size),
            largest_step: going.longest,
            cost: Cost {
                run_time_s: begin.elapsed().as_secs_f64(),
                law_time_s: system.law.law_time.as_secs_f64(),
                contact_time_s: system.work.time.as_secs_f64(),
                steps: going.steps,
                rejected_steps: going.rejected,
                law_calls: system.law.law_calls,
                points_evaluated: system.law.points_evaluated,
                contact_solves: system.work.solves,
                contact_iterations: system.work.iterations,
                fft_pairs: system.work.fft_pairs,
                peak_memory_bytes: peak_memory(),
            },
            history,
            wear: stepper.wear,
            pressure: std::mem::take(&mut system.pressure),
            state: std::mem::take(&mut system.state),
            memory: self.memory(),
            warnings,
            profile,
            geometry,
            units,
            end,
        }
    }

    fn blocks(&self, system: &mut System<'p>, going: &mut Going<'_>) -> Result<(), Leave> {
        let mut number = 0;
        for block in &self.plan.blocks {
            let cbcs = block.cycle && self.plan.material.scaling.kind == ScalingKind::Cycle;
            let (mut done, mut scale) = (0.0, 1.0);
            let count = block.count as f64;
            while done < count {
                // The last scaled cycle is cut to land on the count.
                let rest: f64 = count - done;
                scale = rest.min(scale);
                let before = going.clock.cycles;
                let mut change = 0.0;
                for (index, step) in block.steps.iter().enumerate() {
                    let step = if done == 0.0 && index == 0 { &block.entry } else { step };
                    let segment = Segment {
                        step,
                        start: going.clock.simulated,
                        length: step.duration.unwrap_or(0.0),
                        represented: going.clock.represented,
                        scale,
                        number: number + index as i64 + 1,
                        cycle: if block.cycle { (before + 1.0) as i64 } else { 0 },
                    };
                    let period: f64 = block.steps.iter().filter_map(|step| step.duration).sum();
                    let per_time = if block.cycle && period > 0.0 { scale / period } else { 0.0 };
                    change += self.segment(system, going, segment, per_time)?;
                }
                if block.cycle {
                    done += scale;
                    going.clock.cycles = before + scale;
                    if cbcs {
                        scale = self.plan.material.scaling.factor(change / scale);
                    }
                } else {
                    done += 1.0;
                }
            }
            number += block.steps.len() as i64;
        }
        Ok(())
    }

    /// Goes through one load step; gives the relative change of pressure that its wear made, where scaling wants it.
    fn segment(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        cycles_per_time: f64,
    ) -> Result<f64, Leave> {
        let scaling = self.plan.material.scaling.kind;
        system.slides = self.slides(segment.step)?;
        self.press_start(system, going, &segment)?;
        if scaling == ScalingKind::Auto {
            return self.stretched(system, going, segment, cycles_per_time).map(|()| 0.0);
        }
        let mut change = 0.0;
        let mut at = segment.start;
        let mut number = 0;
        for until in segment.cuts(self.plan) {
            let idle = Stepper::is_idle(system, &segment);
            if self.plan.tolerance.is_some() && !idle {
                let pressed = (scaling == ScalingKind::Cycle).then(|| going.stepper.moment(system));
                number = self.controlled(system, going, segment, (at, until, number), cycles_per_time)?;
                at = until;
                if let Some(before) = pressed {
                    change += self.change(system, before.pressed(), &segment, at)?;
                }
            }
            while at < until {
                number += 1;
                let length =
                    self.step(system, going, (segment, Reach { start: at, until, number }), cycles_per_time)?;
                at = if length >= until - at { until } else { at + length };
                if scaling == ScalingKind::Cycle {
                    let before = going.stepper.before();
                    change += self.change(system, before, &segment, at)?;
                }
            }
        }
        going.clock.simulated = segment.end();
        going.clock.represented = segment.represented_at(segment.end());
        Ok(change)
    }

    /// Goes through a load step of constant loading in substeps of one simulated length, each of which stands for as many
    /// as the change of pressure over the one before allows (AUTS); the last of them is cut to land on an event.
    fn stretched(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        cycles_per_time: f64,
    ) -> Result<(), Leave> {
        let unscaled = segment.length / self.plan.substeps.unwrap_or(1) as f64;
        let (mut at, mut represented) = (segment.start, segment.represented);
        let (mut number, mut stretch) = (0, 1.0);
        for until in segment.events(self.plan) {
            while represented < until {
                number += 1;
                let left = (until - represented) / unscaled;
                let scale = if stretch >= left * (1.0 - 1e-12) { left } else { stretch };
                let piece = Segment { start: at, length: unscaled, represented, scale, ..segment };
                let reach = Reach { start: at, until: at + unscaled, number };
                self.step(system, going, (piece, reach), cycles_per_time)?;
                at += unscaled;
                represented = if scale == left { until } else { represented + scale * unscaled };
                going.clock.represented = represented;
                stretch =
                    self.plan.material.scaling.factor(self.change(system, going.stepper.before(), &piece, at)? / scale);
            }
        }
        Ok(())
    }

    /// Takes one step and tells of it; gives its simulated length.
    fn step(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        (segment, reach): (Segment<'p>, Reach),
        cycles_per_time: f64,
    ) -> Result<f64, Leave> {
        let accepted = match Stepper::is_idle(system, &segment) {
            true => going.stepper.rest(system, segment, reach),
            false => going.stepper.advance(system, segment, reach),
        };
        let accepted = accepted.map_err(|source| SolveError::Advance {
            load_step: segment.number,
            substep: reach.number,
            time: segment.represented_at(reach.start),
            source: Box::new(source),
        })?;
        let whole = accepted.length >= reach.until - reach.start;
        let at = if whole { reach.until } else { reach.start + accepted.length };
        going.moved(&segment, accepted.length, at, cycles_per_time);
        let row = rows::row(system, &going.stepper.wear, &going.clock, accepted.length * segment.scale, segment.scale);
        going.tell(system, &segment, &accepted, row, whole)?;
        Ok(accepted.length)
    }

    /// Brings the contact to what presses at the start of a load step, if that differs from the end of the one before.
    fn press_start(&self, system: &mut System<'p>, going: &mut Going<'_>, segment: &Segment<'p>) -> Result<(), Leave> {
        system.substep = Substep { segment: *segment, start: segment.start, dt: segment.length, number: 1 };
        let driven = segment.at(segment.start);
        let first = going.history.rows.is_empty();
        let same = !first && going.pressed == Some(driven.control);
        let first_order =
            self.solved.scheme.formula.order() < 2 && self.solved.scheme.formula != Formula::ExplicitEuler;
        let needed = first || !first_order;
        let scaled = self.plan.material.scaling.kind != ScalingKind::None;
        if !same && (needed || scaled) {
            let advance = |source: crate::solve::PointError| SolveError::Advance {
                load_step: segment.number,
                substep: 1,
                time: segment.represented,
                source: Box::new(source.into()),
            };
            system.press(driven.control, &going.stepper.wear).map_err(advance)?;
        }
        (going.stepper.fresh, going.stepper.known) = (false, false);
        going.clock.temperature = driven.temperature;
        if first {
            going.history.rows.push(rows::row(system, &going.stepper.wear, &going.clock, 0.0, 1.0));
            going.start_pressure.clone_from(&system.pressure);
        }
        Ok(())
    }

    /// The relative change of the pressure that wear has made since the surface was worn by `wear` and carried `pressure`.
    fn change(
        &self,
        system: &mut System<'p>,
        (wear, pressure): (&[f64], &[f64]),
        segment: &Segment<'p>,
        at: f64,
    ) -> Result<f64, SolveError> {
        if system.is_post() {
            return Ok(0.0);
        }
        let end = system.pressure.clone();
        let start = if segment.presses_steadily() {
            pressure.to_vec()
        } else {
            // The same surface as before the step under the load at its end: what differs is what wear changed.
            let solution = system.solution;
            let pressed = system.press(segment.at(at).control, wear);
            let unworn = std::mem::replace(&mut system.pressure, end.clone());
            system.solution = solution;
            pressed.map_err(|source| SolveError::Advance {
                load_step: segment.number,
                substep: 1,
                time: segment.represented_at(at),
                source: Box::new(source.into()),
            })?;
            unworn
        };
        let size = norm(start.iter().copied());
        let moved = norm(start.iter().zip(&end).map(|(a, b)| a - b));
        Ok(if size > 0.0 { moved / size } else { 0.0 })
    }
}
