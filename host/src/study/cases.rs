//! The cases of a study, run from cheap to dear as far as the budget goes.

use super::budget::Budget;
use super::frame::{Fields, Frame};
use super::lines::{AT_LIMIT, Line, Planned};
use super::pick::{Pick, Track};
use super::setup::{How, Outcome, Ran, Setup, effort};
use super::yardstick::Gauge;
use crate::law::Evaluator;
use crate::record::{Case, Errors, Kind, Status, Work};

/// Errors below so many times the yardstick's own say no more than that they are small.
pub(super) const RESOLVED: f64 = 3.0;
/// A line that nobody gave values for ends below this error: two decades below what the verdict speaks of.
const ENOUGH: f64 = 1e-6;
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
        let mut tracks: Vec<Track> = lines.into_iter().map(Track::new).collect();
        let (mut grids, mut ended, mut interrupted) = (Vec::new(), Vec::new(), false);
        while let Some(index) = self.pick().next(&tracks) {
            let planned = tracks[index].line.cases[tracks[index].next].clone();
            let line = &tracks[index].line;
            tell(&format!("{} {}", line.name, crate::study::verdict::value_words(line.kind, planned.value)));
            let law = if line.isolated { self.elsewhere.unwrap_or(self.here) } else { self.here };
            // A case that takes longer than was thought does not take what is kept for others.
            let kept_s = if planned.needed { 0.0 } else { self.pick().kept_s(&tracks) };
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

    fn pick(&self) -> Pick<'_> {
        Pick { budget: self.budget, left_s: self.budget.left_s(), cheapest: self.gauge.cheapest }
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
            1 if track.line.given => "; with it a dearer one".to_owned(),
            _ if track.line.given => format!("; with it {dearer} dearer ones"),
            _ => "; with it all dearer ones".to_owned(),
        };
        let pick = self.pick();
        let one = pick.predicted(tracks, track, track.next);
        let kept = !planned.needed && left > one && pick.kept_s(tracks) > 0.0;
        let why = match interrupted {
            true => "interrupted".to_owned(),
            false => format!(
                "thought to take {:.3} s, {left:.3} s of the budget left{}",
                self.budget.whole_case_s(one),
                if kept { ", some of it kept for stable explicit runs" } else { "" }
            ),
        };
        case.status = Status::LeftOut(why + &rest);
        Some(case)
    }
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
