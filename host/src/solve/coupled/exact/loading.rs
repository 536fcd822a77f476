//! The loading of a scene as exact answers need it: the integral of the speed's power, and load steps one after another.

use crate::plan::{Linear, LoadStep, Plan};

/// A load step, how much of it is gone through, and how often in a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit<'p> {
    pub(super) step: &'p LoadStep,
    /// Part of its duration, up to 1.
    pub(super) part: f64,
    pub(super) times: f64,
}

impl Visit<'_> {
    /// How long one of them lasts.
    pub(super) fn duration(&self) -> f64 {
        self.part * self.step.duration.unwrap_or(0.0)
    }

    /// Speed of a cell that slides as the load step says, from the start to the end of the visited part.
    fn velocity(&self) -> Linear {
        match (self.step.velocity, self.step.velocity_file) {
            (Some(velocity), _) => Linear { from: velocity.from, to: velocity.at(self.part) },
            (None, Some(_)) => Linear { from: 1.0, to: 1.0 },
            (None, None) => Linear { from: 0.0, to: 0.0 },
        }
    }

    /// Integral of |v|^n over time, all visits together.
    pub(super) fn slid(&self, exponent: f64) -> f64 {
        let Linear { from, to } = self.velocity();
        let mean = if from == to {
            from.abs().powf(exponent)
        } else if from.abs() == to.abs() {
            from.abs().powf(exponent) / (exponent + 1.0)
        } else {
            // The integral of |x|^n is x |x|^n / (n + 1).
            let integral = |x: f64| x * x.abs().powf(exponent) / (exponent + 1.0);
            (integral(to) - integral(from)) / (to - from)
        };
        self.times * self.duration() * mean
    }

    /// Whether the speed changes within the step.
    pub(super) fn ramps_speed(&self) -> bool {
        let Linear { from, to } = self.velocity();
        from != to
    }
}

/// Goes through the loading until a represented time. With `together`, all whole rounds of a cycle but its first are one
/// visit to each of their steps: they are alike, and there may be more of them than can be counted.
pub(super) fn walk<'p>(plan: &'p Plan, until: f64, together: bool, mut visit: impl FnMut(Visit<'p>)) {
    let mut at = 0.0;
    for block in &plan.blocks {
        let period: f64 = block.steps.iter().filter_map(|step| step.duration).sum();
        let mut round = 0;
        while round < block.count && at < until {
            let whole = ((until - at) / period * (1.0 + 1e-12)).floor();
            let alike = ((block.count - round) as f64).min(whole);
            if together && round > 0 && alike > 1.0 {
                block.steps.iter().for_each(|step| visit(Visit { step, part: 1.0, times: alike }));
                (round, at) = (round.saturating_add(alike as u64), at + alike * period);
                continue;
            }
            for (index, step) in block.steps.iter().enumerate() {
                let step = if round == 0 && index == 0 { &block.entry } else { step };
                let duration = step.duration.unwrap_or(0.0);
                let left = until - at;
                if left > 0.0 {
                    visit(Visit { step, part: if left >= duration { 1.0 } else { left / duration }, times: 1.0 });
                }
                at += duration;
            }
            round += 1;
        }
    }
}

/// Integral of |v|^n over time until a represented time, for cells that slide as the load steps say.
pub(super) fn slid(plan: &Plan, until: f64, exponent: f64) -> f64 {
    let mut sum = 0.0;
    walk(plan, until, true, |visit| sum += visit.slid(exponent));
    sum
}

/// When the loading ends; represented time.
pub(super) fn end(plan: &Plan) -> f64 {
    let period = |steps: &[LoadStep]| steps.iter().filter_map(|step| step.duration).sum::<f64>();
    plan.blocks.iter().map(|block| block.count as f64 * period(&block.steps)).sum()
}

/// Every load step of a plan once.
pub(super) fn steps(plan: &Plan) -> impl Iterator<Item = &LoadStep> {
    plan.blocks.iter().flat_map(|block| std::iter::once(&block.entry).chain(block.steps.get(1..).unwrap_or_default()))
}

/// Every load step of a plan once, and the first of a cycle also as it is in later rounds.
pub(super) fn all_steps(plan: &Plan) -> impl Iterator<Item = &LoadStep> {
    let again = plan.blocks.iter().filter(|block| block.count > 1).filter_map(|block| block.steps.first());
    steps(plan).chain(again)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(from: f64, to: f64, part: f64) -> (LoadStep, f64) {
        let velocity = Some(Linear { from, to });
        (LoadStep { duration: Some(2.0), velocity, ..LoadStep::NOTHING }, part)
    }

    #[test]
    fn powers_of_the_speed_are_integrated_over_time() {
        for ((step, part), exponent, integral) in [
            (step(-3.0, -3.0, 1.0), 2.0, 18.0),
            (step(0.0, 4.0, 1.0), 1.0, 4.0),
            (step(0.0, 4.0, 0.5), 1.0, 1.0),
            // Half of the time one way, half the other.
            (step(-2.0, 2.0, 1.0), 2.0, 2.0 * 4.0 / 3.0),
            (step(-1.0, 3.0, 1.0), 1.0, 0.25 + 0.75 * 3.0),
            (step(0.0, 0.0, 1.0), 0.0, 2.0),
        ] {
            let found = Visit { step: &step, part, times: 3.0 }.slid(exponent);
            assert!((found - 3.0 * integral).abs() < 1e-14 * integral, "{step:?}: {found}, {integral}");
        }
    }
}
