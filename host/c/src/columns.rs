//! The solver's arrays as columns: where they are, how far they reach, what they are values of.
#![allow(unsafe_code)] // reason: makes slices of the solver's arrays.

use std::ops::Range;

use wearlaw::law::{BatchError, Field, Indices, Values};

use crate::boundary::{aligned, count};
use crate::error::HostError;

/// An array of the solver's that begins with the first value of the first point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column<T> {
    first: *const T,
    /// Numbers from one point to the next; 0: one value for all.
    step: usize,
    /// Values of a point.
    width: usize,
    points: usize,
}

impl<T> Column<T> {
    /// A column of `length` numbers over `points` points; none for NULL.
    pub(crate) fn new(
        (first, length, step): (*const T, i64, i64),
        width: usize,
        points: usize,
        name: &str,
    ) -> Result<Option<Self>, HostError> {
        if first.is_null() {
            return Ok(None);
        }
        aligned(first, name, "an array of 64-bit numbers")?;
        let found = count(&format!("length of `{name}`"), length)?;
        let step = usize::try_from(step).ok().filter(|step| *step == 0 || *step >= width).ok_or_else(|| {
            let expected = format!("0 (one value for all points) or at least {width}, the values of a point");
            HostError::Number { what: format!("step of `{name}`"), found: step.to_string(), expected }
        })?;
        let column = Self { first, step, width, points };
        let expected = column.reach();
        if found < expected {
            return Err(BatchError::Length { field: name.to_owned(), found, expected }.into());
        }
        Ok(Some(column))
    }

    /// Numbers from the first to the last that a law reads.
    fn reach(&self) -> usize {
        let steps = if self.step == 0 { 0 } else { self.points.saturating_sub(1) };
        if self.points == 0 { 0 } else { steps.saturating_mul(self.step).saturating_add(self.width) }
    }

    /// The addresses that a law reads.
    pub(crate) fn addresses(&self) -> Range<usize> {
        addresses(self.first, self.reach())
    }

    /// The numbers that a law reads.
    ///
    /// # Safety
    /// The array is where it was when the column was made, and nobody writes it while the slice lives.
    unsafe fn data<'a>(&self) -> &'a [T] {
        // SAFETY: as the caller says; the solver has said how long it is, and that was found to be enough.
        unsafe { std::slice::from_raw_parts(self.first, self.reach()) }
    }
}

/// The addresses of an array.
pub(crate) fn addresses<T>(first: *const T, length: usize) -> Range<usize> {
    first.addr()..first.addr().saturating_add(length.saturating_mul(size_of::<T>()))
}

impl Column<f64> {
    /// The values for a batch of as many points.
    ///
    /// # Safety
    /// As for `data`.
    pub(crate) unsafe fn values<'a>(&self) -> Values<'a> {
        // SAFETY: as the caller says.
        let data: &'a [_] = unsafe { self.data() };
        match (self.step, data) {
            (0, [value]) => Values::Uniform(*value),
            (0, [x, y, z]) => Values::UniformVector([*x, *y, *z]),
            (step, data) => Values::Strided { data, step },
        }
    }
}

impl Column<i64> {
    /// The numbers for a batch of as many points.
    ///
    /// # Safety
    /// As for `data`.
    pub(crate) unsafe fn indices<'a>(&self) -> Indices<'a> {
        // SAFETY: as the caller says.
        let data: &'a [_] = unsafe { self.data() };
        match (self.step, data) {
            (0, [value]) => Indices::Uniform(*value),
            (step, data) => Indices::Strided { data, step },
        }
    }
}

/// What a solver does to provide a field.
pub(crate) fn how_to_provide(field: Field) -> &'static str {
    match field {
        Field::Pressure => "its contact pressure, positive in compression",
        Field::Slip => "the slip path over the substep (velocity times dt, where the velocity is constant)",
        Field::Velocity => "the sliding velocity (slip over dt, where only the slip is known)",
        Field::SlipVector => "the net slip displacement over the substep, 3 components a point",
        Field::Normal => "the outward unit normal of the worn body, 3 components a point",
        Field::Coordinates => "the positions of the points, 3 components a point",
        Field::Tangent => "a unit tangent, 3 components a point",
        Field::Temperature => "the temperature of the worn surface",
        Field::CounterTemperature => "the temperature of the counter surface",
        Field::FrictionStress => "the friction stress on the worn body, 3 components a point",
        Field::FrictionCoefficient => "the friction coefficient",
        Field::FrictionWork => "the friction work per area over the substep (friction stress times slip)",
        Field::AccumulatedWear => "the sum of the increments of all substeps before",
        Field::AccumulatedSlip => "the sum of the slip of all substeps before",
        Field::NodalTraction => "the normal traction from nodal stresses",
        Field::Gap => "the gap, negative where the surfaces overlap",
        Field::Area => "the area that belongs to each point",
        Field::ContactState => "WL_OPEN, WL_STICK or WL_SLIDING for each point, by wlh_set_index_field",
        Field::PointId => "the numbers of its points, by wlh_set_index_field",
        Field::ElementId => "the numbers of its contact elements, by wlh_set_index_field",
    }
}
