//! One load step at its place in time, and what drives the contact at a moment of it.

use crate::contact::Control;
use crate::plan::{LoadStep, Plan};
use crate::scene::Every;

/// A load step at its place in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment<'p> {
    pub(super) step: &'p LoadStep,
    /// Simulated time at its start.
    pub(super) start: f64,
    /// Its length; simulated time.
    pub(super) length: f64,
    /// Represented time at its start.
    pub(super) represented: f64,
    /// Represented time per simulated time.
    pub(super) scale: f64,
    /// Number of the load step, from 1.
    pub(super) number: i64,
    /// Number of the represented cycle at its start, from 1; 0 outside cycles.
    pub(super) cycle: i64,
}

/// What drives the contact at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Driven {
    pub(super) control: Control,
    /// Sliding velocity where nothing sticks and no file says another; its sign is the direction along x.
    pub(super) velocity: f64,
    pub(super) temperature: f64,
    /// Represented time.
    pub(super) time: f64,
    /// Represented time since the start of the load step.
    pub(super) step_time: f64,
}

impl Segment<'_> {
    /// Simulated time at its end.
    pub(super) fn end(&self) -> f64 {
        self.start + self.length
    }

    fn part(&self, at: f64) -> f64 {
        if self.length > 0.0 { ((at - self.start) / self.length).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// Represented time at a simulated time.
    pub(super) fn represented_at(&self, at: f64) -> f64 {
        self.represented + self.scale * (at - self.start)
    }

    /// What drives the contact at a simulated time.
    pub(super) fn at(&self, at: f64) -> Driven {
        let part = self.part(at);
        let control = match (self.step.load, self.step.approach) {
            (Some(load), _) => Control::Load(load.at(part)),
            (None, Some(approach)) => Control::Approach(approach.at(part)),
            (None, None) => Control::Load(0.0),
        };
        let velocity = match (self.step.velocity, self.step.velocity_file) {
            (Some(velocity), _) => velocity.at(part),
            (None, Some(_)) => 1.0,
            (None, None) => 0.0,
        };
        Driven {
            control,
            velocity,
            temperature: self.step.temperature.map_or(0.0, |temperature| temperature.at(part)),
            time: self.represented_at(at),
            step_time: self.scale * (at - self.start),
        }
    }

    /// Whether load or approach is the same throughout.
    pub(super) fn presses_steadily(&self) -> bool {
        [self.step.load, self.step.approach].into_iter().flatten().all(|line| line.from == line.to)
    }

    /// Represented times inside an unscaled segment at which something bends or is written, ascending, its end last.
    pub(super) fn events(&self, plan: &Plan) -> Vec<f64> {
        let mut events: Vec<f64> = plan.material.constants.break_times().to_vec();
        if let Every::Times(times) = &plan.output.every {
            events.extend(times);
        }
        let end = self.represented + self.length;
        let near = 1e-12 * self.length;
        events.retain(|event| *event > self.represented + near && *event < end - near);
        events.push(end);
        events.sort_by(f64::total_cmp);
        events.dedup_by(|later, earlier| *later - *earlier <= near);
        events
    }

    /// Simulated times inside at which something bends: table points in time and in a temperature that ramps, a velocity
    /// that changes sign, output times, the ends of fixed substeps; ascending, the segment's end last.
    pub(super) fn cuts(&self, plan: &Plan) -> Vec<f64> {
        let mut cuts = Vec::new();
        let simulated = |represented: f64| self.start + (represented - self.represented) / self.scale;
        cuts.extend(plan.material.constants.break_times().iter().map(|time| simulated(*time)));
        if let Every::Times(times) = &plan.output.every {
            cuts.extend(times.iter().map(|time| simulated(*time)));
        }
        if let Some(velocity) = self.step.velocity
            && velocity.from * velocity.to < 0.0
        {
            cuts.push(self.start + self.length * velocity.from / (velocity.from - velocity.to));
        }
        if let Some(temperature) = self.step.temperature.filter(|temperature| temperature.from != temperature.to) {
            let passed = plan.material.constants.break_temperatures().iter();
            let part = |level: &f64| (level - temperature.from) / (temperature.to - temperature.from);
            cuts.extend(
                passed.map(part).filter(|part| (0.0..1.0).contains(part)).map(|part| self.start + self.length * part),
            );
        }
        if let Some(substeps) = plan.substeps {
            cuts.extend((1..substeps).map(|k| self.start + self.length * (k as f64 / substeps as f64)));
        }
        let near = 1e-12 * self.length;
        cuts.retain(|cut| *cut > self.start + near && *cut < self.end() - near);
        cuts.push(self.end());
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|later, earlier| *later - *earlier <= near);
        cuts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Linear;

    #[test]
    fn a_scaled_segment_represents_more_time_under_the_same_loading() {
        let step = LoadStep {
            load: Some(Linear { from: 0.0, to: 8.0 }),
            velocity: Some(Linear { from: 1.0, to: 1.0 }),
            ..LoadStep::default()
        };
        let segment =
            Segment { step: &step, start: 2.0, length: 4.0, represented: 10.0, scale: 5.0, number: 1, cycle: 0 };
        let driven = segment.at(3.0);
        assert_eq!((driven.control, driven.time, driven.step_time), (Control::Load(2.0), 15.0, 5.0));
        assert_eq!(segment.represented_at(segment.end()), 30.0);
        assert!(!segment.presses_steadily());
    }
}
