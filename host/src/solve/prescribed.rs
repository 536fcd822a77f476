//! One run under a prescribed pressure: prepared, then gone through.

mod estimate;
mod ordinary;
mod place;
mod rounds;

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use crate::contact::prescribed::{History, Motion};
use crate::integrator::quadrature::Quadrature;
use crate::integrator::substeps::Control;
use crate::integrator::{Tally, norm};
use crate::law::{Evaluator, OutputItem};
use crate::plan::{Advance, FieldKind, Plan, ReferencePlan};
use crate::record::{
    self, Checkpoint, Cost, End, Estimated, Event, Line, MemoryLine, Observer, Record, Stability, Wish,
};
use crate::scene::ScalingKind;
use crate::solve::chunk::SCANNED_POINTS;
use crate::solve::inputs::Drive;
use crate::solve::progress::Arrays;
use crate::solve::schedule::{self, Piece, Schedule};
use crate::solve::site::Site;
use crate::solve::{ErrorNorm, Expected, SolveError, compare, contents, fields, reference};
use place::Place;

/// Different instants between two rows at which points change sign that become events of their own; more of them are
/// left to the quadrature's halving.
const MOST_EVENTS: usize = 16;
/// How much tighter the run is that a scene is compared with when it asks for a reference of its own.
const REFINEMENT: f64 = 1e-2;

/// A plan with its history read, ready to go.
pub(super) struct Prescribed<'p> {
    pub(super) plan: &'p Plan,
    evaluator: &'p dyn Evaluator,
    history: Option<History>,
    points: usize,
    distances: bool,
}

/// What changes from piece to piece.
struct Going {
    arrays: Arrays,
    history: record::History,
    tally: Tally,
    law_time: Duration,
    warnings: Vec<String>,
    steps: u64,
    start_pressure: Vec<f64>,
    end_pressure: Vec<f64>,
    /// Where the loading can be gone on from; `None`: it has not begun.
    place: Option<Place>,
    /// What the evaluator warned of by the last checkpoint; told at the end.
    asides: Vec<String>,
    /// What the part before the checkpoint has cost that the run went on from.
    spent: Cost,
    begin: Instant,
    /// What the observer wished after the last step.
    wish: Wish,
}

impl<'p> Prescribed<'p> {
    /// Reads the history of a plan.
    ///
    /// # Errors
    /// A history that cannot be read, or that does not cover the loading.
    pub(super) fn prepare(plan: &'p Plan, evaluator: &'p dyn Evaluator) -> Result<Prescribed<'p>, SolveError> {
        let history = plan.history.as_ref().map(|path| History::read(path, &plan.columns)).transpose()?;
        let points = history.as_ref().map_or(1, History::points);
        let mut run = Prescribed { plan, evaluator, history, points, distances: false };
        let mut first = None;
        for placed in Schedule::new(plan, run.history.as_ref())?.placed() {
            first = schedule::pieces(plan, run.history.as_ref(), points, placed).into_iter().next();
            if first.is_some() {
                break;
            }
        }
        run.distances = first.is_some_and(|piece| {
            !Drive::new(plan, run.history.as_ref(), &piece).speed_is_uniform() && plan.motion != Motion::None
        });
        Ok(run)
    }

    /// Its history, where it has one.
    pub(super) fn history(&self) -> Option<&History> {
        self.history.as_ref()
    }

    /// Number of points.
    pub(super) fn points(&self) -> usize {
        self.points
    }

    /// Where the points lie.
    pub(super) fn geometry(&self) -> record::Geometry<'static> {
        fields::geometry(self.plan, self.history.as_ref(), self.points)
    }

    /// The memory that the run takes for its points, a line for each array.
    pub(super) fn memory(&self) -> Vec<MemoryLine> {
        let line = |what: &str, bytes: usize| MemoryLine { what: what.to_owned(), bytes: bytes as u64 };
        let mut lines: Vec<MemoryLine> = self.history.iter().map(|history| line("history", history.bytes())).collect();
        let states = self.plan.initial_state.len();
        let arrays =
            Arrays::bytes(self.points, states, self.distances, self.keeps_directions(), self.plan.material.average);
        lines.extend(arrays.into_iter().map(|(what, bytes)| line(what, bytes)));
        if self.plan.output.has(FieldKind::Pressure) && !self.plan.output.formats.is_empty() {
            lines.push(line("pressure field to write", 8 * self.points));
        }
        lines
    }

    /// Number of pieces of loading that the run goes through.
    ///
    /// # Errors
    /// A history that does not cover the loading.
    pub(super) fn pieces_planned(&self) -> Result<u64, SolveError> {
        let placed = Schedule::new(self.plan, self.history.as_ref())?.placed();
        Ok(placed.map(|placed| self.pieces(placed).len() as u64).sum())
    }

    /// Points times the fewest evaluations of the law at each of them; what misses its tolerance takes more.
    ///
    /// # Errors
    /// A history that does not cover the loading.
    pub(super) fn least_evaluations(&self) -> Result<u64, SolveError> {
        let mut evaluations = 0;
        for placed in Schedule::new(self.plan, self.history.as_ref())?.placed() {
            for piece in self.pieces(placed) {
                let drive = Drive::new(self.plan, self.history.as_ref(), &piece);
                let site = self.site(&piece);
                evaluations += match (crate::solve::chunk::rule(&site, &drive, self.points), self.plan.advance) {
                    (Some(rule), _) => rule.least_evaluations(),
                    (None, Advance::Substeps(Control::Tolerance(_), _)) => 3,
                    (None, _) => 1,
                };
            }
        }
        Ok(evaluations * self.points as u64)
    }

    fn keeps_directions(&self) -> bool {
        self.plan.output.has(FieldKind::Direction) && self.evaluator.descriptor().writes(OutputItem::Direction)
    }

    /// Hashes of what stands behind names of files.
    ///
    /// # Errors
    /// A history that cannot be read again.
    pub(super) fn contents(&self) -> Result<BTreeMap<String, String>, SolveError> {
        let mut all = BTreeMap::new();
        all.insert("the constants of the law".to_owned(), contents::of_value(&self.plan.material));
        if let Some(path) = &self.plan.history {
            all.insert("the history".to_owned(), contents::of_file(path)?);
        }
        Ok(all)
    }

    /// Goes through the plan on at most `threads` threads (0: as many as the machine has), from a checkpoint if there is
    /// one.
    ///
    /// However the run ends, the record holds what was done.
    ///
    /// # Errors
    /// A checkpoint that is not of this plan; nothing has been done then.
    pub(super) fn go(
        &self,
        threads: usize,
        observer: &mut (dyn Observer + Send),
        from: Option<&Checkpoint<'_>>,
    ) -> Result<Record<SolveError>, SolveError> {
        let begin = Instant::now();
        let mut going = Going {
            arrays: Arrays::new(
                self.points,
                &self.plan.initial_state,
                self.distances,
                self.keeps_directions(),
                self.plan.material.average,
            ),
            history: record::History::default(),
            tally: Tally::default(),
            law_time: Duration::ZERO,
            warnings: Vec::new(),
            steps: 0,
            start_pressure: Vec::new(),
            end_pressure: Vec::new(),
            place: None,
            asides: Vec::new(),
            spent: Cost::default(),
            begin,
            wish: Wish::GoOn,
        };
        if let Some(from) = from {
            self.take_up(&mut going, from)?;
        }
        let geometry = fields::geometry(self.plan, self.history.as_ref(), self.points);
        let line = Line::of(&geometry);
        // One chunk of points has nothing to share out.
        let threads = if self.points <= crate::solve::chunk::CHUNK { 1 } else { threads };
        let end = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(|| self.steps(&mut going, observer, line.is_some())),
            Err(error) => End::Failed(SolveError::Threads { threads, text: error.to_string() }),
        };
        for warning in std::mem::take(&mut going.asides).into_iter().chain(self.evaluator.take_warnings()) {
            if !going.warnings.contains(&warning) {
                observer.observe(Event::Warning(&warning));
                going.warnings.push(warning);
            }
        }
        let units = fields::units(self.plan);
        let profile = line.map(|line| {
            let none = vec![0.0; self.points];
            let ends = [&going.start_pressure[..], &going.end_pressure[..], &none[..], &going.arrays.wear[..]];
            line.profile(&units, ends)
        });
        let size = norm(going.arrays.wear.iter().copied());
        let estimated = matches!(
            self.plan.advance,
            Advance::Rate(
                Quadrature::Adaptive(_) | Quadrature::AdaptiveRule(..) | Quadrature::Fixed | Quadrature::Exact
            ) | Advance::Substeps(Control::Tolerance(_), _)
        );
        Ok(Record {
            estimated: Estimated {
                wear_l2_relative: (estimated && size > 0.0).then(|| going.tally.error / size),
                ..Estimated::default()
            },
            largest_step: going.tally.longest,
            cost: going.cost(begin),
            history: going.history,
            wear: going.arrays.wear,
            pressure: Vec::new(),
            state: going.arrays.state,
            memory: self.memory(),
            warnings: going.warnings,
            stability: Stability {
                verdict: "a prescribed pressure has no stability limit".to_owned(),
                ..Stability::default()
            },
            profile,
            geometry,
            units,
            end,
        })
    }

    fn site<'s>(&'s self, piece: &'s Piece<'s>) -> Site<'s> {
        let whole = matches!(self.plan.advance, Advance::Substeps(..));
        let law = self.evaluator.descriptor();
        Site { plan: self.plan, law, piece, history: self.history.as_ref(), whole }
    }

    /// All pieces of a load step, cut at the events inside them.
    fn pieces(&self, placed: schedule::Placed<'p>) -> Vec<Piece<'p>> {
        let coarse = schedule::pieces(self.plan, self.history.as_ref(), self.points, placed);
        let mut pieces = Vec::with_capacity(coarse.len());
        for piece in coarse {
            let drive = Drive::new(self.plan, self.history.as_ref(), &piece);
            pieces.extend(schedule::split(piece, self.events(&drive)));
        }
        for (index, piece) in pieces.iter_mut().enumerate() {
            piece.substep = index as i64 + 1;
        }
        pieces
    }

    /// Fractions of a piece at which pressure or velocity changes sign or a temperature passes a point of the table.
    fn events(&self, drive: &Drive<'_>) -> Vec<f64> {
        if self.points > SCANNED_POINTS {
            return Vec::new();
        }
        let mut events = drive.lift_offs(self.plan, self.points, MOST_EVENTS);
        if self.plan.motion == Motion::Velocity {
            events.extend(drive.velocity.crossings(0.0, MOST_EVENTS).unwrap_or_default());
        }
        events.extend(drive.shear.crossings(0.0, MOST_EVENTS).unwrap_or_default());
        for level in self.plan.material.constants.break_temperatures() {
            events.extend(drive.temperature.crossings(*level, MOST_EVENTS).unwrap_or_default());
        }
        events
    }

    /// Checks, before anything is computed, that the reference which the plan names can be had.
    ///
    /// # Errors
    /// A reference that does not cover the scene, or a file that cannot be read or lacks a point.
    pub(super) fn check_reference(&self) -> Result<(), SolveError> {
        match &self.plan.reference {
            None | Some(ReferencePlan::Refined) => {}
            Some(ReferencePlan::File(path)) => drop(reference::from_file(path, self.ids())?),
            Some(ReferencePlan::Exact(named)) => {
                reference::covered(self.plan, *named, &self.evaluator.descriptor().name)?;
            }
        }
        Ok(())
    }

    /// The numbers of the points in the history, or from 0.
    fn ids(&self) -> impl Iterator<Item = i64> + '_ {
        let history = self.history.as_ref();
        (0..self.points).map(move |i| history.map_or(i as i64, |history| history.point_ids().get(i)))
    }

    /// Compares a record with the reference that the plan names; `None` if it names none.
    ///
    /// # Errors
    /// A reference that does not cover the scene, or cannot be read or computed.
    pub(super) fn error(
        &self,
        record: &Record<SolveError>,
        observer: &mut (dyn Observer + Send),
    ) -> Result<Option<ErrorNorm>, SolveError> {
        if matches!(self.plan.reference, Some(ReferencePlan::Refined)) {
            let wear = self.refined(observer)?;
            let unscaled = self.plan.material.scaling.kind != ScalingKind::None;
            let how = if unscaled { ", without scaling" } else { "" };
            let name = format!("the same scene to a tolerance 100 times tighter{how}");
            return Ok(Some(compare(&record.wear, &wear, &name)));
        }
        let expected = self.expected(record)?;
        Ok(expected.map(|expected| compare(&record.wear, &expected.wear, &expected.reference)))
    }

    /// What the reference that the plan names says of the points; `None` if it names none, or a refined run.
    ///
    /// # Errors
    /// A reference that does not cover the scene, or cannot be read or computed.
    pub(super) fn expected(&self, record: &Record<SolveError>) -> Result<Option<Expected>, SolveError> {
        let (wear, reference) = match &self.plan.reference {
            None | Some(ReferencePlan::Refined) => return Ok(None),
            Some(ReferencePlan::File(path)) => (reference::from_file(path, self.ids())?, path.display().to_string()),
            Some(ReferencePlan::Exact(named)) => {
                let until = record.history.last().map_or(0.0, |row| row.time);
                let mut pieces = Vec::new();
                // Errors compare at represented time: with the loading that was asked for, every cycle of it.
                for placed in Schedule::new(self.plan, self.history.as_ref())?.unscaled().placed() {
                    pieces.extend(self.pieces(placed).into_iter().filter(|piece| piece.end <= until));
                }
                let sites: Vec<_> = pieces
                    .iter()
                    .map(|piece| (self.site(piece), Drive::new(self.plan, self.history.as_ref(), piece)))
                    .collect();
                let law = &self.evaluator.descriptor().name;
                (reference::archard_prescribed(self.plan, *named, law, &sites, self.points)?, named.name().to_owned())
            }
        };
        Ok(Some(Expected { reference, wear, ..Expected::default() }))
    }

    fn refined(&self, observer: &mut (dyn Observer + Send)) -> Result<Vec<f64>, SolveError> {
        let mut plan = self.plan.clone();
        plan.output.fields.clear();
        plan.material.scaling.kind = ScalingKind::None;
        plan.substeps = plan.substeps.map(|substeps| substeps.saturating_mul(16));
        plan.advance = match plan.advance {
            Advance::Rate(Quadrature::Adaptive(tolerance)) => {
                Advance::Rate(Quadrature::Adaptive(tolerance * REFINEMENT))
            }
            Advance::Rate(Quadrature::AdaptiveRule(rule, tolerance)) => {
                Advance::Rate(Quadrature::AdaptiveRule(rule, tolerance * REFINEMENT))
            }
            Advance::Substeps(Control::Tolerance(tolerance), sample) => {
                Advance::Substeps(Control::Tolerance(tolerance * REFINEMENT), sample)
            }
            other => other,
        };
        let record = Prescribed::prepare(&plan, self.evaluator)?.go(1, observer, None)?;
        match record.end {
            End::Failed(error) => Err(error),
            End::Interrupted => Err(SolveError::Interrupted),
            _ => Ok(record.wear),
        }
    }
}
