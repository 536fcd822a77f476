//! One run: prepared, then gone through.

use std::collections::BTreeMap;

use super::coupled::Coupled;
use super::odd::oddities;
use super::prescribed::Prescribed;
use super::{ErrorNorm, Estimate, Expected, Ladder, Ordinary, SolveError};
use crate::law::Evaluator;
use crate::plan::{Plan, Skipped};
use crate::record::{Checkpoint, Geometry, MemoryLine, Observer, Record};
use crate::scene::Scene;

/// A plan with its files read, ready to go.
pub struct Run<'p> {
    kind: Kind<'p>,
}

enum Kind<'p> {
    Prescribed(Box<Prescribed<'p>>),
    Coupled(Box<Coupled<'p>>),
}

impl<'p> Run<'p> {
    /// Reads the history or makes the surface of a plan.
    ///
    /// # Errors
    /// A history that cannot be read or does not cover the loading, a surface that cannot be made.
    pub fn prepare(plan: &'p Plan, evaluator: &'p dyn Evaluator) -> Result<Run<'p>, SolveError> {
        let kind = match &plan.solved {
            None => Kind::Prescribed(Box::new(Prescribed::prepare(plan, evaluator)?)),
            Some(solved) => Kind::Coupled(Box::new(Coupled::prepare(plan, solved, evaluator)?)),
        };
        Ok(Run { kind })
    }

    /// What about a run that went to its end its user should look at, a line each: no wear at all, a depth beyond the body,
    /// rows of the history that no load step reaches.
    pub fn oddities<E>(&self, scene: &Scene, plan: &Plan, record: &Record<E>) -> Vec<String> {
        let history = match &self.kind {
            Kind::Prescribed(run) => run.history(),
            Kind::Coupled(_) => None,
        };
        oddities(scene, plan, history, record)
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        match &self.kind {
            Kind::Prescribed(run) => run.points(),
            Kind::Coupled(run) => run.points(),
        }
    }

    /// Where the points lie.
    pub fn geometry(&self) -> Geometry<'static> {
        match &self.kind {
            Kind::Prescribed(run) => run.geometry(),
            Kind::Coupled(run) => run.geometry(),
        }
    }

    /// What the run leaves out, and why: what its plan does, and what its surface lets it.
    pub fn skipped(&self) -> Vec<Skipped> {
        match &self.kind {
            Kind::Prescribed(run) => run.plan.skipped.clone(),
            Kind::Coupled(run) => run.skipped(),
        }
    }

    /// The memory that the run takes for its points, a line for each array.
    pub fn memory(&self) -> Vec<MemoryLine> {
        match &self.kind {
            Kind::Prescribed(run) => run.memory(),
            Kind::Coupled(run) => run.memory(),
        }
    }

    /// Number of pieces of loading that the run goes through; steps are at least as many.
    ///
    /// # Errors
    /// A history that does not cover the loading.
    pub fn pieces_planned(&self) -> Result<u64, SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.pieces_planned(),
            Kind::Coupled(run) => Ok(run.segments_planned()),
        }
    }

    /// Points times the fewest evaluations of the law at each of them; `None`: it depends on the contact.
    ///
    /// # Errors
    /// A history that does not cover the loading.
    pub fn least_evaluations(&self) -> Result<Option<u64>, SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.least_evaluations().map(Some),
            Kind::Coupled(_) => Ok(None),
        }
    }

    /// Goes through the plan on at most `threads` threads (0: as many as the machine has).
    ///
    /// However the run ends, the record holds what was done.
    pub fn go(&self, threads: usize, observer: &mut (dyn Observer + Send)) -> Record<SolveError> {
        match self.go_from(threads, observer, None) {
            Ok(record) => record,
            // Only a checkpoint is refused, and there is none.
            Err(error) => unreachable!("a run from its start was refused: {error}"),
        }
    }

    /// Goes on from a checkpoint as [`Run::go`] goes from the start, with the same bits as a run that was never stopped.
    ///
    /// Whether the checkpoint is of a run of this scene is for [`crate::record::Identity::follows`] to say.
    ///
    /// # Errors
    /// A checkpoint that lacks what this plan needs, or has it in another size; nothing has been done then.
    pub fn resume(
        &self,
        threads: usize,
        observer: &mut (dyn Observer + Send),
        from: &Checkpoint<'_>,
    ) -> Result<Record<SolveError>, SolveError> {
        self.go_from(threads, observer, Some(from))
    }

    fn go_from(
        &self,
        threads: usize,
        observer: &mut (dyn Observer + Send),
        from: Option<&Checkpoint<'_>>,
    ) -> Result<Record<SolveError>, SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.go(threads, observer, from),
            Kind::Coupled(run) => run.go(threads, observer, from),
        }
    }

    /// SHA-256 of what stands behind the names of files in the scene, by what it is: a history, a surface, velocities, and
    /// the constants, which a deck may give.
    ///
    /// # Errors
    /// A history that cannot be read again.
    pub fn contents(&self) -> Result<BTreeMap<String, String>, SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.contents(),
            Kind::Coupled(run) => Ok(run.contents()),
        }
    }

    /// What every integrator does in steps of many lengths, from the state at a represented time on. `None`: the pressure is
    /// prescribed and nothing has a stability limit.
    ///
    /// `goes_on` is asked between trials.
    ///
    /// # Errors
    /// A time outside the loading, or at which nothing touches; whatever ends the run before that time; an interruption.
    pub fn ladder(&self, at: f64, goes_on: &(dyn Fn() -> bool + Sync)) -> Result<Option<Ladder>, SolveError> {
        match &self.kind {
            Kind::Prescribed(_) => Ok(None),
            Kind::Coupled(run) => run.ladder(at, goes_on)?.map(Some).ok_or(SolveError::Interrupted),
        }
    }

    /// What the most loaded point is under, where pressure is prescribed; `None` where contact is solved.
    pub fn ordinary(&self) -> Option<Ordinary> {
        match &self.kind {
            Kind::Prescribed(run) => Some(run.ordinary()),
            Kind::Coupled(_) => None,
        }
    }

    /// Checks, before anything is computed, that the reference which the plan names can be had.
    ///
    /// # Errors
    /// A reference that does not cover the scene, or a file that cannot be read or lacks a point.
    pub fn check_reference(&self) -> Result<(), SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.check_reference(),
            Kind::Coupled(run) => run.check_reference(),
        }
    }

    /// Estimates the errors of a record, by further runs where the record does not say them; `observer` hears of their steps
    /// and can end them, which leaves their part out.
    pub fn estimate(&self, record: &Record<SolveError>, observer: &mut (dyn Observer + Send)) -> Estimate {
        match &self.kind {
            Kind::Prescribed(run) => run.estimate(record, observer),
            Kind::Coupled(run) => run.estimate(record, observer),
        }
    }

    /// What the reference that the plan names says of the points at the time that a record has reached; `None` if it names
    /// none, or one that says nothing of single points (a refined run, published depths).
    ///
    /// # Errors
    /// A reference that does not cover the scene, or cannot be read or computed.
    pub fn expected(&self, record: &Record<SolveError>) -> Result<Option<Expected>, SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.expected(record),
            Kind::Coupled(run) => run.expected(record),
        }
    }

    /// Compares a record with the reference that the plan names; `None` if it names none.
    ///
    /// A refined run can take many times as long as the run itself; `observer` hears of its steps and can end it.
    ///
    /// # Errors
    /// A reference that does not cover the scene, or cannot be read or computed; an interruption.
    pub fn error(
        &self,
        record: &Record<SolveError>,
        observer: &mut (dyn Observer + Send),
    ) -> Result<Option<ErrorNorm>, SolveError> {
        match &self.kind {
            Kind::Prescribed(run) => run.error(record, observer),
            Kind::Coupled(run) => run.error(record, observer),
        }
    }
}
