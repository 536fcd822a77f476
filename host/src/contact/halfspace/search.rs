//! The search for the cells in contact.
//!
//! A round takes the cells with pressure and those that overlap as the set in contact, goes down on it by conjugate
//! gradients (descend) until the set is more wrong than the pressures are, and drops pressures below zero. The inverse of
//! the compliance has the signs of an M-matrix, for which such rounds with exact descents end (Hintermüller, Ito,
//! Kunisch, SIAM J. Optim. 13, 2002). Where a round raises the energy all the same, the best state on the way is taken,
//! which costs no transform, because the displacement is linear on it.

use super::contact_set::ContactSet;
use super::descend::{Descent, Goal};
use super::passes::{change, each_chunk, sum};
use super::patch::Patch;
use super::stencil::Stencil;

/// Rounds after which a search is given up, and those without progress.
const MOST_ROUNDS: u64 = 1000;
const PATIENCE: u64 = 40;
/// Rounds without progress after which energies have to fall.
const LENIENCE: u64 = 8;
/// Iterations of one descent.
const MOST_ITERATIONS: u64 = 400;
/// What a descent reduces the residual to, on a set that has just changed and on one that stays.
const CHANGED: f64 = 0.15;
const SAME: f64 = 0.01;
/// How much of the residual wrong pressures may make up; see [`Goal::wrong`].
const WRONG: f64 = 2.0;

/// How exact an answer has to be.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Largest error, over the scale.
    pub tolerance: f64,
    /// Length that errors are measured with; 0: the largest displacement.
    pub scale: f64,
    /// Error that is enough, over the largest displacement, whatever the tolerance: a first guess.
    pub rough: f64,
}

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Approach beyond the datum of the problem.
    pub approach: f64,
    /// Iterations.
    pub iterations: u64,
    /// The error, over the scale.
    pub error: f64,
    /// The error that was allowed, as a length.
    pub bar: f64,
    /// Whether the error is small enough.
    pub converged: bool,
}

/// What a pressure and its displacement amount to.
#[derive(Clone, Copy, Debug, Default)]
struct State {
    total: f64,
    /// Sums of p gap and p |gap|.
    weighted: [f64; 2],
    lowest: f64,
    /// Largest displacement, and largest gap without pressure, in contact.
    displaced: f64,
    height: f64,
    energy: f64,
    /// Sum of p |u / 2 + gap|.
    energies: f64,
}

impl State {
    fn of(patch: &Patch<'_>, pressure: &[f64], u: &[f64]) -> State {
        let parts = each_chunk(patch.threads, pressure.len(), |range| {
            let mut part = State { lowest: f64::INFINITY, ..State::default() };
            for cell in range {
                let (p, first, u) = (pressure[cell], patch.gap[cell], u[cell]);
                let gap = first + u;
                part.lowest = part.lowest.min(gap);
                if p > 0.0 {
                    part.total += p;
                    part.weighted[0] += p * gap;
                    part.weighted[1] += p * gap.abs();
                    part.displaced = part.displaced.max(u.abs());
                    part.height = part.height.max(first.abs());
                    part.energy += p * (0.5 * u + first);
                    part.energies += p * (0.5 * u.abs() + first.abs());
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
        };
        parts.into_iter().fold(State { lowest: f64::INFINITY, ..State::default() }, add)
    }

    /// The approach that goes with it.
    fn approach(&self, patch: &Patch<'_>) -> f64 {
        if patch.sum.is_some() && self.total > 0.0 { self.weighted[0] / self.total } else { 0.0 }
    }

    fn error(&self, patch: &Patch<'_>) -> f64 {
        if patch.sum.is_some() {
            return self.approach(patch) - self.lowest;
        }
        let mean = if self.total > 0.0 { self.weighted[1] / self.total } else { 0.0 };
        mean + (-self.lowest).max(0.0)
    }
}

/// Finds the contact and its pressures over the window, from a start.
pub fn search(patch: &mut Patch<'_>, accuracy: Accuracy, pressure: &mut Vec<f64>) -> Outcome {
    let count = pressure.len();
    start(patch, pressure);
    let mut u = vec![0.0; count];
    let (mut before, mut u_before) = (Vec::new(), Vec::new());
    let mut last = State::default();
    let mut set = ContactSet::default();
    let mut best = (f64::INFINITY, 0.0, 0, ContactSet::default(), Vec::new());
    let mut iterations = 0;
    for round in 0.. {
        patch.evaluate(pressure, &mut u);
        let mut state = State::of(patch, pressure, &u);
        if patch.sum.is_none() && state.weighted[0] != 0.0 {
            enlarge(patch, pressure, &mut u, &state);
            state = State::of(patch, pressure, &u);
        }
        let going_round = round > best.2 + LENIENCE;
        if going_round && patch.symmetric() && state.energy > last.energy + 1e-12 * state.energies {
            go_back(patch, &before, &u_before, pressure, &mut u);
            state = State::of(patch, pressure, &u);
        }
        let scale = if accuracy.scale > 0.0 { accuracy.scale } else { state.displaced };
        let floor = 8.0 * f64::EPSILON * (state.displaced + state.height);
        let bar = (accuracy.tolerance * scale).max(accuracy.rough * state.displaced).max(floor);
        let (error, approach) = (state.error(patch), state.approach(patch));
        let outcome = |error: f64, approach: f64, converged: bool| Outcome {
            approach,
            iterations,
            error: if scale > 0.0 { error / scale } else { error },
            bar,
            converged,
        };
        if error <= bar {
            return outcome(error, approach, true);
        }
        let touching = ContactSet::of(patch.counts, |cell| pressure[cell] > 0.0);
        if error < 0.9 * best.0 {
            let values = touching.gather(pressure);
            best = (error, approach, round, touching, values);
        }
        if round >= MOST_ROUNDS || round > best.2 + PATIENCE || !error.is_finite() {
            pressure.fill(0.0);
            best.3.scatter(&best.4, pressure);
            // What rounding left over is no failure.
            return outcome(best.0, best.1, best.0 <= 64.0 * floor);
        }
        let joins = approach - 0.25 * bar;
        let now = ContactSet::of(patch.counts, |cell| pressure[cell] > 0.0 || patch.gap[cell] + u[cell] < joins);
        let same = now == set;
        set = now;
        let mut stencil = Stencil::new(patch, &set);
        let residual = set.cells.iter().map(|cell| patch.gap[*cell as usize] + u[*cell as usize] - approach).collect();
        let mut descent = Descent { pressure: set.gather(pressure), residual, iterations: 0 };
        let reduction = if same { SAME } else { CHANGED };
        let goal =
            Goal { norm: reduction * descent.norm(patch), error: 0.5 * bar, wrong: WRONG, most: MOST_ITERATIONS };
        descent.run(patch, &set, &mut stencil, &goal);
        iterations += descent.iterations;
        before.clone_from(pressure);
        std::mem::swap(&mut u, &mut u_before);
        u.resize(count, 0.0);
        last = state;
        descent.pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        set.scatter(&descent.pressure, pressure);
        rescale(patch, pressure);
    }
    unreachable!("the rounds end by themselves")
}

/// The state with the least energy between the one before and this one.
fn go_back(patch: &Patch<'_>, before: &[f64], u_before: &[f64], pressure: &mut [f64], u: &mut [f64]) {
    let (threads, count) = (patch.threads, pressure.len());
    let touches = |i: usize| before[i] > 0.0 || pressure[i] > 0.0;
    let slope =
        sum(
            threads,
            count,
            |i| {
                if touches(i) { (pressure[i] - before[i]) * (patch.gap[i] + u_before[i]) } else { 0.0 }
            },
        );
    let curvature = sum(threads, count, |i| (pressure[i] - before[i]) * (u[i] - u_before[i]));
    let step = (-slope / curvature).clamp(0.05, 1.0);
    if step.is_finite() {
        change(threads, pressure, |i, p| before[i] + step * (p - before[i]));
        change(threads, u, |i, u| u_before[i] + step * (u - u_before[i]));
    }
}

/// The multiple of the pressures with the least energy, when no load says how large they are: a uniform change of all
/// pressures, which displaces the most, is what descents that are broken off find last.
fn enlarge(patch: &Patch<'_>, pressure: &mut [f64], u: &mut [f64], state: &State) {
    let curvature = 2.0 * (state.weighted[0] - state.energy);
    let factor = 1.0 - state.weighted[0] / curvature;
    if curvature > 0.0 && factor > 0.0 && factor.is_finite() {
        change(patch.threads, pressure, |_, p| p * factor);
        change(patch.threads, u, |_, u| u * factor);
    }
}

/// Makes a start possible: no pressure below zero or where nothing can touch, and the sum that is given.
fn start(patch: &Patch<'_>, pressure: &mut [f64]) {
    change(
        patch.threads,
        pressure,
        |cell, p| if p.is_finite() && p > 0.0 && patch.gap[cell].is_finite() { p } else { 0.0 },
    );
    rescale(patch, pressure);
}

/// Gives the pressures the sum that is given.
fn rescale(patch: &Patch<'_>, pressure: &mut [f64]) {
    let Some(wanted) = patch.sum else { return };
    let total = sum(patch.threads, pressure.len(), |cell| pressure[cell]);
    let factor = wanted / total;
    if total > 0.0 && factor.is_finite() {
        change(patch.threads, pressure, |_, p| p * factor);
    } else {
        let touching = patch.gap.iter().filter(|gap| gap.is_finite()).count();
        let mean = wanted / touching as f64;
        change(patch.threads, pressure, |cell, _| if patch.gap[cell].is_finite() { mean } else { 0.0 });
    }
}
