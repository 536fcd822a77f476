//! Writes a wear material as the law section of a scene.
//!
//! Constants of the Archard law go by name, those of a user's law by position; C5 to C8 become the host's own
//! keys. Every number is the shortest text that reads back to the same 64 bits.

use std::fmt::Write as _;

use thiserror::Error;

use super::deck::{LawOption, Scaling, ScalingKind, TableRow, WearMaterial};
use crate::scene::documented::{Controls, ControlsError, controls};
use crate::scene::{Basis, Mode};

/// Names of C1 to C4 in a scene.
const ARCHARD_NAMES: [&str; 4] = ["K", "H", "m", "n"];

/// Why a wear material has no law section; none of these happens to a material that came out of a deck.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LowerError {
    /// A constant that the law needs is blank; K, H, m, n and a user's constants have no default.
    #[error("material {material}, row {row}: C{location} is blank, expected a number")]
    MissingConstant {
        /// The material's number.
        material: i64,
        /// The table's row, from 1.
        row: usize,
        /// Which constant, from 1.
        location: usize,
    },
    /// A number is NaN or infinite.
    #[error("material {material}: found {value}, expected a finite number")]
    NotFinite {
        /// The material's number.
        material: i64,
        /// The number.
        value: f64,
    },
    /// A row has neither time nor temperature although there are several, or there is none.
    #[error("material {material} has {rows} rows, expected one, or a time or temperature for each")]
    NoPoint {
        /// The material's number.
        material: i64,
        /// How many rows there are.
        rows: usize,
    },
    /// C5 to C8 are not settings of the host.
    #[error("material {material}, row {row}: {cause}")]
    Controls {
        /// The material's number.
        material: i64,
        /// The table's row, from 1.
        row: usize,
        /// What is wrong with them.
        cause: ControlsError,
    },
    /// C5 to C8 differ between rows.
    #[error("material {material}, row {row}: C5 to C8 differ from those of the first row")]
    ControlsDiffer {
        /// The material's number.
        material: i64,
        /// The table's row, from 1.
        row: usize,
    },
}

/// The `[law]` section of a scene, and its `[scaling]` section where the material has one, as TOML text.
///
/// # Errors
/// The material does not hold what its law needs; one that [`super::Deck`] gave always does.
pub fn to_toml(material: &WearMaterial) -> Result<String, LowerError> {
    let mut text = format!("# material {}, {}\n[law]\n", material.id, title(material));
    match material.option {
        LawOption::Archard => text.push_str("use = \"archard\"\n"),
        LawOption::User { .. } => text.push_str(
            "# name the law: a library, or a source file or crate that is built first\n\
             use = \"PATH-TO-YOUR-LAW\"\n",
        ),
    }
    let rows = &material.tables;
    let plain = match rows.as_slice() {
        [only] if only.time.is_none() && only.temperature.is_none() => Some(only),
        _ => None,
    };
    if let Some(row) = plain {
        let _ = writeln!(text, "constants = {}", constants(material, 0, row)?);
    }
    if material.option == LawOption::Archard {
        write_controls(&mut text, &common_controls(material)?);
    }
    if plain.is_none() {
        let needed = material.option != (LawOption::User { constants: 0 });
        let without_point = |row: &TableRow| row.time.is_none() && row.temperature.is_none();
        if rows.iter().any(without_point) || (rows.is_empty() && needed) {
            return Err(LowerError::NoPoint { material: material.id, rows: rows.len() });
        }
        for (at, row) in rows.iter().enumerate() {
            text.push_str("\n[[law.table]]\n");
            for (key, value) in [("time", row.time), ("temperature", row.temperature)] {
                if let Some(value) = value {
                    let _ = writeln!(text, "{key} = {}", number(material, value)?);
                }
            }
            let _ = writeln!(text, "constants = {}", constants(material, at, row)?);
        }
    }
    if let Some(scaling) = &material.scaling {
        write_scaling(&mut text, material, scaling)?;
    }
    Ok(text)
}

fn title(material: &WearMaterial) -> &'static str {
    match material.option {
        LawOption::Archard => "TB,WEAR with ARCD",
        LawOption::User { .. } => "TB,WEAR with USER",
    }
}

/// `{ K = .., H = .., m = .., n = .. }` or `[..]`.
fn constants(material: &WearMaterial, at: usize, row: &TableRow) -> Result<String, LowerError> {
    let value = |location: usize| {
        let given = row.constants.get(location - 1).copied().flatten();
        let given = given.ok_or(LowerError::MissingConstant { material: material.id, row: at + 1, location })?;
        number(material, given)
    };
    match material.option {
        LawOption::Archard => {
            let named = ARCHARD_NAMES.iter().zip(1..);
            let pairs: Result<Vec<_>, LowerError> =
                named.map(|(name, location)| Ok(format!("{name} = {}", value(location)?))).collect();
            Ok(format!("{{ {} }}", pairs?.join(", ")))
        }
        LawOption::User { constants } => {
            let values: Result<Vec<_>, _> = (1..=constants).map(value).collect();
            Ok(format!("[{}]", values?.join(", ")))
        }
    }
}

/// The controls of all rows, which are the same.
fn common_controls(material: &WearMaterial) -> Result<Controls, LowerError> {
    let mut first: Option<Controls> = None;
    for (row, table) in (1..).zip(&material.tables) {
        let material = material.id;
        let found = controls(&table.constants).map_err(|cause| LowerError::Controls { material, row, cause })?;
        if !first.get_or_insert(found).same_meaning(&found) {
            return Err(LowerError::ControlsDiffer { material, row });
        }
    }
    Ok(first.unwrap_or_default())
}

/// Only what the deck states: a key that is not there keeps its default.
fn write_controls(text: &mut String, controls: &Controls) {
    if let Some(basis) = controls.basis {
        let basis = match basis {
            Basis::Pressure => "pressure",
            Basis::NodalStress => "nodal-stress",
        };
        let _ = writeln!(text, "basis = \"{basis}\"");
    }
    if let Some(average) = controls.average {
        let _ = writeln!(text, "average = {average}");
    }
    if let Some(mode) = controls.mode {
        let mode = match mode {
            Mode::Apply => "apply",
            Mode::Post => "post",
        };
        let _ = writeln!(text, "mode = \"{mode}\"");
    }
    let vector = |v: [f64; 3]| v.map(finite_number).join(", ");
    if let Some(direction) = controls.direction {
        if let Some(given) = controls.direction_before_scaling {
            let given = vector(given);
            let _ = writeln!(text, "# C6 to C8 were {given}, scaled to length 1");
        }
        let _ = writeln!(text, "direction = [{}]", vector(direction));
    }
}

fn write_scaling(text: &mut String, material: &WearMaterial, scaling: &Scaling) -> Result<(), LowerError> {
    let kind = match scaling.kind {
        ScalingKind::Auto => "auto",
        ScalingKind::Cycle => "cycle",
    };
    let safety = number(material, scaling.safety)?;
    let maximum = number(material, scaling.maximum)?;
    let _ = write!(text, "\n[scaling]\nkind = \"{kind}\"\nsafety = {safety}\nmaximum = {maximum}\n");
    Ok(())
}

fn number(material: &WearMaterial, value: f64) -> Result<String, LowerError> {
    if value.is_finite() {
        return Ok(finite_number(value));
    }
    let material = material.id;
    Err(LowerError::NotFinite { material, value })
}

/// The shortest digits that give the same bits; with an exponent where they would be hard to count.
fn finite_number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e6).contains(&size) { format!("{value:?}") } else { format!("{value:e}") }
}
