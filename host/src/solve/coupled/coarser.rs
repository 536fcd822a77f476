//! Estimated errors of a run on a contact that answers back: half as many substeps, and every second cell.

use std::time::Instant;

use super::run::Coupled;
use crate::contact::Cells;
use crate::plan::{Plan, SolvedPlan};
use crate::record::Record;
use crate::solve::SolveError;
use crate::solve::estimate::{Estimate, Pair, Part, Watching, covers, finished, half};

/// Cells along a line below which every second one is no grid any more.
const FEWEST: usize = 8;

/// Every second cell of a grid, the one of the apex among them.
struct Halved {
    cells: Cells,
    /// First cell along x and y.
    first: [usize; 2],
    /// Place of the apex on the coarser grid.
    center: [f64; 2],
    /// Cells between two that are kept, along x and y.
    stride: [usize; 2],
}

impl Halved {
    fn of(fine: Cells, center: Option<[f64; 2]>, periodic: bool) -> Result<Halved, String> {
        let mut halved = Halved { cells: fine, first: [0; 2], center: [0.5; 2], stride: [1; 2] };
        for axis in 0..usize::from(fine.dimension - 1) {
            let (count, spacing) = (fine.counts[axis], fine.spacing[axis]);
            if count < FEWEST {
                return Err(format!("{count} cells along a line cannot be halved, expected at least {FEWEST}"));
            }
            if periodic && !count.is_multiple_of(2) {
                return Err(format!("an odd number of cells, {count}, cannot be halved on a periodic grid"));
            }
            let apex = center.map_or((count / 2) as f64, |center| center[axis] / spacing - 0.5);
            let first = (apex.round().max(0.0) as usize) % 2;
            halved.first[axis] = first;
            halved.stride[axis] = 2;
            halved.cells.counts[axis] = (count - first).div_ceil(2);
            halved.cells.spacing[axis] = 2.0 * spacing;
            halved.center[axis] = ((apex - first as f64) / 2.0 + 0.5) * 2.0 * spacing;
        }
        Ok(halved)
    }

    /// The values at the cells that are kept of one for each cell of the finer grid, `across` in a row.
    fn of_field(&self, field: &[f64], across: usize) -> Vec<f64> {
        let rows = field.chunks(across).skip(self.first[1]).step_by(self.stride[1]);
        rows.flat_map(|row| row.iter().skip(self.first[0]).step_by(self.stride[0])).copied().collect()
    }
}

impl Coupled<'_> {
    /// Estimates the errors of a record of this run by further runs.
    pub(in crate::solve) fn estimate(&self, record: &Record<SolveError>, observer: Watching<'_>) -> Estimate {
        let begin = Instant::now();
        let covered = covers(record);
        let part = |known: &mut dyn FnMut() -> Part| covered.clone().and_then(|()| known());
        let steps = match self.plan.tolerance {
            Some(_) => Ok(record.estimated),
            None => part(&mut || self.by_substeps(record, observer)),
        };
        let grid = part(&mut || self.by_cells(record, observer));
        Estimate::new(self.plan, begin, steps, Some(grid))
    }

    fn by_substeps(&self, record: &Record<SolveError>, observer: Watching<'_>) -> Part {
        let substeps = half(self.plan.substeps)?;
        let plan = Plan { substeps: Some(substeps), ..self.further() };
        let coarse = finished(self.with(&plan, self.solved).go(0, observer, None), "in half as many substeps")?;
        let ratio = self.plan.substeps.unwrap_or(1) as f64 / substeps as f64;
        let sum = |wear: &[f64]| wear.iter().sum::<f64>();
        let pair = Pair {
            wear: [&record.wear, &coarse.wear],
            pressure: [&record.pressure, &coarse.pressure],
            volume: [sum(&record.wear), sum(&coarse.wear)],
        };
        Ok(pair.estimated(ratio))
    }

    fn by_cells(&self, record: &Record<SolveError>, observer: Watching<'_>) -> Part {
        let fine = self.solved.cells;
        let halved = Halved::of(fine, self.solved.surface.center, self.solved.is_periodic())?;
        let plan = self.further();
        let mut solved = SolvedPlan { cells: halved.cells, ..self.solved.clone() };
        solved.surface.center = Some(halved.center);
        let kept = |field: &Vec<f64>| halved.of_field(field, fine.counts[0]);
        let coarse = Coupled {
            plan: &plan,
            solved: &solved,
            evaluator: self.evaluator,
            gap: kept(&self.gap),
            velocities: self.velocities.iter().map(kept).collect(),
        };
        let coarse = finished(coarse.go(0, observer, None), "on every second cell")?;
        let volume = |wear: &[f64], cells: Cells| wear.iter().sum::<f64>() * cells.area();
        let (wear, pressure) = (kept(&record.wear), kept(&record.pressure));
        let pair = Pair {
            wear: [&wear, &coarse.wear],
            pressure: [&pressure, &coarse.pressure],
            volume: [volume(&record.wear, fine), volume(&coarse.wear, halved.cells)],
        };
        Ok(pair.estimated(2.0))
    }

    /// The plan of a further run, of which only the end counts.
    fn further(&self) -> Plan {
        let mut plan = self.plan.clone();
        plan.output.fields.clear();
        plan
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(counts: [usize; 2]) -> Cells {
        Cells {
            dimension: if counts[1] == 1 { 2 } else { 3 },
            counts,
            spacing: [0.25, if counts[1] == 1 { 1.0 } else { 0.5 }],
        }
    }

    #[test]
    fn the_cell_of_the_apex_is_kept_and_stays_the_apex() {
        for counts in [[8, 8], [9, 10], [14, 11], [15, 1], [16, 1]] {
            let fine = cells(counts);
            let halved = Halved::of(fine, None, false).unwrap();
            let index = |k: usize| k % counts[0] == counts[0] / 2 && k / counts[0] == counts[1] / 2;
            let field: Vec<f64> = (0..fine.count()).map(|k| f64::from(u8::from(index(k)))).collect();
            let kept = halved.of_field(&field, counts[0]);
            let at = kept.iter().position(|one| *one == 1.0).expect("the apex");
            assert_eq!(kept.len(), halved.cells.count());
            let [across, _] = halved.cells.counts;
            let place = |index: usize, axis: usize| (index as f64 + 0.5) * halved.cells.spacing[axis];
            assert_eq!(place(at % across, 0), halved.center[0], "{counts:?}");
            assert!(counts[1] == 1 || place(at / across, 1) == halved.center[1], "{counts:?}");
        }
    }

    #[test]
    fn grids_that_cannot_be_halved_are_refused() {
        let few = Halved::of(cells([7, 1]), None, false).err().unwrap();
        assert!(few.contains("7 cells") && few.contains("at least 8"), "{few}");
        let odd = Halved::of(cells([9, 8]), None, true).err().unwrap();
        assert!(odd.contains("9") && odd.contains("periodic"), "{odd}");
        assert!(Halved::of(cells([9, 8]), None, false).is_ok());
    }
}
