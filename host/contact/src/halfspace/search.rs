//! The search for the cells in contact.
//!
//! A round takes the cells with pressure and those that overlap as the set in contact, goes down on it by conjugate
//! gradients (descend) until the set is more wrong than the pressures are, and drops pressures below zero. The inverse of
//! the compliance has the signs of an M-matrix, for which such rounds with exact descents end (Hintermüller, Ito,
//! Kunisch, SIAM J. Optim. 13, 2002). Where they go round in circles all the same, which a smoothed local compliance can
//! bring about, the energy is made to fall from then on: a round that would raise it goes back to the best state on its
//! way, and careful rounds follow, which always lower it: steps straight down the gradient, projected, and a descent on
//! the cells with pressure that ends where the first of them has none left (Moré and Toraldo, SIAM J. Optim. 1, 1991).

use super::contact_set::ContactSet;
use super::descend::{Descent, Followed, Goal};
use super::passes::change;
use super::patch::Patch;
use super::state::{self, State, enlarge, go_back, project, start, stop_at_zero};
use super::stencil::Stencil;

/// Rounds after which a search is given up, and those without progress.
const MOST_ROUNDS: u64 = 1000;
const PATIENCE: u64 = 120;
/// Rounds without progress after which energies have to fall, and careful rounds after one that would have raised it.
const LENIENCE: u64 = 8;
const CAREFUL: u32 = 4;
/// Iterations of one descent.
const MOST_ITERATIONS: u64 = 400;
/// What a descent reduces the residual to, on a set that has just changed and on one that stays.
const CHANGED: f64 = 0.15;
const SAME: f64 = 0.01;
/// How much of the residual wrong pressures may make up; see [`Goal::wrong`].
const WRONG: f64 = 2.0;
/// Iterations of a descent for which the displacement is kept everywhere; see [`Followed`].
const FOLLOWED: u64 = 4;
/// Bars below this times the floor of rounding are only met by a displacement that was computed anew.
const SURE: f64 = 1e4;
/// Relative difference from the sum that is given which rounding makes.
const ROUNDING: f64 = 1e-13;

/// Arrays of numbers over the cells that a search has at most, with all of them in contact: gap, pressure, displacement and
/// the field of the stencil, a spare displacement, two of a round that may be undone, the best pressures; pressure and
/// residual of a descent and its five; four lists of cells, half as long.
pub const MOST_ARRAYS: usize = 17;

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
    /// Whether the contact has come to where the surface goes on beyond the window, and so was not finished.
    pub outgrown: bool,
}

/// Finds the contact and its pressures over the window, from a start.
pub fn search(patch: &mut Patch<'_>, accuracy: Accuracy, pressure: &mut [f64]) -> Outcome {
    start(patch, pressure);
    let mut u = patch.room.take(pressure.len());
    let mut stencil = None;
    let outcome = rounds(patch, accuracy, pressure, &mut u, &mut stencil);
    patch.room.give(u);
    if let Some(stencil) = stencil {
        stencil.end(patch);
    }
    outcome
}

/// The rounds of a search; `u` and `stencil` are room.
fn rounds(
    patch: &mut Patch<'_>,
    accuracy: Accuracy,
    pressure: &mut [f64],
    u: &mut Vec<f64>,
    stencil: &mut Option<Stencil>,
) -> Outcome {
    let (mut before, mut u_before) = (Vec::new(), Vec::new());
    let mut last = State::default();
    let mut set = ContactSet::default();
    let mut best = (f64::INFINITY, 0.0, 0, ContactSet::default(), Vec::new());
    let mut iterations = 0;
    let (mut guarded, mut careful) = (false, 0);
    // Whether u is that of the pressures already.
    let mut known = false;
    for round in 0.. {
        // Without symmetry the energy is no more than a way out of the circle.
        guarded = round > best.2 + LENIENCE || guarded && patch.symmetric();
        let (state, scale, floor, bar) = loop {
            if !known {
                patch.evaluate(pressure, u);
            }
            let mut state = State::of(patch, pressure, u);
            if patch.sum.is_none() && state.weighted[0] != 0.0 {
                enlarge(patch, pressure, u, &state);
                state = State::of(patch, pressure, u);
            }
            if guarded && state.energy > last.energy + 1e-12 * state.energies {
                let step = go_back(patch, &before, &u_before, pressure, u);
                if careful == 0 && step < 0.5 {
                    careful = CAREFUL;
                }
                state = State::of(patch, pressure, u);
            }
            let scale = if accuracy.scale > 0.0 { accuracy.scale } else { state.displaced };
            let floor = 8.0 * f64::EPSILON * (state.displaced + state.height);
            let bar = (accuracy.tolerance * scale).max(accuracy.rough * state.displaced).max(floor);
            if known && bar < SURE * floor && state.error(patch) <= bar {
                // What rounding has added up to on the way may count.
                known = false;
                continue;
            }
            break (state, scale, floor, bar);
        };
        let (error, approach) = (state.error(patch), state.approach(patch));
        let outcome = |error: f64, approach: f64, converged: bool| Outcome {
            approach,
            iterations,
            error: if scale > 0.0 { error / scale } else { error },
            bar,
            converged,
            outgrown: false,
        };
        if error <= bar {
            return outcome(error, approach, true);
        }
        if round > 1 && patch.is_outgrown(pressure) {
            return Outcome { outgrown: true, ..outcome(error, approach, false) };
        }
        // The last careful round is on the cells with pressure alone.
        let joins = if careful == 1 { f64::NEG_INFINITY } else { approach - 0.25 * bar };
        let now = ContactSet::touching(patch.threads, patch.counts[0], pressure, &patch.gap, u, joins);
        let now = now.weighed(patch.threads, &patch.weights);
        if error < 0.9 * best.0 {
            let values = now.gather(patch.threads, pressure);
            best = (error, approach, round, now.clone(), values);
        }
        if round >= MOST_ROUNDS || round > best.2 + PATIENCE || !error.is_finite() {
            pressure.fill(0.0);
            best.3.scatter(patch.threads, &best.4, pressure);
            // What rounding left over is no failure.
            return outcome(best.0, best.1, best.0 <= 64.0 * floor);
        }
        let same = now == set;
        set = now;
        let stencil = stencil.get_or_insert_with(|| Stencil::new(patch, &set));
        if !same {
            stencil.turn_to(patch, &set);
        }
        let threads = patch.threads;
        let mut residual = vec![0.0; set.len()];
        change(threads, &mut residual, |at, _| {
            let cell = set.cells[at] as usize;
            patch.gap[cell] + u[cell] - approach
        });
        let mut descent = Descent { pressure: set.gather(threads, pressure), residual, iterations: 0 };
        let next_guarded = guarded || round + 1 > best.2 + LENIENCE;
        if next_guarded {
            before.clear();
            before.extend_from_slice(pressure);
            u_before.clear();
            u_before.extend_from_slice(u);
        }
        known = false;
        if careful > 1 {
            descent.straight(patch, &set);
            project(patch, &set, &mut descent.pressure);
        } else {
            let reduction = if same { SAME } else { CHANGED };
            let norm = reduction * descent.norm(patch, &set);
            let goal = Goal { norm, error: 0.5 * bar, wrong: WRONG, most: MOST_ITERATIONS };
            let mut followed = Followed { u, most: FOLLOWED, kept: !next_guarded };
            descent.run(patch, &set, stencil, &goal, &mut followed);
            known = followed.kept;
            if careful == 1 {
                stop_at_zero(&set.gather(threads, pressure), &mut descent.pressure);
            }
            known &= descent.pressure.iter().all(|p| *p >= 0.0);
            change(threads, &mut descent.pressure, |_, p| p.max(0.0));
        }
        careful = careful.saturating_sub(1);
        iterations += descent.iterations;
        last = state;
        set.scatter(threads, &descent.pressure, pressure);
        known &= rescale(patch, &set, &descent.pressure, pressure);
    }
    unreachable!("the rounds end by themselves")
}

/// Gives the pressures the sum that is given; they are these on a set and zero elsewhere. Whether that was rounding alone.
fn rescale(patch: &Patch<'_>, set: &ContactSet, on_set: &[f64], pressure: &mut [f64]) -> bool {
    let Some(wanted) = patch.sum else { return true };
    let factor = wanted / set.sum(patch.threads, |at| on_set[at]);
    if (factor - 1.0).abs() <= ROUNDING {
        return true;
    }
    state::rescale(patch, pressure);
    false
}
