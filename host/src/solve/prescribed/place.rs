//! Where a prescribed run is in its loading, and what it saves there to go on from.

use std::borrow::Cow;
use std::time::Instant;

use super::{Going, Prescribed};
use crate::record::{Checkpoint, CheckpointError, Cost, Event, Observer};
use crate::solve::ending::peak_memory;
use crate::solve::schedule::{self, Piece, Placed, Round};

/// A place between two pieces of the loading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) round: Round,
    /// Index of the load step in the round.
    pub(super) step: usize,
    /// Pieces of the load step that are done.
    pub(super) pieces: usize,
    /// Represented time reached.
    pub(super) time: f64,
    /// Represented time at which the load step ends.
    pub(super) end: f64,
}

const NAMES: [&str; 10] = [
    "place.block",
    "place.done",
    "place.scale",
    "place.clock",
    "place.lag",
    "place.cycles",
    "place.step",
    "place.pieces",
    "place.time",
    "place.end",
];

impl Place {
    pub(super) fn at(round: Round) -> Place {
        Place { round, step: 0, pieces: 0, time: round.clock, end: round.clock }
    }

    /// Of the pieces of its load step, the last that is done and all that are not.
    pub(super) fn left<'p>(&self, placed: &Placed<'p>, mut all: Vec<Piece<'p>>) -> (Option<Piece<'p>>, Vec<Piece<'p>>) {
        if self.pieces == 0 {
            return (None, all);
        }
        if placed.end == self.end {
            let rest = all.split_off(self.pieces.min(all.len()));
            return (all.pop(), rest);
        }
        // The load step is longer than it was: it is divided otherwise, and what has been done of a piece is cut off.
        let near = 1e-12 * (placed.end - placed.start);
        let (mut done, mut rest) = (None, Vec::new());
        for piece in all {
            if piece.end <= self.time + near {
                done = Some(piece);
            } else if piece.start < self.time - near {
                let part = (self.time - piece.start) / (piece.end - piece.start);
                let mut halves = schedule::split(piece, vec![part]);
                rest.extend(halves.pop());
                done = halves.pop().or(done);
            } else {
                rest.push(piece);
            }
        }
        (done, rest)
    }

    fn save(&self, to: &mut Checkpoint<'_>) {
        let Round { block, done, scale, clock, lag, cycles } = self.round;
        let (step, pieces) = (self.step as f64, self.pieces as f64);
        let values = [block as f64, done, scale, clock, lag, cycles, step, pieces, self.time, self.end];
        NAMES.iter().zip(values).for_each(|(name, value)| to.set(name, value));
    }

    fn load(from: &Checkpoint<'_>) -> Result<Place, CheckpointError> {
        let mut values = [0.0; 10];
        for (name, value) in NAMES.iter().zip(&mut values) {
            *value = from.number(name)?;
        }
        let [block, done, scale, clock, lag, cycles, step, pieces, time, end] = values;
        let round = Round { block: block as usize, done, scale, clock, lag, cycles };
        Ok(Place { round, step: step as usize, pieces: pieces as usize, time, end })
    }
}

impl Going {
    /// What the run has cost by now, with the part before a checkpoint that it went on from.
    pub(super) fn cost(&self, begin: Instant) -> Cost {
        Cost {
            run_time_s: self.spent.run_time_s + begin.elapsed().as_secs_f64(),
            law_time_s: self.spent.law_time_s + self.law_time.as_secs_f64(),
            steps: self.steps,
            rejected_steps: self.tally.rejected,
            law_calls: self.tally.law_calls,
            points_evaluated: self.tally.points_evaluated,
            peak_memory_bytes: peak_memory(),
            ..Cost::default()
        }
    }
}

impl Prescribed<'_> {
    /// Tells of a checkpoint if one is wanted; `last`: the run ends here.
    pub(super) fn offer(&self, going: &mut Going, observer: &mut (dyn Observer + Send), last: bool) {
        if !observer.wants_checkpoint(last) {
            return;
        }
        for aside in self.evaluator.take_warnings() {
            if !going.asides.contains(&aside) {
                going.asides.push(aside);
            }
        }
        let mut checkpoint = Checkpoint {
            time: going.place.map_or(0.0, |place| place.time),
            history: Cow::Borrowed(&going.history),
            warnings: going.warnings[..].into(),
            asides: going.asides[..].into(),
            cost: going.cost(going.begin),
            ..Checkpoint::default()
        };
        let to = &mut checkpoint;
        if let Some(place) = going.place {
            place.save(to);
        }
        to.set("tally.accepted", going.tally.accepted as f64);
        to.set("tally.error", going.tally.error);
        to.set("tally.shortest", going.tally.shortest);
        to.set("tally.longest", going.tally.longest);
        to.put("start_pressure", &going.start_pressure[..]);
        going.arrays.save(to);
        observer.observe(Event::Checkpoint { checkpoint: to, last });
    }

    /// Takes up a checkpoint; `going` is as new.
    ///
    /// # Errors
    /// A checkpoint that is not of this plan.
    pub(super) fn take_up(&self, going: &mut Going, from: &Checkpoint<'_>) -> Result<(), CheckpointError> {
        going.history = (*from.history).clone();
        going.warnings = from.warnings.to_vec();
        going.asides = from.asides.to_vec();
        going.spent = from.cost;
        going.steps = from.cost.steps;
        going.tally.accepted = from.number("tally.accepted")? as u64;
        going.tally.rejected = from.cost.rejected_steps;
        going.tally.law_calls = from.cost.law_calls;
        going.tally.points_evaluated = from.cost.points_evaluated;
        going.tally.error = from.number("tally.error")?;
        going.tally.shortest = from.number("tally.shortest")?;
        going.tally.longest = from.number("tally.longest")?;
        going.start_pressure = from.array("start_pressure")?.to_vec();
        going.arrays.take_up(from, going.steps > 0)?;
        let place = Place::load(from)?;
        let block = self.plan.blocks.get(place.round.block);
        if block.is_none_or(|block| place.step >= block.steps.len()) {
            let found = format!("load step {} of block {}", place.step + 1, place.round.block + 1);
            return Err(CheckpointError::Place { found });
        }
        going.place = Some(place);
        Ok(())
    }
}
