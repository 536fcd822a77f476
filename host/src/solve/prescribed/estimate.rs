//! Estimated errors of a run under a prescribed pressure: its quadrature's own, or half as many substeps.

use std::time::Instant;

use super::Prescribed;
use crate::plan::Plan;
use crate::record::{Estimated, Record};
use crate::solve::SolveError;
use crate::solve::estimate::{Estimate, Pair, Part, Watching, covers, finished, half};

impl Prescribed<'_> {
    /// Estimates the errors of a record of this run.
    pub(in crate::solve) fn estimate(&self, record: &Record<SolveError>, observer: Watching<'_>) -> Estimate {
        let begin = Instant::now();
        let steps = match record.estimated.wear_l2_relative {
            Some(_) => Ok(record.estimated),
            None => covers(record).and_then(|()| self.by_substeps(record, observer)),
        };
        Estimate::new(self.plan, begin, steps, None)
    }

    fn by_substeps(&self, record: &Record<SolveError>, observer: Watching<'_>) -> Part {
        let substeps = half(self.plan.substeps)?;
        let mut plan = Plan { substeps: Some(substeps), ..self.plan.clone() };
        plan.output.fields.clear();
        let what = "in half as many substeps";
        let coarse = Prescribed::prepare(&plan, self.evaluator).and_then(|run| run.go(0, observer, None));
        let coarse = finished(coarse, what)?;
        let ratio = self.plan.substeps.unwrap_or(1) as f64 / substeps as f64;
        let volumes = [record, &coarse].map(|record| record.history.last().and_then(|row| row.wear_volume));
        let pair = Pair {
            wear: [&record.wear, &coarse.wear],
            pressure: [&[], &[]],
            volume: volumes.map(|volume| volume.unwrap_or(f64::NAN)),
        };
        let estimated = pair.estimated(ratio);
        let with_volume = volumes.iter().all(Option::is_some);
        Ok(Estimated { volume_relative: estimated.volume_relative.filter(|_| with_volume), ..estimated })
    }
}
