//! The cases of a study, run from cheap to dear as far as the budget goes.

use super::budget::Budget;
use super::frame::{Fields, Frame};
use super::lines::{AT_LIMIT, Line, Planned};
use super::setup::{How, Outcome, Ran, Setup, effort};
use super::yardstick::Gauge;
use crate::law::Evaluator;
use crate::record::{Case, Errors, Kind, Status, Work};

/// Errors below so many times the yardstick's own say no more than that they are small.
pub(super) const RESOLVED: f64 = 3.0;
/// A line that nobody gave values for ends below this error: two decades below what the verdict speaks of.
const ENOUGH: f64 = 1e-6;
/// Lines with a case that the verdict needs are run as if they cost so much of what they do.
const FIRST: f64 = 0.1;
/// What a case may take more than it was thought to take.
const SURPRISE: f64 = 1.1;

/// A line while it is run.
struct Track {
    line: Line,
    next: usize,
    /// Value, seconds of one run and steps of the last that ran.
    last: Option<(f64, f64, f64)>,
    /// How much dearer it was than the one before.
    growth: f64,
    open: bool,
    cases: Vec<Case>,
}

impl Track {
    /// Whether the last of its cases that ran to its end was unstable.
    fn is_unstable(&self) -> bool {
        let ran = self.cases.iter().rev().find(|case| case.timing.is_some());
        ran.is_some_and(|case| case.status == Status::Unstable)
    }
}

/// The outcome of all lines.
#[derive(Default)]
pub(super) struct Found {
    pub(super) cases: Vec<Case>,
    /// Fields of the grids, with what the scene's reference says of them.
    pub(super) grids: Vec<OnGrid>,
    /// Lines that ended because there was no more to see, and why.
    pub(super) ended: Vec<String>,
    pub(super) interrupted: bool,
}

/// A grid's fields.
pub(super) struct OnGrid {
    /// Index of its case.
    pub(super) case: usize,
    pub(super) fields: Fields,
    pub(super) frame: Frame,
    pub(super) expected: Option<Fields>,
}

/// What the cases are run with.
pub(super) struct Field<'a> {
    pub(super) setup: &'a Setup<'a>,
    pub(super) here: &'a dyn Evaluator,
    pub(super) elsewhere: Option<&'a dyn Evaluator>,
    pub(super) budget: &'a Budget,
    pub(super) gauge: &'a Gauge,
    /// The norm that says when a line has gone far enough.
    pub(super) norm: &'static str,
}

impl Field<'_> {
    /// Runs the lines.
    pub(super) fn run(&self, lines: Vec<Line>, tell: &mut dyn FnMut(&str)) -> Found {
        let track = |line| Track { line, next: 0, last: None, growth: 2.0, open: true, cases: Vec::new() };
        let mut tracks: Vec<Track> = lines.into_iter().map(track).collect();
        let (mut grids, mut ended, mut interrupted) = (Vec::new(), Vec::new(), false);
        while let Some(index) = self.cheapest(&tracks) {
            let planned = tracks[index].line.cases[tracks[index].next].clone();
            let line = &tracks[index].line;
            tell(&format!("{} {}", line.name, crate::study::verdict::value_words(line.kind, planned.value)));
            let law = if line.isolated { self.elsewhere.unwrap_or(self.here) } else { self.here };
            // A case that takes longer than was thought does not take what is kept for others.
            let kept_s = if planned.needed { 0.0 } else { self.kept_s(&tracks) };
            let until = 1.0 - kept_s / self.budget.whole_s();
            let how = How { budget: self.budget, until, repeated: true, isolated: line.isolated };
            let begin = self.budget.spent_s();
            let outcome = self.setup.run(law, &planned.overrides, how);
            let spent = self.budget.spent_s() - begin;
            let track = &mut tracks[index];
            let mut case = blank(&track.line, &planned);
            match outcome {
                Outcome::Ran(ran) => {
                    if track.line.name == AT_LIMIT {
                        case.value = ran.record.cost.steps as f64;
                    }
                    if track.line.kind == Kind::Grid {
                        grids.push((index, track.cases.len(), on_grid(&ran)));
                    }
                    self.fill(&mut case, &ran);
                    let one = effort(&ran.timing, track.line.isolated) + ran.timing.limit_s;
                    if let Some((_, before, _)) = track.last {
                        track.growth = one / before.max(1e-9);
                    }
                    track.last = Some((planned.value, one, ran.record.cost.steps as f64));
                    if let Some(why) = self.seen_enough(track, &case) {
                        ended.push(why);
                        track.open = false;
                    }
                }
                Outcome::Refused(reason) => {
                    case.status = Status::Refused(reason);
                    track.open = false;
                }
                Outcome::Failed(reason) => case.status = Status::Failed(reason),
                Outcome::Cut => {
                    let why = if kept_s > 0.0 {
                        "when what was left of the budget was kept for stable explicit runs"
                    } else {
                        "when the budget was spent"
                    };
                    case.status = Status::LeftOut(format!("cut off after {spent:.2} s, {why}"));
                    track.open = false;
                }
                Outcome::Interrupted => {
                    case.status = Status::LeftOut("interrupted".to_owned());
                    track.open = false;
                    interrupted = true;
                }
            }
            track.cases.push(case);
            track.next += 1;
            if interrupted {
                break;
            }
        }
        self.gathered(tracks, grids, ended, interrupted)
    }

    /// What has to be left for all runs of a case to begin, if one is thought to take so long.
    fn room_s(&self, one_s: f64) -> f64 {
        SURPRISE * self.budget.whole_case_s(one_s)
    }

    /// What has to be left for the next case of a line that the verdict needs.
    fn needed_s(&self, tracks: &[Track], track: &Track) -> Option<f64> {
        let ahead = track.line.cases.iter().skip(track.next).position(|case| case.needed);
        let ahead = ahead.filter(|_| track.open)?;
        Some(self.room_s(self.predicted(tracks, track, track.next + ahead)))
    }

    /// Time that is kept for what the verdict needs.
    fn kept_s(&self, tracks: &[Track]) -> f64 {
        let left = self.budget.left_s();
        // Time is kept for what can fit; keeping it for more would run nothing at all.
        let kept = tracks.iter().filter_map(|track| self.needed_s(tracks, track));
        let all: f64 = kept.filter(|one| *one <= left).sum();
        if all > left { 0.0 } else { all }
    }

    /// The line whose next case is the cheapest of those that fit, time being kept for what the verdict needs.
    fn cheapest(&self, tracks: &[Track]) -> Option<usize> {
        let left = self.budget.left_s();
        let all = self.kept_s(tracks);
        let fitting = tracks.iter().enumerate().filter_map(|(index, track)| {
            let case = track.line.cases.get(track.next).filter(|_| track.open)?;
            let one = self.predicted(tracks, track, track.next);
            let for_others = if case.needed { 0.0 } else { all };
            // What the verdict needs, and what leads to it, comes before what costs as much.
            let weight = if self.needed_s(tracks, track).is_some() { FIRST } else { 1.0 };
            (self.room_s(one) <= left - for_others.min(left)).then_some((index, weight * one))
        });
        fitting.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
    }

    /// What a case of a line is thought to take; seconds of one run.
    fn predicted(&self, tracks: &[Track], track: &Track, index: usize) -> f64 {
        let next = &track.line.cases[index];
        let (wall_s, solves) = self.gauge.cheapest;
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

    /// What a run shows.
    fn fill(&self, case: &mut Case, ran: &Ran) {
        case.status = if ran.record.stability.is_unstable { Status::Unstable } else { Status::Done };
        case.timing = Some(ran.timing);
        case.work = Some(Work::from(&ran.record.cost));
        if case.kind != Kind::Grid {
            case.errors = self.gauge.frame.errors(&Fields::of(&ran.record), &self.gauge.fields);
            case.unresolved = unresolved(&case.errors, &self.gauge.yardstick.stated);
        }
    }

    /// Why a line needs not go on.
    fn seen_enough(&self, track: &Track, case: &Case) -> Option<String> {
        if track.line.given || case.status != Status::Done || track.next + 1 >= track.line.cases.len() {
            return None;
        }
        let error = *case.errors.get(self.norm)?;
        let place = crate::study::verdict::value_words(track.line.kind, case.value);
        let why = if case.unresolved.iter().any(|name| name == self.norm) {
            format!("its error of {error:.1e} is below {RESOLVED} times the yardstick's own")
        } else if error < ENOUGH {
            format!("its error of {error:.1e} is below {ENOUGH:e}")
        } else {
            return None;
        };
        Some(format!("{} beyond {place}: {why}", track.line.name))
    }

    /// All cases line by line, with what was left out.
    fn gathered(
        &self,
        tracks: Vec<Track>,
        grids: Vec<(usize, usize, OnGrid)>,
        ended: Vec<String>,
        interrupted: bool,
    ) -> Found {
        let mut found = Found { ended, interrupted, ..Found::default() };
        let left = self.budget.left_s();
        let mut starts = Vec::new();
        let missing: Vec<Option<Case>> =
            tracks.iter().map(|track| self.left_out(&tracks, track, left, interrupted)).collect();
        for (track, missing) in tracks.into_iter().zip(missing) {
            starts.push(found.cases.len());
            found.cases.extend(track.cases);
            found.cases.extend(missing);
        }
        let placed = grids.into_iter().map(|(track, place, grid)| OnGrid { case: starts[track] + place, ..grid });
        found.grids = placed.collect();
        found
    }

    /// The case that stands for what a line still had when the budget was spent.
    fn left_out(&self, tracks: &[Track], track: &Track, left: f64, interrupted: bool) -> Option<Case> {
        let planned = track.line.cases.get(track.next).filter(|_| track.open)?;
        let mut case = blank(&track.line, planned);
        let dearer = track.line.cases.len() - track.next - 1;
        let rest = match dearer {
            0 => String::new(),
            _ if track.line.given => format!("; with it {dearer} dearer ones"),
            _ => "; with it all dearer ones".to_owned(),
        };
        let one = self.predicted(tracks, track, track.next);
        let why = match interrupted {
            true => "interrupted".to_owned(),
            false => format!(
                "thought to take {:.3} s, {left:.3} s of the budget left{}",
                self.budget.whole_case_s(one),
                if planned.needed || left <= one { "" } else { ", some of it kept for stable explicit runs" }
            ),
        };
        case.status = Status::LeftOut(why + &rest);
        Some(case)
    }
}

/// What a case is thought to take after an unstable one, whose chequerboards take more rounds than stable steps do: at
/// most what as many contact solves of the yardstick's cheapest run take.
fn after_unstable(scaled_s: f64, usual_s: f64) -> f64 {
    if usual_s > 0.0 { scaled_s.min(usual_s) } else { scaled_s }
}

/// A case that has not run.
fn blank(line: &Line, planned: &Planned) -> Case {
    Case {
        line: line.name.clone(),
        kind: line.kind,
        method: line.method.to_owned(),
        isolated: line.isolated,
        value: planned.value,
        overrides: planned.overrides.clone(),
        status: Status::Done,
        timing: None,
        work: None,
        errors: Errors::new(),
        unresolved: Vec::new(),
        note: line.note.map(str::to_owned),
    }
}

fn on_grid(ran: &Ran) -> OnGrid {
    OnGrid {
        case: 0,
        fields: Fields::of(&ran.record),
        frame: Frame::of(&ran.scene, &ran.record),
        expected: ran.expected.clone().map(Fields::from),
    }
}

/// Names of the errors that the yardstick does not tell from its own.
fn unresolved(errors: &Errors, stated: &Errors) -> Vec<String> {
    let small = |(name, error): &(&String, &f64)| stated.get(*name).is_some_and(|own| **error < RESOLVED * own);
    errors.iter().filter(small).map(|(name, _)| name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_unstable_steps_cost_does_not_keep_stable_ones_out() {
        assert_eq!(after_unstable(480.0, 30.0), 30.0);
        assert_eq!(after_unstable(2.0, 30.0), 2.0);
        assert_eq!(after_unstable(2.0, 0.0), 2.0, "nothing is known of the yardstick");
    }
}
