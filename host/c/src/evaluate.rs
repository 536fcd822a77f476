//! One evaluation of a surface: what is checked before it, what the law is lent, what it came to.
#![allow(unsafe_code)] // reason: lends the solver's arrays to the law for a call.

use std::ops::Range;
use std::sync::Arc;

use wearlaw::law::{Batch, CallNumbers, Evaluation, Field, Fields, LawDescriptor, PointInputs, Values};
use wearlaw::plan::ConstantTable;
use wearlaw_plugin_api::abi as law_abi;

use crate::abi;
use crate::columns::{Column, how_to_provide};
use crate::error::HostError;
use crate::surface::Surface;
use crate::written::Written;

/// What an evaluation came to, beside its arrays.
pub(crate) struct Evaluated {
    pub(crate) result: Result<Evaluation, HostError>,
    /// The first point that it speaks of.
    pub(crate) point: Option<usize>,
}

impl Surface {
    /// Evaluates the law over a substep.
    ///
    /// # Safety
    /// Columns are where they were when they were set, outputs are as long as they say; nobody else uses either.
    pub(crate) unsafe fn evaluate(&mut self, step: &abi::Step, outputs: &abi::Outputs) -> Evaluated {
        self.may_commit = false;
        // SAFETY: as the caller says.
        let mut result = unsafe { self.evaluated(step, outputs) };
        let point = match &mut result {
            Ok(evaluation) => evaluation.at_mut().map(|at| at.point),
            Err(HostError::Evaluate(error)) => error.at_mut().map(|at| at.point),
            Err(_) => None,
        };
        self.may_commit = matches!(result, Ok(Evaluation::Good | Evaluation::Unreliable { .. }));
        Evaluated { result, point }
    }

    /// # Safety
    /// As for [`Surface::evaluate`].
    unsafe fn evaluated(&mut self, step: &abi::Step, outputs: &abi::Outputs) -> Result<Evaluation, HostError> {
        let numbers = numbers(step, &self.law.numbers)?;
        let written = Written::new(outputs, self.points)?;
        self.is_apart(&written)?;
        self.has_start()?;
        let table = self.constants.as_ref().map_err(Clone::clone)?;
        let law = Arc::clone(&self.law);
        let descriptor = law.evaluator.descriptor();
        self.has_everything(descriptor, table)?;
        if self.points == 0 {
            return Ok(Evaluation::Good);
        }
        let temperature = match self.reals[Field::Temperature as usize] {
            // SAFETY: as the caller says.
            Some(column) if table.varies_in_temperature() => unsafe { column.values() },
            _ => Values::Absent,
        };
        is_finite(&temperature)?;
        let constants = table.at(numbers.time + 0.5 * numbers.dt, &temperature, self.points, &mut self.room);
        // SAFETY: as the caller says.
        let inputs =
            self.inputs.iter().map(|column| column.map_or(Values::Absent, |column| unsafe { column.values() }));
        let inputs: Vec<Values<'_>> = inputs.collect();
        let mut batch = Batch::builder(descriptor, self.points)
            .numbers(numbers)
            .constant_values(&constants)
            .inputs(&inputs)
            .state(Values::PerPoint(&self.start));
        for field in descriptor.fields().iter() {
            if let Some(column) = self.reals[field as usize] {
                // SAFETY: as the caller says.
                batch = batch.field(field, unsafe { column.values() });
            }
            if let Some(column) = self.integers[field as usize] {
                // SAFETY: as the caller says.
                batch = batch.indices(field, unsafe { column.indices() });
            }
        }
        // SAFETY: as the caller says; they were found to overlap nothing.
        let mut outputs = unsafe { written.outputs() };
        outputs.state = (!self.end.is_empty()).then_some(self.end.as_mut_slice());
        Ok(law.evaluator.evaluate(&batch.build()?, &mut outputs)?)
    }

    /// Looks for inputs that the law needs and the solver has not set.
    fn has_everything(&self, law: &LawDescriptor, table: &ConstantTable) -> Result<(), HostError> {
        let is_set = |field: Field| self.reals[field as usize].is_some() || self.integers[field as usize].is_some();
        let not_set = |name: &str, remedy: String| {
            Err(HostError::NotSet { law: law.name.clone(), name: name.to_owned(), remedy })
        };
        let wanted = if table.varies_in_temperature() { Fields::EMPTY.with(Field::Temperature) } else { Fields::EMPTY };
        // NULL is what an array of no points may be.
        let missing = law.reads.union(wanted).iter().find(|field| !is_set(*field) && self.points > 0);
        if let Some(field) = missing {
            let how = how_to_provide(field);
            let constant = field.name().to_uppercase();
            let why = if law.reads.contains(field) { "" } else { "its constants are a table over temperature; " };
            return not_set(field.name(), format!("{why}set WL_FIELD_{constant}, {how}"));
        }
        let mut inputs = law.inputs.iter().zip(&self.inputs);
        match inputs.find(|(input, column)| column.is_none() && input.default.is_none() && self.points > 0) {
            Some((input, _)) => not_set(&input.name, format!("set it by wlh_set_input ({})", input.summary)),
            None => Ok(()),
        }
    }

    /// Refuses outputs that overlap an input, the state variables or each other.
    fn is_apart(&self, written: &Written) -> Result<(), HostError> {
        let law = self.descriptor();
        let fields = law.fields().iter().filter_map(|field| {
            let reals = self.reals[field as usize].as_ref().map(Column::addresses);
            let found = reals.or_else(|| self.integers[field as usize].as_ref().map(Column::addresses));
            Some((field.name(), found?))
        });
        let inputs = law.inputs.iter().zip(&self.inputs);
        let inputs = inputs.filter_map(|(input, column)| Some((input.name.as_str(), column.as_ref()?.addresses())));
        let arrays: Vec<(&str, Range<usize>)> = fields.chain(inputs).collect();
        let outputs = written.addresses();
        for (index, (output, mine)) in outputs.iter().enumerate() {
            let others = outputs[..index].iter().map(|(name, range)| (*name, range));
            let mut others = others.chain(arrays.iter().map(|(name, range)| (*name, range)));
            let overlaps = |(_, range): &(&str, &Range<usize>)| mine.start < range.end && range.start < mine.end;
            if let Some((other, _)) = others.find(overlaps) {
                return Err(HostError::Overlap { output, other: other.to_owned() });
            }
        }
        Ok(())
    }
}

/// Refuses temperatures between which no table can be interpolated.
fn is_finite(temperature: &Values<'_>) -> Result<(), HostError> {
    let found = match temperature {
        Values::Uniform(value) => (!value.is_finite()).then_some((0, *value)),
        Values::Strided { data, step } => {
            data.iter().step_by(*step).copied().enumerate().find(|(_, value)| !value.is_finite())
        }
        _ => None,
    };
    match found {
        Some((point, value)) => Err(HostError::Temperature { field: Field::Temperature.name(), point, value }),
        None => Ok(()),
    }
}

/// The numbers of a call: the solver's, and those of the substep.
fn numbers(step: &abi::Step, solver: &CallNumbers) -> Result<CallNumbers, HostError> {
    let wrong = |what: &str, found: String, expected: &str| HostError::Number {
        what: format!("wlh_step.{what}"),
        found,
        expected: expected.to_owned(),
    };
    for (what, found, is_good) in [
        ("time", step.time, step.time.is_finite()),
        ("dt", step.dt, step.dt.is_finite() && step.dt >= 0.0),
        ("step_time", step.step_time, step.step_time.is_finite()),
    ] {
        if !is_good {
            let expected = if what == "dt" { "a finite number, 0 or more" } else { "a finite number" };
            return Err(wrong(what, found.to_string(), expected));
        }
    }
    let number = |what: &str, found: i64, usual: i64| match found {
        0 => Ok(usual),
        number if number > 0 => Ok(number),
        _ => Err(wrong(what, found.to_string(), "a number from 1, or 0")),
    };
    Ok(CallNumbers {
        time: step.time,
        dt: step.dt,
        step_time: step.step_time,
        load_step: number("load_step", step.load_step, 1)?,
        substep: number("substep", step.substep, 1)?,
        cycle: number("cycle", step.cycle, 0)?,
        material: number("material", step.material, 1)?,
        pair: number("pair", step.pair, 1)?,
        body: number("body", step.body, 1)?,
        counter_body: number("counter_body", step.counter_body, 2)?,
        ..*solver
    })
}

/// The status and the words of an evaluation that gave no error.
pub(crate) fn told(evaluation: Evaluation) -> (i32, f64, String) {
    let at = |at: Option<PointInputs>| at.map(|at| format!(" at {at}")).unwrap_or_default();
    match evaluation {
        Evaluation::Good => (law_abi::WL_OK, 1.0, String::new()),
        Evaluation::Unreliable { at: place, text } => {
            (law_abi::WL_UNRELIABLE, 1.0, format!("the law warns{}: {text}", at(place)))
        }
        Evaluation::CutStep { factor, at: place, text } => {
            (law_abi::WL_CUT_STEP, factor, format!("the law wants a substep shorter by {factor}{}: {text}", at(place)))
        }
    }
}
