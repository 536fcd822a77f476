//! The scene's units: labels for reports, and their sizes in SI for whoever must tell dimensions apart.

use serde::{Serialize, Serializer};

use super::bound::Bound;
use super::contact::ModelKind;
use super::error::SceneError;
use super::reader::{Item, Section};

/// Lengths and their sizes in metres.
const LENGTHS: &[(&str, f64)] =
    &[("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("nm", 1e-9), ("cm", 1e-2), ("in", 0.0254)];
/// Forces and their sizes in newtons; a pound-force is 0.45359237 kg times 9.80665 m/s^2.
const FORCES: &[(&str, f64)] =
    &[("N", 1.0), ("kN", 1e3), ("MN", 1e6), ("mN", 1e-3), ("uN", 1e-6), ("µN", 1e-6), ("lbf", 4.448_221_615_260_5)];
/// Times and their sizes in seconds.
const TIMES: &[(&str, f64)] = &[("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("min", 60.0), ("h", 3600.0)];
/// Temperatures and their sizes in kelvins.
const TEMPERATURES: &[(&str, f64)] = &[("K", 1.0), ("C", 1.0), ("degC", 1.0), ("°C", 1.0)];

/// `[units]`: the labels of the scene's units; the numbers of a scene are never converted.
///
/// | key | labels |
/// | --- | --- |
/// | `length` | m (default), mm, um, µm, nm, cm, in |
/// | `force` | N (default), kN, MN, mN, uN, µN, lbf |
/// | `time` | s (default), ms, us, µs, min, h |
/// | `temperature` | K (default), C, degC, °C; the last three are one, with absolute zero at -273.15 |
/// | `reference_temperature` | a temperature of the scene that laws may ask for; not stated by default |
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Units {
    /// Unit of lengths.
    pub length: Unit,
    /// Unit of forces.
    pub force: Unit,
    /// Unit of times.
    pub time: Unit,
    /// Unit of temperatures.
    pub temperature: Unit,
    /// Reference temperature in the scene's units, if it is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_temperature: Option<f64>,
}

/// A label and its size in the SI unit of the same kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// The label as written.
    pub label: &'static str,
    /// How many SI units it is.
    pub size: f64,
}

impl Serialize for Unit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.label)
    }
}

/// How many SI units each unit of the scene is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sizes {
    /// Metres in the scene's length.
    pub metre: f64,
    /// Newtons in the scene's force.
    pub newton: f64,
    /// Seconds in the scene's time.
    pub second: f64,
    /// Kelvins in the scene's temperature.
    pub kelvin: f64,
    /// Kilograms in the scene's mass, which is force * time^2 / length.
    pub kilogram: f64,
}

impl Default for Units {
    fn default() -> Self {
        let first = |(label, size): (&'static str, f64)| Unit { label, size };
        Self {
            length: first(LENGTHS[0]),
            force: first(FORCES[0]),
            time: first(TIMES[0]),
            temperature: first(TEMPERATURES[0]),
            reference_temperature: None,
        }
    }
}

impl Units {
    /// Sizes of the units in SI.
    pub fn sizes(&self) -> Sizes {
        let (metre, newton, second) = (self.length.size, self.force.size, self.time.size);
        Sizes { metre, newton, second, kelvin: self.temperature.size, kilogram: newton * second * second / metre }
    }

    /// Temperature of absolute zero in the scene's unit: 0 for kelvins, -273.15 for degrees Celsius.
    pub fn absolute_zero(&self) -> f64 {
        if self.temperature.label == "K" { 0.0 } else { -273.15 }
    }

    /// The range of temperatures that exist.
    pub(super) fn temperatures(&self) -> Bound {
        Bound::AtLeast(self.absolute_zero())
    }

    pub(super) fn read(section: &Section<'_>, model: ModelKind) -> Result<Self, SceneError> {
        section.keys(
            &[("length", &[]), ("force", &[]), ("time", &[]), ("temperature", &[]), ("reference_temperature", &[])],
            model,
        )?;
        let unit = |key: &str, labels: &'static [(&'static str, f64)]| match section.get(key) {
            Some(item) => Unit::read(&item, labels),
            None => Ok(Unit { label: labels[0].0, size: labels[0].1 }),
        };
        let mut units = Self {
            length: unit("length", LENGTHS)?,
            force: unit("force", FORCES)?,
            time: unit("time", TIMES)?,
            temperature: unit("temperature", TEMPERATURES)?,
            reference_temperature: None,
        };
        let bound = units.temperatures();
        units.reference_temperature =
            section.get("reference_temperature").map(|item| item.number(bound)).transpose()?;
        Ok(units)
    }
}

impl Unit {
    /// Labels are told apart by case: `mN` is not `MN`.
    fn read(item: &Item<'_>, labels: &'static [(&'static str, f64)]) -> Result<Self, SceneError> {
        let found = item.text()?;
        if let Some(&(label, size)) = labels.iter().find(|(label, _)| *label == found) {
            return Ok(Self { label, size });
        }
        let words: Vec<&str> = labels.iter().map(|(label, _)| *label).collect();
        Err(item.unknown_label(&found, &words))
    }
}
