//! What pressures amount to, and the ways from one to better ones that need no transform.

use super::super::RootMean;
use super::contact_set::ContactSet;
use super::descend::NEAR;
use super::passes::{change, each_chunk, sum};
use super::patch::Patch;

/// Cells that are looked at together.
const BLOCK: usize = 32;
/// Comparisons side by side.
const LANES: usize = 8;

/// What a pressure and its displacement amount to.
#[derive(Clone, Copy, Debug, Default)]
pub struct State {
    /// Sum of the pressures.
    pub total: f64,
    /// Sums of p gap and p |gap|.
    pub weighted: [f64; 2],
    /// Lowest gap.
    pub lowest: f64,
    /// Largest displacement, or what the largest pressure displaces its own cell, if that is more, in contact.
    pub displaced: f64,
    /// Largest gap without pressure in contact, or what the pressure does to it before anything cancels.
    pub height: f64,
    /// Sum of p (u / 2 + gap).
    pub energy: f64,
    /// Sum of p |u / 2 + gap|.
    pub energies: f64,
    /// What is open, or overlaps, where the local compliance takes most of the displacement; see [`soft`].
    pub soft: f64,
}

impl State {
    /// Of pressures and their displacements.
    pub fn of(patch: &Patch<'_>, pressure: &[f64], u: &[f64]) -> State {
        let own = patch.kernel.mode([1, 0], [2, 1]);
        let parts = each_chunk(patch.threads, pressure.len(), |range| {
            let mut part = State { lowest: f64::INFINITY, ..State::default() };
            for first in range.clone().step_by(BLOCK) {
                let cells = first..range.end.min(first + BLOCK);
                let (pressure, gap, u) = (&pressure[cells.clone()], &patch.gap[cells.clone()], &u[cells.clone()]);
                part.lowest = part.lowest.min(least(gap, u));
                // Without a branch for each cell, because most blocks are without pressure.
                if !pressure.iter().fold(false, |any, p| any | (*p > 0.0)) {
                    continue;
                }
                for (((p, first), u), cell) in
                    pressure.iter().zip(gap).zip(u).zip(cells).filter(|(((p, _), _), _)| **p > 0.0)
                {
                    let gap = first + u;
                    let all = patch.weight(cell) * p;
                    part.total += all;
                    part.weighted[0] += all * gap;
                    part.weighted[1] += all * gap.abs();
                    part.displaced = part.displaced.max(u.abs()).max(own * p);
                    part.height = part.height.max(first.abs()).max((own + patch.local(cell)) * p);
                    part.energy += all * (0.5 * u + first);
                    part.energies += all * (0.5 * u.abs() + first.abs());
                }
            }
            part
        });
        let add = |a: State, b: State| State {
            total: a.total + b.total,
            weighted: [a.weighted[0] + b.weighted[0], a.weighted[1] + b.weighted[1]],
            lowest: a.lowest.min(b.lowest),
            displaced: a.displaced.max(b.displaced),
            height: a.height.max(b.height),
            energy: a.energy + b.energy,
            energies: a.energies + b.energies,
            soft: 0.0,
        };
        let mut state = parts.into_iter().fold(State { lowest: f64::INFINITY, ..State::default() }, add);
        if !patch.local.is_empty() {
            state.soft = soft(patch, pressure, u, state.approach(patch));
        }
        state
    }

    /// The approach that goes with it.
    pub fn approach(&self, patch: &Patch<'_>) -> f64 {
        if patch.sum.is_some() && self.total > 0.0 { self.weighted[0] / self.total } else { 0.0 }
    }

    /// The complementarity error, as a length.
    pub fn error(&self, patch: &Patch<'_>) -> f64 {
        let soft = self.soft / NEAR;
        if patch.sum.is_some() {
            return (self.approach(patch) - self.lowest).max(soft);
        }
        let mean = if self.total > 0.0 { self.weighted[1] / self.total } else { 0.0 };
        (mean + (-self.lowest).max(0.0)).max(soft)
    }
}

/// Root mean square of the gap, less the approach, over the cells with pressure, each counting by the part of its own
/// displacement that is the local compliance's.
///
/// An implicit step wears b p off a cell. Where b is far above the elastic compliance p is next to nothing, and so is its
/// part in the complementarity error, however wrong the wear is.
fn soft(patch: &Patch<'_>, pressure: &[f64], u: &[f64], approach: f64) -> f64 {
    let own = patch.kernel.mode([1, 0], [2, 1]);
    let parts = each_chunk(patch.threads, pressure.len(), |range| {
        let mut open = RootMean::default();
        for cell in range.filter(|cell| pressure[*cell] > 0.0) {
            let local = patch.local(cell);
            for _ in 0..patch.weight(cell) as usize {
                open.add(local / (local + own) * (patch.gap[cell] + u[cell] - approach));
            }
        }
        open
    });
    parts.into_iter().fold(RootMean::default(), RootMean::with).value()
}

/// The least of the sums of two arrays.
fn least(a: &[f64], b: &[f64]) -> f64 {
    // Side by side, so that comparisons do not wait for each other.
    let mut lanes = [f64::INFINITY; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a + b);
    for (a, b) in a.zip(b) {
        for lane in 0..LANES {
            let sum = a[lane] + b[lane];
            lanes[lane] = if sum < lanes[lane] { sum } else { lanes[lane] };
        }
    }
    lanes.into_iter().chain(rest).fold(f64::INFINITY, f64::min)
}

/// Goes to the state with the least energy between the one before and this one; says how much of the way is left.
///
/// It costs no transform, because the displacement is linear on it.
pub fn go_back(patch: &Patch<'_>, before: &[f64], u_before: &[f64], pressure: &mut [f64], u: &mut [f64]) -> f64 {
    let (threads, count) = (patch.threads, pressure.len());
    // Where nothing touches before or after there may be no gap to multiply with.
    let along = |i: usize| {
        let change = pressure[i] - before[i];
        if change == 0.0 { 0.0 } else { patch.weight(i) * change * (patch.gap[i] + u_before[i]) }
    };
    let slope = sum(threads, count, along);
    let curvature = sum(threads, count, |i| patch.weight(i) * (pressure[i] - before[i]) * (u[i] - u_before[i]));
    let step = (-slope / curvature).clamp(0.0, 1.0);
    if step.is_nan() {
        return 1.0;
    }
    change(threads, pressure, |i, p| before[i] + step * (p - before[i]));
    change(threads, u, |i, u| u_before[i] + step * (u - u_before[i]));
    step
}

/// The multiple of the pressures with the least energy, when no load says how large they are: a uniform change of all
/// pressures, which displaces the most, is what descents that are broken off find last.
pub fn enlarge(patch: &Patch<'_>, pressure: &mut [f64], u: &mut [f64], state: &State) {
    let curvature = 2.0 * (state.weighted[0] - state.energy);
    let factor = 1.0 - state.weighted[0] / curvature;
    if curvature > 0.0 && factor > 0.0 && factor.is_finite() {
        change(patch.threads, pressure, |_, p| p * factor);
        change(patch.threads, u, |_, u| u * factor);
    }
}

/// Makes a start possible: no pressure below zero or where nothing can touch, and the sum that is given.
pub fn start(patch: &Patch<'_>, pressure: &mut [f64]) {
    change(
        patch.threads,
        pressure,
        |cell, p| if p.is_finite() && p > 0.0 && patch.gap[cell].is_finite() { p } else { 0.0 },
    );
    rescale(patch, pressure);
}

/// Gives the pressures the sum that is given.
pub fn rescale(patch: &Patch<'_>, pressure: &mut [f64]) {
    let Some(wanted) = patch.sum else { return };
    let total = sum(patch.threads, pressure.len(), |cell| patch.weight(cell) * pressure[cell]);
    let factor = wanted / total;
    if total > 0.0 && factor.is_finite() {
        change(patch.threads, pressure, |_, p| p * factor);
    } else {
        let touching = (0..pressure.len()).filter(|cell| patch.gap[*cell].is_finite());
        let mean = wanted / touching.map(|cell| patch.weight(cell)).sum::<f64>();
        change(patch.threads, pressure, |cell, _| if patch.gap[cell].is_finite() { mean } else { 0.0 });
    }
}

/// Moves values on a set to the nearest that are not negative and, under a load, have the sum that is given.
pub fn project(patch: &Patch<'_>, set: &ContactSet, values: &mut [f64]) {
    if let Some(wanted) = patch.sum {
        // The shift grows with each cell that it leaves without pressure, so this ends.
        let (mut shift, mut count) = (f64::NEG_INFINITY, usize::MAX);
        loop {
            let (mut sum, mut weight, mut left) = (0.0, 0.0, 0);
            for (at, value) in values.iter().enumerate().filter(|(_, value)| **value > shift) {
                sum += set.weight(at) * value;
                weight += set.weight(at);
                left += 1;
            }
            if left == 0 || left >= count {
                break;
            }
            (shift, count) = ((sum - wanted) / weight, left);
        }
        values.iter_mut().for_each(|value| *value -= shift);
    }
    values.iter_mut().for_each(|value| *value = value.max(0.0));
}

/// Moves values back towards those before, all not negative, until none is below zero.
pub fn stop_at_zero(before: &[f64], values: &mut [f64]) {
    let reach = |(from, to): (&f64, &f64)| if *to < 0.0 { from / (from - to) } else { 1.0 };
    let step = before.iter().zip(values.iter()).map(reach).fold(1.0, f64::min);
    values.iter_mut().zip(before).for_each(|(to, from)| *to = from + step * (*to - from));
}
