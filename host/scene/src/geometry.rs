//! `[grid]` and `[surface]`: the points of a solved contact and the initial gap of the pair.

use std::path::PathBuf;

use serde::Serialize;

use super::bound::Bound;
use super::contact::ModelKind;
use super::error::{Problem, SceneError};
use super::reader::{Item, Section};

/// Cells in all beyond which an index no longer fits every format that is written.
const MOST_CELLS: u64 = 1 << 40;

/// `[grid]`: equal cells over a rectangle, or over a line in 2-D.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Grid {
    /// Extent in each direction: two entries in 3-D, one in 2-D.
    pub size: Vec<f64>,
    /// Number of cells in each direction.
    pub cells: Vec<usize>,
}

impl Grid {
    pub(super) fn read(section: &Section<'_>, model: ModelKind, dimension: u8) -> Result<Self, SceneError> {
        section.keys(&[("size", &[]), ("cells", &[])], model)?;
        let item = section.need("size")?;
        let size = item.numbers(Bound::Above(0.0))?;
        in_plane(&item, size.len(), dimension)?;
        let item = section.need("cells")?;
        let cells = counts(&item, 1)?;
        in_plane(&item, cells.len(), dimension)?;
        let all = cells.iter().try_fold(1_u64, |all, &cells| all.checked_mul(cells as u64));
        if all.is_none_or(|all| all > MOST_CELLS) {
            return Err(item.error(Problem::TooManyCells { key: item.path.clone(), cells, most: MOST_CELLS }));
        }
        Ok(Self { size, cells })
    }
}

/// `[surface]`: the initial gap of the pair.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Surface {
    /// The shape with the keys that belong to it.
    #[serde(flatten)]
    pub shape: Shape,
    /// Where the apex lies, from the corner of the grid; `None`: on the centre of cell n/2 (counted from 0).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub center: Option<Vec<f64>>,
}

/// Shape of the initial gap.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "shape", rename_all = "kebab-case")]
pub enum Shape {
    /// Paraboloid of this radius at the apex.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Parabolic cylinder with its axis along y.
    Cylinder {
        /// Radius.
        radius: f64,
    },
    /// Cone.
    Cone {
        /// Degrees between its flank and the plane, between 0 and 90.
        angle: f64,
    },
    /// Flat punch: no gap within its width, never contact beyond.
    FlatPunch {
        /// Width, or diameter in 3-D.
        width: f64,
    },
    /// Waves.
    Wavy {
        /// Height of the waves from mean to crest.
        amplitude: f64,
        /// Waves per size of the grid in each direction; not all zero.
        waves: Vec<u64>,
    },
    /// Self-affine random roughness.
    Rough {
        /// Hurst exponent, above 0 and up to 1.
        hurst: f64,
        /// Root mean square slope.
        rms_slope: f64,
        /// Wave number, in waves per size, below which the spectrum is flat.
        roll_off: f64,
        /// Largest wave number, in waves per size.
        cut_off: f64,
        /// Seed of the random phases.
        seed: u64,
    },
    /// Heights from a file.
    File {
        /// An array of the grid's shape.
        file: PathBuf,
    },
}

const SHAPES: &[&str] = &["sphere", "cylinder", "cone", "flat-punch", "wavy", "rough", "file"];
/// Each key with the shapes it belongs to.
const OWNERS: &[(&str, &[&str])] = &[
    ("radius", &["sphere", "cylinder"]),
    ("angle", &["cone"]),
    ("width", &["flat-punch"]),
    ("amplitude", &["wavy"]),
    ("waves", &["wavy"]),
    ("hurst", &["rough"]),
    ("rms_slope", &["rough"]),
    ("roll_off", &["rough"]),
    ("cut_off", &["rough"]),
    ("seed", &["rough"]),
    ("file", &["file"]),
];

impl Surface {
    pub(super) fn read(section: &Section<'_>, model: ModelKind, dimension: u8) -> Result<Self, SceneError> {
        let mut keys: Vec<(&'static str, &[ModelKind])> = vec![("shape", &[]), ("center", &[])];
        keys.extend(OWNERS.iter().map(|(key, _)| (*key, &[] as &[ModelKind])));
        section.keys(&keys, model)?;
        let item = section.need("shape")?;
        let word = item.text()?;
        if !SHAPES.contains(&word.as_str()) {
            return Err(item.unknown_word(&word, SHAPES));
        }
        section.only_with("shape", &word, OWNERS)?;
        let positive = |key| section.need(key)?.number(Bound::Above(0.0));
        let shape = match word.as_str() {
            "sphere" => Shape::Sphere { radius: positive("radius")? },
            "cylinder" => Shape::Cylinder { radius: positive("radius")? },
            "cone" => Shape::Cone { angle: section.need("angle")?.number(Bound::Between(0.0, 90.0))? },
            "flat-punch" => Shape::FlatPunch { width: positive("width")? },
            "wavy" => {
                let amplitude = section.need("amplitude")?.number(Bound::AtLeast(0.0))?;
                Shape::Wavy { amplitude, waves: waves(&section.need("waves")?, dimension)? }
            }
            "rough" => {
                let roll_off = positive("roll_off")?;
                Shape::Rough {
                    hurst: section.need("hurst")?.number(Bound::AboveUpTo(0.0, 1.0))?,
                    rms_slope: positive("rms_slope")?,
                    roll_off,
                    cut_off: section.need("cut_off")?.number(Bound::AtLeast(roll_off))?,
                    // Written as a TOML integer, which ends at 63 bits.
                    seed: section.get("seed").map(|item| item.count(0, i64::MAX as u64)).transpose()?.unwrap_or(0),
                }
            }
            _ => Shape::File { file: section.need("file")?.path()? },
        };
        let center = match section.get("center") {
            Some(item) => {
                let center = item.numbers(Bound::Finite)?;
                in_plane(&item, center.len(), dimension)?;
                Some(center)
            }
            None => None,
        };
        Ok(Self { shape, center })
    }
}

fn waves(item: &Item<'_>, dimension: u8) -> Result<Vec<u64>, SceneError> {
    let waves: Vec<u64> = counts(item, 0)?.into_iter().map(|count| count as u64).collect();
    in_plane(item, waves.len(), dimension)?;
    if waves.iter().all(|&count| count == 0) {
        // No wave in any direction is no shape: the first count is the one that has to grow.
        let key = item.path.clone();
        return Err(item.error(Problem::CountOutOfRange { key, found: 0, least: 1, most: 1 << 31 }));
    }
    Ok(waves)
}

fn counts(item: &Item<'_>, least: u64) -> Result<Vec<usize>, SceneError> {
    item.list("a list of whole numbers")?
        .iter()
        .map(|entry| entry.count(least, 1 << 31).map(|count| count as usize))
        .collect()
}

/// Two entries in 3-D, one in 2-D.
fn in_plane(item: &Item<'_>, found: usize, dimension: u8) -> Result<(), SceneError> {
    match (found, dimension) {
        (1, 2) | (2, 3) => Ok(()),
        (_, 2) => Err(item.length(found, 1, "in a scene with contact.dimension = 2")),
        _ => Err(item.length(found, 2, "in a scene with contact.dimension = 3")),
    }
}
