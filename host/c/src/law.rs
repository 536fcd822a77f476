//! A law as a solver has opened it: where it comes from, what the solver provides, what it says of itself.
#![allow(unsafe_code)] // reason: reads texts of the solver's.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use wearlaw::law::isolate::DEADLINE;
use wearlaw::law::lookup::{LawSource, find};
use wearlaw::law::{
    CallNumbers, Evaluator, Field, Fields, IsolateOptions, IsolatedLaw, LoadOptions, Plugin, Quantity, UnitSizes,
    embedded,
};
use wearlaw_plugin_api::abi as law_abi;

use crate::abi::{Description, Solver, Source};
use crate::boundary::{put, text};
use crate::columns::how_to_provide;
use crate::error::HostError;
use crate::handle::Kind;

/// An open law. Surfaces keep it open after its handle is closed.
pub(crate) struct OpenLaw {
    pub(crate) evaluator: Box<dyn Evaluator>,
    pub(crate) provides: Fields,
    /// Dimension, units and temperature scale; the rest is the substep's.
    pub(crate) numbers: CallNumbers,
    warnings: Mutex<Vec<String>>,
}

impl Kind for Arc<OpenLaw> {
    const MAGIC: u64 = u64::from_ne_bytes(*b"wl_law_1");
    const NAME: &'static str = "law";
}

impl OpenLaw {
    /// Opens a law for a solver.
    ///
    /// # Safety
    /// Texts of `source` are NULL or ended by a NUL.
    pub(crate) unsafe fn new(source: &Source, solver: &Solver) -> Result<Self, HostError> {
        let provides = Fields::from_bits(solver.provides);
        if provides.unknown() != 0 {
            return Err(HostError::Field { bits: provides.unknown() });
        }
        let numbers = numbers(solver)?;
        // SAFETY: as the caller says.
        let (evaluator, warnings) = unsafe { opened(source) }?;
        let law = evaluator.descriptor();
        if let Some(field) = law.reads.difference(provides).iter().next() {
            return Err(HostError::NotProvided {
                law: law.name.clone(),
                field: field.name(),
                constant: format!("WL_FIELD_{}", field.name().to_uppercase()),
                how: how_to_provide(field),
            });
        }
        Ok(Self { evaluator, provides, numbers, warnings: Mutex::new(warnings) })
    }

    /// What the law says of itself.
    pub(crate) fn description(&self) -> Description {
        let law = self.evaluator.descriptor();
        let mut description = Description {
            struct_size: 0,
            reads: law.reads.bits(),
            uses: law.uses.bits(),
            writes: law.writes.bits(),
            claims: law.claims.bits(),
            flags: law.flags.bits(),
            constant_count: law.constants.len() as i64,
            state_count: law.state.len() as i64,
            input_count: law.inputs.len() as i64,
            name: [0; law_abi::WL_NAME_SIZE],
            version: [0; law_abi::WL_VERSION_SIZE],
        };
        put(&mut description.name, &law.name);
        put(&mut description.version, &law.version);
        description
    }

    /// One constant, state variable or further input.
    pub(crate) fn quantity(&self, kind: i32, index: i64) -> Result<law_abi::Quantity, HostError> {
        let law = self.evaluator.descriptor();
        let (what, all) = match kind {
            law_abi::WL_KIND_CONSTANT => ("constants", &law.constants),
            law_abi::WL_KIND_STATE => ("state variables", &law.state),
            law_abi::WL_KIND_INPUT => ("inputs", &law.inputs),
            _ => {
                let expected = "WL_KIND_CONSTANT, WL_KIND_STATE or WL_KIND_INPUT".to_owned();
                return Err(HostError::Number { what: "kind".to_owned(), found: kind.to_string(), expected });
            }
        };
        let found = usize::try_from(index).ok().and_then(|index| all.get(index));
        found.map(in_c).ok_or_else(|| HostError::Number {
            what: "index".to_owned(),
            found: index.to_string(),
            expected: format!("0 or more and less than {}, the number of {what} of law `{}`", all.len(), law.name),
        })
    }

    /// Takes the warnings that have come up since the last time.
    pub(crate) fn take_warnings(&self) -> String {
        let mut all = std::mem::take(&mut *self.warnings.lock().unwrap_or_else(PoisonError::into_inner));
        all.extend(self.evaluator.take_warnings());
        all.join("\n")
    }
}

/// Finds a law by its name and opens it, here or in a process of its own.
///
/// # Safety
/// Texts of `source` are NULL or ended by a NUL.
unsafe fn opened(source: &Source) -> Result<(Box<dyn Evaluator>, Vec<String>), HostError> {
    // SAFETY: as the caller says.
    let text = |pointer, what| unsafe { text(pointer, what) };
    let name = text(source.name, "wlh_source.name")?.ok_or(HostError::Null("wlh_source.name"))?;
    let sha256 = text(source.sha256, "wlh_source.sha256")?.map(str::to_owned);
    let options = text(source.options, "wlh_source.options")?;
    let worker = text(source.worker, "wlh_source.worker")?;
    let deadline = deadline(source.deadline)?;
    let found = find(name, Path::new(""))?;
    let origin = match found.source {
        LawSource::Embedded(name) => wearlaw::law::Source::Embedded(name.to_owned()),
        LawSource::Library(path) => wearlaw::law::Source::File(path),
        LawSource::Source(path) => return Err(HostError::IsSource(path.display().to_string())),
    };
    if let Some(program) = worker {
        let wanted = IsolateOptions {
            sha256,
            law: found.law,
            options: options.map(str::to_owned),
            deadline,
            program: Some(PathBuf::from(program)),
            ..IsolateOptions::new(origin)
        };
        return Ok((Box::new(IsolatedLaw::open(&wanted)?), Vec::new()));
    }
    let plugin = match &origin {
        wearlaw::law::Source::File(path) => Plugin::open(path, &LoadOptions { sha256 })?,
        // `find` gives no other names than those of embedded laws.
        wearlaw::law::Source::Embedded(name) => {
            let entry = embedded::entry(name).ok_or_else(|| HostError::Internal(format!("no law `{name}`")))?;
            Plugin::from_entry(entry)?
        }
    };
    let law = plugin.law(found.law.as_deref())?.create(options)?;
    Ok((Box::new(law), plugin.warnings().to_vec()))
}

fn deadline(seconds: f64) -> Result<Duration, HostError> {
    if seconds == 0.0 {
        return Ok(DEADLINE);
    }
    Duration::try_from_secs_f64(seconds).map_err(|_| HostError::Number {
        what: "wlh_source.deadline".to_owned(),
        found: seconds.to_string(),
        expected: "seconds above 0, or 0 for 60".to_owned(),
    })
}

/// The numbers that hold for everything a solver asks.
fn numbers(solver: &Solver) -> Result<CallNumbers, HostError> {
    let wrong = |what: &str, found: String, expected: &str| HostError::Number {
        what: format!("wlh_solver.{what}"),
        found,
        expected: expected.to_owned(),
    };
    if ![2, 3].contains(&solver.dimension) {
        return Err(wrong("dimension", solver.dimension.to_string(), "2 or 3"));
    }
    let size = |what: &str, found: f64| match found {
        0.0 => Ok(1.0),
        size if size > 0.0 && size.is_finite() => Ok(size),
        _ => Err(wrong(what, found.to_string(), "a finite number above 0, or 0 for 1")),
    };
    let finite = |what: &str, found: f64| {
        if found.is_finite() { Ok(found) } else { Err(wrong(what, found.to_string(), "a finite number")) }
    };
    Ok(CallNumbers {
        dimension: solver.dimension,
        units: UnitSizes {
            metre: size("unit_metre", solver.unit_metre)?,
            kilogram: size("unit_kilogram", solver.unit_kilogram)?,
            second: size("unit_second", solver.unit_second)?,
            kelvin: size("unit_kelvin", solver.unit_kelvin)?,
        },
        absolute_zero: finite("absolute_zero", solver.absolute_zero)?,
        reference_temperature: finite("reference_temperature", solver.reference_temperature)?,
        ..CallNumbers::default()
    })
}

/// A quantity as C has it: bounds and default in SI units.
fn in_c(quantity: &Quantity) -> law_abi::Quantity {
    let flag = |set: bool, bit: i64| if set { bit } else { 0 };
    let [metre, kilogram, second, kelvin] = quantity.exponents;
    let mut found = law_abi::Quantity {
        struct_size: 0,
        name: [0; law_abi::WL_NAME_SIZE],
        summary: [0; law_abi::WL_SUMMARY_SIZE],
        metre,
        kilogram,
        second,
        kelvin,
        minimum: quantity.minimum,
        maximum: quantity.maximum,
        default_value: quantity.default.unwrap_or(f64::NAN),
        flags: flag(quantity.closes_units, law_abi::WL_QUANTITY_CLOSES_UNITS)
            | flag(quantity.above_minimum, law_abi::WL_QUANTITY_ABOVE_MINIMUM)
            | flag(quantity.below_maximum, law_abi::WL_QUANTITY_BELOW_MAXIMUM),
    };
    put(&mut found.name, &quantity.name);
    put(&mut found.summary, &quantity.summary);
    found
}

/// The field of one bit.
pub(crate) fn field_of(bits: i64) -> Result<Field, HostError> {
    let fields = Fields::from_bits(bits);
    let mut known = fields.iter();
    match (known.next(), known.next(), fields.unknown()) {
        (Some(field), None, 0) => Ok(field),
        _ => Err(HostError::Field { bits }),
    }
}
