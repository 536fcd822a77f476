//! The time that a study may take, and how often a case is run in it.

use std::time::{Duration, Instant};

use crate::record::{Event, Observer, Wish};

/// Part of the budget that the runs of one case may take together.
const OF_A_CASE: f64 = 1.0 / 40.0;
/// Fewest timed runs for which a case is warmed up: below, its first run is the only one.
const FEWEST: u32 = 2;

/// The time that a study may take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    begin: Instant,
    whole: Duration,
    /// Most timed runs of a case.
    runs: u32,
}

impl Budget {
    /// A budget that begins now.
    pub(super) fn begin(whole: Duration, runs: u32) -> Self {
        Self { begin: Instant::now(), whole, runs: runs.max(1) }
    }

    /// The whole of it; s.
    pub(super) fn whole_s(&self) -> f64 {
        self.whole.as_secs_f64()
    }

    /// What is spent; s.
    pub(super) fn spent_s(&self) -> f64 {
        self.begin.elapsed().as_secs_f64()
    }

    /// What is left; s.
    pub(super) fn left_s(&self) -> f64 {
        (self.whole_s() - self.spent_s()).max(0.0)
    }

    /// When so much of it, as a part of 1, is spent; `None`: beyond what a clock can tell.
    pub(super) fn moment(&self, part: f64) -> Option<Instant> {
        self.begin.checked_add(Duration::try_from_secs_f64(part * self.whole_s()).ok()?)
    }

    /// How often a case is timed after a run to warm up, if one run takes so long; `None`: it runs once and that is it.
    pub(super) fn timed_runs(&self, one_s: f64) -> Option<u32> {
        let room = (OF_A_CASE * self.whole_s() / one_s.max(1e-9)).min(1e6) as u32;
        let runs = self.runs.min(room.saturating_sub(1));
        (runs >= FEWEST.min(self.runs)).then_some(runs)
    }

    /// How long all runs of a case take, if one takes so long; s.
    pub(super) fn whole_case_s(&self, one_s: f64) -> f64 {
        one_s * f64::from(1 + self.timed_runs(one_s).unwrap_or(0))
    }
}

/// Ends a run when its time is over, or somebody wants to end the study.
pub(super) struct Deadline<'a> {
    /// When its time is over; `None`: never.
    pub(super) at: Option<Instant>,
    /// Whether to go on.
    pub(super) goes_on: &'a (dyn Fn() -> bool + Sync),
}

impl Deadline<'_> {
    /// Whether the time is over.
    pub(super) fn is_over(&self) -> bool {
        self.at.is_some_and(|at| Instant::now() >= at)
    }
}

impl Observer for Deadline<'_> {
    fn observe(&mut self, _event: Event<'_>) -> Wish {
        if self.is_over() || !(self.goes_on)() { Wish::Stop } else { Wish::GoOn }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cheap_cases_are_repeated_and_dear_ones_run_once() {
        let budget = Budget::begin(Duration::from_secs(40), 5);
        assert_eq!(budget.timed_runs(1e-3), Some(5));
        assert_eq!(budget.timed_runs(0.25), Some(3));
        assert_eq!(budget.timed_runs(0.4), None);
        assert_eq!((budget.whole_case_s(0.125), budget.whole_case_s(7.0)), (0.75, 7.0));
        assert_eq!(Budget::begin(Duration::from_secs(40), 1).timed_runs(0.4), Some(1));
        assert_eq!(Budget::begin(Duration::from_secs(40), 1).timed_runs(0.6), None);
        assert!(budget.left_s() > 39.0 && budget.spent_s() < 1.0);
    }

    #[test]
    fn a_run_is_ended_at_its_moment_or_when_asked() {
        let (go, stop) = (|| true, || false);
        let wish = |at, goes_on: &(dyn Fn() -> bool + Sync)| {
            Deadline { at, goes_on }.observe(Event::Trial { time: 0.0, done: 0.0 })
        };
        assert_eq!(wish(None, &go), Wish::GoOn);
        assert_eq!(wish(None, &stop), Wish::Stop);
        assert_eq!(wish(Some(Instant::now()), &go), Wish::Stop);
        assert_eq!(wish(Budget::begin(Duration::MAX, 1).moment(1.0), &go), Wish::GoOn);
    }
}
