//! Pressures of either sign that close the gap on a set that is given.

use super::contact_set::ContactSet;
use super::descend::{Descent, Followed, Goal};
use super::patch::Patch;
use super::search::Outcome;
use super::stencil::Stencil;

/// Rounds, each of which starts from a residual without accumulated rounding.
const MOST_ROUNDS: usize = 50;
/// Iterations of one round.
const MOST_ITERATIONS: u64 = 2000;
/// What a round reduces the residual to at most.
const REDUCTION: f64 = 1e-9;

/// Closes the gap on the set. `pressure` is over the window.
pub fn close(patch: &mut Patch<'_>, set: &ContactSet, tolerance: f64, pressure: &mut [f64]) -> Outcome {
    let count = set.len();
    let mut values = set.gather(patch.threads, pressure);
    values.iter_mut().filter(|p| !p.is_finite()).for_each(|p| *p = 0.0);
    if let Some(wanted) = patch.sum {
        let lacking = (wanted - values.iter().sum::<f64>()) / count.max(1) as f64;
        values.iter_mut().for_each(|p| *p += lacking);
    }
    let gap = set.gather(patch.threads, &patch.gap);
    let mut stencil = Stencil::new(patch, set);
    stencil.turn_to(patch, set);
    let mut descent = Descent { pressure: values, residual: gap.clone(), iterations: 0 };
    let mut reference = descent.norm(patch, set);
    let mut image = vec![0.0; count];
    let mut outcome = Outcome {
        approach: 0.0,
        iterations: 0,
        error: f64::INFINITY,
        bar: 0.0,
        converged: count == 0,
        outgrown: false,
    };
    let mut best = Vec::new();
    for round in 0..MOST_ROUNDS {
        patch.image(set, &descent.pressure, &mut image);
        let size = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>().sqrt();
        if round == 0 {
            descent.residual.copy_from_slice(&image);
            reference = reference.max(descent.norm(patch, set));
        }
        let floor = 8.0 * f64::EPSILON * (size(&gap) + size(&image));
        descent.residual.iter_mut().zip(gap.iter().zip(&image)).for_each(|(r, (gap, u))| *r = gap + u);
        let norm = descent.norm(patch, set);
        let error = if norm == 0.0 { 0.0 } else { norm / reference };
        let better = error < 0.5 * outcome.error;
        if error < outcome.error {
            let approach = descent.residual.iter().sum::<f64>() / count.max(1) as f64;
            outcome.approach = if patch.sum.is_some() { approach } else { 0.0 };
            outcome.error = error;
            best.clone_from(&descent.pressure);
        }
        outcome.iterations = descent.iterations;
        outcome.converged = outcome.error <= tolerance || outcome.error * reference <= floor;
        if outcome.converged || !better {
            break;
        }
        let mean = outcome.approach;
        descent.residual.iter_mut().for_each(|r| *r -= mean);
        let norm = (0.5 * tolerance * reference).max(REDUCTION * norm);
        let goal = Goal { norm, error: 0.0, wrong: f64::INFINITY, most: MOST_ITERATIONS };
        let mut followed = Followed { u: &mut [], most: 0, kept: false };
        descent.run(patch, set, &mut stencil, &goal, &mut followed);
        if let Some(wanted) = patch.sum {
            // What rounding did to the sum.
            let lacking = (wanted - descent.pressure.iter().sum::<f64>()) / count.max(1) as f64;
            descent.pressure.iter_mut().for_each(|p| *p += lacking);
        }
    }
    stencil.end(patch);
    pressure.fill(0.0);
    set.scatter(patch.threads, &best, pressure);
    outcome
}
