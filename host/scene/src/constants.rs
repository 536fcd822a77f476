//! The law's numbers: by name or by position, constant or in a table over time and temperature.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use super::bound::Bound;
use super::contact::ModelKind;
use super::error::{Problem, SceneError};
use super::reader::{Item, Section};
use super::units::Units;

/// Constants as they were given, in the scene's units. The finite range is checked here, the bounds of the law by the plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Constants {
    /// `{ K = 1e-4, .. }`.
    ByName(BTreeMap<String, f64>),
    /// `[1e-4, ..]`, in the law's order.
    ByPosition(Vec<f64>),
}

impl Constants {
    /// How many constants were given.
    pub fn len(&self) -> usize {
        match self {
            Self::ByName(constants) => constants.len(),
            Self::ByPosition(constants) => constants.len(),
        }
    }

    /// Whether none were given.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn read(item: &Item<'_>) -> Result<Self, SceneError> {
        if let Ok(section) = item.section() {
            let mut constants = BTreeMap::new();
            for (name, entry) in section.entries() {
                constants.insert(name.to_owned(), entry.number(Bound::Finite)?);
            }
            return Ok(Self::ByName(constants));
        }
        let list = item.list("constants by name, { K = 1e-4, .. }, or by position, [1e-4, ..]")?;
        list.iter().map(|entry| entry.number(Bound::Finite)).collect::<Result<_, _>>().map(Self::ByPosition)
    }

    /// The names, or the number of positions: what must agree between the rows of a table.
    fn shape(&self) -> RowShape {
        match self {
            Self::ByName(constants) => RowShape::Names(constants.keys().cloned().collect()),
            Self::ByPosition(constants) => RowShape::Positions(constants.len()),
        }
    }
}

/// Which constants a row of a table gives.
#[derive(Debug, Clone, PartialEq)]
pub enum RowShape {
    /// These names.
    Names(Vec<String>),
    /// So many by position.
    Positions(usize),
}

impl fmt::Display for RowShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Names(names) => write!(f, "the constants `{}`", names.join("`, `")),
            Self::Positions(1) => write!(f, "1 constant by position"),
            Self::Positions(count) => write!(f, "{count} constants by position"),
        }
    }
}

/// A row of `[[law.table]]`: constants at a time, at a temperature, or at both.
///
/// Every row of a scene has the same axes and the same constants, no point has two rows, and rows over both axes form a
/// full grid. Rows stand in written order. Between rows each constant is interpolated linearly, outside it is held.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TableRow {
    /// Time in the scene's units.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// Temperature in the scene's units.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature: Option<f64>,
    /// The constants there.
    pub constants: Constants,
}

impl TableRow {
    fn read(section: &Section<'_>, model: ModelKind, units: &Units) -> Result<Self, SceneError> {
        section.keys(&[("time", &[]), ("temperature", &[]), ("constants", &[])], model)?;
        let row = Self {
            time: section.get("time").map(|item| item.number(Bound::Finite)).transpose()?,
            temperature: section.get("temperature").map(|item| item.number(units.temperatures())).transpose()?,
            constants: Constants::read(&section.need("constants")?)?,
        };
        if row.time.is_none() && row.temperature.is_none() {
            return Err(section.error("", Problem::RowWithoutPoint));
        }
        Ok(row)
    }

    fn axes(&self) -> &'static str {
        match (self.time, self.temperature) {
            (Some(_), Some(_)) => "`time` and `temperature`",
            (Some(_), None) => "`time` alone",
            (None, Some(_)) => "`temperature` alone",
            (None, None) => "neither",
        }
    }
}

/// Reads all rows and holds them to one shape and a full grid.
pub(super) fn read_table(item: &Item<'_>, model: ModelKind, units: &Units) -> Result<Vec<TableRow>, SceneError> {
    let items = item.list("rows of a table, [[law.table]]")?;
    let mut rows: Vec<TableRow> = Vec::with_capacity(items.len());
    let mut points = std::collections::BTreeSet::new();
    for item in &items {
        let row = TableRow::read(&item.section()?, model, units)?;
        let first = rows.first().unwrap_or(&row);
        if row.axes() != first.axes() {
            return Err(item.error(Problem::RowAxes { found: row.axes(), expected: first.axes() }));
        }
        if row.constants.shape() != first.constants.shape() {
            let (found, expected) = (row.constants.shape(), first.constants.shape());
            return Err(item.error(Problem::RowConstants { found, expected }));
        }
        if !points.insert((row.time.map(ordered), row.temperature.map(ordered))) {
            return Err(item.error(Problem::RowRepeated { time: row.time, temperature: row.temperature }));
        }
        rows.push(row);
    }
    let axis = |value: fn(&TableRow) -> Option<f64>| {
        let mut values: Vec<f64> = rows.iter().filter_map(value).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let (times, temperatures) = (axis(|row| row.time), axis(|row| row.temperature));
    for &time in &times {
        for &temperature in &temperatures {
            if !points.contains(&(Some(ordered(time)), Some(ordered(temperature)))) {
                let (times, temperatures) = (times.len(), temperatures.len());
                return Err(item.error(Problem::TableHole { time, temperature, times, temperatures }));
            }
        }
    }
    Ok(rows)
}

/// Bits that are equal exactly where finite numbers are: with one zero.
fn ordered(value: f64) -> u64 {
    (value + 0.0).to_bits()
}
