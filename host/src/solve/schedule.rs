//! The pieces of time that a run goes through: smooth inside, with every event at their ends.

use crate::contact::prescribed::History;
use crate::plan::{Block, Linear, LoadStep, Plan};
use crate::scene::{Every, ScalingKind};
use crate::solve::SolveError;
use crate::solve::source::Between;

/// Points times recorded instants that cost next to nothing; a small scene is recorded often enough for a smooth plot.
const FREE_EVALUATIONS: usize = 1_000_000;
/// Most instants that are recorded for the sake of a plot alone.
const PLOTTED_INSTANTS: usize = 64;

/// One load step at its place in represented time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'p> {
    pub(super) step: &'p LoadStep,
    pub(super) start: f64,
    pub(super) end: f64,
    /// Represented time per simulated time: the loading is gone through that much slower, so that every duration, and
    /// with it slip and friction work, stands for as many cycles.
    pub(super) scale: f64,
    /// What is added to `scale` times a history's time.
    pub(super) offset: f64,
    /// How far simulated time lies behind at its start.
    pub(super) lag: f64,
    pub(super) number: i64,
    /// Number of the represented cycle at its start, from 1; 0 outside cycles.
    pub(super) cycle: i64,
    /// Represented cycles that are done at its start and at its end.
    pub(super) cycles: Linear,
}

impl Placed<'_> {
    /// Represented cycles that are done at a represented time of it.
    pub(super) fn cycles_at(&self, time: f64) -> f64 {
        if time >= self.end {
            return self.cycles.to;
        }
        self.cycles.at((time - self.start) / (self.end - self.start))
    }

    /// Simulated time at a represented time of it.
    pub(super) fn simulated_at(&self, time: f64) -> f64 {
        time - (self.lag + (time - self.start) * (1.0 - self.scale.recip()))
    }
}

/// A piece of a load step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<'p> {
    pub(super) placed: Placed<'p>,
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) substep: i64,
    pub(super) between: Option<Between>,
    /// Whether a snapshot was asked for at its end.
    pub(super) output: bool,
}

impl Piece<'_> {
    /// A load step's quantity over this piece.
    pub(super) fn linear(&self, line: Linear) -> Linear {
        let length = self.placed.end - self.placed.start;
        let part = |time: f64| if length > 0.0 { (time - self.placed.start) / length } else { 0.0 };
        Linear { from: line.at(part(self.start)), to: line.at(part(self.end)) }
    }
}

/// The way through the loading, round by round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Schedule<'p> {
    plan: &'p Plan,
    /// First and last time of the history.
    first: f64,
    last: f64,
    one_time: bool,
    /// Whether cycles go through the history again and again.
    repeats: bool,
    /// Simulated cycles stand for at most so many.
    largest_scale: f64,
}

/// One time through the steps of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Round {
    pub(super) block: usize,
    /// Rounds of the block that are done before it; represented.
    pub(super) done: f64,
    /// Rounds that it stands for.
    pub(super) scale: f64,
    /// Represented time at its start.
    pub(super) clock: f64,
    /// How far simulated time lies behind at its start.
    pub(super) lag: f64,
    /// Represented cycles before it.
    pub(super) cycles: f64,
}

impl<'p> Schedule<'p> {
    /// The loading of a plan.
    ///
    /// # Errors
    /// A history that does not cover it.
    pub(super) fn new(plan: &'p Plan, history: Option<&History>) -> Result<Schedule<'p>, SolveError> {
        let times = history.map(History::times).unwrap_or_default();
        let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
        let covered = last - first;
        let path = history.map(|history| history.path().display().to_string()).unwrap_or_default();
        let one_time = times.len() == 1 || history.is_none();
        for block in &plan.blocks {
            let open = block.steps.iter().any(|step| step.duration.is_none());
            if one_time && open {
                return Err(SolveError::NoDuration { history: path });
            }
            // Durations are sums of decimal numbers; a rounding error beyond the last row is not a missing row.
            let asked = stated(block);
            if !one_time && asked > covered * (1.0 + 1e-12) {
                return Err(SolveError::HistoryTooShort { history: path, asked, covered });
            }
        }
        let scaling = &plan.material.scaling;
        // Wear does not change a prescribed pressure, so nothing but C2 limits the factor.
        let largest_scale = if scaling.kind == ScalingKind::Cycle { scaling.factor(0.0) } else { 1.0 };
        let repeats = plan.blocks.iter().any(|block| block.cycle);
        Ok(Schedule { plan, first, last, one_time, repeats, largest_scale })
    }

    /// The same loading with every cycle gone through.
    pub(super) fn unscaled(self) -> Schedule<'p> {
        Schedule { largest_scale: 1.0, ..self }
    }

    /// The first round.
    pub(super) fn start(&self) -> Round {
        Round { block: 0, done: 0.0, scale: 1.0, clock: self.first, lag: 0.0, cycles: 0.0 }
    }

    /// The load steps of a round.
    pub(super) fn steps(&self, round: &Round) -> Vec<Placed<'p>> {
        let Round { scale, .. } = *round;
        let Some(block) = self.plan.blocks.get(round.block) else { return Vec::new() };
        let covered = self.last - self.first;
        let base: usize = self.plan.blocks[..round.block].iter().map(|block| block.steps.len()).sum();
        let offset = if self.repeats && !self.one_time { round.clock - scale * self.first } else { 0.0 };
        let rest = covered - stated(block);
        let period: f64 = block.steps.iter().map(|step| step.duration.unwrap_or(rest)).sum();
        let (mut clock, mut lag, mut cycles) = (round.clock, round.lag, round.cycles);
        let mut here = Vec::with_capacity(block.steps.len());
        for (index, step) in block.steps.iter().enumerate() {
            let step = if round.done == 0.0 && index == 0 { &block.entry } else { step };
            let duration = step.duration.unwrap_or(rest);
            let start = clock;
            let mut end = start + scale * duration;
            let last = scale * self.last + offset;
            if !self.one_time && (end - last).abs() <= 1e-12 * scale * covered {
                end = last;
            }
            let before = cycles;
            if block.cycle {
                let whole = index + 1 == block.steps.len() || period <= 0.0;
                cycles = if whole { round.cycles + scale } else { cycles + scale * (duration / period) };
            }
            here.push(Placed {
                step,
                start,
                end,
                scale,
                offset,
                lag,
                number: (base + index) as i64 + 1,
                cycle: if block.cycle { (round.cycles + 1.0) as i64 } else { 0 },
                cycles: if block.cycle { Linear { from: before, to: cycles } } else { Linear { from: 0.0, to: 0.0 } },
            });
            clock = end;
            lag += (end - start) * (1.0 - scale.recip());
        }
        here
    }

    /// The round behind one with these steps; `None`: the loading is over.
    ///
    /// The first cycle of a block stands for itself; the last scaled one is cut to land on the count.
    pub(super) fn next(&self, round: &Round, steps: &[Placed<'p>]) -> Option<Round> {
        let block = self.plan.blocks.get(round.block)?;
        let end = steps.last();
        let clock = end.map_or(round.clock, |placed| placed.end);
        let lag = end.map_or(round.lag, |placed| clock - placed.simulated_at(clock));
        let cycles = round.cycles + if block.cycle { round.scale } else { 0.0 };
        let done = round.done + round.scale;
        let left = block.count as f64 - done;
        if left > 1e-12 * block.count as f64 {
            let scale = if block.cycle { self.largest_scale.min(left) } else { 1.0 };
            return Some(Round { block: round.block, done, scale, clock, lag, cycles });
        }
        let next = Round { block: round.block + 1, done: 0.0, scale: 1.0, clock, lag, cycles };
        (next.block < self.plan.blocks.len()).then_some(next)
    }

    /// All load steps, one after another.
    pub(super) fn placed(self) -> impl Iterator<Item = Placed<'p>> + use<'p> {
        let mut next = Some(self.start());
        let rounds = std::iter::from_fn(move || {
            let round = next?;
            let steps = self.steps(&round);
            next = self.next(&round, &steps);
            Some(steps)
        });
        rounds.flatten()
    }
}

/// The durations of a block's steps that have one.
fn stated(block: &Block) -> f64 {
    block.steps.iter().filter_map(|step| step.duration).sum()
}

/// Start and end of all load steps, the end up to rounding.
pub(super) fn span(plan: &Plan, history: Option<&History>) -> (f64, f64) {
    let times = history.map(History::times).unwrap_or_default();
    let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
    let lasts = |block: &Block| {
        let open = block.steps.iter().any(|step| step.duration.is_none());
        block.count as f64 * if open { last - first } else { stated(block) }
    };
    (first, first + plan.blocks.iter().map(lasts).sum::<f64>())
}

/// The pieces of one load step, without the crossings that lie inside them.
pub(super) fn pieces<'p>(plan: &Plan, history: Option<&History>, points: usize, placed: Placed<'p>) -> Vec<Piece<'p>> {
    let (start, end) = (placed.start, placed.end);
    let length = end - start;
    if length <= 0.0 {
        return Vec::new();
    }
    let inside = |time: &f64| *time > start && *time < end;
    let times = history.map(History::times).unwrap_or_default();
    let mut cuts: Vec<f64> = times.iter().map(|time| placed.scale * time + placed.offset).filter(inside).collect();
    cuts.extend(plan.material.constants.break_times().iter().copied().filter(inside));
    let asked: &[f64] = if let Every::Times(times) = &plan.output.every { times } else { &[] };
    cuts.extend(asked.iter().copied().filter(inside));
    let even = match plan.substeps {
        Some(substeps) => substeps as usize,
        None => (FREE_EVALUATIONS / points.max(1)).clamp(1, PLOTTED_INSTANTS),
    };
    // A load step that its events cut finely enough needs no further instants for the plot.
    if plan.substeps.is_some() || cuts.len() < even {
        cuts.extend((1..even).map(|k| start + length * (k as f64 / even as f64)).filter(inside));
    }
    cuts.push(end);
    cuts.sort_by(f64::total_cmp);
    let near = 1e-12 * length;
    let mut pieces: Vec<Piece<'p>> = Vec::with_capacity(cuts.len());
    let mut from = start;
    for cut in cuts {
        let last = cut == end;
        if cut - from <= near && !last {
            continue;
        }
        if cut - from <= near
            && let Some(tail) = pieces.last_mut()
        {
            tail.end = end;
            continue;
        }
        let substep = pieces.len() as i64 + 1;
        pieces.push(Piece { placed, start: from, end: cut, substep, between: None, output: false });
        from = cut;
    }
    for piece in &mut pieces {
        piece.between = between(times, &placed, piece.start, piece.end);
        piece.output = asked.iter().any(|time| (time - piece.end).abs() <= near);
    }
    pieces
}

/// The two rows of a history between which a piece lies.
fn between(times: &[f64], placed: &Placed<'_>, start: f64, end: f64) -> Option<Between> {
    if times.is_empty() {
        return None;
    }
    if times.len() == 1 {
        return Some(Between { k: 0, k1: 0, a: 0.0, b: 0.0, time: 0.0 });
    }
    let in_history = |at: f64| (at - placed.offset) / placed.scale;
    let middle = in_history(0.5 * (start + end));
    let k = times.partition_point(|time| *time <= middle).clamp(1, times.len() - 1) - 1;
    let (from, to) = (times[k], times[k + 1]);
    let time = to - from;
    let part = |at: f64| {
        let part = if time > 0.0 { (in_history(at) - from) / time } else { 0.0 };
        // A cut at a row is that row, whatever the offset rounds to.
        if part.abs() < 1e-12 {
            0.0
        } else if (part - 1.0).abs() < 1e-12 {
            1.0
        } else {
            part.clamp(0.0, 1.0)
        }
    };
    Some(Between { k, k1: k + 1, a: part(start), b: part(end), time })
}

/// Splits a piece at fractions of its length.
pub(super) fn split<'p>(piece: Piece<'p>, mut parts: Vec<f64>) -> Vec<Piece<'p>> {
    parts.retain(|part| *part > 1e-12 && *part < 1.0 - 1e-12);
    parts.sort_by(f64::total_cmp);
    parts.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    let mut pieces = Vec::with_capacity(parts.len() + 1);
    let mut from = 0.0;
    let at = |part: f64| {
        let way = |b: &Between| b.a + part * (b.b - b.a);
        (piece.start + part * (piece.end - piece.start), piece.between.as_ref().map(way))
    };
    for part in parts.into_iter().chain([1.0]) {
        let ((start, a), (end, b)) = (at(from), at(part));
        let end = if part == 1.0 { piece.end } else { end };
        let between = piece.between.map(|rows| Between { a: a.unwrap_or(0.0), b: b.unwrap_or(0.0), ..rows });
        pieces.push(Piece { start, end, between, output: piece.output && part == 1.0, ..piece });
        from = part;
    }
    pieces
}
