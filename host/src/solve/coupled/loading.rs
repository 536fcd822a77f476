//! The way through the loading: blocks, their rounds, the load steps of a round.

use super::going::{Going, Leave};
use super::place::Place;
use super::run::Coupled;
use super::segment::Segment;
use super::system::System;
use crate::scene::ScalingKind;
use crate::solve::ending::stop_reached;

impl<'p> Coupled<'p> {
    /// Goes through the loading from `going.place` to its end, where the place stays behind the last load step: a longer
    /// scene goes on from there.
    pub(super) fn blocks(&self, system: &mut System<'p>, going: &mut Going<'_>) -> Result<(), Leave> {
        // A run that was stopped has reached its limit already, unless the limit is another now.
        if let Some(reason) = going.history.last().and_then(|row| stop_reached(&self.plan.stop, row))
            && going.steps > 0
        {
            return Err(Leave::Stopped(reason));
        }
        loop {
            let place = going.place;
            let Some(block) = self.plan.blocks.get(place.block) else { return Ok(()) };
            let Some(step) = block.steps.get(place.step) else {
                if block.cycle {
                    going.clock.cycles = place.before + place.scale;
                }
                if !self.next_round(going) {
                    return Ok(());
                }
                continue;
            };
            let step = if place.done == 0.0 && place.step == 0 { &block.entry } else { step };
            if !place.entered {
                going.place.start = going.clock.simulated;
                going.place.represented = going.clock.represented;
                going.place.at = going.clock.simulated;
                (going.place.number, going.place.stretch) = (0, 1.0);
            }
            let earlier: usize = self.plan.blocks[..place.block].iter().map(|block| block.steps.len()).sum();
            let segment = Segment {
                step,
                start: going.place.start,
                length: step.duration.unwrap_or(0.0),
                represented: going.place.represented,
                scale: place.scale,
                number: (earlier + place.step) as i64 + 1,
                cycle: if block.cycle { (place.before + 1.0) as i64 } else { 0 },
            };
            going.place.length = segment.length;
            let period: f64 = block.steps.iter().filter_map(|step| step.duration).sum();
            let per_time = if block.cycle && period > 0.0 { period.recip() } else { 0.0 };
            self.segment(system, going, segment, per_time)?;
            going.place.step += 1;
            going.place.entered = false;
        }
    }

    /// Goes on to the next round or block; false at the end of the loading.
    fn next_round(&self, going: &mut Going<'_>) -> bool {
        let Place { block: at, done, scale, change, .. } = going.place;
        let block = &self.plan.blocks[at];
        let count = block.count as f64;
        let done = done + if block.cycle { scale } else { 1.0 };
        // What rounding leaves of a cut cycle is no cycle.
        if count - done > 1e-12 * count {
            let scaled = block.cycle && self.plan.material.scaling.kind == ScalingKind::Cycle;
            let wanted = if scaled { self.plan.material.scaling.factor(change / scale) } else { 1.0 };
            // The last scaled cycle is cut to land on the count.
            going.place.scale = wanted.min(count - done);
            going.place.done = done;
        } else if at + 1 < self.plan.blocks.len() {
            going.place = Place { block: at + 1, ..going.place };
            (going.place.done, going.place.scale) = (0.0, 1.0);
        } else {
            return false;
        }
        going.place.step = 0;
        going.place.change = 0.0;
        going.place.before = going.clock.cycles;
        true
    }
}
