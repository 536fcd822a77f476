//! How large the error of a run is likely to be where nothing exact is known, from further runs of the same scene.
//!
//! The steps: what the integrator says of itself, or else the difference to a run in half as many fixed substeps. The grid:
//! the difference to a run on every second cell, at the cells that both have. Both are taken as if errors fell no faster
//! than in proportion to the step and to the cells, so what falls faster is overrated.

use std::time::Instant;

use serde::Serialize;

use super::reference::relative_l2;
use super::{ErrorNorm, SolveError};
use crate::plan::Plan;
use crate::record::{ESTIMATED, End, Estimated, Observer, Record};
use crate::scene::ScalingKind;

/// Order at which errors are taken to fall: below the formulas' own, because of moving edges.
const ORDER: f64 = 0.75;

/// Estimated errors of a run by their causes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Estimate {
    /// Of the steps in time.
    pub steps: Estimated,
    /// Of the grid; nothing where pressure is prescribed.
    pub grid: Estimated,
    /// Both together.
    pub total: Estimated,
    /// What is not in it, and why.
    pub without: Vec<String>,
    /// Wall time that it took; s.
    pub time_s: f64,
}

/// A part of an estimate, or why it is not known.
pub(super) type Part = Result<Estimated, String>;

impl Estimate {
    /// What a run says of itself, without further ones.
    #[must_use]
    pub fn of_steps<E>(record: &Record<E>) -> Estimate {
        let (steps, solved) = (record.estimated, !record.pressure.is_empty());
        let mut estimate = Estimate { steps, ..Estimate::default() };
        if solved {
            estimate.without.push("the error of the grid: `output.error_estimate` does not ask for it".to_owned());
        } else {
            estimate.total = steps;
        }
        estimate
    }

    /// The estimated error of the wear depth, where there is nothing better to compare with: that of steps and grid, or of
    /// the steps alone; `None`: not known.
    #[must_use]
    pub fn norm(&self) -> Option<ErrorNorm> {
        let grid = self.grid != Estimated::default();
        let (known, causes) = match (self.total.wear_l2_relative, grid) {
            (Some(_), true) => (self.total, "steps and grid"),
            _ => (self.steps, "steps in time"),
        };
        let named = [
            ("wear_l2_relative", known.wear_l2_relative),
            ("pressure_l2_relative", known.pressure_l2_relative),
            ("volume_relative", known.volume_relative),
        ];
        Some(ErrorNorm {
            reference: format!("{ESTIMATED}{causes}"),
            norm: "relative L2 error of the wear depth".to_owned(),
            value: known.wear_l2_relative?,
            by_field: named.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?))).collect(),
        })
    }

    /// Puts both parts together; `grid` is `None` where there is none.
    pub(super) fn new(plan: &Plan, begin: Instant, steps: Part, grid: Option<Part>) -> Estimate {
        let mut without = Vec::new();
        let mut known = |part: Part, what: &str| {
            part.unwrap_or_else(|why| {
                without.push(format!("the error of the {what}: {why}"));
                Estimated::default()
            })
        };
        let steps = known(steps, "steps");
        let (grid, total) = match grid {
            None => (Estimated::default(), steps),
            Some(grid) => {
                let grid = known(grid, "grid");
                (grid, steps.plus(grid))
            }
        };
        if plan.material.scaling.kind != ScalingKind::None {
            without.push("what the scaling of wear increments costs".to_owned());
        }
        Estimate { steps, grid, total, without, time_s: begin.elapsed().as_secs_f64() }
    }
}

/// Of two runs of one scene, the finer and the coarser, at the same points; pressure where it is solved.
pub(super) struct Pair<'a> {
    pub(super) wear: [&'a [f64]; 2],
    pub(super) pressure: [&'a [f64]; 2],
    /// Worn volumes, or sums of depths over equal points.
    pub(super) volume: [f64; 2],
}

impl Pair<'_> {
    /// Estimated error of the finer one, whose steps or cells are smaller by `ratio`.
    pub(super) fn estimated(&self, ratio: f64) -> Estimated {
        let spread = (ratio.powf(ORDER) - 1.0).recip();
        let known = |[fine, coarse]: [&[f64]; 2]| {
            let error = spread * relative_l2(coarse, fine);
            (!fine.is_empty() && error.is_finite()).then_some(error)
        };
        let [fine, coarse] = self.volume;
        Estimated {
            wear_l2_relative: known(self.wear),
            pressure_l2_relative: known(self.pressure),
            volume_relative: known([&[fine], &[coarse]]),
        }
    }
}

/// A record of a further run that came as far as the one that it is compared with.
pub(super) fn finished(
    record: Result<Record<SolveError>, SolveError>,
    what: &str,
) -> Result<Record<SolveError>, String> {
    let record = record.map_err(|error| format!("the run {what} failed: {error}"))?;
    match record.end {
        End::Done => Ok(record),
        End::Stopped(reason) => Err(format!("the run {what} ended early: {reason}")),
        End::Interrupted => Err(format!("the run {what} was interrupted")),
        End::Failed(error) => Err(format!("the run {what} failed: {error}")),
    }
}

/// Substeps of the run that one in so many is compared with.
pub(super) fn half(substeps: Option<u64>) -> Result<u64, String> {
    match substeps {
        Some(2..) => Ok(substeps.unwrap_or(2).div_ceil(2)),
        _ => Err("one substep per load step cannot be halved".to_owned()),
    }
}

/// Whether a record covers the whole scene; a run that ended early is compared with nothing.
pub(super) fn covers(record: &Record<SolveError>) -> Result<(), String> {
    match &record.end {
        End::Done => Ok(()),
        End::Stopped(reason) => Err(format!("the run ended early: {reason}")),
        End::Interrupted | End::Failed(_) => Err("the run did not come to its end".to_owned()),
    }
}

/// What observers of further runs are.
pub(super) type Watching<'o> = &'o mut (dyn Observer + Send);
