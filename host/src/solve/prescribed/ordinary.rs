//! What the most loaded point of a prescribed scene is under.

use super::Prescribed;
use crate::contact::prescribed::{Column, History};
use crate::plan::{Linear, LoadStep};
use crate::solve::Ordinary;

impl Prescribed<'_> {
    /// Largest pressure of the history or the load steps, with the velocity and the temperature of that point and time.
    pub(in crate::solve) fn ordinary(&self) -> Ordinary {
        let steps = || self.plan.blocks.iter().flat_map(|block| &block.steps);
        let largest = |of: fn(&LoadStep) -> Option<Linear>| {
            steps().filter_map(of).map(|line| line.from.abs().max(line.to.abs())).fold(0.0, f64::max)
        };
        let stepped = Ordinary {
            pressure: largest(|step| step.pressure),
            velocity: largest(|step| step.velocity),
            temperature: steps().find_map(|step| step.temperature).map_or(0.0, |line| line.to),
        };
        let Some(history) = &self.history else { return stepped };
        let (row, point) = most_loaded(history);
        let given = |column| history.column(column).map(|values| values.value(row, point));
        Ordinary {
            pressure: given(Column::Pressure).unwrap_or(stepped.pressure),
            velocity: given(Column::Velocity)
                .map(f64::abs)
                .or_else(|| slid(history, row, point))
                .unwrap_or(stepped.velocity),
            temperature: given(Column::Temperature).unwrap_or(stepped.temperature),
        }
    }
}

/// Row and point of the largest pressure.
fn most_loaded(history: &History) -> (usize, usize) {
    let Some(pressure) = history.column(Column::Pressure) else { return (0, 0) };
    let places = (0..history.times().len()).flat_map(|row| (0..history.points()).map(move |point| (row, point)));
    let largest = places.map(|(row, point)| (pressure.value(row, point), (row, point)));
    largest.fold((f64::NEG_INFINITY, (0, 0)), |most, one| if one.0 > most.0 { one } else { most }).1
}

/// Speed at which a point slips in the stretch of time that begins at a row, or ends there where it is the last.
fn slid(history: &History, row: usize, point: usize) -> Option<f64> {
    let times = history.times();
    let row = row.min(times.len().checked_sub(2)?);
    let duration = times[row + 1] - times[row];
    let paths = [Column::Slip, Column::SlipX, Column::SlipY, Column::SlipZ].map(|column| history.column(column));
    let moved = paths.iter().flatten().map(|path| path.value(row + 1, point) - path.value(row, point));
    let length = moved.map(|one| one * one).sum::<f64>().sqrt();
    (duration > 0.0).then(|| length / duration)
}
