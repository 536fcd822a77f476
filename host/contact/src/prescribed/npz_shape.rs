//! What the shapes of the arrays in an NPZ history mean.

use super::{HistoryError, Layout};
use std::path::Path;

/// Name and shape of an array.
pub(super) type Shaped<'a> = (&'a str, &'a [usize]);

/// The arrangement that the shapes show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    pub layout: Layout,
    /// Number of times (grid form) or of rows (long form).
    pub times: usize,
    /// Number of points (grid form).
    pub points: usize,
}

/// Tells the two forms apart and counts times and points.
///
/// Long form: `time`, `point` and all other arrays have one index of the same length (single
/// values apart). Everything else is the grid form.
pub(super) fn extent(path: &Path, arrays: &[Shaped<'_>]) -> Result<Extent, HistoryError> {
    let shape_of = |name: &str| arrays.iter().find(|a| a.0 == name).map(|a| a.1);
    let Some(time) = shape_of("time") else {
        return Err(HistoryError::MissingColumn {
            path: path.into(),
            name: "time".to_string(),
            found: arrays.iter().map(|a| a.0.to_string()).collect(),
        });
    };
    let times = one_index(path, "time", time)?;
    let ids = shape_of("point").map(|shape| one_index(path, "point", shape)).transpose()?;
    let long = ids == Some(times)
        && arrays.iter().all(|(_, shape)| shape.is_empty() || *shape == [times])
        && arrays.iter().any(|(name, shape)| !matches!(*name, "time" | "point") && *shape == [times]);
    if long && times > 1 {
        return Ok(Extent { layout: Layout::NpzLong, times, points: 0 });
    }
    let two_indices = arrays.iter().filter(|(_, shape)| shape.len() == 2);
    let widest = two_indices.map(|(_, shape)| shape[1]).max();
    let others = arrays.iter().filter(|(_, shape)| shape.len() == 1 && shape[0] != times);
    let longest = others.map(|(_, shape)| shape[0]).max();
    let points = ids.or(widest.filter(|n| *n != 1)).or(longest).unwrap_or(1);
    if times == 0 || points == 0 {
        return Err(HistoryError::NoRows { path: path.into() });
    }
    Ok(Extent { layout: Layout::NpzGrid, times, points })
}

fn one_index(path: &Path, name: &str, shape: &[usize]) -> Result<usize, HistoryError> {
    match shape {
        [] => Ok(1),
        [n] => Ok(*n),
        _ => Err(HistoryError::Shape {
            path: path.into(),
            name: name.to_string(),
            shape: shape.to_vec(),
            expected: "one index".to_string(),
        }),
    }
}

/// Steps over times and points of an array in the grid form.
pub(super) fn steps(path: &Path, array: Shaped<'_>, extent: Extent) -> Result<(usize, usize), HistoryError> {
    let (times, points) = (extent.times, extent.points);
    let fault = |expected: String| HistoryError::Shape {
        path: path.into(),
        name: array.0.to_string(),
        shape: array.1.to_vec(),
        expected,
    };
    match *array.1 {
        [] | [1] => Ok((0, 0)),
        [n] if n == times && n == points => Err(fault(format!(
            "({n}, 1) for a value per time or (1, {n}) for a value per point, as there are {n} of both"
        ))),
        [n] if n == times => Ok((1, 0)),
        [n] if n == points => Ok((0, 1)),
        [t, n] if (t == times || t == 1) && (n == points || n == 1) => {
            let point_step = usize::from(n > 1);
            Ok((if t > 1 { n } else { 0 }, point_step))
        }
        _ => Err(fault(format!("({times}, {points}), ({times},), ({points},) or ()"))),
    }
}
