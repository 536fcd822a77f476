//! How far a run on a contact that answers back is from what it should be.

use super::run::Coupled;
use crate::plan::ReferencePlan;
use crate::record::{End, Nobody, Record};
use crate::solve::reference::{compare, from_file, relative_l2};
use crate::solve::{ErrorNorm, ReferenceError, SolveError};

/// How much tighter the tolerance of a refined run is.
const REFINEMENT: f64 = 1.0 / 32.0;
/// How many more fixed substeps a refined run takes.
const MORE_SUBSTEPS: u64 = 16;

/// What a run should have come to.
struct Expected {
    wear: Vec<f64>,
    pressure: Option<Vec<f64>>,
    name: String,
}

impl Coupled<'_> {
    /// Checks, before anything is computed, that the reference which the plan names can be had.
    pub(in crate::solve) fn check_reference(&self) -> Result<(), SolveError> {
        match &self.plan.reference {
            None | Some(ReferencePlan::Refined) => {}
            Some(ReferencePlan::File(path)) => drop(from_file(path, self.ids())?),
            Some(ReferencePlan::Exact(named)) => {
                let reason = "it is for another contact model";
                return Err(ReferenceError::NotCovered { kind: named.name(), reason: reason.to_owned() }.into());
            }
        }
        Ok(())
    }

    fn ids(&self) -> std::ops::Range<i64> {
        0..self.points() as i64
    }

    /// Compares a record with the reference that the plan names; `None` if it names none.
    pub(in crate::solve) fn error(&self, record: &Record<SolveError>) -> Result<Option<ErrorNorm>, SolveError> {
        let Some(wanted) = &self.plan.reference else { return Ok(None) };
        let expected = match wanted {
            ReferencePlan::File(path) => {
                Expected { wear: from_file(path, self.ids())?, pressure: None, name: path.display().to_string() }
            }
            ReferencePlan::Refined => self.refined(record)?,
            ReferencePlan::Exact(named) => {
                let reason = "it is for another contact model".to_owned();
                return Err(ReferenceError::NotCovered { kind: named.name(), reason }.into());
            }
        };
        let mut error = compare(&record.wear, &expected.wear, &expected.name);
        let area = self.solved.cells.area();
        let volume = |wear: &[f64]| wear.iter().sum::<f64>() * area;
        let mut also = |name: &str, value: f64| error.by_field.insert(name.to_owned(), value);
        also("volume_relative", relative(volume(&record.wear), volume(&expected.wear)));
        if let Some(pressure) = &expected.pressure {
            also("pressure_l2_relative", relative_l2(&record.pressure, pressure));
        }
        Ok(Some(error))
    }

    /// The same scene in many more steps, and to a tighter contact tolerance.
    fn refined(&self, record: &Record<SolveError>) -> Result<Expected, SolveError> {
        let mut plan = self.plan.clone();
        let mut solved = self.solved.clone();
        plan.output.fields.clear();
        plan.substeps = plan.substeps.map(|substeps| substeps.saturating_mul(MORE_SUBSTEPS));
        plan.tolerance = plan.tolerance.map(|tolerance| tolerance * REFINEMENT);
        solved.contact_tolerance = (0.1 * solved.contact_tolerance).max(1e-12);
        let finer = Coupled::prepare(&plan, &solved, self.evaluator)?.go(0, &mut Nobody, None)?;
        match finer.end {
            End::Failed(error) => Err(error),
            _ => Ok(Expected {
                wear: finer.wear,
                pressure: (!record.pressure.is_empty()).then_some(finer.pressure),
                name: "the same scene in many more steps".to_owned(),
            }),
        }
    }
}

fn relative(found: f64, expected: f64) -> f64 {
    if found == expected { 0.0 } else { (found - expected).abs() / expected.abs() }
}
