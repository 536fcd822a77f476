//! Which check comes next, and which are blocked: each waits for the checks that it needs.

use std::collections::BTreeMap;

use super::check::Check;
use super::needs::{FAULTS, needs, runs_alone};
use super::outcome::Outcome;

/// A check of a law (by its index), or of the library as a whole.
pub(super) type Item = (Option<usize>, Check);

/// Checks that one worker does together.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unit {
    /// Index of the law; none: the library as a whole.
    pub(super) law: Option<usize>,
    pub(super) checks: Vec<Check>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Waiting,
    Running,
    Done,
}

/// What to do now.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Next {
    /// Run this unit.
    Run(usize),
    /// These are blocked by the check beside them; ask again.
    Blocked(Vec<(Item, Check)>),
    /// Wait for a unit that runs.
    Wait,
    /// Everything is done.
    Finished,
}

/// The units of a run, what is done, and what is not worth doing.
pub(super) struct Schedule {
    units: Vec<(Unit, State)>,
    /// What stands in the way of others, by the check that failed: itself, or the one that it was blocked by.
    failed: BTreeMap<Item, Check>,
}

impl Schedule {
    /// A schedule of items; `failed` have been done before and stand in the way of others.
    pub(super) fn new(items: &[Item], failed: &[(Item, Check)]) -> Self {
        let mut units: Vec<Unit> = Vec::new();
        for (law, check) in items.iter().copied() {
            let together = |unit: &&mut Unit| unit.law == law && FAULTS.contains(&unit.checks[0]);
            match units.iter_mut().find(together).filter(|_| FAULTS.contains(&check)) {
                Some(unit) => unit.checks.push(check),
                None => units.push(Unit { law, checks: vec![check] }),
            }
        }
        // What much depends on comes first, and what measures time last.
        let weight = |unit: &Unit| {
            let dependants = items.iter().filter(|(_, check)| needs(*check).contains(&unit.checks[0])).count();
            (runs_alone(unit.checks[0]), std::cmp::Reverse(dependants))
        };
        units.sort_by_key(weight);
        Self {
            units: units.into_iter().map(|unit| (unit, State::Waiting)).collect(),
            failed: failed.iter().copied().collect(),
        }
    }

    /// The unit of that number.
    pub(super) fn unit(&self, index: usize) -> &Unit {
        &self.units[index].0
    }

    /// The check that stands in the way of one, if any; what a library does depends on every law in it.
    fn obstacle(&self, law: Option<usize>, check: Check) -> Option<Check> {
        let needed = needs(check);
        let matters = |item: &Item| needed.contains(&item.1) && related(law, item.0);
        self.failed.iter().find(|(item, _)| matters(item)).map(|(_, by)| *by)
    }

    /// True if everything that a unit needs and that is to be done is done.
    fn is_ready(&self, unit: &Unit) -> bool {
        let needed: Vec<Check> = unit.checks.iter().flat_map(|check| needs(*check)).collect();
        self.units.iter().all(|(other, state)| {
            let matters = related(unit.law, other.law) && other != unit;
            let matters = matters && other.checks.iter().any(|check| needed.contains(check));
            !matters || *state == State::Done
        })
    }

    /// What to do now; a unit that is to be run counts as running from here on.
    pub(super) fn next(&mut self) -> Next {
        let mut blocked = Vec::new();
        for at in 0..self.units.len() {
            if self.units[at].1 != State::Waiting {
                continue;
            }
            let unit = self.units[at].0.clone();
            if let Some(obstacle) = unit.checks.iter().find_map(|check| self.obstacle(unit.law, *check)) {
                self.units[at].1 = State::Done;
                for check in unit.checks {
                    self.failed.insert((unit.law, check), obstacle);
                    blocked.push(((unit.law, check), obstacle));
                }
            }
        }
        if !blocked.is_empty() {
            return Next::Blocked(blocked);
        }
        let running = self.units.iter().filter(|(_, state)| *state == State::Running).count();
        let waiting = |at: &usize| self.units[*at].1 == State::Waiting && self.is_ready(&self.units[*at].0);
        let ready: Vec<usize> = (0..self.units.len()).filter(waiting).collect();
        let alone = |at: &usize| runs_alone(self.units[*at].0.checks[0]);
        let others_left = self.units.iter().any(|(unit, state)| *state != State::Done && !runs_alone(unit.checks[0]));
        let pick =
            ready.iter().find(|at| !alone(at)).or_else(|| ready.first().filter(|_| running == 0 && !others_left));
        match pick {
            Some(at) => {
                self.units[*at].1 = State::Running;
                Next::Run(*at)
            }
            None if self.units.iter().all(|(_, state)| *state == State::Done) => Next::Finished,
            None => Next::Wait,
        }
    }

    /// Notes what a unit came to; `blocks` tells whether a failure stands in the way of others.
    pub(super) fn finish(&mut self, unit: usize, outcomes: &[(Check, Outcome)], blocks: bool) {
        self.units[unit].1 = State::Done;
        let law = self.units[unit].0.law;
        for (check, outcome) in outcomes {
            match outcome {
                Outcome::Blocked(by) if blocks => {
                    self.failed.insert((law, *check), *by);
                }
                outcome if outcome.falls_short() && blocks => {
                    self.failed.insert((law, *check), *check);
                }
                _ => {}
            }
        }
    }
}

/// True if what holds for one matters for the other: they belong to one law, or one of them to the whole library.
fn related(one: Option<usize>, other: Option<usize>) -> bool {
    one.is_none() || other.is_none() || one == other
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Finding;

    fn items(checks: &[Check]) -> Vec<Item> {
        checks.iter().map(|check| (None, *check)).collect()
    }

    fn fail() -> Outcome {
        Outcome::Fail(Finding::new("no"))
    }

    #[test]
    fn a_check_waits_for_what_it_needs_and_is_blocked_by_its_failure() {
        let checks = [Check::MemoryOutputs, Check::MemoryAfter, Check::DeterminismRepeat, Check::LoadSilent];
        let mut schedule = Schedule::new(&items(&checks), &[]);
        let Next::Run(first) = schedule.next() else { panic!("something can run") };
        assert_eq!(schedule.unit(first).checks, [Check::MemoryOutputs]);
        let Next::Run(silent) = schedule.next() else { panic!("one needs nothing of these") };
        assert_eq!(schedule.unit(silent).checks, [Check::LoadSilent]);
        assert_eq!(schedule.next(), Next::Wait);
        schedule.finish(first, &[(Check::MemoryOutputs, fail())], true);
        let Next::Blocked(blocked) = schedule.next() else { panic!("the rest is blocked") };
        assert_eq!(blocked.len(), 2);
        assert!(blocked.iter().all(|(_, by)| *by == Check::MemoryOutputs), "{blocked:?}");
        schedule.finish(silent, &[(Check::LoadSilent, Outcome::Pass(None))], true);
        assert_eq!(schedule.next(), Next::Finished);
    }

    #[test]
    fn a_failure_that_does_not_block_lets_the_others_run() {
        let checks = [Check::FaultsHang, Check::FaultsExit, Check::ValuesFinite];
        let mut schedule = Schedule::new(&items(&checks), &[]);
        let Next::Run(faults) = schedule.next() else { panic!("the faults come first") };
        assert_eq!(schedule.unit(faults).checks.len(), 2, "one run judges them all");
        let hang = Outcome::TimedOut(Finding::new("no"));
        let outcomes = [(Check::FaultsHang, hang), (Check::FaultsExit, Outcome::Blocked(Check::FaultsHang))];
        schedule.finish(faults, &outcomes, false);
        assert!(matches!(schedule.next(), Next::Run(_)));
    }

    #[test]
    fn what_measures_time_runs_last_and_alone() {
        let checks = [Check::CostPerPoint, Check::CostSubnormals, Check::LoadSilent];
        let mut schedule = Schedule::new(&items(&checks), &[]);
        let Next::Run(first) = schedule.next() else { panic!() };
        assert_eq!(schedule.unit(first).checks, [Check::LoadSilent]);
        assert_eq!(schedule.next(), Next::Wait);
        schedule.finish(first, &[(Check::LoadSilent, Outcome::Pass(None))], true);
        let Next::Run(second) = schedule.next() else { panic!() };
        assert_eq!(schedule.next(), Next::Wait);
        let check = schedule.unit(second).checks[0];
        schedule.finish(second, &[(check, Outcome::Pass(None))], true);
        assert!(matches!(schedule.next(), Next::Run(_)));
    }

    #[test]
    fn what_failed_before_blocks_every_law() {
        let items = [(Some(0), Check::ValuesFinite), (Some(1), Check::ValuesFinite)];
        let mut schedule = Schedule::new(&items, &[((None, Check::LoadOpens), Check::LoadSymbols)]);
        let Next::Blocked(blocked) = schedule.next() else { panic!() };
        assert_eq!(blocked.len(), 2);
        assert!(blocked.iter().all(|(_, by)| *by == Check::LoadSymbols));
    }
}
