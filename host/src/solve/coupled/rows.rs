//! What is told of a step: quantities, fields, and whether the grid is large enough.

use super::segment::Segment;
use super::stepper::Stepper;
use super::system::System;
use crate::plan::{Elastic, FieldKind};
use crate::record::{self, Field, FieldData, HistoryRow, Snapshot};
use crate::solve::SolveError;

/// Where a run is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Clock {
    /// Simulated time.
    pub(super) simulated: f64,
    /// Represented time.
    pub(super) represented: f64,
    /// Represented cycles, whole and part.
    pub(super) cycles: f64,
    /// Temperature at that time.
    pub(super) temperature: f64,
}

/// The row of a moment; `dt` is represented.
pub(super) fn row(system: &System<'_>, wear: &[f64], clock: &Clock, dt: f64, scale: f64) -> HistoryRow {
    let area = system.cells().area();
    let touching = system.pressure.iter().filter(|pressure| **pressure > 0.0).count();
    let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(*value));
    let slid = if system.distance.is_empty() { system.uniform_distance } else { largest(&system.distance) };
    HistoryRow {
        time: clock.represented,
        dt,
        sliding_distance: slid,
        load: Some(system.solution.load),
        approach: Some(system.solution.approach),
        max_pressure: largest(&system.pressure),
        contact_area: Some(touching as f64 * area),
        max_wear_depth: largest(wear),
        wear_volume: Some(wear.iter().sum::<f64>() * area),
        scale,
        simulated_time: clock.simulated,
        cycle: clock.cycles,
    }
}

/// The fields of a moment, the large ones borrowed.
pub(super) fn snapshot<'a>(
    system: &'a System<'_>,
    stepper: &'a Stepper,
    clock: &Clock,
    step_index: u64,
    units: &record::Units,
) -> Snapshot<'a> {
    let cells = stepper.wear.len();
    let states = system.plan.initial_state.len();
    let fields = system.plan.output.fields.iter().map(|(name, kind)| match kind {
        FieldKind::Pressure => Field::scalar(name, &system.pressure[..], units.pressure()),
        FieldKind::Wear => Field::scalar(name, &stepper.wear[..], units.length.clone()),
        FieldKind::SlidingDistance => {
            let data: FieldData<'a> = match system.distance.is_empty() {
                true => vec![system.uniform_distance; cells].into(),
                false => (&system.distance[..]).into(),
            };
            Field::scalar(name, data, units.length.clone())
        }
        FieldKind::Temperature => {
            Field::scalar(name, vec![clock.temperature; cells], system.plan.units.temperature.label)
        }
        FieldKind::Direction => {
            let mut data = vec![0.0; 3 * cells];
            for (i, cell) in system.room.cells.iter().enumerate() {
                if let Some(direction) = system.law.direction.get(3 * i..3 * i + 3) {
                    data[3 * *cell as usize..3 * *cell as usize + 3].copy_from_slice(direction);
                }
            }
            Field::vector(name, data, "")
        }
        FieldKind::State(index) => {
            let data: Vec<f64> = (0..cells).map(|i| system.state[i * states + index]).collect();
            Field::scalar(name, data, "")
        }
    });
    Snapshot { time: clock.represented, step_index, fields: fields.collect() }
}

/// Part of the rim of a free grid that carries pressure.
pub(super) fn rim_in_contact(system: &System<'_>) -> f64 {
    let cells = system.cells();
    let [nx, ny] = cells.counts;
    let flat = cells.dimension == 2;
    let row = |j: usize| {
        let whole = !flat && (j == 0 || j + 1 == ny);
        // The ends of a row; a row of one cell has one.
        let step = if whole { 1 } else { (nx - 1).max(1) };
        (j * nx..(j + 1) * nx).step_by(step)
    };
    let (mut all, mut touching) = (0_usize, 0_usize);
    for cell in (0..ny).flat_map(row) {
        all += 1;
        touching += usize::from(system.pressure[cell] > 0.0);
    }
    touching as f64 / all.max(1) as f64
}

/// A warning where the contact reaches the rim of a free half-space's grid.
///
/// # Errors
/// A contact that covers all of the rim of a surface that is not flat there: beyond the grid it would go on.
pub(super) fn check_rim(
    system: &System<'_>,
    segment: &Segment<'_>,
    clock: &Clock,
) -> Result<Option<String>, SolveError> {
    if !matches!(system.solved.elastic, Elastic::HalfSpace { periodic: false, .. }) {
        return Ok(None);
    }
    let part = rim_in_contact(system);
    if part == 0.0 {
        return Ok(None);
    }
    let gaps = &system.initial_gap;
    let (low, high) = gaps.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), gap| (low.min(*gap), high.max(*gap)));
    if part >= 1.0 && high > low {
        return Err(SolveError::DomainFull { load_step: segment.number, time: clock.represented });
    }
    Ok((high > low).then(|| {
        format!(
            "the contact reaches the rim of the grid, {:.0} % of which carries pressure: what lies beyond is not modelled; a \
             larger `grid.size` would show it",
            100.0 * part
        )
    }))
}
