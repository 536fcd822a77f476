//! CSV: the history of a run, and the fields of one time with a row per point.
//!
//! Numbers have the shortest digits that read back to the same bits; a quantity that is not known
//! is an empty cell.

use super::{OutputError, write_file};
use crate::record::{Geometry, History, Snapshot};
use std::io::{self, Write};
use std::path::Path;

/// The columns of `history.csv`.
pub const HISTORY_COLUMNS: [&str; 12] = [
    "time",
    "dt",
    "sliding_distance",
    "load",
    "approach",
    "max_pressure",
    "contact_area",
    "max_wear_depth",
    "wear_volume",
    "scale",
    "simulated_time",
    "cycle",
];

/// Writes `history.csv`: a header, then a row per accepted step.
///
/// # Errors
/// `Io` with the path; then nothing is left of the file.
pub fn write_history(history: &History, path: &Path) -> Result<(), OutputError> {
    write_file(path, |to| history_rows(history, to))
}

fn history_rows(history: &History, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "{}", HISTORY_COLUMNS.join(","))?;
    for row in &history.rows {
        let cells = [
            Some(row.time),
            Some(row.dt),
            Some(row.sliding_distance),
            row.load,
            row.approach,
            Some(row.max_pressure),
            row.contact_area,
            Some(row.max_wear_depth),
            row.wear_volume,
            Some(row.scale),
            Some(row.simulated_time),
            Some(row.cycle),
        ];
        for (i, cell) in cells.iter().enumerate() {
            let comma = if i == 0 { "" } else { "," };
            match cell {
                Some(number) => write!(to, "{comma}{number:?}")?,
                None => write!(to, "{comma}")?,
            }
        }
        writeln!(to)?;
    }
    Ok(())
}

/// Writes the fields of one time: `point`, then `x,y,z` where they are known, then a column per
/// component. The caller has checked the lengths (`write_fields` does).
pub(super) fn field_rows(snapshot: &Snapshot<'_>, geometry: &Geometry<'_>, to: &mut impl Write) -> io::Result<()> {
    write!(to, "point")?;
    if geometry.count() > 0 && geometry.coordinates(0).is_some() {
        write!(to, ",x,y,z")?;
    }
    for name in snapshot.fields.iter().flat_map(|field| field.component_names()) {
        write!(to, ",{}", quoted(&name))?;
    }
    writeln!(to)?;
    for point in 0..geometry.count() {
        write!(to, "{}", geometry.id(point))?;
        for at in geometry.coordinates(point).into_iter().flatten() {
            write!(to, ",{at:?}")?;
        }
        for field in &snapshot.fields {
            for number in &field.data[point * field.components..(point + 1) * field.components] {
                write!(to, ",{number:?}")?;
            }
        }
        writeln!(to)?;
    }
    Ok(())
}

fn quoted(name: &str) -> std::borrow::Cow<'_, str> {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\"")).into()
    } else {
        name.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Field, HistoryRow, PointIds, Points};

    fn text(fill: impl FnOnce(&mut Vec<u8>) -> io::Result<()>) -> String {
        let mut bytes = Vec::new();
        fill(&mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn history_reads_back_to_the_same_bits() {
        let mut row = HistoryRow::at(0.1 + 0.2);
        (row.max_wear_depth, row.load, row.dt) = (7.322_799_325_1e-6, Some(1.0 / 3.0), 5e-324);
        (row.max_pressure, row.wear_volume) = (f64::MAX, Some(-0.0));
        let history = History { rows: vec![HistoryRow::at(0.0), row] };
        let text = text(|to| history_rows(&history, to));
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        assert_eq!(reader.headers().unwrap(), &HISTORY_COLUMNS[..]);
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 2);
        let cell = |column: usize| rows[1][column].parse::<f64>().ok().map(f64::to_bits);
        let expected = [
            Some(row.time),
            Some(row.dt),
            Some(0.0),
            row.load,
            None,
            Some(f64::MAX),
            None,
            Some(row.max_wear_depth),
            row.wear_volume,
            Some(1.0),
        ];
        for (column, number) in expected.iter().enumerate() {
            assert_eq!(cell(column), number.map(f64::to_bits), "{}", HISTORY_COLUMNS[column]);
        }
    }

    #[test]
    fn fields_have_a_row_per_point_and_a_column_per_component() {
        let mut points = Points { ids: PointIds::Listed(vec![7, 3].into()), coordinates: None, dimension: 3 };
        let snapshot = Snapshot {
            time: 1.0,
            step_index: 4,
            fields: vec![
                Field::scalar("wear", vec![1e-6, 2.5], "m"),
                Field::vector("direction", vec![0.0, 0.0, -1.0, 1.0, 0.0, 0.0], ""),
            ],
        };
        let bare = Geometry::Points(points.clone());
        assert_eq!(
            text(|to| field_rows(&snapshot, &bare, to)),
            "point,wear,direction_x,direction_y,direction_z\n7,1e-6,0.0,0.0,-1.0\n3,2.5,1.0,0.0,0.0\n"
        );
        points.coordinates = Some(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0].into());
        let placed = text(|to| field_rows(&snapshot, &Geometry::Points(points), to));
        assert!(placed.starts_with("point,x,y,z,wear,"), "{placed}");
        assert!(placed.contains("\n3,4.0,5.0,6.0,2.5,"), "{placed}");
        assert_eq!(quoted("a,\"b"), "\"a,\"\"b\"");
    }
}
