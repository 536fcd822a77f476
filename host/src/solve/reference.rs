//! How far the computed wear is from what it should be.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use thiserror::Error;

use crate::contact::prescribed::Motion;
use crate::integrator::norm;
use crate::law::Values;
use crate::plan::Plan;
use crate::reference::archard::{self, ArchardConstants, ArchardReferenceError, TablePoint};
use crate::reference::{NamedReference, Piece as LinearPiece};
use crate::scene::Basis;
use crate::solve::inputs::Drive;
use crate::solve::site::Site;
use crate::solve::source::value;

/// An error with its norm.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorNorm {
    /// What it was compared with.
    pub reference: String,
    /// Which norm `value` is.
    pub norm: String,
    /// Its value.
    pub value: f64,
    /// Further norms by name.
    pub by_field: BTreeMap<String, f64>,
}

/// What a scene should have come to, point by point; in the scene's units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expected {
    /// Where it is from: the name of an exact answer, or a file.
    pub reference: String,
    /// Wear depth `[points]`.
    pub wear: Vec<f64>,
    /// Contact pressure `[points]`; empty where the reference says nothing of it.
    pub pressure: Vec<f64>,
    /// Worn volume, where it is known better than by the points.
    pub volume: Option<f64>,
}

/// Why a reference cannot be evaluated.
#[derive(Debug, Error)]
pub enum ReferenceError {
    /// The scene is not one that the exact answer covers.
    #[error("the reference \"{kind}\" does not cover this scene: {reason}")]
    NotCovered {
        /// The exact answer.
        kind: &'static str,
        /// What is not covered.
        reason: String,
    },
    /// The exact answer has no value at a point.
    #[error("the reference at point {point}: {source}")]
    Exact {
        /// The point's number.
        point: i64,
        /// Why.
        source: ArchardReferenceError,
    },
    /// The file cannot be read.
    #[error("could not read the reference {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// The file's header is not as it should be.
    #[error("{path}: found the columns {found}, expected `point` and `wear`")]
    Columns {
        /// The file.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// A number in the file is none.
    #[error("{path}:{line}: found \"{found}\", expected a finite number")]
    Number {
        /// The file.
        path: PathBuf,
        /// The line.
        line: u64,
        /// What was found.
        found: String,
    },
    /// A point is not in the file.
    #[error("{path}: found no row for point {point}, expected one for every point of the scene")]
    Point {
        /// The file.
        path: PathBuf,
        /// The point's number.
        point: i64,
    },
}

/// Relative L2 error of a wear profile, with the largest error beside it.
pub fn compare(wear: &[f64], exact: &[f64], reference: &str) -> ErrorNorm {
    let largest = exact.iter().fold(0.0, |most: f64, w| most.max(w.abs()));
    let differences = wear.iter().zip(exact).map(|(a, b)| a - b);
    let value = relative_l2(wear, exact);
    let most = differences.fold(0.0, |most: f64, d| most.max(d.abs()));
    let by_field = [("wear_l2_relative".to_owned(), value), ("wear_max_relative".to_owned(), relative(most, largest))];
    ErrorNorm {
        reference: reference.to_owned(),
        norm: "relative L2 error of the wear depth".to_owned(),
        value,
        by_field: by_field.into_iter().collect(),
    }
}

/// |found - exact| / |exact| in the L2 norm over the points; 0 where both vanish.
pub(super) fn relative_l2(found: &[f64], exact: &[f64]) -> f64 {
    let differences = found.iter().zip(exact).map(|(a, b)| a - b);
    relative(norm(differences), norm(exact.iter().copied()))
}

fn relative(error: f64, size: f64) -> f64 {
    match (error, size) {
        (0.0, _) => 0.0,
        (_, 0.0) => f64::INFINITY,
        (error, size) => error / size,
    }
}

/// Checks that a named answer is that of Archard's law under a prescribed pressure and covers a plan.
///
/// # Errors
/// What it does not cover.
pub(super) fn covered(plan: &Plan, named: NamedReference, law: &str) -> Result<(), ReferenceError> {
    let refuse = |reason: &str| Err(ReferenceError::NotCovered { kind: named.name(), reason: reason.to_owned() });
    let material = &plan.material;
    if named != NamedReference::ArchardPrescribed {
        return refuse("it is for a contact that is solved, this pressure is prescribed");
    } else if law != "archard" {
        return refuse("the law is not `archard`");
    } else if material.constants.varies_in_temperature() {
        return refuse("the constants depend on temperature");
    } else if material.average {
        return refuse("increments are averaged over the contact area");
    } else if material.basis == Basis::NodalStress {
        return refuse("wear is based on nodal stresses");
    } else if material.direction.is_some() {
        return refuse("the wear direction is not the default");
    }
    Ok(())
}

/// Wear depths of Archard's law from the linear pieces of a scene, by a quadrature of its own.
pub(super) fn archard_prescribed(
    plan: &Plan,
    named: NamedReference,
    law: &str,
    sites: &[(Site<'_>, Drive<'_>)],
    points: usize,
) -> Result<Vec<f64>, ReferenceError> {
    covered(plan, named, law)?;
    let material = &plan.material;
    let times = material.constants.break_times();
    let at = |time: f64| {
        let constants = [0, 1, 2, 3].map(|c| material.constants.value(c, time, 0.0));
        TablePoint { time, constants: ArchardConstants::from_array(constants) }
    };
    let table: Vec<TablePoint> =
        if times.is_empty() { vec![at(0.0)] } else { times.iter().map(|time| at(*time)).collect() };
    let mut wear = Vec::with_capacity(points);
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for i in 0..points {
        let mut pieces = Vec::with_capacity(sites.len());
        for (site, drive) in sites {
            let piece = site.piece;
            let ends = |part: f64, a: &mut Vec<f64>| value(&drive.pressure.at(part, i..i + 1, a), 0);
            let pressure = [ends(0.0, &mut a), ends(1.0, &mut a)];
            let velocity = match plan.motion {
                Motion::None => [0.0; 2],
                Motion::Velocity => [0.0, 1.0].map(|part| value(&drive.velocity.at(part, i..i + 1, &mut b), 0)),
                Motion::Slip | Motion::SlipVector => {
                    let mut parts = Default::default();
                    let length = piece.end - piece.start;
                    let path: Values<'_> = drive.paths((0.0, 1.0), length, i..i + 1, &mut b, &mut parts);
                    [value(&path, 0) / length; 2]
                }
            };
            pieces.push(LinearPiece { time: [piece.start, piece.end], pressure, velocity });
        }
        let exact = archard::prescribed(&table, &pieces);
        let point = sites.first().map_or(0, |(site, _)| site.id(i));
        wear.push(exact.map_err(|source| ReferenceError::Exact { point, source })?);
    }
    Ok(wear)
}

/// Wear depths from a CSV file with the columns `point` and `wear`.
pub(super) fn from_file(path: &Path, ids: impl Iterator<Item = i64>) -> Result<Vec<f64>, ReferenceError> {
    let read = |source: csv::Error| ReferenceError::Read { path: path.to_owned(), source };
    let mut reader =
        csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_path(path).map_err(read)?;
    let names = reader.headers().map_err(read)?.clone();
    let place = |wanted: &str| names.iter().position(|name| name == wanted);
    let (Some(point), Some(wear)) = (place("point"), place("wear")) else {
        let found = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        return Err(ReferenceError::Columns { path: path.to_owned(), found });
    };
    let mut rows = BTreeMap::new();
    for row in reader.records() {
        let row = row.map_err(read)?;
        let line = row.position().map_or(0, csv::Position::line);
        let bad = |found: &str| ReferenceError::Number { path: path.to_owned(), line, found: found.to_owned() };
        let (id, depth) = (row.get(point).unwrap_or(""), row.get(wear).unwrap_or(""));
        let id: i64 = id.parse().map_err(|_| bad(id))?;
        let number: f64 = depth.parse().map_err(|_| bad(depth))?;
        if !number.is_finite() {
            return Err(bad(depth));
        }
        rows.insert(id, number);
    }
    ids.map(|id| rows.get(&id).copied().ok_or(ReferenceError::Point { path: path.to_owned(), point: id })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_are_relative_to_the_reference() {
        let error = compare(&[3.0, 5.0], &[3.0, 4.0], "test");
        assert_eq!((error.value, error.by_field["wear_max_relative"]), (0.2, 0.25));
        assert_eq!(compare(&[0.0], &[0.0], "test").value, 0.0);
        assert_eq!(compare(&[1.0], &[0.0], "test").value, f64::INFINITY);
    }
}
