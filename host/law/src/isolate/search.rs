//! Which point a worker was lost at: a fresh worker is given one point of the piece at a time.

use std::ops::Range;
use std::time::{Duration, Instant};

use super::super::batch::{Batch, Outputs};
use super::super::evaluation::{Evaluator, PointInputs};
use super::parent::{IsolatedLaw, Trouble};

/// A single point of a law that answers at all takes microseconds; a second is a hang.
const POINT_DEADLINE: Duration = Duration::from_secs(1);
/// Longer than the points of any piece take; a law that is slower than that is not searched further.
const SEARCH: Duration = Duration::from_secs(5);

/// The outputs that a call asked for: what is not asked for may be what a law dies of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked {
    direction: bool,
    state: bool,
    status: bool,
    d_pressure: bool,
}

impl Asked {
    pub(super) fn of(outputs: &Outputs<'_>) -> Self {
        Self {
            direction: outputs.direction.is_some(),
            state: outputs.state.is_some(),
            status: outputs.status.is_some(),
            d_pressure: outputs.d_pressure.is_some(),
        }
    }
}

impl IsolatedLaw {
    /// The first point of `piece` at which a fresh worker is lost too, asked for the same outputs, and its inputs.
    pub(super) fn search(&self, batch: &Batch<'_>, piece: Range<usize>, asked: Asked) -> Option<PointInputs> {
        let law = self.descriptor();
        let mut worker = self.fresh().ok()?;
        let end = Instant::now() + SEARCH.min(self.deadline());
        let (mut increment, mut direction) = ([0.0], [0.0; 3]);
        let (mut state, mut status, mut d_pressure) = (vec![0.0; law.state.len()], [0], [0.0]);
        for point in piece {
            let single = batch.range(point..point + 1);
            let mut outputs = Outputs {
                increment: &mut increment,
                direction: asked.direction.then_some(&mut direction[..]),
                state: asked.state.then_some(&mut state[..]),
                status: asked.status.then_some(&mut status[..]),
                d_pressure: asked.d_pressure.then_some(&mut d_pressure[..]),
            };
            match worker.call(&single, &mut outputs, POINT_DEADLINE.min(self.deadline())) {
                Ok(_) if Instant::now() < end => {}
                Ok(_) | Err(Trouble::Channel(_)) => return None,
                Err(Trouble::Lost { .. }) => return Some(batch.inputs_at(point)),
            }
        }
        None
    }
}
