//! Which case of a study is run next: the cheapest that fits, time being kept for what the verdict needs.

use super::budget::Budget;
use super::lines::Line;
use crate::record::{Case, Kind, Status};

/// Lines with a case that the verdict needs are run as if they cost so much of what they do.
const FIRST: f64 = 0.1;
/// What a case may take more than it was thought to take.
const SURPRISE: f64 = 1.1;

/// A line while it is run.
pub(super) struct Track {
    pub(super) line: Line,
    pub(super) next: usize,
    /// Value, seconds of one run and steps of the last that ran.
    pub(super) last: Option<(f64, f64, f64)>,
    /// How much dearer it was than the one before.
    pub(super) growth: f64,
    pub(super) open: bool,
    pub(super) cases: Vec<Case>,
}

impl Track {
    /// Of a line that has not begun.
    pub(super) fn new(line: Line) -> Track {
        Track { line, next: 0, last: None, growth: 2.0, open: true, cases: Vec::new() }
    }

    /// Whether the last of its cases that ran to its end was unstable.
    fn is_unstable(&self) -> bool {
        let ran = self.cases.iter().rev().find(|case| case.timing.is_some());
        ran.is_some_and(|case| case.status == Status::Unstable)
    }

    /// Whether a case that the verdict needs ran to its end, and is stable.
    fn has_what_is_needed(&self) -> bool {
        let mut ran = self.line.cases.iter().zip(&self.cases);
        ran.any(|(planned, case)| planned.needed && case.status == Status::Done && case.timing.is_some())
    }
}

/// What the next case is picked by.
pub(super) struct Pick<'a> {
    pub(super) budget: &'a Budget,
    /// Seconds of the budget that are left.
    pub(super) left_s: f64,
    /// Seconds of the yardstick's cheapest run, and how often it solved the contact.
    pub(super) cheapest: (f64, f64),
}

impl Pick<'_> {
    /// The line whose next case is the cheapest of those that fit.
    pub(super) fn next(&self, tracks: &[Track]) -> Option<usize> {
        let all = self.kept_s(tracks);
        let fitting = tracks.iter().enumerate().filter_map(|(index, track)| {
            let case = track.line.cases.get(track.next).filter(|_| track.open)?;
            let one = self.predicted(tracks, track, track.next);
            let for_others = if case.needed { 0.0 } else { all };
            // What the verdict needs, and what leads to it, comes before what costs as much.
            let weight = if self.needed_s(tracks, track).is_some() { FIRST } else { 1.0 };
            (self.room_s(one) <= self.left_s - for_others.min(self.left_s)).then_some((index, weight * one))
        });
        fitting.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// Seconds that are kept for what the verdict needs: one stable explicit run, whichever it comes to.
    pub(super) fn kept_s(&self, tracks: &[Track]) -> f64 {
        // Time is kept for what can fit; keeping it for more would run nothing at all.
        let needed = tracks.iter().filter_map(|track| self.needed_s(tracks, track));
        needed.filter(|one| *one <= self.left_s).fold(0.0, f64::max)
    }

    /// What has to be left for all runs of a case to begin, if one is thought to take so long; s.
    fn room_s(&self, one_s: f64) -> f64 {
        SURPRISE * self.budget.whole_case_s(one_s)
    }

    /// What has to be left for a line to come to its next case that the verdict needs; `None` if it has none, or if there
    /// is a stable explicit run already.
    fn needed_s(&self, tracks: &[Track], track: &Track) -> Option<f64> {
        if tracks.iter().any(Track::has_what_is_needed) {
            return None;
        }
        let ahead = track.line.cases.iter().skip(track.next).position(|case| case.needed);
        let last = track.next + ahead.filter(|_| track.open)?;
        Some((track.next..=last).map(|index| self.room_s(self.predicted(tracks, track, index))).sum())
    }

    /// What a case of a line is thought to take; seconds of one run.
    pub(super) fn predicted(&self, tracks: &[Track], track: &Track, index: usize) -> f64 {
        let next = &track.line.cases[index];
        let (wall_s, solves) = self.cheapest;
        // An explicit step solves the contact once; the others are tried with few steps first.
        let usual = wall_s / solves;
        if let Some((value, wall_s, _)) = track.last {
            if track.is_unstable() {
                return after_unstable(wall_s * next.value / value, usual * next.steps);
            }
            let times = match track.line.kind {
                Kind::Substeps => next.value / value,
                Kind::Scaling => value / next.value,
                Kind::Grid => 1.3 * (next.value / value).powi(2),
                Kind::Tolerance => track.growth.clamp(1.3, 10.0),
            };
            return wall_s * times;
        }
        // Nothing of the line is known: its steps cost what those of its method, or of any, have cost so far.
        let each = |track: &Track| track.last.map(|(_, wall_s, steps)| wall_s / steps.max(1.0));
        let alike = tracks.iter().filter(|other| other.line.method == track.line.method && !other.is_unstable());
        let each = alike.filter_map(each).fold(f64::NAN, f64::min);
        let each = if each.is_nan() { usual } else { each };
        match track.line.kind {
            Kind::Substeps | Kind::Scaling => each * next.steps,
            Kind::Tolerance => each,
            Kind::Grid => 0.1 * wall_s,
        }
    }
}

/// What a case is thought to take after an unstable one, whose chequerboards take more rounds than stable steps do: at
/// most what as many contact solves of the yardstick's cheapest run take.
fn after_unstable(scaled_s: f64, usual_s: f64) -> f64 {
    if usual_s > 0.0 { scaled_s.min(usual_s) } else { scaled_s }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::record::{Errors, Timing};
    use crate::study::lines::{AT_LIMIT, Planned};

    fn line(name: &str, method: &'static str, cases: &[(f64, bool)]) -> Track {
        let cases = cases.iter().map(|(steps, needed)| Planned {
            value: *steps,
            steps: *steps,
            overrides: Vec::new(),
            needed: *needed,
        });
        Track::new(Line {
            name: name.to_owned(),
            kind: Kind::Substeps,
            method,
            isolated: false,
            cases: cases.collect(),
            given: false,
            note: None,
        })
    }

    /// Its next case ran, or was cut before it had a time.
    fn ran(track: &mut Track, status: Status, one_s: Option<f64>) {
        let planned = track.line.cases[track.next].clone();
        track.last = one_s.map(|one_s| (planned.value, one_s, planned.steps)).or(track.last);
        track.cases.push(Case {
            line: track.line.name.clone(),
            kind: track.line.kind,
            method: track.line.method.to_owned(),
            isolated: false,
            value: planned.value,
            overrides: Vec::new(),
            status,
            timing: one_s.map(|wall_s| Timing {
                wall_s,
                wall_spread: 0.0,
                processor_s: wall_s,
                limit_s: 0.0,
                runs: 1,
                warmed_up: false,
            }),
            work: None,
            errors: Errors::new(),
            unresolved: Vec::new(),
            note: None,
        });
        track.next += 1;
    }

    #[test]
    fn what_unstable_steps_cost_does_not_keep_stable_ones_out() {
        assert_eq!(after_unstable(480.0, 30.0), 30.0);
        assert_eq!(after_unstable(2.0, 30.0), 2.0);
        assert_eq!(after_unstable(2.0, 0.0), 2.0, "nothing is known of the yardstick");
    }

    #[test]
    fn a_stable_explicit_run_is_in_the_study_although_unstable_ones_overrun() {
        let budget = Budget::begin(Duration::from_secs(240), 5);
        let mut tracks = [
            line("explicit-euler", "explicit-euler", &[(26.0, false), (52.0, false), (104.0, false), (1700.0, true)]),
            line(AT_LIMIT, "explicit-euler", &[(2094.0, true)]),
            line("implicit-euler", "implicit-euler", &(0..30).map(|k| (2.0_f64.powi(k), false)).collect::<Vec<_>>()),
        ];
        // A step of the yardstick takes 20 ms, an unstable one twenty times as long as it is thought to.
        let (mut left_s, mut stable) = (120.0, false);
        for _ in 0..60 {
            let pick = Pick { budget: &budget, left_s, cheapest: (17.4, 870.0) };
            let Some(index) = pick.next(&tracks) else { break };
            let kept = if tracks[index].line.cases[tracks[index].next].needed { 0.0 } else { pick.kept_s(&tracks) };
            let thought = budget.whole_case_s(pick.predicted(&tracks, &tracks[index], tracks[index].next));
            let steps = tracks[index].line.cases[tracks[index].next].steps;
            let unstable = index == 0 && steps < 1675.0;
            let one_s = if unstable { 0.06 * steps } else { 0.02 * steps };
            let whole = if unstable { 20.0 * thought } else { budget.whole_case_s(one_s) };
            if whole > left_s - kept {
                left_s = kept;
                ran(&mut tracks[index], Status::LeftOut("cut".to_owned()), None);
                tracks[index].open = false;
                continue;
            }
            left_s -= whole;
            ran(&mut tracks[index], if unstable { Status::Unstable } else { Status::Done }, Some(one_s));
            if index < 2 && !unstable {
                stable = true;
            }
        }
        assert!(stable, "{left_s} s left of 120 s, no stable explicit run of 34 or 42 s came to its end");
        let pick = Pick { budget: &budget, left_s, cheapest: (17.4, 870.0) };
        assert_eq!(pick.kept_s(&tracks), 0.0, "nothing is kept once there is a stable explicit run");
    }

    #[test]
    fn a_case_that_was_cut_does_not_count_as_stable_or_unstable() {
        let mut track = line("explicit-euler", "explicit-euler", &[(26.0, false), (52.0, false), (1700.0, true)]);
        assert!(!track.is_unstable());
        ran(&mut track, Status::Unstable, Some(1.0));
        ran(&mut track, Status::LeftOut("cut".to_owned()), None);
        assert!(track.is_unstable() && !track.has_what_is_needed());
        ran(&mut track, Status::LeftOut("cut".to_owned()), None);
        assert!(!track.has_what_is_needed());
    }
}
