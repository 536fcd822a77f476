//! One chunk of points over one piece: the law called for the points in contact, as a rate or by whole substeps.

use std::ops::Range;
use std::time::{Duration, Instant};

use crate::integrator::quadrature::{self, Quadrature, Rate, Span};
use crate::integrator::substeps::{self, Control, Memory, Substep};
use crate::integrator::{AdvanceError, Reply, Tally};
use crate::law::{Batch, Degree, Evaluation, Evaluator, OutputItem, Outputs, PointInputs, Values};
use crate::plan::{Advance, Sample};
use crate::solve::inputs::Drive;
use crate::solve::site::{Moment, Remembered, Rooms, Site};
use crate::solve::source::{value, vector};
use crate::solve::sums::Sums;
use crate::solve::sweeps::{all_positive, largest};
use crate::solve::{PointError, ShortStep};

/// Points of one chunk: its columns stay in the second cache while it is integrated. Fixed, so that bits do not
/// depend on the number of threads.
pub(super) const CHUNK: usize = 8192;

/// Points up to which a history's rows are looked through for events.
pub(super) const SCANNED_POINTS: usize = 100_000;

/// Everything of one thread that is kept from chunk to chunk.
#[derive(Default)]
pub(super) struct Scratch {
    rooms: Rooms,
    quadrature: quadrature::Room,
    substeps: substeps::Room,
    memory: Memory,
    direction: Vec<f64>,
    distance: Vec<f64>,
    path: Vec<f64>,
    parts: [Vec<f64>; 9],
    pressure: Vec<f64>,
    areas: Vec<f64>,
}

/// The parts of the run's arrays that belong to one chunk.
pub(super) struct Slices<'a> {
    pub(super) wear: &'a mut [f64],
    pub(super) state: &'a mut [f64],
    pub(super) distance: &'a mut [f64],
    pub(super) direction: &'a mut [f64],
    /// The substep to try first.
    pub(super) hint: &'a mut f64,
}

/// What one chunk came to over one piece.
#[derive(Default)]
pub(super) struct Done {
    pub(super) tally: Tally,
    pub(super) law_time: Duration,
    pub(super) warnings: Vec<String>,
    pub(super) sums: Sums,
}

/// The law at the points of one chunk over one piece.
struct Caller<'c, 's> {
    site: &'c Site<'s>,
    drive: &'c Drive<'s>,
    evaluator: &'c dyn Evaluator,
    range: Range<usize>,
    rooms: &'c mut Rooms,
    /// Wear directions of the last call `[points][3]`; empty where nobody wants them.
    direction: &'c mut Vec<f64>,
    keep_direction: &'c mut [f64],
    distance: &'c [f64],
    uniform_distance: f64,
    path: &'c mut Vec<f64>,
    parts: &'c mut [Vec<f64>; 9],
    sample: Sample,
    law_time: Duration,
    warnings: Vec<String>,
    /// Where the law last wished for a shorter step, and its words.
    cut: Option<(Option<PointInputs>, String)>,
}

impl Caller<'_, '_> {
    fn call(
        &mut self,
        moment: &Moment,
        remembered: Remembered<'_>,
        increment: &mut [f64],
        end: &mut [f64],
    ) -> Result<Reply, PointError> {
        let Caller {
            site,
            drive,
            evaluator,
            range,
            rooms,
            direction,
            keep_direction,
            law_time,
            warnings,
            cut: wished,
            ..
        } = self;
        let states = site.law.state.len();
        let turns = site.law.writes(OutputItem::Direction);
        if turns {
            direction.resize(3 * range.len(), 0.0);
        }
        let wants_open = site.law.wants_open_points();
        let first = range.start;
        drive.with_batch(site, moment, range.clone(), remembered, rooms, |batch, pressure, normals| {
            let points = range.len();
            let mut cut: Option<f64> = None;
            for_runs(pressure, points, wants_open, |run, closed| {
                if !closed {
                    increment[run.clone()].fill(0.0);
                    if states > 0 {
                        let state = run.start * states..run.end * states;
                        end[state.clone()].copy_from_slice(&remembered.state[state]);
                    }
                    return Ok(());
                }
                let mut outputs = Outputs::new(&mut increment[run.clone()]);
                outputs.state = (states > 0).then(|| &mut end[run.start * states..run.end * states]);
                outputs.direction = turns.then(|| &mut direction[3 * run.start..3 * run.end]);
                let part = if run.len() == points { batch.clone() } else { batch.range(run.clone()) };
                let begin = Instant::now();
                let answer = evaluator.evaluate(&part, &mut outputs);
                *law_time += begin.elapsed();
                match answer.map_err(|error| located(error, first, site))? {
                    Evaluation::Good => {}
                    Evaluation::Unreliable { at, text } => {
                        let place = at.map(|at| format!(" at point {}", site.id(first + at.point))).unwrap_or_default();
                        let words = if text.is_empty() { String::new() } else { format!(": {text}") };
                        let warning = format!("law `{}` is unreliable{place}{words}", site.law.name);
                        if warnings.is_empty() {
                            warnings.push(warning);
                        }
                    }
                    Evaluation::CutStep { factor, at, text } => {
                        let at = at.map(|at| PointInputs { point: numbered(at.point, first, site), ..at });
                        *wished = Some((at, text));
                        cut = Some(cut.map_or(factor, |least| least.min(factor)));
                    }
                }
                Ok::<(), PointError>(())
            })?;
            if let Some(factor) = cut {
                return Ok(Reply::Cut(factor));
            }
            turn(site, batch, pressure, normals, turns.then_some(direction.as_slice()), first, increment)?;
            if turns && !keep_direction.is_empty() {
                keep_direction.copy_from_slice(direction);
            }
            Ok(Reply::Good)
        })
    }
}

/// Names the point of a law's error by its number in the history.
fn located(mut error: crate::law::EvaluateError, first: usize, site: &Site<'_>) -> PointError {
    if let Some(at) = error.at_mut() {
        at.point = numbered(at.point, first, site);
    }
    error.into()
}

/// The number in the history of a point that is the so-manieth behind `first`.
fn numbered(point: usize, first: usize, site: &Site<'_>) -> usize {
    usize::try_from(site.id(first + point)).unwrap_or(first + point)
}

/// Goes through runs of adjacent points that are all in contact, or all not; all at once for laws that want both.
fn for_runs<E>(
    pressure: &Values<'_>,
    points: usize,
    wants_open: bool,
    mut each: impl FnMut(Range<usize>, bool) -> Result<(), E>,
) -> Result<(), E> {
    let all = match pressure {
        _ if wants_open => Some(true),
        Values::PerPoint(values) => all_positive(values).then_some(true),
        uniform => Some(value(uniform, 0) > 0.0),
    };
    if let Some(closed) = all {
        return each(0..points, closed);
    }
    let mut start = 0;
    while start < points {
        let closed = value(pressure, start) > 0.0;
        let length = (start..points).take_while(|i| (value(pressure, *i) > 0.0) == closed).count();
        each(start..start + length, closed)?;
        start += length;
    }
    Ok(())
}

/// Turns increments along the wear direction d into depths along the normal: times -d.n, which must be positive.
fn turn(
    site: &Site<'_>,
    batch: &Batch<'_>,
    pressure: &Values<'_>,
    normals: &Values<'_>,
    directions: Option<&[f64]>,
    first: usize,
    increment: &mut [f64],
) -> Result<(), PointError> {
    let given = site.plan.material.direction;
    if directions.is_none() && given.is_none() {
        return Ok(());
    }
    for (i, increment) in increment.iter_mut().enumerate().take(batch.points()) {
        if value(pressure, i) <= 0.0 {
            continue;
        }
        let n = vector(normals, i);
        let d = match (directions, given) {
            (Some(all), _) => [all[3 * i], all[3 * i + 1], all[3 * i + 2]],
            (None, Some(direction)) => direction,
            (None, None) => n.map(|x| -x),
        };
        let along = -(0..3).map(|k| d[k] * n[k]).sum::<f64>();
        if along <= 0.0 {
            // No negative zero in words.
            let (point, along) = (numbered(i, first, site), along + 0.0);
            return Err(PointError::Direction { point, along, by_law: directions.is_some() });
        }
        *increment *= along;
    }
    Ok(())
}

impl Rate for Caller<'_, '_> {
    type Error = PointError;

    fn points(&self) -> usize {
        self.range.len()
    }

    fn increments(&mut self, at: f64, dt: f64, out: &mut [f64]) -> Result<Reply, PointError> {
        let moment = Moment { at, from: at, dt };
        self.call(&moment, Remembered::default(), out, &mut [])
    }
}

impl Substep for Caller<'_, '_> {
    type Error = PointError;

    fn evaluate(
        &mut self,
        from: f64,
        to: f64,
        start: &Memory,
        increment: &mut [f64],
        end: &mut [f64],
    ) -> Result<Reply, PointError> {
        let at = match self.sample {
            Sample::Start => from,
            Sample::Middle => 0.5 * (from + to),
            Sample::End => to,
        };
        let length = self.site.piece.end - self.site.piece.start;
        let moment = Moment { at, from, dt: (to - from) * length };
        let mut path = std::mem::take(self.path);
        let mut distance = Vec::new();
        let slipped = self.drive.paths((0.0, from), length, self.range.clone(), &mut path, self.parts);
        let so_far = match (self.distance.is_empty(), &slipped) {
            (true, slipped) => Values::Uniform(self.uniform_distance + value(slipped, 0)),
            (false, slipped) => {
                distance.extend(self.distance.iter().enumerate().map(|(i, d)| d + value(slipped, i)));
                Values::PerPoint(&distance)
            }
        };
        let remembered = Remembered { wear: &start.wear, distance: so_far, state: &start.state };
        let reply = self.call(&moment, remembered, increment, end);
        *self.path = path;
        reply
    }
}

/// Says which law asked for too short a step, and where; other errors know.
fn named(error: AdvanceError<PointError>, caller: &mut Caller<'_, '_>) -> AdvanceError<PointError> {
    let AdvanceError::SmallestStep { time, asked, smallest } = error else { return error };
    let (at, text) = caller.cut.take().unwrap_or_default();
    let law = caller.site.law.name.clone();
    AdvanceError::Evaluate(PointError::SmallestStep(Box::new(ShortStep { law, time, asked, smallest, at, text })))
}

/// Advances one chunk over one piece.
pub(super) fn advance(
    site: &Site<'_>,
    drive: &Drive<'_>,
    evaluator: &dyn Evaluator,
    range: Range<usize>,
    slices: &mut Slices<'_>,
    (rule, uniform_distance): (Option<Quadrature>, f64),
    scratch: &mut Scratch,
) -> Result<Done, AdvanceError<PointError>> {
    let Scratch { rooms, quadrature, substeps, memory, direction, path, parts, .. } = scratch;
    let piece = site.piece;
    let (smallest, most) = (site.plan.smallest_step, site.plan.most_substeps);
    let span = Span { start: piece.start, length: piece.end - piece.start, smallest, most };
    let (control, sample) = match site.plan.advance {
        Advance::Rate(_) => (Control::Fixed, Sample::Middle),
        Advance::Substeps(control, sample) => (control, sample),
    };
    let mut caller = Caller {
        site,
        drive,
        evaluator,
        range: range.clone(),
        rooms,
        direction,
        keep_direction: slices.direction,
        distance: slices.distance,
        uniform_distance,
        path,
        parts,
        sample,
        law_time: Duration::ZERO,
        warnings: Vec::new(),
        cut: None,
    };
    let tally = match site.plan.advance {
        Advance::Rate(planned) => {
            let result = rule.unwrap_or(planned).integrate(&mut caller, span, quadrature, slices.wear);
            result.map_err(|error| named(error, &mut caller))?
        }
        Advance::Substeps(..) => {
            memory.wear.clear();
            memory.wear.extend_from_slice(slices.wear);
            memory.state.clear();
            memory.state.extend_from_slice(slices.state);
            let result = control.advance(&mut caller, span, slices.hint, substeps, memory);
            let tally = result.map_err(|error| named(error, &mut caller))?;
            slices.wear.copy_from_slice(&memory.wear);
            slices.state.copy_from_slice(&memory.state);
            tally
        }
    };
    Ok(Done { tally, law_time: caller.law_time, warnings: caller.warnings, sums: Sums::default() })
}

/// The rule for a piece: one evaluation in the middle where that is exact, because nothing changes, or because only the
/// pressure does (linearly, and without reaching zero) and the increment is proportional to it.
pub(super) fn rule(site: &Site<'_>, drive: &Drive<'_>, points: usize) -> Option<Quadrature> {
    let Advance::Rate(planned) = site.plan.advance else { return None };
    let named = matches!(planned, Quadrature::FixedRule(_) | Quadrature::AdaptiveRule(..));
    if named || !drive.only_pressure_changes(site.plan) {
        return Some(planned);
    }
    if drive.pressure_is_constant() {
        return Some(Quadrature::Exact);
    }
    let table = &site.plan.material.constants;
    let degree = match site.law.pressure_degree {
        Degree::Constant(c) if !table.varies_in_temperature() => Some(table.value(c, 0.0, 0.0)),
        Degree::Value(degree) => Some(degree),
        _ => None,
    };
    let reaches_zero = || drive.pressure.crossings(0.0, 0).is_none_or(|crossings| !crossings.is_empty());
    let exact = degree == Some(1.0) && points <= SCANNED_POINTS && !reaches_zero();
    Some(if exact { Quadrature::Exact } else { planned })
}

/// Adds the slip paths of a piece to the sliding distances, where they differ from point to point.
pub(super) fn slide(drive: &Drive<'_>, length: f64, range: Range<usize>, distance: &mut [f64], scratch: &mut Scratch) {
    if distance.is_empty() {
        return;
    }
    if let Some(velocities) = drive.lasting_velocities(range.clone()) {
        distance.iter_mut().zip(velocities).for_each(|(distance, velocity)| *distance += velocity.abs() * length);
        return;
    }
    match drive.paths((0.0, 1.0), length, range, &mut scratch.distance, &mut scratch.parts) {
        Values::PerPoint(paths) => distance.iter_mut().zip(paths).for_each(|(distance, path)| *distance += path),
        paths => distance.iter_mut().for_each(|distance| *distance += value(&paths, 0)),
    }
}

/// Sums over a chunk at a fraction of a piece; `worn` is false where neither wear nor distance has ever been written,
/// so that the memory for them is not asked for before it is needed.
pub(super) fn measure(
    site: &Site<'_>,
    drive: &Drive<'_>,
    (part, worn): (f64, bool),
    range: Range<usize>,
    slices: &Slices<'_>,
    scratch: &mut Scratch,
) -> Sums {
    let Scratch { pressure, parts, areas, .. } = scratch;
    let pressure = drive.driving_pressure(site.plan, part, range.clone(), (pressure, parts));
    let areas = drive.areas(part, range.clone(), areas);
    let mut sums = Sums::default();
    match (&pressure, &areas) {
        (Values::Uniform(p), Values::Absent) => sums.max_pressure = p.max(0.0),
        (Values::PerPoint(all), Values::Absent) => sums.max_pressure = largest(all),
        _ => {
            for (i, wear) in slices.wear.iter().enumerate() {
                let p = value(&pressure, i).max(0.0);
                let area = if areas == Values::Absent { 0.0 } else { value(&areas, i) };
                sums.load += p * area;
                sums.area += if p > 0.0 { area } else { 0.0 };
                sums.volume += wear * area;
                sums.max_pressure = sums.max_pressure.max(p);
            }
        }
    }
    if worn {
        sums.max_wear = largest(slices.wear);
        sums.max_distance = largest(slices.distance);
    }
    sums
}

/// The mean of a chunk's increments over the points in contact in the middle of a piece: sums of weight times
/// increment, and of weights; areas are weights where they are given.
pub(super) fn contact_sums(
    site: &Site<'_>,
    drive: &Drive<'_>,
    range: Range<usize>,
    increment: &[f64],
    scratch: &mut Scratch,
) -> (f64, f64) {
    let Scratch { pressure, parts, areas, .. } = scratch;
    let pressure = drive.driving_pressure(site.plan, 0.5, range.clone(), (pressure, parts));
    let areas = drive.areas(0.5, range.clone(), areas);
    let mut sums = (0.0, 0.0);
    for (i, increment) in increment.iter().enumerate() {
        if value(&pressure, i) > 0.0 {
            let weight = if areas == Values::Absent { 1.0 } else { value(&areas, i) };
            sums = (sums.0 + weight * increment, sums.1 + weight);
        }
    }
    sums
}

/// Gives every point in contact the mean increment, and every other point none.
pub(super) fn spread(
    site: &Site<'_>,
    drive: &Drive<'_>,
    range: Range<usize>,
    mean: f64,
    increment: &mut [f64],
    scratch: &mut Scratch,
) {
    let Scratch { pressure, parts, .. } = scratch;
    let pressure = drive.driving_pressure(site.plan, 0.5, range, (pressure, parts));
    for (i, increment) in increment.iter_mut().enumerate() {
        *increment = if value(&pressure, i) > 0.0 { mean } else { 0.0 };
    }
}
