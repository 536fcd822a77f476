//! The fields that a scene asks for, at the end of a piece.

use crate::contact::prescribed::{Column, History, PointIds};
use crate::law::Values;
use crate::plan::{FieldKind, Plan};
use crate::record::{self, Field, FieldData, Geometry, Points, Snapshot};
use crate::solve::inputs::Drive;
use crate::solve::progress::Arrays;
use crate::solve::site::Site;
use crate::solve::source::value;

/// Values of the driving pressure at a fraction of a piece `[points]`.
pub(super) fn pressure(site: &Site<'_>, drive: &Drive<'_>, part: f64, points: usize) -> Vec<f64> {
    let (mut room, mut parts) = (Vec::new(), Default::default());
    let values = drive.driving_pressure(site.plan, part, 0..points, (&mut room, &mut parts));
    spread(&values, points)
}

fn spread(values: &Values<'_>, points: usize) -> Vec<f64> {
    match values {
        Values::PerPoint(all) => all.to_vec(),
        uniform => vec![value(uniform, 0); points],
    }
}

/// The snapshot of a time, its large fields borrowed.
pub(super) fn snapshot<'a>(
    site: &Site<'_>,
    drive: &Drive<'_>,
    arrays: &'a Arrays,
    step_index: u64,
    units: &record::Units,
) -> Snapshot<'a> {
    let points = arrays.wear.len();
    let states = site.law.state.len();
    let fields = site.plan.output.fields.iter().map(|(name, kind)| match kind {
        FieldKind::Pressure => Field::scalar(name, pressure(site, drive, 1.0, points), units.pressure()),
        FieldKind::Wear => Field::scalar(name, &arrays.wear[..], units.length.clone()),
        FieldKind::SlidingDistance => {
            let data: FieldData<'a> = match arrays.distance.is_empty() {
                true => vec![arrays.uniform_distance; points].into(),
                false => (&arrays.distance[..]).into(),
            };
            Field::scalar(name, data, units.length.clone())
        }
        FieldKind::Temperature => {
            let mut room = Vec::new();
            let values = drive.temperature.at(1.0, 0..points, &mut room);
            Field::scalar(name, spread(&values, points), site.plan.units.temperature.label)
        }
        FieldKind::Direction => Field::vector(name, &arrays.direction[..], ""),
        FieldKind::State(index) => {
            let data: Vec<f64> = (0..points).map(|i| arrays.state[i * states + index]).collect();
            Field::scalar(name, data, "")
        }
    });
    Snapshot { time: site.piece.end, step_index, fields: fields.collect() }
}

/// Labels of a plan's units.
pub(super) fn units(plan: &Plan) -> record::Units {
    record::Units {
        length: plan.units.length.label.to_owned(),
        force: plan.units.force.label.to_owned(),
        time: plan.units.time.label.to_owned(),
        per_length: plan.dimension == 2,
    }
}

/// Where the points of a run lie.
pub(super) fn geometry(plan: &Plan, history: Option<&History>, points: usize) -> Geometry<'static> {
    let ids = match history.map(History::point_ids) {
        Some(PointIds::Listed(ids)) if ids.iter().all(|id| *id >= 0) => {
            record::PointIds::Listed(ids.iter().map(|id| id.unsigned_abs()).collect())
        }
        _ => record::PointIds::Counted { first: 0, count: points },
    };
    let column = |column: Column| history.and_then(|history| history.column(column));
    let coordinates = match Column::COORDINATES.map(column) {
        [Some(x), Some(y), Some(z)] => {
            Some((0..points).flat_map(|i| [x.value(0, i), y.value(0, i), z.value(0, i)]).collect::<Vec<f64>>().into())
        }
        _ => None,
    };
    Geometry::Points(Points { ids, coordinates, dimension: plan.dimension })
}
