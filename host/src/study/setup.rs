//! Running the scene once or several times under overrides, with both clocks beside it.

use std::path::Path;
use std::time::Instant;

use super::budget::{Budget, Deadline};
use super::processor;
use crate::law::Evaluator;
use crate::plan::Plan;
use crate::record::{End, Record, Timing};
use crate::scene::{Override, Scene, SceneError};
use crate::solve::{Expected, Run, SolveError};

/// Keys that exclude one another: of a scene's own overrides none stays beside another of its group.
const RIVALS: [&[&str]; 1] = [&["integrator.tolerance", "integrator.substeps"]];

/// What all runs of a study share.
pub(super) struct Setup<'a> {
    /// The scene's file.
    pub(super) file: &'a Path,
    /// What the user changed in it.
    pub(super) own: &'a [Override],
    /// Threads of a run; 0: as many as the machine has.
    pub(super) threads: usize,
    /// Whether to go on.
    pub(super) goes_on: &'a (dyn Fn() -> bool + Sync),
}

/// A case that ran to its end.
pub(super) struct Ran {
    /// The scene with the overrides.
    pub(super) scene: Scene,
    /// What happened.
    pub(super) record: Record<SolveError>,
    /// How long it took.
    pub(super) timing: Timing,
    /// What the scene's reference says; `None` if it says nothing of single points.
    pub(super) expected: Option<Expected>,
}

/// How a case ended.
pub(super) enum Outcome {
    /// At its end.
    Ran(Box<Ran>),
    /// The scene cannot have it.
    Refused(String),
    /// Early, by an error.
    Failed(String),
    /// Early, because its time was over.
    Cut,
    /// Early, because the study was interrupted.
    Interrupted,
}

/// How a case is run.
#[derive(Clone, Copy)]
pub(super) struct How<'b> {
    /// The time of the study.
    pub(super) budget: &'b Budget,
    /// Part of the budget at whose end it is cut off.
    pub(super) until: f64,
    /// Whether it is repeated, as far as the budget allows.
    pub(super) repeated: bool,
    /// Whether the law runs in a process that the clock of the processors does not see.
    pub(super) isolated: bool,
}

/// What a run takes by itself, as far as the clocks tell: on a machine with other work less than its wall time.
pub(super) fn effort(timing: &Timing, isolated: bool) -> f64 {
    if isolated || timing.processor_s.is_nan() { timing.wall_s } else { timing.wall_s.min(timing.processor_s) }
}

impl Setup<'_> {
    /// Runs the scene under overrides with a law.
    pub(super) fn run(&self, law: &dyn Evaluator, overrides: &[String], how: How<'_>) -> Outcome {
        let scene = match self.scene(overrides) {
            Ok(scene) => scene,
            Err(error) => return Outcome::Refused(error.to_string()),
        };
        let plan = match Plan::new(&scene, law.descriptor()) {
            Ok(plan) => plan,
            Err(error) => return Outcome::Refused(error.to_string()),
        };
        let run = match Run::prepare(&plan, law) {
            Ok(run) => run,
            Err(error) => return Outcome::Failed(error.to_string()),
        };
        match self.timed(&run, how) {
            Ok((record, timing)) => match run.expected(&record) {
                Ok(expected) => Outcome::Ran(Box::new(Ran { record, timing, expected, scene })),
                Err(error) => Outcome::Failed(error.to_string()),
            },
            Err(outcome) => outcome,
        }
    }

    /// The scene under overrides, which take the place of the user's own.
    pub(super) fn scene(&self, overrides: &[String]) -> Result<Scene, SceneError> {
        let changed = |text: &Override| overrides.iter().any(|new| replaces(new, &text.0));
        let own = self.own.iter().filter(|text| !changed(text)).cloned();
        let all: Vec<Override> = own.chain(overrides.iter().map(|text| Override::from(text.as_str()))).collect();
        Scene::read(self.file, &all)
    }

    /// Runs it as often as its length allows; the record is that of the first run, whose bits all others share.
    fn timed(&self, run: &Run<'_>, how: How<'_>) -> Result<(Record<SolveError>, Timing), Outcome> {
        let (record, first) = self.once(run, how)?;
        let timed = how.budget.timed_runs(effort(&first, how.isolated)).filter(|_| how.repeated);
        let Some(timed) = timed else { return Ok((record, first)) };
        let mut timing =
            Timing { wall_s: f64::INFINITY, processor_s: f64::INFINITY, warmed_up: true, runs: 0, ..first };
        let mut longest: f64 = 0.0;
        for _ in 0..timed {
            let Ok((_, one)) = self.once(run, how) else { break };
            timing.wall_s = timing.wall_s.min(one.wall_s);
            timing.processor_s = timing.processor_s.min(one.processor_s);
            timing.runs += 1;
            longest = longest.max(one.wall_s);
        }
        if timing.runs == 0 {
            return Ok((record, first));
        }
        timing.wall_spread = longest / timing.wall_s - 1.0;
        Ok((record, timing))
    }

    fn once(&self, run: &Run<'_>, how: How<'_>) -> Result<(Record<SolveError>, Timing), Outcome> {
        let mut deadline = Deadline { at: how.budget.moment(how.until), goes_on: self.goes_on };
        let (begin, processor) = (Instant::now(), processor::seconds());
        let record = run.go(self.threads, &mut deadline);
        let (wall_s, processor_s) = (begin.elapsed().as_secs_f64(), processor::seconds() - processor);
        match record.end {
            End::Done | End::Stopped(_) => {
                let limit_s = record.cost.limit_time_s;
                // In wall seconds it is known; of the processors it has the same part.
                let part = (1.0 - limit_s / wall_s).max(0.0);
                let (wall_s, processor_s) = (part * wall_s, part * processor_s);
                Ok((record, Timing { wall_s, wall_spread: 0.0, processor_s, limit_s, runs: 1, warmed_up: false }))
            }
            End::Interrupted if !(self.goes_on)() => Err(Outcome::Interrupted),
            End::Interrupted => Err(Outcome::Cut),
            End::Failed(error) => Err(Outcome::Failed(error.to_string())),
        }
    }
}

/// Whether an override takes the place of another.
fn replaces(new: &str, old: &str) -> bool {
    let key =
        |text: &str| text.split('=').next().unwrap_or_default().split('.').map(str::trim).collect::<Vec<_>>().join(".");
    let (new, old) = (key(new), key(old));
    new == old || RIVALS.iter().any(|group| group.contains(&new.as_str()) && group.contains(&old.as_str()))
}

#[cfg(test)]
mod tests {
    use super::replaces;

    #[test]
    fn an_override_of_a_case_takes_the_place_of_the_users_own() {
        assert!(replaces("integrator.substeps=4", "integrator . tolerance = 1e-3"));
        assert!(replaces("grid.cells=[4]", "grid.cells=[8]"));
        assert!(!replaces("integrator.method=sdirk2", "integrator.substeps=4"));
    }
}
