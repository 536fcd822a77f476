//! Gathers, checks and lays out the columns of a batch.

use std::marker::PhantomData;
use std::sync::Arc;

use wearlaw_plugin_api::abi;

use super::super::descriptor::{LawDescriptor, Quantity};
use super::super::fields::{Field, Shape};
use super::super::values::{CallNumbers, Indices, Values};
use super::columns::{blank_view, column_of, index_column_of, step_of};
use super::{Batch, BatchError, Store, halves};

/// Gathers the columns of a [`Batch`]; what the law did not declare is dropped.
pub struct BatchBuilder<'a> {
    descriptor: &'a LawDescriptor,
    points: usize,
    numbers: CallNumbers,
    fields: [Values<'a>; Field::ALL.len()],
    indices: [Indices<'a>; Field::ALL.len()],
    constants: Vec<Values<'a>>,
    inputs: Vec<Values<'a>>,
    state: Values<'a>,
}

impl<'a> BatchBuilder<'a> {
    /// Begins a batch of `points` points for the law of `descriptor`.
    pub fn new(descriptor: &'a LawDescriptor, points: usize) -> Self {
        Self {
            descriptor,
            points,
            numbers: CallNumbers::default(),
            fields: [Values::Absent; Field::ALL.len()],
            indices: [Indices::Absent; Field::ALL.len()],
            constants: Vec::new(),
            inputs: Vec::new(),
            state: Values::Absent,
        }
    }

    /// The numbers that hold for all points.
    pub fn numbers(mut self, numbers: CallNumbers) -> Self {
        self.numbers = numbers;
        self
    }

    /// The values of a real field; dropped if the law neither reads nor uses it.
    pub fn field(mut self, field: Field, values: Values<'a>) -> Self {
        self.fields[field as usize] = values;
        self
    }

    /// The values of an integer field; dropped if the law neither reads nor uses it.
    pub fn indices(mut self, field: Field, indices: Indices<'a>) -> Self {
        self.indices[field as usize] = indices;
        self
    }

    /// All constants, each one value for all points, in the law's order.
    pub fn constants(mut self, constants: &[f64]) -> Self {
        self.constants = constants.iter().copied().map(Values::Uniform).collect();
        self
    }

    /// All constants, in the law's order.
    pub fn constant_values(mut self, constants: &[Values<'a>]) -> Self {
        self.constants = constants.to_vec();
        self
    }

    /// The further inputs, in the law's order; one that is absent or left out takes its default, if it has one.
    pub fn inputs(mut self, inputs: &[Values<'a>]) -> Self {
        self.inputs = inputs.to_vec();
        self
    }

    /// The state variables at the start of the substep `[points][variables]`.
    pub fn state(mut self, state: Values<'a>) -> Self {
        self.state = state;
        self
    }

    /// Checks every length and lays the columns out.
    ///
    /// # Errors
    /// A needed field that is absent, an array of the wrong length, or a wrong number of constants or inputs.
    pub fn build(mut self) -> Result<Batch<'a>, BatchError> {
        let law = self.descriptor;
        self.count("constants", self.constants.len(), law.constants.len())?;
        if self.inputs.len() > law.inputs.len() {
            self.count("inputs", self.inputs.len(), law.inputs.len())?;
        }
        self.inputs.resize(law.inputs.len(), Values::Absent);
        let mut view = blank_view(&self.numbers, self.points, law);
        // One allocation each, of the largest size that can be needed: pointers into it must not move.
        let real = 3 * (Field::ALL.len() + law.constants.len() + law.inputs.len()) + law.state.len();
        let mut numbers = Vec::with_capacity(real);
        let mut indices = Vec::with_capacity(Field::ALL.len());
        for field in law.fields().iter() {
            self.kind_fits(field)?;
            if field.shape() == Shape::Index {
                let column = self.index_column(field, &mut indices)?;
                if let Some(place) = index_column_of(&mut view, field) {
                    *place = column;
                }
            } else if let Some(place) = column_of(&mut view, field) {
                let values = self.fields[field as usize];
                *place = self.column(field.name(), field.shape().width(), values, &mut numbers)?;
            }
            let absent = column_of(&mut view, field).is_some_and(|column| column.ptr.is_null())
                || index_column_of(&mut view, field).is_some_and(|column| column.ptr.is_null());
            if absent && law.reads.contains(field) {
                return Err(self.missing(field.name()));
            }
        }
        let mut columns = Vec::with_capacity(law.constants.len() + law.inputs.len());
        let given = self.constants.iter().chain(&self.inputs);
        for (quantity, values) in law.constants.iter().chain(&law.inputs).zip(given) {
            let values = self.or_default(quantity, *values, columns.len() >= law.constants.len());
            let column = self.column(&quantity.name, 1, values, &mut numbers)?;
            if column.ptr.is_null() {
                return Err(self.missing(&quantity.name));
            }
            columns.push(column);
        }
        if !law.state.is_empty() {
            view.state = self.column("state", law.state.len(), self.state, &mut numbers)?;
            if view.state.ptr.is_null() {
                return Err(self.missing("state"));
            }
        }
        (view.constants, view.inputs) = halves(&columns, view.constant_count);
        let moves = |field: &Field| step_of(&view, *field) != 0;
        let moving: Vec<Field> = law.fields().iter().filter(moves).collect();
        let steps = moving.iter().map(|field| step_of(&view, *field)).chain(columns.iter().map(|column| column.step));
        let store = Store {
            bytes_per_point: size_of::<f64>() * (1 + steps.chain([view.state.step]).sum::<i64>() as usize),
            moving,
            numbers: self.numbers,
            descriptor: law,
            view,
            columns_are_uniform: columns.iter().all(|column| column.step == 0),
            columns,
            _numbers: numbers,
            _indices: indices,
            borrowed: PhantomData,
        };
        Ok(Batch { store: Arc::new(store), first: 0, points: self.points })
    }

    fn count(&self, what: &'static str, found: usize, expected: usize) -> Result<(), BatchError> {
        if found == expected {
            return Ok(());
        }
        Err(BatchError::Count { law: self.descriptor.name.clone(), what, found, expected })
    }

    fn missing(&self, field: &str) -> BatchError {
        BatchError::Missing { law: self.descriptor.name.clone(), field: field.to_owned() }
    }

    /// A default is in SI units, a batch in the scene's.
    fn or_default(&self, quantity: &Quantity, values: Values<'a>, is_input: bool) -> Values<'a> {
        match (values, quantity.default) {
            (Values::Absent, Some(default)) if is_input => {
                Values::Uniform(default / self.numbers.units.factor(quantity.exponents))
            }
            _ => values,
        }
    }

    fn kind_fits(&self, field: Field) -> Result<(), BatchError> {
        let real = self.fields[field as usize] != Values::Absent;
        let index = self.indices[field as usize] != Indices::Absent;
        let (found, expected) = match field.shape() {
            Shape::Index if real => ("column of reals", "column of integers"),
            Shape::Scalar | Shape::Vector if index => ("column of integers", "column of reals"),
            Shape::Scalar if matches!(self.fields[field as usize], Values::UniformVector(_)) => ("vector", "scalar"),
            _ => return Ok(()),
        };
        Err(BatchError::Kind { field: field.name().to_owned(), found, expected })
    }

    fn column(
        &self,
        name: &str,
        width: usize,
        values: Values<'a>,
        numbers: &mut Vec<f64>,
    ) -> Result<abi::Column, BatchError> {
        let start = numbers.len();
        match values {
            Values::Absent => {
                return Ok(abi::Column { ptr: std::ptr::null(), step: 0 });
            }
            Values::Uniform(value) => numbers.extend(std::iter::repeat_n(value, width)),
            Values::UniformVector(vector) if width == 3 => numbers.extend(vector),
            Values::UniformVector(_) => {
                return Err(BatchError::Kind { field: name.to_owned(), found: "vector", expected: "scalar" });
            }
            Values::PerPoint(data) => {
                let expected = self.points * width;
                self.exact(name, data.len(), expected)?;
                return Ok(abi::Column { ptr: data.as_ptr(), step: width as i64 });
            }
            Values::Strided { data, step } => {
                self.reaches(name, data.len(), step, width)?;
                return Ok(abi::Column { ptr: data.as_ptr(), step: step as i64 });
            }
        }
        Ok(abi::Column { ptr: numbers[start..].as_ptr(), step: 0 })
    }

    fn index_column(&self, field: Field, numbers: &mut Vec<i64>) -> Result<abi::IndexColumn, BatchError> {
        let start = numbers.len();
        match self.indices[field as usize] {
            Indices::Absent => {
                return Ok(abi::IndexColumn { ptr: std::ptr::null(), step: 0 });
            }
            Indices::Uniform(value) => numbers.push(value),
            Indices::PerPoint(data) => {
                self.exact(field.name(), data.len(), self.points)?;
                return Ok(abi::IndexColumn { ptr: data.as_ptr(), step: 1 });
            }
            Indices::Strided { data, step } => {
                self.reaches(field.name(), data.len(), step, 1)?;
                return Ok(abi::IndexColumn { ptr: data.as_ptr(), step: step as i64 });
            }
        }
        Ok(abi::IndexColumn { ptr: numbers[start..].as_ptr(), step: 0 })
    }

    fn exact(&self, name: &str, found: usize, expected: usize) -> Result<(), BatchError> {
        if found == expected {
            return Ok(());
        }
        Err(BatchError::Length { field: name.to_owned(), found, expected })
    }

    fn reaches(&self, name: &str, found: usize, step: usize, width: usize) -> Result<(), BatchError> {
        if step < width {
            return Err(BatchError::Step { field: name.to_owned(), step, width });
        }
        let expected = match self.points.checked_sub(1) {
            None => 0,
            Some(steps) => steps.saturating_mul(step).saturating_add(width),
        };
        if found >= expected {
            return Ok(());
        }
        Err(BatchError::Length { field: name.to_owned(), found, expected })
    }
}
