//! The points of one call: columns over the caller's arrays, laid out as the ABI wants them.
#![allow(unsafe_code)] // reason: promises that the shared slices behind the raw pointers may cross threads.

use std::marker::PhantomData;
use std::ops::Range;
use std::sync::Arc;

use thiserror::Error;
use wearlaw_plugin_api::abi;

use super::descriptor::LawDescriptor;
use super::evaluation::{NamedValues, PointInputs};
use super::fields::Field;
use super::values::CallNumbers;

mod builder;
mod columns;
mod outputs;
mod spans;

pub use builder::BatchBuilder;
use columns::{advance, behind};
pub use columns::{blank_view, column_of, index_column_of};
pub use outputs::Outputs;

/// Why a batch cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum BatchError {
    /// A needed field was not given.
    #[error("law `{law}` needs `{field}`, which was not given")]
    Missing {
        /// The law.
        law: String,
        /// The field, constant, input or `state`.
        field: String,
    },
    /// An array is too short or too long.
    #[error("`{field}` has {found} values, expected {expected}")]
    Length {
        /// The field, constant, input or `state`.
        field: String,
        /// Length of the array.
        found: usize,
        /// What the points need.
        expected: usize,
    },
    /// Fewer doubles from point to point than one point has.
    #[error("`{field}` has a step of {step}, expected at least {width}")]
    Step {
        /// The field, constant, input or `state`.
        field: String,
        /// The step given.
        step: usize,
        /// Values of one point.
        width: usize,
    },
    /// The kind of values does not fit the field.
    #[error("`{field}` is a {found}, expected a {expected}")]
    Kind {
        /// The field.
        field: String,
        /// What was given.
        found: &'static str,
        /// What it takes.
        expected: &'static str,
    },
    /// More or fewer constants or inputs than the law declares.
    #[error("{found} {what} were given, law `{law}` declares {expected}")]
    Count {
        /// The law.
        law: String,
        /// `constants` or `inputs`.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many the law declares.
        expected: usize,
    },
}

/// What one call is given: the points of one surface over one substep, borrowed from the caller's arrays.
///
/// It is cheap to clone and to cut into ranges, and may be read from several threads at once.
#[derive(Clone)]
pub struct Batch<'a> {
    store: Arc<Store<'a>>,
    first: usize,
    points: usize,
}

struct Store<'a> {
    numbers: CallNumbers,
    descriptor: &'a LawDescriptor,
    /// Columns begin at the first point of the whole batch.
    view: abi::View,
    /// Constants, then inputs; `view` leads here.
    columns: Vec<abi::Column>,
    columns_are_uniform: bool,
    /// Fields that differ from point to point.
    moving: Vec<Field>,
    /// Of columns that differ from point to point, with a wear increment.
    bytes_per_point: usize,
    _numbers: Vec<f64>,
    _indices: Vec<i64>,
    borrowed: PhantomData<(&'a [f64], &'a [i64])>,
}

// SAFETY: every pointer in `view` and `columns` leads into `_numbers`, `_indices` or a slice that is borrowed as shared
// for 'a; all of them are plain numbers that nobody writes while the store lives, and `Batch` only reads through them.
unsafe impl Send for Store<'_> {}
// SAFETY: as for Send: shared reading of numbers that nobody writes.
unsafe impl Sync for Store<'_> {}

/// Views of one range of a batch after another, made in one place.
pub(super) struct Cursor<'b> {
    view: abi::View,
    columns: Vec<abi::Column>,
    store: &'b Store<'b>,
    first: usize,
    at: usize,
}

impl Cursor<'_> {
    /// The ABI's view of `range` (counted in the cursor's batch), valid until the next one.
    pub(super) fn at(&mut self, range: &Range<usize>) -> &abi::View {
        let first = self.first + range.start;
        self.view.points = range.len() as i64;
        // The view stands at point `at`; a piece that is looked at again lies before it.
        let step = first.wrapping_sub(self.at);
        self.at = first;
        for &field in &self.store.moving {
            advance(&mut self.view, field, step);
        }
        self.view.state = behind(self.store.view.state, first);
        if !self.store.columns_are_uniform {
            self.columns.clear();
            self.columns.extend(self.store.columns.iter().map(|column| behind(*column, first)));
            (self.view.constants, self.view.inputs) = halves(&self.columns, self.view.constant_count);
        }
        &self.view
    }

    /// Where the columns with a number a point go on behind the points of the last view, were there more of them.
    pub(super) fn behind(&self) -> impl Iterator<Item = *const f64> {
        let mut view = self.view;
        let points = view.points as usize;
        let columns = self.store.moving.iter().filter_map(move |field| column_of(&mut view, *field).copied());
        columns.filter(|column| column.step == 1).map(move |column| behind(column, points).ptr)
    }
}

/// Where the constants begin, and the inputs behind them.
fn halves(columns: &[abi::Column], constants: i64) -> (*const abi::Column, *const abi::Column) {
    let (constants, inputs) = columns.split_at(constants as usize);
    (constants.as_ptr(), inputs.as_ptr())
}

impl<'a> Batch<'a> {
    /// Begins a batch of `points` points for the law of `descriptor`.
    pub fn builder(descriptor: &'a LawDescriptor, points: usize) -> BatchBuilder<'a> {
        BatchBuilder::new(descriptor, points)
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Index of its first point in the batch that was built.
    pub fn first(&self) -> usize {
        self.first
    }

    /// The numbers that hold for all points.
    pub fn numbers(&self) -> &CallNumbers {
        &self.store.numbers
    }

    /// The law that it was built for.
    pub fn descriptor(&self) -> &'a LawDescriptor {
        self.store.descriptor
    }

    /// The points `range`, counted from the first point of this batch, without copying a number.
    ///
    /// # Panics
    /// If the range ends behind the last point or before its own start, as indexing a slice does.
    pub fn range(&self, range: Range<usize>) -> Batch<'a> {
        assert!(range.start <= range.end && range.end <= self.points, "{range:?} of {} points", self.points);
        Batch { store: Arc::clone(&self.store), first: self.first + range.start, points: range.len() }
    }

    /// The ABI's view of this batch, if it is the whole one: it asks for nothing but the increment, and is no copy.
    #[inline]
    pub(super) fn whole_view(&self) -> Option<&abi::View> {
        let view = &self.store.view;
        (self.first == 0 && view.points == self.points as i64).then_some(view)
    }

    /// Bytes of the whole batch that a call reads at each point for itself, and of the increments that it writes.
    pub(super) fn bytes_moved(&self) -> usize {
        (self.store.view.points as usize).saturating_mul(self.store.bytes_per_point)
    }

    /// [`Batch::bytes_moved`] of the points of this batch alone.
    pub(super) fn bytes_of_points(&self) -> usize {
        self.points.saturating_mul(self.store.bytes_per_point)
    }

    /// Begins to go through this batch with views of its ranges.
    pub(super) fn cursor(&self, request: i64) -> Cursor<'_> {
        Cursor {
            view: abi::View { request, ..self.store.view },
            columns: Vec::new(),
            store: &self.store,
            first: self.first,
            at: 0,
        }
    }

    /// What the law is given at a point of this batch: fields, constants, further inputs and state variables.
    ///
    /// # Panics
    /// If there is no such point, as indexing a slice does.
    pub fn inputs_at(&self, point: usize) -> PointInputs {
        assert!(point < self.points, "point {point} of {}", self.points);
        let law = self.descriptor();
        let mut view = self.store.view;
        let index = self.first + point;
        let mut values = Vec::new();
        for field in law.fields().iter() {
            let found = if let Some(column) = index_column_of(&mut view, field) {
                self.integer(*column, index).map(|number| vec![number as f64])
            } else {
                column_of(&mut view, field).and_then(|column| self.reals(*column, index, field.shape().width()))
            };
            if let Some(found) = found {
                values.push(NamedValues::new(field.name(), &found));
            }
        }
        let quantities = law.constants.iter().chain(&law.inputs);
        for (quantity, column) in quantities.zip(&self.store.columns) {
            if let Some(found) = self.reals(*column, index, 1) {
                values.push(NamedValues::new(&quantity.name, &found));
            }
        }
        let state = self.reals(view.state, index, law.state.len()).unwrap_or_default();
        for (variable, value) in law.state.iter().zip(state) {
            values.push(NamedValues::new(&variable.name, &[value]));
        }
        PointInputs { point: index, values }
    }

    fn reals(&self, column: abi::Column, index: usize, width: usize) -> Option<Vec<f64>> {
        if column.ptr.is_null() {
            return None;
        }
        let first = column.ptr.wrapping_offset(index as isize * column.step as isize);
        // SAFETY: the builder checked that the column reaches over all points, and `index` is one of them; the numbers
        // are borrowed or owned by the store.
        Some(unsafe { std::slice::from_raw_parts(first, width) }.to_vec())
    }

    fn integer(&self, column: abi::IndexColumn, index: usize) -> Option<i64> {
        if column.ptr.is_null() {
            return None;
        }
        // SAFETY: as for `reals`.
        Some(unsafe { *column.ptr.wrapping_offset(index as isize * column.step as isize) })
    }
}
