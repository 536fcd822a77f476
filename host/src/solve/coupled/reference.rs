//! How far a run on a contact that answers back is from what it should be.

use std::path::Path;

use super::exact::{Answer, Asked, Published};
use super::run::Coupled;
use crate::plan::ReferencePlan;
use crate::record::{End, Observer, Record};
use crate::reference::NamedReference;
use crate::scene::ScalingKind;
use crate::solve::reference::{compare, from_file, relative_l2};
use crate::solve::{ErrorNorm, Expected, ReferenceError, SolveError};

/// How much tighter the tolerance of a refined run is.
const REFINEMENT: f64 = 1.0 / 32.0;
/// How many more fixed substeps a refined run takes.
const MORE_SUBSTEPS: u64 = 16;
/// Most cells times substeps of an unscaled run that a scaled one is compared with: about ten seconds of a linear law on a
/// half-space.
const MOST_UNSCALED: f64 = 1e8;

/// What a run should have come to.
struct Wanted {
    answer: Answer,
    name: String,
    /// Whether its pressure counts.
    pressed: bool,
}

impl Coupled<'_> {
    /// Checks, before anything is computed, that the reference which the plan names can be had.
    pub(in crate::solve) fn check_reference(&self) -> Result<(), SolveError> {
        match &self.plan.reference {
            None | Some(ReferencePlan::Refined) => {}
            Some(ReferencePlan::File(path)) => drop(from_file(path, self.ids())?),
            Some(ReferencePlan::Exact(named)) => {
                self.ask(*named).map_err(|reason| not_covered(*named, reason))?;
            }
        }
        Ok(())
    }

    fn ids(&self) -> std::ops::Range<i64> {
        0..self.points() as i64
    }

    /// Compares a record with the reference that the plan names; `None` if it names none.
    pub(in crate::solve) fn error(
        &self,
        record: &Record<SolveError>,
        observer: &mut (dyn Observer + Send),
    ) -> Result<Option<ErrorNorm>, SolveError> {
        let Some(wanted) = &self.plan.reference else { return Ok(None) };
        let wanted = match wanted {
            ReferencePlan::Refined => self.refined(record, observer)?,
            ReferencePlan::File(path) => self.on_file(path)?,
            ReferencePlan::Exact(named) => match self.exactly(*named, record)? {
                Ok(wanted) => wanted,
                Err(depths) => return Ok(Some(published(record, &depths, named.name()))),
            },
        };
        Ok(Some(self.norms(record, &wanted)))
    }

    /// What the reference that the plan names says of the cells; `None` if it names none or says nothing of single cells.
    pub(in crate::solve) fn expected(&self, record: &Record<SolveError>) -> Result<Option<Expected>, SolveError> {
        let wanted = match &self.plan.reference {
            None | Some(ReferencePlan::Refined) => return Ok(None),
            Some(ReferencePlan::File(path)) => self.on_file(path)?,
            Some(ReferencePlan::Exact(named)) => match self.exactly(*named, record)? {
                Ok(wanted) => wanted,
                Err(_) => return Ok(None),
            },
        };
        let Answer { wear, pressure, volume, .. } = wanted.answer;
        Ok(Some(Expected { reference: wanted.name, wear, pressure, volume }))
    }

    fn on_file(&self, path: &Path) -> Result<Wanted, SolveError> {
        let answer = Answer { wear: from_file(path, self.ids())?, ..Answer::default() };
        Ok(Wanted { answer, name: path.display().to_string(), pressed: false })
    }

    /// What an exact answer says of the cells, or what was published of the deepest.
    fn exactly(
        &self,
        named: NamedReference,
        record: &Record<SolveError>,
    ) -> Result<Result<Wanted, Published>, SolveError> {
        let refuse = |reason| not_covered(named, reason);
        let asked = self.ask(named).map_err(refuse)?;
        let last = record.history.last();
        if matches!(asked, Asked::Published) {
            return Ok(Err(self.published(last.map_or(0.0, |row| row.cycle)).map_err(refuse)?));
        }
        let answer = self.answer(&asked, last.map_or(0.0, |row| row.time)).map_err(refuse)?;
        Ok(Ok(Wanted { answer, name: named.name().to_owned(), pressed: true }))
    }

    /// All norms of the difference between a record and an answer on the cells.
    fn norms(&self, record: &Record<SolveError>, Wanted { answer, name, pressed }: &Wanted) -> ErrorNorm {
        let cells = self.solved.cells;
        let mut error = compare(&record.wear, &answer.wear, name);
        let mut also = |name: &str, value: f64| error.by_field.insert(name.to_owned(), value);
        let volume = |wear: &[f64]| wear.iter().sum::<f64>() * cells.area();
        also("volume_relative", relative(volume(&record.wear), answer.volume.unwrap_or_else(|| volume(&answer.wear))));
        if !pressed || record.pressure.is_empty() {
            return error;
        }
        let pressure = relative_l2(&record.pressure, &answer.pressure);
        also("pressure_l2_relative", pressure);
        if let Some(center) = answer.center {
            also("centre_depth_relative", relative(record.wear[center], answer.wear[center]));
            also("centre_pressure_relative", relative(record.pressure[center], answer.pressure[center]));
        }
        if let Some(radius) = answer.contact_radius {
            let area = record.pressure.iter().filter(|pressure| **pressure > 0.0).count() as f64 * cells.area();
            let found = if cells.dimension == 2 { area / 2.0 } else { (area / std::f64::consts::PI).sqrt() };
            also("contact_radius_cells", (found - radius).abs() / cells.spacing[0]);
        }
        if let (Some(load), Some(found)) = (answer.load, record.history.last().and_then(|row| row.load)) {
            also("load_relative", relative(found, load));
        }
        if answer.wear.iter().all(|depth| *depth == 0.0) {
            // Nothing is worn away, so the contact is what the answer is about.
            error.value = pressure;
            error.norm = "relative L2 error of the contact pressure".to_owned();
        }
        error
    }

    /// The same scene in many more steps, to a tighter contact tolerance, and without scaling where that can be paid for.
    fn refined(&self, record: &Record<SolveError>, observer: &mut (dyn Observer + Send)) -> Result<Wanted, SolveError> {
        let mut plan = self.plan.clone();
        let mut solved = self.solved.clone();
        plan.output.fields.clear();
        let scaled = plan.material.scaling.kind != ScalingKind::None;
        let finer = if scaled { self.affordable(record) } else { Some(MORE_SUBSTEPS) };
        if finer.is_some() {
            plan.material.scaling.kind = ScalingKind::None;
        }
        plan.substeps = plan.substeps.map(|substeps| substeps.saturating_mul(finer.unwrap_or(MORE_SUBSTEPS)));
        plan.tolerance = plan.tolerance.map(|tolerance| tolerance * REFINEMENT);
        solved.contact_tolerance = (0.1 * solved.contact_tolerance).max(1e-12);
        let name = match (scaled, finer, plan.tolerance) {
            (false, ..) => "the same scene in many more steps".to_owned(),
            (true, Some(_), Some(_)) => "the same scene without scaling, to a tighter tolerance".to_owned(),
            (true, Some(1), None) => "the same scene without scaling, in the same substeps".to_owned(),
            (true, Some(finer), None) => format!("the same scene without scaling, in {finer} times as many substeps"),
            (true, None, _) => {
                "the same scene in many more steps, scaled alike: the error of the scaling is not in it".to_owned()
            }
        };
        let finer = Coupled::prepare(&plan, &solved, self.evaluator)?.go(0, observer, None)?;
        match finer.end {
            End::Failed(error) => Err(error),
            End::Interrupted => Err(SolveError::Interrupted),
            _ => Ok(Wanted {
                answer: Answer { wear: finer.wear, pressure: finer.pressure, ..Answer::default() },
                name,
                pressed: true,
            }),
        }
    }

    /// How many times as many substeps an unscaled run may take, from what a scaled one came to; `None`: not even as many.
    /// A run to a tolerance is counted with as many more as its own tighter one takes.
    fn affordable(&self, record: &Record<SolveError>) -> Option<u64> {
        let last = record.history.last()?;
        let stretched = if last.simulated_time > 0.0 { last.time / last.simulated_time } else { 1.0 };
        let tried = (record.cost.steps + record.cost.rejected_steps) as f64;
        let unscaled = stretched * tried * self.points() as f64;
        let fits = |times: &u64| unscaled * *times as f64 <= MOST_UNSCALED;
        match self.plan.tolerance {
            Some(_) => Some(MORE_SUBSTEPS).filter(fits),
            None => [16, 8, 4, 2, 1].into_iter().find(fits),
        }
    }
}

fn relative(found: f64, expected: f64) -> f64 {
    if found == expected { 0.0 } else { (found - expected).abs() / expected.abs() }
}

/// The largest depth of the wearing body against what was published.
fn published(record: &Record<SolveError>, published: &Published, name: &str) -> ErrorNorm {
    let deepest = published.share * record.wear.iter().fold(0.0, |most: f64, depth| most.max(*depth));
    let computed = relative(deepest, published.computed);
    let mut by_field = std::collections::BTreeMap::from([("computed_depth_relative".to_owned(), computed)]);
    if let Some(measured) = published.measured {
        by_field.insert("measured_depth_relative".to_owned(), relative(deepest, measured));
    }
    ErrorNorm {
        reference: name.to_owned(),
        norm: "relative error of the largest wear depth of the wearing body, computed by finite elements".to_owned(),
        value: computed,
        by_field,
    }
}

fn not_covered(named: NamedReference, reason: String) -> SolveError {
    ReferenceError::NotCovered { kind: named.name(), reason }.into()
}
