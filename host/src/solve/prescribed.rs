//! One run under a prescribed pressure: prepared, then gone through.

use std::time::{Duration, Instant};

use crate::contact::prescribed::{History, Motion};
use crate::integrator::quadrature::Quadrature;
use crate::integrator::substeps::Control;
use crate::integrator::{Tally, norm};
use crate::law::{Evaluator, OutputItem};
use crate::plan::{Advance, FieldKind, Plan, ReferencePlan};
use crate::record::{self, Cost, End, Event, HistoryRow, Line, MemoryLine, Nobody, Observer, Record, Wish};
use crate::scene::Every;
use crate::solve::chunk::SCANNED_POINTS;
use crate::solve::ending::{peak_memory, stop_reached};
use crate::solve::inputs::Drive;
use crate::solve::progress::Arrays;
use crate::solve::schedule::{self, Piece};
use crate::solve::site::Site;
use crate::solve::sums::Sums;
use crate::solve::{ErrorNorm, SolveError, claims, compare, fields, reference};

/// Different instants between two rows at which points change sign that become events of their own; more of them are
/// left to the quadrature's halving.
const MOST_EVENTS: usize = 16;
/// How much tighter the run is that a scene is compared with when it asks for a reference of its own.
const REFINEMENT: f64 = 1e-2;

/// A plan with its history read, ready to go.
pub(super) struct Prescribed<'p> {
    plan: &'p Plan,
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
        for placed in schedule::placed(plan, run.history.as_ref())? {
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
        let placed = schedule::placed(self.plan, self.history.as_ref())?;
        Ok(placed.map(|placed| self.pieces(placed).len() as u64).sum())
    }

    /// Points times the fewest evaluations of the law at each of them; what misses its tolerance takes more.
    ///
    /// # Errors
    /// A history that does not cover the loading.
    pub(super) fn least_evaluations(&self) -> Result<u64, SolveError> {
        let mut evaluations = 0;
        for placed in schedule::placed(self.plan, self.history.as_ref())? {
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

    /// Goes through the plan on at most `threads` threads (0: as many as the machine has).
    ///
    /// However the run ends, the record holds what was done.
    pub(super) fn go(&self, threads: usize, observer: &mut (dyn Observer + Send)) -> Record<SolveError> {
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
        };
        let geometry = fields::geometry(self.plan, self.history.as_ref(), self.points);
        let line = Line::of(&geometry);
        // One chunk of points has nothing to share out.
        let threads = if self.points <= crate::solve::chunk::CHUNK { 1 } else { threads };
        let end = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(|| self.steps(&mut going, observer, line.is_some())),
            Err(error) => End::Failed(SolveError::Threads { threads, text: error.to_string() }),
        };
        for warning in self.evaluator.take_warnings() {
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
        Record {
            estimated_error: (estimated && size > 0.0).then(|| going.tally.error / size),
            largest_step: going.tally.longest,
            cost: Cost {
                run_time_s: begin.elapsed().as_secs_f64(),
                law_time_s: going.law_time.as_secs_f64(),
                steps: going.steps,
                rejected_steps: going.tally.rejected,
                law_calls: going.tally.law_calls,
                points_evaluated: going.tally.points_evaluated,
                peak_memory_bytes: peak_memory(),
                ..Cost::default()
            },
            history: going.history,
            wear: going.arrays.wear,
            pressure: Vec::new(),
            state: going.arrays.state,
            memory: self.memory(),
            warnings: going.warnings,
            profile,
            geometry,
            units,
            end,
        }
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

    fn steps(&self, going: &mut Going, observer: &mut (dyn Observer + Send), profiled: bool) -> End<SolveError> {
        // One after another: a scene may have more cycles than a list of them has room for.
        let placed = match schedule::placed(self.plan, self.history.as_ref()) {
            Ok(placed) => placed,
            Err(error) => return End::Failed(error),
        };
        let (start, end) = schedule::span(self.plan, self.history.as_ref());
        let units = fields::units(self.plan);
        let mut last: Option<Piece<'_>> = None;
        for placed in placed {
            for piece in self.pieces(placed) {
                let site = self.site(&piece);
                let drive = Drive::new(self.plan, self.history.as_ref(), &piece);
                if going.history.rows.is_empty() {
                    let sums = going.arrays.measure(&site, &drive, 0.0);
                    going.history.rows.push(self.row(piece.start, 0.0, piece.placed.cycle, &sums, &going.arrays));
                    if profiled {
                        going.start_pressure = fields::pressure(&site, &drive, 0.0, self.points);
                    }
                }
                let tried = match self.plan.advance {
                    Advance::Rate(_) if going.steps == 0 => {
                        claims::linear_in_dt(&site, &drive, self.evaluator, self.points, &mut going.tally)
                    }
                    _ => Ok(()),
                };
                let advanced = tried.and_then(|()| going.arrays.advance(&site, &drive, self.evaluator));
                let done = match advanced {
                    Ok(done) => done,
                    Err(source) => {
                        let (load_step, substep, time) = (piece.placed.number, piece.substep, piece.start);
                        let source = Box::new(source);
                        self.finish(going, last.as_ref(), observer, &units, profiled);
                        return End::Failed(SolveError::Advance { load_step, substep, time, source });
                    }
                };
                going.tally.then(&done.tally);
                going.law_time += done.law_time;
                going.steps += 1;
                for warning in done.warnings {
                    if !going.warnings.contains(&warning) {
                        observer.observe(Event::Warning(&warning));
                        going.warnings.push(warning);
                    }
                }
                let row = self.row(piece.end, piece.end - piece.start, piece.placed.cycle, &done.sums, &going.arrays);
                let part = if end > start { (piece.end - start) / (end - start) } else { 1.0 };
                let wish = observer.observe(Event::Step { row: &row, steps: going.steps, done: part });
                going.history.rows.push(row);
                if self.wants_snapshot(&piece, going.steps) {
                    let snapshot = fields::snapshot(&site, &drive, &going.arrays, going.steps, &units);
                    observer.observe(Event::Snapshot(&snapshot));
                }
                last = Some(piece);
                let stop = stop_reached(&self.plan.stop, &row);
                if wish == Wish::Stop || stop.is_some() {
                    self.finish(going, last.as_ref(), observer, &units, profiled);
                    return stop.map_or(End::Interrupted, End::Stopped);
                }
            }
        }
        self.finish(going, last.as_ref(), observer, &units, profiled);
        End::Done
    }

    /// What is left to tell when a run ends, for whatever reason: the fields and the pressure at its last step.
    fn finish(
        &self,
        going: &mut Going,
        last: Option<&Piece<'_>>,
        observer: &mut (dyn Observer + Send),
        units: &record::Units,
        profiled: bool,
    ) {
        let Some(piece) = last else { return };
        let site = self.site(piece);
        let drive = Drive::new(self.plan, self.history.as_ref(), piece);
        if profiled {
            going.end_pressure = fields::pressure(&site, &drive, 1.0, self.points);
        }
        if !self.plan.output.fields.is_empty() && !self.wants_snapshot(piece, going.steps) {
            let snapshot = fields::snapshot(&site, &drive, &going.arrays, going.steps, units);
            observer.observe(Event::Snapshot(&snapshot));
        }
    }

    fn wants_snapshot(&self, piece: &Piece<'_>, steps: u64) -> bool {
        let asked = match &self.plan.output.every {
            Every::End => false,
            Every::Steps(every) => steps.is_multiple_of(*every),
            Every::Times(_) => piece.output,
        };
        asked && !self.plan.output.fields.is_empty()
    }

    fn row(&self, time: f64, dt: f64, cycle: i64, sums: &Sums, arrays: &Arrays) -> HistoryRow {
        let areas = self.plan.columns.has(crate::contact::prescribed::Column::Area);
        HistoryRow {
            time,
            dt,
            sliding_distance: if self.distances { sums.max_distance } else { arrays.uniform_distance },
            load: areas.then_some(sums.load),
            approach: None,
            max_pressure: sums.max_pressure,
            contact_area: areas.then_some(sums.area),
            max_wear_depth: sums.max_wear,
            wear_volume: areas.then_some(sums.volume),
            scale: 1.0,
            simulated_time: time,
            cycle: cycle as f64,
        }
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
    pub(super) fn error(&self, record: &Record<SolveError>) -> Result<Option<ErrorNorm>, SolveError> {
        let Some(wanted) = &self.plan.reference else { return Ok(None) };
        let (exact, name) = match wanted {
            ReferencePlan::File(path) => (reference::from_file(path, self.ids())?, path.display().to_string()),
            ReferencePlan::Refined => (self.refined()?, "the same scene to a tolerance 100 times tighter".to_owned()),
            ReferencePlan::Exact(named) => {
                let until = record.history.last().map_or(0.0, |row| row.time);
                let mut pieces = Vec::new();
                for placed in schedule::placed(self.plan, self.history.as_ref())? {
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
        Ok(Some(compare(&record.wear, &exact, &name)))
    }

    fn refined(&self) -> Result<Vec<f64>, SolveError> {
        let mut plan = self.plan.clone();
        plan.output.fields.clear();
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
        let record = Prescribed::prepare(&plan, self.evaluator)?.go(1, &mut Nobody);
        match record.end {
            End::Failed(error) => Err(error),
            _ => Ok(record.wear),
        }
    }
}
