//! `[[step]]` and `[[cycle]]`: what the pair is put through.

use serde::Serialize;

use super::bound::{Bound, LARGEST_COUNT};
use super::contact::{Contact, Model, ModelKind, PRESCRIBED, SOLVED};
use super::drive::{Drive, Sliding};
use super::error::{Problem, SceneError};
use super::reader::{Item, Section, Word};
use super::tree::join;
use super::units::Units;

/// A piece of loading: `[[step]]` or `[[cycle.step]]`. Everything is constant over it but what `ramp` names.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Step {
    /// Represented time it takes, not negative. `None` only in the last step of a prescribed scene with a history and
    /// no cycle: to the end of the history.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
    /// What presses the bodies together; `None` only in a prescribed scene with a history.
    #[serde(flatten)]
    pub drive: Option<Drive>,
    /// What slides; `None`: nothing, or what the history says.
    #[serde(flatten)]
    pub sliding: Option<Sliding>,
    /// Radius around the apex within which nothing slips.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stick: Option<f64>,
    /// Temperature of all points; of a history only where it has no such column.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature: Option<f64>,
    /// Friction stress over pressure in this step of a prescribed scene, instead of `contact.friction`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// What goes linearly from its value at the end of the step before (0 before the first).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ramp: Vec<Quantity>,
}

/// What a ramp can change; the names are the keys of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// `load`.
    Load,
    /// `approach`.
    Approach,
    /// `pressure`.
    Pressure,
    /// `velocity`.
    Velocity,
    /// `temperature`.
    Temperature,
    /// `friction`.
    Friction,
}

/// `[[cycle]]`: a block of steps that repeats.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cycle {
    /// Represented number of cycles, at least 1.
    pub count: u64,
    /// The steps of one cycle; empty only in a prescribed scene with a history, which is then the cycle.
    #[serde(rename = "step", skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step>,
}

impl Word for Quantity {
    const ALL: &'static [(&'static str, Self)] = &[
        ("load", Self::Load),
        ("approach", Self::Approach),
        ("pressure", Self::Pressure),
        ("velocity", Self::Velocity),
        ("temperature", Self::Temperature),
        ("friction", Self::Friction),
    ];
}

/// Steps, then cycles, with the key paths that changed on the way (as written, as they are now).
pub(super) struct Loading {
    pub(super) steps: Vec<Step>,
    pub(super) cycles: Vec<Cycle>,
    pub(super) moved: Vec<(String, String)>,
}

/// What steps are read against.
struct Setting<'a> {
    model: ModelKind,
    history: bool,
    units: &'a Units,
}

impl Loading {
    /// Reads the loading in written order. A step written after a cycle becomes a cycle of one, so that the order is
    /// steps first, cycles after, and survives formats that keep no order between keys.
    pub(super) fn read(root: &Section<'_>, contact: &Contact, units: &Units) -> Result<Self, SceneError> {
        let history = matches!(&contact.model, Model::Prescribed(prescribed) if prescribed.history.is_some());
        let setting = Setting { model: contact.model.kind(), history, units };
        let steps = root.get("step").map(|item| item.list("load steps, [[step]]")).transpose()?.unwrap_or_default();
        let cycles = root.get("cycle").map(|item| item.list("cycles, [[cycle]]")).transpose()?.unwrap_or_default();
        if steps.is_empty() && cycles.is_empty() && !history {
            let reason = match setting.model {
                ModelKind::Prescribed => "because there is no `contact.history` that says what happens",
                _ => "because nothing else says what happens",
            };
            return Err(root.missing("step", reason));
        }
        let mut loading = Self { steps: Vec::new(), cycles: Vec::new(), moved: Vec::new() };
        // Whole lists from an override have no place in the file: steps come first then, cycles last.
        let place = |item: &Item<'_>, other| {
            if item.node.place.text == 0 { item.node.place.span.start } else { other }
        };
        let mut blocks: Vec<(usize, bool, &Item<'_>)> =
            steps.iter().map(|item| (place(item, 0), false, item)).collect();
        blocks.extend(cycles.iter().map(|item| (place(item, usize::MAX), true, item)));
        blocks.sort_by_key(|(start, _, _)| *start);
        let mut before: Option<(String, Step)> = None;
        let last = blocks.len().saturating_sub(1);
        for (index, (_, is_cycle, item)) in blocks.into_iter().enumerate() {
            if is_cycle {
                let cycle = Cycle::read(item, &setting, &mut before)?;
                loading.moved.push((item.path.clone(), join("cycle", &loading.cycles.len().to_string())));
                loading.cycles.push(cycle);
                continue;
            }
            let open = history && index == last && cycles.is_empty();
            let step = Step::read(item, &setting, open)?;
            step.check_ramp(item, before.as_ref())?;
            before = Some((item.path.clone(), step.clone()));
            if loading.cycles.is_empty() {
                loading.steps.push(step);
            } else {
                loading.moved.push((item.path.clone(), format!("cycle.{}.step.0", loading.cycles.len())));
                loading.cycles.push(Cycle { count: 1, steps: vec![step] });
            }
        }
        Ok(loading)
    }
}

impl Cycle {
    fn read(item: &Item<'_>, setting: &Setting<'_>, before: &mut Option<(String, Step)>) -> Result<Self, SceneError> {
        let section = item.section()?;
        section.keys(&[("count", &[]), ("step", &[])], setting.model)?;
        let count = section.need("count")?.count(1, LARGEST_COUNT)?;
        let items =
            section.get("step").map(|item| item.list("load steps, [[cycle.step]]")).transpose()?.unwrap_or_default();
        if items.is_empty() && !setting.history {
            return Err(section.missing("step", "because nothing else says what repeats"));
        }
        let steps = items.iter().map(|item| Step::read(item, setting, false)).collect::<Result<Vec<_>, _>>()?;
        for (index, (item, step)) in items.iter().zip(&steps).enumerate() {
            step.check_ramp(item, before.as_ref())?;
            // The first step of a cycle also comes after the last one.
            if index == 0
                && count > 1
                && let (Some(item_before), Some(step_before)) = (items.last(), steps.last())
            {
                step.check_ramp(item, Some(&(item_before.path.clone(), step_before.clone())))?;
            }
            *before = Some((item.path.clone(), step.clone()));
        }
        Ok(Self { count, steps })
    }
}

impl Step {
    fn read(item: &Item<'_>, setting: &Setting<'_>, open: bool) -> Result<Self, SceneError> {
        let section = item.section()?;
        section.keys(
            &[
                ("duration", &[]),
                ("load", SOLVED),
                ("approach", SOLVED),
                ("pressure", PRESCRIBED),
                ("velocity", &[]),
                ("stroke", &[]),
                ("frequency", &[]),
                ("stick", SOLVED),
                ("temperature", &[]),
                ("friction", PRESCRIBED),
                ("ramp", &[]),
            ],
            setting.model,
        )?;
        let duration = match section.get("duration") {
            Some(item) => Some(item.number(Bound::AtLeast(0.0))?),
            None if open => None,
            None => return Err(section.missing("duration", "")),
        };
        let temperatures = setting.units.temperatures();
        Ok(Self {
            duration,
            drive: Drive::read(&section, setting.model, setting.history)?,
            sliding: Sliding::read(&section)?,
            stick: section.get("stick").map(|item| item.number(Bound::AtLeast(0.0))).transpose()?,
            temperature: section.get("temperature").map(|item| item.number(temperatures)).transpose()?,
            friction: section.get("friction").map(|item| item.number(Bound::AtLeast(0.0))).transpose()?,
            ramp: match section.get("ramp") {
                Some(item) => item.list("a list of keys")?.iter().map(Item::word).collect::<Result<_, _>>()?,
                None => Vec::new(),
            },
        })
    }

    /// Whether the step gives this quantity as one number.
    pub fn gives(&self, quantity: Quantity) -> bool {
        match quantity {
            Quantity::Load => matches!(self.drive, Some(Drive::Load(_))),
            Quantity::Approach => matches!(self.drive, Some(Drive::Approach(_))),
            Quantity::Pressure => matches!(self.drive, Some(Drive::Pressure(_))),
            // A stroke is a speed too.
            Quantity::Velocity => self.sliding.is_some(),
            Quantity::Temperature => self.temperature.is_some(),
            Quantity::Friction => self.friction.is_some(),
        }
    }

    /// A ramp needs both its ends: this step and, unless it is the first, the step before give the quantity.
    fn check_ramp(&self, item: &Item<'_>, before: Option<&(String, Self)>) -> Result<(), SceneError> {
        for &quantity in &self.ramp {
            let key = join(&item.path, "ramp");
            let name = quantity.word().to_owned();
            if !self.gives(quantity) {
                return Err(item.section()?.error("ramp", Problem::RampWithoutEnd { key, quantity: name }));
            }
            if let Some((path, step)) = before
                && !step.gives(quantity)
            {
                let problem = Problem::RampWithoutStart { key, quantity: name, before: path.clone() };
                return Err(item.section()?.error("ramp", problem));
            }
        }
        Ok(())
    }
}
