//! Explicit steps and their stability limit: measured where a load step begins and where the contact or the law's slope
//! has changed since, then kept, cut or overstepped as the scene says.

use super::controlled::failed;
use super::going::{Going, Leave};
use super::run::Coupled;
use super::segment::{Driven, Segment};
use super::system::{Substep, System, Tractions};
use crate::contact::Control;
use crate::integrator::{AdvanceError, Formula, Reply};
use crate::plan::{Elastic, Slope};
use crate::record::{Checkpoint, CheckpointError, Stability};
use crate::scene::{BeyondLimit, Mode};
use crate::solve::{PointError, SolveError};
use crate::stability::stiffness::{Basis, Linearised, Stiffness, measure};
use crate::stability::{EXPLICIT_LIMIT, explicit_limit};

/// Part of the limit that steps are cut to: what the stiffness may change before it is measured again.
const KEPT: f64 = 0.9;
/// Part of the largest pressure below which points are left out of the measure where the law is concave: its derivative
/// is infinite at no pressure.
const LEFT_OUT: f64 = 1e-2;
/// Local degree of the law in the pressure below which it is concave; difference quotients are good to 1e-7.
const CONCAVE: f64 = 0.999;
/// Change of the number of cells in contact after which the stiffness is measured again.
const GROWN: f64 = 0.25;
/// Relative change of the law's slope after which it is measured again; less is followed by the slope itself.
const STEEPER: f64 = 0.1;
/// Wishes of a law for a shorter step that are followed while its slope is looked up.
const MOST_CUTS: usize = 60;

/// The stiffness at one moment.
#[derive(Clone, Debug, Default)]
pub(super) struct Measured {
    pub(super) stiffness: Stiffness,
    /// Slopes d(rate)/d(pressure) `[cells]`.
    pub(super) slopes: Vec<f64>,
    /// Cells in contact that were left out because the law is concave there.
    pub(super) left_out: usize,
    pub(super) touching: usize,
    /// The cell with the largest slope.
    steepest: usize,
}

/// What later steps are compared with.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// The stiffness; per time.
    per_time: f64,
    /// The cell with the largest slope, and that slope.
    steepest: usize,
    slope: f64,
    /// Cells in contact.
    touching: usize,
    load_given: bool,
}

/// What is known of the limit during a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    last: Option<Known>,
    measured: Option<f64>,
    left_out: usize,
    /// Steps that were cut, and steps that were taken although they were too long.
    cut: u64,
    beyond: u64,
    /// Time that measuring took; not in checkpoints, because nothing depends on it.
    pub(super) spent: std::time::Duration,
}

impl System<'_> {
    /// Slopes of the law `[cells]` under the pressure of the last solve, per represented time, and the number of points
    /// left out.
    fn slopes(&mut self, driven: Driven) -> Result<(Vec<f64>, usize), PointError> {
        let point = self.pressure.clone();
        let mut slopes = vec![0.0; point.len()];
        Self::list(&mut self.room.cells, &point, false);
        if !self.linearised(driven, &point)? {
            return Ok((slopes, 0));
        }
        let largest = self.room.compact.iter().fold(0.0, |most: f64, p| most.max(*p));
        let mut left_out = 0;
        for (i, cell) in self.room.cells.iter().enumerate() {
            let (pressure, slope, increment) = (self.room.compact[i], self.law.slope[i], self.law.increment[i]);
            if pressure < LEFT_OUT * largest && slope * pressure < CONCAVE * increment {
                left_out += 1;
            } else {
                slopes[*cell as usize] = slope / self.substep.dt;
            }
        }
        Ok((slopes, left_out))
    }

    /// Looks the law up at `room.cells`, in a step as short as it wishes; false if no step is short enough.
    fn linearised(&mut self, driven: Driven, point: &[f64]) -> Result<bool, PointError> {
        for _ in 0..MOST_CUTS {
            let reply = match self.solved.scheme.slope {
                // Of degree 1 the slope is the increment over the pressure, to the last digit.
                Slope::Proportional => self.evaluate(driven, point, Tractions::OfContact, false)?,
                Slope::Derivative | Slope::Difference => self.linearise_listed(driven, point, Tractions::OfContact)?,
            };
            match reply {
                Reply::Good if self.solved.scheme.slope == Slope::Proportional => {
                    let pairs = self.law.increment.iter().zip(&self.room.compact);
                    self.law.slope.clear();
                    self.law.slope.extend(pairs.map(|(increment, pressure)| increment / pressure));
                    return Ok(true);
                }
                Reply::Good => return Ok(true),
                Reply::Cut(factor) => self.substep.dt *= factor,
            }
        }
        Ok(false)
    }

    /// The slope at one cell under the pressure of the last solve.
    fn slope_at(&mut self, driven: Driven, cell: usize) -> Result<f64, PointError> {
        let point = self.pressure.clone();
        self.room.cells.clear();
        self.room.cells.push(cell as u32);
        let found = point[cell] > 0.0 && self.linearised(driven, &point)?;
        Ok(if found { self.law.slope[0] / self.substep.dt } else { 0.0 })
    }

    /// Measures how stiff the contact of the last solve is against wear.
    ///
    /// # Errors
    /// A law that fails or falls with pressure; a contact that cannot be solved on the frozen set.
    pub(super) fn stiffness(
        &mut self,
        driven: Driven,
        load_given: bool,
        wants_mode: bool,
    ) -> Result<Measured, PointError> {
        let (slopes, left_out) = self.slopes(driven)?;
        let set: Vec<bool> = self.pressure.iter().map(|p| *p > 0.0).collect();
        let touching = set.iter().filter(|on| **on).count();
        let periodic = matches!(self.solved.elastic, Elastic::HalfSpace { periodic: true, .. });
        let basis = match (self.plan.material.average, self.smoothed()) {
            (true, _) => Basis::Average,
            (_, true) => Basis::NodalStress { periodic },
            _ => Basis::Pressure,
        };
        // In full contact a periodic surface has no mean pressure to lose.
        let load_given = load_given || (periodic && touching == set.len());
        let contact = Linearised { set: &set, slopes: &slopes, basis, load_given };
        let begin = std::time::Instant::now();
        let found = measure(self.model.as_mut(), &contact, wants_mode);
        self.work.time += begin.elapsed();
        let stiffness = found?;
        self.work.solves += stiffness.solves;
        self.work.iterations += stiffness.iterations;
        self.work.fft_pairs += stiffness.fft_pairs;
        let largest = |best: usize, cell: usize| if slopes[cell] > slopes[best] { cell } else { best };
        let steepest = (0..slopes.len()).fold(0, largest);
        Ok(Measured { stiffness, slopes, left_out, touching, steepest })
    }
}

impl<'p> Coupled<'p> {
    /// Whether steps have a stability limit at all.
    pub(super) fn has_limit(&self) -> bool {
        self.solved.scheme.formula == Formula::ExplicitEuler && self.plan.material.mode != Mode::Post
    }

    /// Simulated time at which a step of a segment may end: `until`, or less where the scene wants steps to be cut.
    ///
    /// # Errors
    /// A step beyond the limit, where the scene refuses such; a limit that cannot be measured.
    pub(super) fn within_limit(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: &Segment<'p>,
        (at, until, number): (f64, f64, i64),
    ) -> Result<f64, Leave> {
        if !self.has_limit() {
            return Ok(until);
        }
        let step = (until - at) * segment.scale;
        let limit = self.limit(system, going, segment, (at, until, number))?;
        // What rounding makes of a step that is as long as the limit is not beyond it.
        if step <= limit * (1.0 + 1e-9) {
            return Ok(until);
        }
        let refused =
            SolveError::BeyondLimit { load_step: segment.number, time: segment.represented_at(at), step, limit };
        match self.solved.beyond_limit {
            BeyondLimit::Refuse => Err(refused.into()),
            BeyondLimit::Run => {
                going.watch.beyond += 1;
                Ok(until)
            }
            BeyondLimit::Substep => {
                let pieces = (step / (KEPT * limit)).ceil();
                let end = at + (until - at) / pieces;
                let most = self.plan.most_substeps;
                if end - at <= 16.0 * f64::EPSILON * until.abs() || pieces > most as f64 {
                    let many =
                        AdvanceError::ManySubsteps { time: segment.represented_at(at), substeps: pieces as u64, most };
                    return Err(failed(segment, number - 1, at, many).into());
                }
                going.watch.cut += 1;
                Ok(end)
            }
        }
    }

    /// The fewest equal steps over a stretch that keep the limit as it is at its start; 1 for implicit steps.
    ///
    /// # Errors
    /// More steps than any pass takes; a limit that cannot be measured.
    pub(super) fn fewest_steps(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: &Segment<'p>,
        (at, until, number): (f64, f64, i64),
    ) -> Result<u64, Leave> {
        if !self.has_limit() {
            return Ok(1);
        }
        let step = (until - at) * segment.scale;
        let limit = self.limit(system, going, segment, (at, until, number + 1))?;
        let steps = (step / (KEPT * limit)).ceil().max(1.0);
        let most = self.plan.most_substeps;
        if steps > most as f64 {
            let many = AdvanceError::ManySubsteps { time: segment.represented_at(at), substeps: steps as u64, most };
            return Err(failed(segment, number, at, many).into());
        }
        Ok(steps as u64)
    }

    /// The limit for a step; infinite where nothing that it wears changes the pressure.
    fn limit(
        &self,
        system: &mut System<'p>,
        going: &mut Going<'_>,
        segment: &Segment<'p>,
        (at, until, number): (f64, f64, i64),
    ) -> Result<f64, Leave> {
        let advance = |source: PointError| SolveError::Advance {
            load_step: segment.number,
            substep: number,
            time: segment.represented_at(at),
            source: Box::new(source.into()),
        };
        system.substep = Substep { segment: *segment, start: at, dt: (until - at) * segment.scale, number };
        let mut driven = system.driven(at);
        let end = segment.at(until).velocity;
        if end.abs() > driven.velocity.abs() {
            // The slope at the start says nothing of a motion that is still to begin.
            driven.velocity = end;
        }
        let load_given = matches!(driven.control, Control::Load(_));
        if let Some(last) = going.watch.last.filter(|last| last.load_given == load_given) {
            let touching = system.pressure.iter().filter(|p| **p > 0.0).count();
            let (cell, before, known) = (last.steepest, last.slope, last.touching);
            let slope = system.slope_at(driven, cell).map_err(advance)?;
            let begins = number == 1;
            let grown = (touching as f64 / known as f64 - 1.0).abs();
            let steeper = if before == 0.0 && slope == 0.0 { 0.0 } else { (slope / before - 1.0).abs() };
            let same = match begins {
                // Another load step with the contact and the slope of the one before has its limit, too.
                true => system.slides.is_empty() && grown <= 0.2 * GROWN && steeper <= 0.1 * STEEPER,
                false => grown < GROWN && steeper < STEEPER,
            };
            if same {
                let ratio = if before > 0.0 { slope / before } else { 1.0 };
                return Ok(explicit_limit(last.per_time * ratio));
            }
        }
        let begin = std::time::Instant::now();
        let measured = system.stiffness(driven, load_given, false).map_err(advance);
        going.watch.spent += begin.elapsed();
        let measured = measured?;
        let found = measured.stiffness.per_time;
        let watch = &mut going.watch;
        watch.measured = Some(watch.measured.map_or(found, |most| most.max(found)));
        watch.left_out = watch.left_out.max(measured.left_out);
        watch.last = Some(Known {
            per_time: found,
            steepest: measured.steepest,
            slope: measured.slopes[measured.steepest],
            touching: measured.touching,
            load_given,
        });
        Ok(explicit_limit(found))
    }
}

impl Watch {
    /// Keeps what later steps and the report depend on.
    pub(super) fn save(&self, to: &mut Checkpoint<'_>) {
        let mut set = |name: &str, value: f64| to.set(&format!("limit.{name}"), value);
        set("measured", self.measured.unwrap_or(-1.0));
        set("left_out", self.left_out as f64);
        set("cut", self.cut as f64);
        set("beyond", self.beyond as f64);
        set("known", f64::from(u8::from(self.last.is_some())));
        if let Some(last) = self.last {
            set("per_time", last.per_time);
            set("steepest", last.steepest as f64);
            set("slope", last.slope);
            set("touching", last.touching as f64);
            set("load_given", f64::from(u8::from(last.load_given)));
        }
    }

    /// Takes up what [`Watch::save`] kept of a run on so many cells.
    ///
    /// # Errors
    /// A number that is not there, or a cell that the grid does not have.
    pub(super) fn load(from: &Checkpoint<'_>, cells: usize) -> Result<Watch, CheckpointError> {
        let number = |name: &str| from.number(&format!("limit.{name}"));
        let last = if number("known")? > 0.0 {
            let steepest = number("steepest")?;
            if !(steepest >= 0.0 && steepest < cells as f64) {
                return Err(CheckpointError::Place { found: "a cell that the grid does not have".to_owned() });
            }
            Some(Known {
                per_time: number("per_time")?,
                steepest: steepest as usize,
                slope: number("slope")?,
                touching: number("touching")? as usize,
                load_given: number("load_given")? > 0.0,
            })
        } else {
            None
        };
        Ok(Watch {
            last,
            measured: Some(number("measured")?).filter(|stiffness| *stiffness >= 0.0),
            left_out: number("left_out")? as usize,
            cut: number("cut")? as u64,
            beyond: number("beyond")? as u64,
            ..Watch::default()
        })
    }

    /// What a report says, after so many steps.
    pub(super) fn told(&self, run: &Coupled<'_>, steps: u64) -> Stability {
        let limit = self.measured.map(explicit_limit).filter(|limit| limit.is_finite());
        let text = self.measured.map_or_else(
            || "not measured".to_owned(),
            |stiffness| match limit {
                Some(limit) => format!("the smallest limit is {limit:.4e} ({EXPLICIT_LIMIT} / {stiffness:.4e})"),
                None => "nothing limits them: what wears does not change the pressure".to_owned(),
            },
        );
        let left_out = match self.left_out {
            0 => String::new(),
            points => format!(
                "; {points} points under less than {LEFT_OUT} of the largest pressure were left out of the measure, \
                 because the law's derivative grows without bound there"
            ),
        };
        let verdict = match run.solved.scheme.formula {
            _ if run.plan.material.mode == Mode::Post => {
                "no step has a stability limit: wear is only a result and never changes the contact".to_owned()
            }
            Formula::ExplicitEuler if self.beyond > 0 => format!(
                "unstable: {} of {steps} explicit steps were longer than the stability limit, {text}{left_out}; the \
                 wear depths and pressures are not to be trusted, whatever the volume",
                self.beyond
            ),
            Formula::ExplicitEuler if self.cut > 0 => {
                format!("stable: explicit steps were cut to {KEPT} of their limit {} times, {text}{left_out}", self.cut)
            }
            Formula::ExplicitEuler => format!("stable: every explicit step kept its limit, {text}{left_out}"),
            _ => "stable at any step: the method is implicit; `wearlaw stability` measures the stiffness".to_owned(),
        };
        Stability { stiffness: self.measured, explicit_limit: limit, is_unstable: self.beyond > 0, verdict }
    }
}
