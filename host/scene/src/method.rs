//! `[integrator]`, `[scaling]` and `[stop]`: how wear is advanced, how it is sped up, and when it ends early.

use serde::{Serialize, Serializer};

use super::bound::{Bound, LARGEST_COUNT};
use super::contact::{ModelKind, SOLVED};
use super::error::SceneError;
use super::reader::{Section, Word};

/// How wear depth is advanced in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The plan picks, and says what and why.
    #[default]
    Auto,
    /// Forward Euler.
    ExplicitEuler,
    /// Backward Euler.
    ImplicitEuler,
    /// TR-BDF2 in its DIRK form.
    TrBdf2,
    /// Two-stage SDIRK of order 2.
    Sdirk2,
}

/// What an explicit step over the stability limit does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BeyondLimit {
    /// It is refused; the safe default, because an unstable run looks plausible.
    #[default]
    Refuse,
    /// It is cut into stable steps.
    Substep,
    /// It is taken, and the result is marked unstable.
    Run,
}

/// What sets the size of the substeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Accuracy {
    /// Relative L2 error of the wear profile at the end; above 0 and below 1.
    Tolerance(f64),
    /// Fixed number of substeps per load step, at least 1.
    Substeps(u64),
}

/// `[integrator]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Integrator {
    /// The method.
    pub method: Method,
    /// `tolerance` or `substeps`.
    #[serde(flatten)]
    pub accuracy: Accuracy,
    /// What an explicit step over the stability limit does; prescribed scenes have no limit and no such key.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_limit: Option<BeyondLimit>,
    /// A law's wish for a step below this is an error; `None`: no such limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest_step: Option<f64>,
    /// Most substeps between two events of the loading; `None`: [`Integrator::MOST_SUBSTEPS`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most_substeps: Option<u64>,
}

/// Which scaling of the wear increment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ScalingKind {
    /// None.
    #[default]
    None,
    /// Per substep (AUTS).
    Auto,
    /// Cycle by cycle (CBCS).
    Cycle,
}

/// `[scaling]`. All keys stay `None` where the scene is silent, because a command file may say the same thing.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Scaling {
    /// Which scaling; the default is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kind: Option<ScalingKind>,
    /// Safety factor C1, above 0 and below 1; the default is [`Scaling::SAFETY`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub safety: Option<f64>,
    /// Largest factor C2, at least 1; the default is [`Scaling::MAXIMUM`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maximum: Option<f64>,
}

/// `[stop]`: ends the run early; `None`: never.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Stop {
    /// Largest wear depth of any point.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear_depth: Option<f64>,
    /// Wear volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear_volume: Option<f64>,
}

impl Word for Method {
    const ALL: &'static [(&'static str, Self)] = &[
        ("auto", Self::Auto),
        ("explicit-euler", Self::ExplicitEuler),
        ("implicit-euler", Self::ImplicitEuler),
        ("tr-bdf2", Self::TrBdf2),
        ("sdirk2", Self::Sdirk2),
    ];
}

impl Word for BeyondLimit {
    const ALL: &'static [(&'static str, Self)] =
        &[("refuse", Self::Refuse), ("substep", Self::Substep), ("run", Self::Run)];
}

impl Word for ScalingKind {
    const ALL: &'static [(&'static str, Self)] = &[("none", Self::None), ("auto", Self::Auto), ("cycle", Self::Cycle)];
}

impl Default for Accuracy {
    /// 1e-4, an order below what wear coefficients are known to.
    fn default() -> Self {
        Self::Tolerance(1e-4)
    }
}

impl Serialize for Accuracy {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Tolerance(tolerance) => serializer.collect_map([("tolerance", tolerance)]),
            Self::Substeps(substeps) => serializer.collect_map([("substeps", substeps)]),
        }
    }
}

impl Integrator {
    /// Most substeps between two events of the loading, where a scene does not say.
    pub const MOST_SUBSTEPS: u64 = 100_000;

    pub(super) fn read(section: &Section<'_>, model: ModelKind) -> Result<Self, SceneError> {
        section.keys(
            &[
                ("method", &[]),
                ("tolerance", &[]),
                ("substeps", &[]),
                ("beyond_limit", SOLVED),
                ("smallest_step", &[]),
                ("most_substeps", &[]),
            ],
            model,
        )?;
        section.at_most_one(&["tolerance", "substeps"])?;
        let accuracy = match (section.get("tolerance"), section.get("substeps")) {
            (Some(item), _) => Accuracy::Tolerance(item.number(Bound::Between(0.0, 1.0))?),
            (None, Some(item)) => Accuracy::Substeps(item.count(1, LARGEST_COUNT)?),
            (None, None) => Accuracy::default(),
        };
        Ok(Self {
            method: section.get("method").map(|item| item.word()).transpose()?.unwrap_or_default(),
            accuracy,
            beyond_limit: section.get("beyond_limit").map(|item| item.word()).transpose()?,
            smallest_step: section.get("smallest_step").map(|item| item.number(Bound::Above(0.0))).transpose()?,
            most_substeps: section.get("most_substeps").map(|item| item.count(1, LARGEST_COUNT)).transpose()?,
        })
    }
}

impl Scaling {
    /// Whether the scene is silent about it.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Safety factor of the public documents.
    pub const SAFETY: f64 = 0.1;
    /// Largest factor of the public documents.
    pub const MAXIMUM: f64 = 1e5;

    pub(super) fn read(section: &Section<'_>, model: ModelKind) -> Result<Self, SceneError> {
        section.keys(&[("kind", &[]), ("safety", &[]), ("maximum", &[])], model)?;
        Ok(Self {
            kind: section.get("kind").map(|item| item.word()).transpose()?,
            safety: section.get("safety").map(|item| item.number(Bound::Between(0.0, 1.0))).transpose()?,
            maximum: section.get("maximum").map(|item| item.number(Bound::AtLeast(1.0))).transpose()?,
        })
    }
}

impl Stop {
    /// Whether the scene is silent about it.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn read(section: &Section<'_>, model: ModelKind) -> Result<Self, SceneError> {
        section.keys(&[("wear_depth", &[]), ("wear_volume", &[])], model)?;
        let positive = |key: &str| section.get(key).map(|item| item.number(Bound::Above(0.0))).transpose();
        Ok(Self { wear_depth: positive("wear_depth")?, wear_volume: positive("wear_volume")? })
    }
}
