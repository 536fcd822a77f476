//! What a step does to the pair: how it is pressed together and how it slides.

use std::path::PathBuf;

use serde::Serialize;

use super::bound::Bound;
use super::contact::ModelKind;
use super::error::{Problem, SceneError};
use super::reader::Section;

/// What presses the bodies together: `load`, `approach` or `pressure`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Drive {
    /// Total load, not negative; per length in 2-D.
    Load(f64),
    /// Rigid-body approach.
    Approach(f64),
    /// The same contact pressure at every point, not negative; prescribed scenes without a history.
    Pressure(f64),
}

/// What slides: `velocity`, or `stroke` with `frequency`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Sliding {
    /// Sliding velocity, whose sign says nothing about wear.
    Velocity {
        /// One for all points or one for each.
        velocity: Field,
    },
    /// Back and forth at the constant speed 2 * stroke * frequency.
    Stroke {
        /// One-way travel, twice the amplitude.
        stroke: f64,
        /// Full turns per time.
        frequency: f64,
    },
}

/// A number for all points or a file with one for each.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Field {
    /// The same everywhere.
    Uniform(f64),
    /// From a file.
    File(PathBuf),
}

impl Drive {
    pub(super) fn read(section: &Section<'_>, model: ModelKind, history: bool) -> Result<Option<Self>, SceneError> {
        section.at_most_one(&["load", "approach"])?;
        if let Some(item) = section.get("load") {
            return item.number(Bound::AtLeast(0.0)).map(|load| Some(Self::Load(load)));
        }
        if let Some(item) = section.get("approach") {
            return item.number(Bound::Finite).map(|approach| Some(Self::Approach(approach)));
        }
        if let Some(item) = section.get("pressure") {
            if history {
                let first = "contact.history".to_owned();
                return Err(section.error("pressure", Problem::Both { first, second: item.path }));
            }
            return item.number(Bound::AtLeast(0.0)).map(|pressure| Some(Self::Pressure(pressure)));
        }
        match model {
            ModelKind::Prescribed if history => Ok(None),
            ModelKind::Prescribed => Err(section.missing("pressure", "because there is no `contact.history`")),
            _ => Err(section.missing("load` or `approach", "to press the bodies together")),
        }
    }
}

impl Sliding {
    pub(super) fn read(section: &Section<'_>) -> Result<Option<Self>, SceneError> {
        section.at_most_one(&["velocity", "stroke"])?;
        section.at_most_one(&["velocity", "frequency"])?;
        if let Some(item) = section.get("velocity") {
            let velocity = match item.number(Bound::Finite) {
                Ok(velocity) => Field::Uniform(velocity),
                Err(error) if matches!(*error.problem, Problem::WrongType { .. }) => match item.text() {
                    Ok(_) => Field::File(item.path()?),
                    Err(_) => return Err(item.wrong("a number or the path of a file")),
                },
                Err(error) => return Err(error),
            };
            return Ok(Some(Self::Velocity { velocity }));
        }
        match (section.get("stroke"), section.get("frequency")) {
            (None, None) => Ok(None),
            (Some(item), None) => Err(section.error("stroke", Problem::Alone { key: item.path, partner: "frequency" })),
            (None, Some(item)) => Err(section.error("frequency", Problem::Alone { key: item.path, partner: "stroke" })),
            (Some(stroke), Some(frequency)) => Ok(Some(Self::Stroke {
                stroke: stroke.number(Bound::AtLeast(0.0))?,
                frequency: frequency.number(Bound::AtLeast(0.0))?,
            })),
        }
    }
}
