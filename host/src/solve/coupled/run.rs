//! One run on a contact that answers back: prepared, then gone through.

use std::collections::BTreeMap;
use std::time::Instant;

use super::going::{Going, Leave};
use super::rows;
use super::segment::Segment;
use super::stepper::{Reach, Stepper};
use super::system::{Substep, System};
use crate::contact::surface::height_map;
use crate::integrator::{AdvanceError, Formula, norm};
use crate::law::Evaluator;
use crate::plan::{Plan, SolvedPlan};
use crate::record::{Checkpoint, End, Estimated, Line, Observer, Record};
use crate::scene::ScalingKind;
use crate::solve::{SolveError, contents};

/// Cells below which more threads than one cost more than they give.
pub(super) const SHARED: usize = 512 * 512;

/// A plan with its surface made and its velocities read, ready to go.
pub(in crate::solve) struct Coupled<'p> {
    pub(in crate::solve) plan: &'p Plan,
    pub(in crate::solve) solved: &'p SolvedPlan,
    pub(in crate::solve) evaluator: &'p dyn Evaluator,
    pub(super) gap: Vec<f64>,
    pub(super) velocities: Vec<Vec<f64>>,
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

    /// The same surface and velocities under another plan.
    pub(super) fn with<'q>(&self, plan: &'q Plan, solved: &'q SolvedPlan) -> Coupled<'q>
    where
        'p: 'q,
    {
        Coupled { plan, solved, evaluator: self.evaluator, gap: self.gap.clone(), velocities: self.velocities.clone() }
    }

    pub(in crate::solve) fn points(&self) -> usize {
        self.gap.len()
    }

    /// Hashes of what stands behind names of files.
    pub(in crate::solve) fn contents(&self) -> BTreeMap<String, String> {
        let mut contents = BTreeMap::from([
            ("the constants of the law".to_owned(), contents::of_value(&self.plan.material)),
            ("the surface".to_owned(), contents::of_numbers(&self.gap)),
        ]);
        contents.extend(self.velocities.iter().enumerate().map(|(index, velocities)| {
            (format!("the file of velocities number {}", index + 1), contents::of_numbers(velocities))
        }));
        contents
    }

    /// Goes through the plan on at most `threads` threads (0: as many as the machine has), from a checkpoint if there is
    /// one.
    ///
    /// # Errors
    /// A checkpoint that is not of this plan; nothing has been done then.
    pub(in crate::solve) fn go(
        &self,
        threads: usize,
        observer: &mut (dyn Observer + Send),
        from: Option<&Checkpoint<'_>>,
    ) -> Result<Record<SolveError>, SolveError> {
        let begin = Instant::now();
        let threads = if self.gap.len() < SHARED { 1 } else { threads };
        let geometry = self.geometry();
        let line = Line::of(&geometry);
        let mut going = Going::new(self.plan, self.gap.len(), observer);
        going.begin = begin;
        let (mut system, mut refused) = (None, None);
        let end = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(|| {
                let system = system.insert(self.system(pool.current_num_threads()));
                if let Some(from) = from
                    && let Err(error) = going.take_up(system, self.plan, from)
                {
                    refused = Some(error);
                    return End::Interrupted;
                }
                let left = self.blocks(system, &mut going);
                going.offer(system, self.evaluator, true);
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
        if let Some(error) = refused {
            return Err(error.into());
        }
        for warning in std::mem::take(&mut going.asides).into_iter().chain(self.evaluator.take_warnings()) {
            going.warn(warning);
        }
        if going.replaced > 0 {
            going.warn(format!(
                "in {} of {} steps the second-order method would have worn a closed point open: backward Euler took them",
                going.replaced, going.steps
            ));
        }
        let mut system = system.unwrap_or_else(|| self.system(1));
        let cost = going.cost(&system);
        let stability = going.watch.told(self, going.steps);
        let Going { stepper, history, warnings, units, start_pressure, control, longest, .. } = going;
        let none = vec![0.0; self.gap.len()];
        let profile = line.map(|line| {
            line.profile(&units, [&start_pressure[..], &system.pressure[..], &none[..], &stepper.wear[..]])
        });
        let estimated =
            if self.plan.tolerance.is_some() { control.estimated(&stepper.wear) } else { Estimated::default() };
        Ok(Record {
            estimated,
            largest_step: longest,
            cost,
            history,
            wear: stepper.wear,
            pressure: std::mem::take(&mut system.pressure),
            state: std::mem::take(&mut system.state),
            memory: self.memory(),
            warnings,
            stability,
            profile,
            geometry,
            units,
            end,
        })
    }

    /// Goes through one load step from `going.place` on; sums up there the relative change of pressure that its wear makes,
    /// where scaling wants it.
    pub(super) fn segment(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: Segment<'p>,
        cycles_per_time: f64,
    ) -> Result<(), Leave> {
        let scaling = self.plan.material.scaling.kind;
        system.slides = self.slides(segment.step)?;
        if !going.place.entered {
            self.press_start(system, going, &segment)?;
            going.place.entered = true;
        }
        if scaling == ScalingKind::Auto {
            return self.stretched(system, going, segment, cycles_per_time);
        }
        for until in segment.cuts(self.plan) {
            let idle = Stepper::is_idle(system, &segment);
            if self.plan.tolerance.is_some() && !idle && going.place.at < until {
                self.once_more(system, going, segment, until, cycles_per_time)?;
                if going.leaving.is_none() && going.place.at < until {
                    self.controlled(system, going, segment, until, cycles_per_time)?;
                }
                going.settle(system, self.evaluator)?;
            }
            let first = going.place.number;
            while going.place.at < until {
                let (at, number) = (going.place.at, going.place.number + 1);
                self.few_enough(&segment, (first, number), segment.represented_at(at))?;
                let end = self.within_limit(system, going, &segment, (at, until, number))?;
                let reach = Reach { start: at, until: end, number };
                let length = self.step(system, going, (segment, reach), cycles_per_time)?;
                going.place.at = if length >= until - at { until } else { at + length };
                going.place.number = number;
                if scaling == ScalingKind::Cycle {
                    let before = going.stepper.before();
                    going.place.change += self.change(system, before, &segment, going.place.at)?;
                }
                going.settle(system, self.evaluator)?;
            }
        }
        going.clock.simulated = segment.end();
        going.clock.represented = segment.represented_at(segment.end());
        Ok(())
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
        for until in segment.events(self.plan) {
            let first = going.place.number;
            while going.clock.represented < until {
                let (at, represented) = (going.place.at, going.clock.represented);
                self.few_enough(&segment, (first, going.place.number + 1), represented)?;
                let left = (until - represented) / unscaled;
                let stretch = going.place.stretch;
                let scale = if stretch >= left * (1.0 - 1e-12) { left } else { stretch };
                let mut piece = Segment { start: at, length: unscaled, represented, scale, ..segment };
                let number = going.place.number + 1;
                let end = self.within_limit(system, going, &piece, (at, at + unscaled, number))?;
                let scale = scale * ((end - at) / unscaled).min(1.0);
                piece.scale = scale;
                let reach = Reach { start: at, until: at + unscaled, number };
                let length = self.step(system, going, (piece, reach), cycles_per_time)?;
                going.place.at = if length >= unscaled { at + unscaled } else { at + length };
                going.place.number = number;
                if length >= unscaled {
                    going.clock.represented = if scale == left { until } else { represented + scale * unscaled };
                }
                let change = self.change(system, going.stepper.before(), &piece, going.place.at)?;
                going.place.stretch = self.plan.material.scaling.factor(change / scale);
                going.settle(system, self.evaluator)?;
            }
        }
        Ok(())
    }

    /// Refuses a substep number that lies too far behind the last event, at a represented time.
    fn few_enough(&self, segment: &Segment<'p>, (first, number): (i64, i64), time: f64) -> Result<(), SolveError> {
        let (substeps, most) = ((number - first).unsigned_abs(), self.plan.most_substeps);
        if substeps <= most {
            return Ok(());
        }
        let source = Box::new(AdvanceError::ManySubsteps { time, substeps, most });
        Err(SolveError::Advance { load_step: segment.number, substep: number, time, source })
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
        going.tell(system, &segment, &accepted, row, whole);
        Ok(accepted.length)
    }

    /// Brings the contact to what presses at the start of a load step, if that differs from the end of the one before.
    pub(super) fn press_start(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: &Segment<'p>,
    ) -> Result<(), Leave> {
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
            let before = (system.pressure.clone(), system.solution);
            if let Err(source) = system.press(driven.control, &going.stepper.wear) {
                system.go_back(&before.0);
                system.solution = before.1;
                return Err(advance(source).into());
            }
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
    pub(super) fn change(
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
