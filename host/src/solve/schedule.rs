//! The pieces of time that a run goes through: smooth inside, with every event at their ends.

use crate::contact::prescribed::History;
use crate::plan::{Linear, LoadStep, Plan};
use crate::scene::Every;
use crate::solve::SolveError;
use crate::solve::source::Between;

/// Points times recorded instants that cost next to nothing; a small scene is recorded often enough for a smooth plot.
const FREE_EVALUATIONS: usize = 1_000_000;
/// Most instants that are recorded for the sake of a plot alone.
const PLOTTED_INSTANTS: usize = 64;

/// One load step at its place in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed<'p> {
    pub(super) step: &'p LoadStep,
    pub(super) start: f64,
    pub(super) end: f64,
    /// What is added to a history's time.
    pub(super) offset: f64,
    pub(super) number: i64,
    pub(super) cycle: i64,
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

/// The load steps of a plan at their places in time, one after another.
pub(super) fn placed<'p>(
    plan: &'p Plan,
    history: Option<&History>,
) -> Result<impl Iterator<Item = Placed<'p>> + use<'p>, SolveError> {
    let times = history.map(History::times).unwrap_or_default();
    let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
    let covered = last - first;
    let path = history.map(|history| history.path().display().to_string()).unwrap_or_default();
    let one_time = times.len() == 1 || history.is_none();
    for block in &plan.blocks {
        let stated: f64 = block.steps.iter().filter_map(|step| step.duration).sum();
        let open = block.steps.iter().any(|step| step.duration.is_none());
        if one_time && open {
            return Err(SolveError::NoDuration { history: path });
        }
        // Durations are sums of decimal numbers; a rounding error beyond the last row is not a missing row.
        if !one_time && stated > covered * (1.0 + 1e-12) {
            return Err(SolveError::HistoryTooShort { history: path, asked: stated, covered });
        }
    }
    let mut clock = first;
    let mut number = 0;
    let mut cycle = 0;
    let repeats = plan.blocks.iter().any(|block| block.cycle);
    let rounds = plan.blocks.iter().flat_map(move |block| {
        let base = number;
        number += block.steps.len() as i64;
        let from = cycle;
        cycle += if block.cycle { block.count as i64 } else { 0 };
        (0..block.count as i64).map(move |round| (block, base, round, if block.cycle { from + round + 1 } else { 0 }))
    });
    Ok(rounds.flat_map(move |(block, base, round, cycle)| {
        let offset = if repeats && !one_time { clock - first } else { 0.0 };
        let stated: f64 = block.steps.iter().filter_map(|step| step.duration).sum();
        let mut here = Vec::with_capacity(block.steps.len());
        for (index, step) in block.steps.iter().enumerate() {
            let step = if round == 0 && index == 0 { &block.entry } else { step };
            let start = clock;
            let duration = step.duration.unwrap_or(covered - stated);
            let mut end = start + duration;
            if !one_time && (end - (last + offset)).abs() <= 1e-12 * covered {
                end = last + offset;
            }
            clock = end;
            here.push(Placed { step, start, end, offset, number: base + index as i64 + 1, cycle });
        }
        here
    }))
}

/// Start and end of all load steps, the end up to rounding.
pub(super) fn span(plan: &Plan, history: Option<&History>) -> (f64, f64) {
    let times = history.map(History::times).unwrap_or_default();
    let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
    let lasts = |block: &crate::plan::Block| {
        let stated: f64 = block.steps.iter().filter_map(|step| step.duration).sum();
        let open = block.steps.iter().any(|step| step.duration.is_none());
        block.count as f64 * if open { last - first } else { stated }
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
    let mut cuts: Vec<f64> = times.iter().map(|time| time + placed.offset).filter(inside).collect();
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
        piece.between = between(times, placed.offset, piece.start, piece.end);
        piece.output = asked.iter().any(|time| (time - piece.end).abs() <= near);
    }
    pieces
}

/// The two rows of a history between which a piece lies.
fn between(times: &[f64], offset: f64, start: f64, end: f64) -> Option<Between> {
    if times.is_empty() {
        return None;
    }
    if times.len() == 1 {
        return Some(Between { k: 0, k1: 0, a: 0.0, b: 0.0, time: 0.0 });
    }
    let middle = 0.5 * (start + end) - offset;
    let k = times.partition_point(|time| *time <= middle).clamp(1, times.len() - 1) - 1;
    let (from, to) = (times[k], times[k + 1]);
    let time = to - from;
    let part = |at: f64| {
        let part = if time > 0.0 { (at - offset - from) / time } else { 0.0 };
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
