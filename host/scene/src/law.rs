//! `[law]`: which wear law, its constants, and what the host does with its increments.

use std::path::PathBuf;

use serde::Serialize;

use super::bound::Bound;
use super::constants::{Constants, TableRow, read_table};
use super::contact::ModelKind;
use super::error::{Problem, SceneError};
use super::reader::{Item, Section, Word};
use super::units::Units;

/// What drives the law (documented as C5 = 1 and 11).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// The contact pressure.
    #[default]
    Pressure,
    /// The normal traction of nodal stresses, max(0, -n.sigma.n).
    NodalStress,
}

/// What becomes of the wear (documented as C5 = -99).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Wear moves the surface.
    #[default]
    Apply,
    /// Wear is computed, the geometry never moves.
    Post,
}

impl Word for Basis {
    const ALL: &'static [(&'static str, Self)] = &[("pressure", Self::Pressure), ("nodal-stress", Self::NodalStress)];
}

impl Word for Mode {
    const ALL: &'static [(&'static str, Self)] = &[("apply", Self::Apply), ("post", Self::Post)];
}

/// `[law]`. At most one of `constants`, `table` and `apdl` is given.
///
/// `basis`, `average`, `mode` and `direction` stay `None` where the scene is silent, because constants of the law may
/// say the same thing, and only the plan knows whether they do. Their defaults are `Basis::Pressure`, `false`,
/// `Mode::Apply` and the direction opposite to the contact normal.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Law {
    /// Key `use`: the name of a law in the program, or a path to a library, a source file or a crate.
    #[serde(rename = "use")]
    pub plugin: String,
    /// The law's constants, if they are the same always.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub constants: Option<Constants>,
    /// A file of commands that gives constants, tables, controls and scaling.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub apdl: Option<PathBuf>,
    /// The material of that file; `None`: the only one in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<u64>,
    /// What drives the law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basis: Option<Basis>,
    /// Whether the wear increment is averaged over the contact area of the pair.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub average: Option<bool>,
    /// Whether wear moves the surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mode: Option<Mode>,
    /// Direction in which material goes, as given and not scaled to length 1; `[x, z]` of a 2-D scene is `[x, 0, z]` here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// Shares of the wear of the wearing body and the counterbody; they sum to 1. `None`: all on the wearing body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub share: Option<[f64; 2]>,
    /// SHA-256 of the only library that may be loaded, in lower case.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
    /// Options for the law's `create`, handed over as they are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub options: Option<String>,
    /// Rows of constants over time, temperature or both; empty if there is no table.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub table: Vec<TableRow>,
}

impl Law {
    pub(super) fn read(
        section: &Section<'_>,
        model: ModelKind,
        dimension: u8,
        units: &Units,
    ) -> Result<Self, SceneError> {
        section.keys(
            &[
                ("use", &[]),
                ("constants", &[]),
                ("table", &[]),
                ("apdl", &[]),
                ("material", &[]),
                ("basis", &[]),
                ("average", &[]),
                ("mode", &[]),
                ("direction", &[]),
                ("share", &[]),
                ("sha256", &[]),
                ("options", &[]),
            ],
            model,
        )?;
        let plugin = section.need("use")?.name("the name of a law or the path of a library or source")?;
        section.at_most_one(&["constants", "table", "apdl"])?;
        if let Some(material) = section.get("material")
            && section.get("apdl").is_none()
        {
            return Err(section.error("material", Problem::Alone { key: material.path, partner: "law.apdl" }));
        }
        Ok(Self {
            plugin,
            constants: section.get("constants").map(|item| Constants::read(&item)).transpose()?,
            apdl: section.get("apdl").map(|item| item.path()).transpose()?,
            material: section.get("material").map(|item| item.count(1, u64::from(u32::MAX))).transpose()?,
            basis: section.get("basis").map(|item| item.word()).transpose()?,
            average: section.get("average").map(|item| item.boolean()).transpose()?,
            mode: section.get("mode").map(|item| item.word()).transpose()?,
            direction: section.get("direction").map(|item| direction(&item, dimension)).transpose()?,
            share: section.get("share").map(|item| share(&item)).transpose()?,
            sha256: section.get("sha256").map(|item| digest(&item)).transpose()?,
            options: section.get("options").map(|item| item.text()).transpose()?,
            table: section.get("table").map(|item| read_table(&item, model, units)).transpose()?.unwrap_or_default(),
        })
    }
}

/// Three components, or two in 2-D; a 2-D direction with a third one in the middle is taken where it is zero.
fn direction(item: &Item<'_>, dimension: u8) -> Result<[f64; 3], SceneError> {
    let given = item.numbers(Bound::Finite)?;
    let direction = match (given.as_slice(), dimension) {
        (&[x, z], 2) => [x, 0.0, z],
        (&[x, y, z], 2) if y == 0.0 => [x, y, z],
        (&[_, y, _], 2) => {
            return Err(item.error(Problem::LeavesPlane { key: item.path.clone(), y }));
        }
        (&[x, y, z], _) => [x, y, z],
        (_, 2) => return Err(item.length(given.len(), 2, "in a scene with contact.dimension = 2")),
        _ => return Err(item.length(given.len(), 3, "in a scene with contact.dimension = 3")),
    };
    // The largest component first: the sum of squares of tiny or huge components would not be representable.
    let length = direction.iter().fold(0.0_f64, |most, component| most.max(component.abs()));
    if length == 0.0 {
        return Err(item.error(Problem::NoDirection { key: item.path.clone(), length }));
    }
    Ok(direction)
}

fn share(item: &Item<'_>) -> Result<[f64; 2], SceneError> {
    let given = item.numbers(Bound::FromTo(0.0, 1.0))?;
    let &[body, counterbody] = given.as_slice() else {
        return Err(item.length(given.len(), 2, "for wearing body and counterbody"));
    };
    // Decimal shares such as 0.1 and 0.9 sum to 1 only up to rounding.
    let sum = body + counterbody;
    if (sum - 1.0).abs() > 1e-9 {
        return Err(item.error(Problem::ShareSum { key: item.path.clone(), sum }));
    }
    Ok([body, counterbody])
}

fn digest(item: &Item<'_>) -> Result<String, SceneError> {
    let text = item.text()?;
    let stranger = text.chars().find(|character| !character.is_ascii_hexdigit());
    let length = text.chars().count();
    if length != 64 || stranger.is_some() {
        return Err(item.error(Problem::Digest { key: item.path.clone(), length, stranger }));
    }
    Ok(text.to_ascii_lowercase())
}
