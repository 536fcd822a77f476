//! `[contact]`: where the contact pressure comes from, and what it takes.

use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

use super::bound::Bound;
use super::error::{Problem, SceneError};
use super::reader::{Key, Section, Word};

/// The contact models by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ModelKind {
    /// The pressure is given.
    Prescribed,
    /// Independent springs (Winkler).
    Foundation,
    /// Elastic half-space.
    HalfSpace,
}

impl Word for ModelKind {
    const ALL: &'static [(&'static str, Self)] =
        &[("prescribed", Self::Prescribed), ("foundation", Self::Foundation), ("halfspace", Self::HalfSpace)];
}

impl fmt::Display for ModelKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// Models in which the pressure follows from the gap.
pub(super) const SOLVED: &[ModelKind] = &[ModelKind::Foundation, ModelKind::HalfSpace];
/// The model in which it does not.
pub(super) const PRESCRIBED: &[ModelKind] = &[ModelKind::Prescribed];
const HALFSPACE: &[ModelKind] = &[ModelKind::HalfSpace];
const FOUNDATION: &[ModelKind] = &[ModelKind::Foundation];

/// `[contact]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Contact {
    /// The model with the keys that belong to it.
    #[serde(flatten)]
    pub model: Model,
    /// 2 (plane strain, loads per length) or 3 (the default).
    pub dimension: u8,
    /// Friction stress over pressure where the point slides, for laws that read a friction stress.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
}

/// The contact model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "model", rename_all = "lowercase")]
pub enum Model {
    /// The pressure is given by a history or by the steps.
    Prescribed(Prescribed),
    /// Independent springs (Winkler).
    Foundation(Foundation),
    /// Elastic half-space.
    HalfSpace(HalfSpace),
}

/// Keys of `model = "prescribed"`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Prescribed {
    /// History of pressure and sliding in CSV or NPZ; `None`: the steps give a uniform pressure at one point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub history: Option<PathBuf>,
}

/// Keys of `model = "foundation"`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Foundation {
    /// Pressure per length of compression.
    pub stiffness: f64,
    /// Complementarity error at which the contact is solved: sum p (gap - smallest gap) / (sum p * std of the initial gap).
    pub tolerance: f64,
}

/// Keys of `model = "halfspace"`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HalfSpace {
    /// Stiffness of the pair.
    #[serde(flatten)]
    pub elasticity: Elasticity,
    /// What lies beyond the grid.
    pub boundary: Boundary,
    /// Complementarity error at which the contact is solved: sum p (gap - smallest gap) / (sum p * std of the initial gap).
    pub tolerance: f64,
    /// Distance at which the displacement is zero; given in 2-D free contact under `approach`, and only there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub datum: Option<f64>,
}

/// Stiffness of a half-space pair: `modulus` or `bodies`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Elasticity {
    /// The contact modulus E*.
    Modulus(f64),
    /// Both bodies: 1/E* = sum (1 - nu^2)/E.
    Bodies([Body; 2]),
}

/// An elastic body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Body {
    /// Young's modulus; infinity cannot be written, a rigid body is `modulus` of the other.
    #[serde(rename = "E")]
    pub young: f64,
    /// Poisson's ratio, above -1 and up to 0.5.
    #[serde(rename = "nu")]
    pub poisson: f64,
}

/// What lies beyond the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// Free surface.
    #[default]
    Free,
    /// The same grid again.
    Periodic,
}

impl Word for Boundary {
    const ALL: &'static [(&'static str, Self)] = &[("free", Self::Free), ("periodic", Self::Periodic)];
}

impl Model {
    /// Complementarity error below the grid error of any grid that fits in memory.
    pub const TOLERANCE: f64 = 1e-8;

    /// The model's name.
    pub fn kind(&self) -> ModelKind {
        match self {
            Self::Prescribed(_) => ModelKind::Prescribed,
            Self::Foundation(_) => ModelKind::Foundation,
            Self::HalfSpace(_) => ModelKind::HalfSpace,
        }
    }
}

impl Elasticity {
    /// The contact modulus E*, from 1/E* = sum (1 - nu^2)/E.
    pub fn modulus(&self) -> f64 {
        match self {
            Self::Modulus(modulus) => *modulus,
            Self::Bodies(bodies) => {
                bodies.iter().map(|body| (1.0 - body.poisson * body.poisson) / body.young).sum::<f64>().recip()
            }
        }
    }
}

const KEYS: &[Key] = &[
    ("model", &[]),
    ("dimension", &[]),
    ("friction", &[]),
    ("history", PRESCRIBED),
    ("stiffness", FOUNDATION),
    ("tolerance", SOLVED),
    ("modulus", HALFSPACE),
    ("bodies", HALFSPACE),
    ("boundary", HALFSPACE),
    ("datum", HALFSPACE),
];

impl Contact {
    pub(super) fn read(section: &Section<'_>) -> Result<Self, SceneError> {
        let kind: ModelKind = match section.get("model") {
            Some(item) => item.word()?,
            // A misspelt `model` is the better thing to say; keys of some model cannot be judged yet.
            None => match section.keys(KEYS, ModelKind::HalfSpace) {
                Err(error) if matches!(*error.problem, Problem::UnknownKey { .. }) => {
                    return Err(error);
                }
                _ => return Err(section.missing("model", "")),
            },
        };
        section.keys(KEYS, kind)?;
        let dimension = section.get("dimension").map(|item| item.count(2, 3)).transpose()?.unwrap_or(3);
        let tolerance = section.get("tolerance").map(|item| item.number(Bound::Between(0.0, 1.0))).transpose()?;
        let tolerance = tolerance.unwrap_or(Model::TOLERANCE);
        let model = match kind {
            ModelKind::Prescribed => {
                Model::Prescribed(Prescribed { history: section.get("history").map(|item| item.path()).transpose()? })
            }
            ModelKind::Foundation => {
                let stiffness = section.need("stiffness")?.number(Bound::Above(0.0))?;
                Model::Foundation(Foundation { stiffness, tolerance })
            }
            ModelKind::HalfSpace => Model::HalfSpace(HalfSpace {
                elasticity: Elasticity::read(section)?,
                boundary: section.get("boundary").map(|item| item.word()).transpose()?.unwrap_or_default(),
                tolerance,
                datum: section.get("datum").map(|item| item.number(Bound::Above(0.0))).transpose()?,
            }),
        };
        let friction = section.get("friction").map(|item| item.number(Bound::AtLeast(0.0))).transpose()?;
        Ok(Self { model, dimension: dimension as u8, friction })
    }
}

impl Elasticity {
    fn read(section: &Section<'_>) -> Result<Self, SceneError> {
        section.at_most_one(&["modulus", "bodies"])?;
        if let Some(item) = section.get("modulus") {
            return item.number(Bound::Above(0.0)).map(Self::Modulus);
        }
        let Some(item) = section.get("bodies") else {
            return Err(section.missing("modulus` or `bodies", "because a half-space is elastic"));
        };
        let list = item.list("two bodies, [{ E = .., nu = .. }, { .. }]")?;
        let [first, second] = list.as_slice() else {
            return Err(item.length(list.len(), 2, "because two bodies touch"));
        };
        let body = |section: Section<'_>| {
            section.keys(&[("E", &[]), ("nu", &[])], ModelKind::HalfSpace)?;
            let young = section.need("E")?.number(Bound::Above(0.0))?;
            let poisson = section.need("nu")?.number(Bound::AboveUpTo(-1.0, 0.5))?;
            Ok(Body { young, poisson })
        };
        Ok(Self::Bodies([body(first.section()?)?, body(second.section()?)?]))
    }
}
