//! The solver's arrays that a law writes.
#![allow(unsafe_code)] // reason: makes slices of the solver's arrays.

use std::ops::Range;

use wearlaw::law::Outputs;

use crate::abi;
use crate::boundary::aligned;
use crate::columns::addresses;
use crate::error::HostError;

/// Outputs of the solver's that have the right lengths.
pub(crate) struct Written {
    points: usize,
    increment: *mut f64,
    direction: *mut f64,
    d_pressure: *mut f64,
    status: *mut i32,
}

impl Written {
    /// Looks at lengths and addresses.
    pub(crate) fn new(outputs: &abi::Outputs, points: usize) -> Result<Self, HostError> {
        if outputs.increment.is_null() && points > 0 {
            return Err(HostError::Null("wlh_outputs.increment"));
        }
        let of_points = |what: &'static str, is_null: bool, length: i64, width: usize| {
            if is_null || usize::try_from(length) == Ok(width * points) {
                return Ok(());
            }
            let expected = format!("{}: {width} for each of {points} points", width * points);
            Err(HostError::Number { what: format!("wlh_outputs.{what}_length"), found: length.to_string(), expected })
        };
        of_points("increment", outputs.increment.is_null(), outputs.increment_length, 1)?;
        of_points("direction", outputs.direction.is_null(), outputs.direction_length, 3)?;
        of_points("d_pressure", outputs.d_pressure.is_null(), outputs.d_pressure_length, 1)?;
        of_points("status", outputs.status.is_null(), outputs.status_length, 1)?;
        aligned(outputs.increment, "wlh_outputs.increment", "an array of doubles")?;
        aligned(outputs.direction, "wlh_outputs.direction", "an array of doubles")?;
        aligned(outputs.d_pressure, "wlh_outputs.d_pressure", "an array of doubles")?;
        aligned(outputs.status, "wlh_outputs.status", "an array of 32-bit integers")?;
        Ok(Self {
            points,
            increment: outputs.increment,
            direction: outputs.direction,
            d_pressure: outputs.d_pressure,
            status: outputs.status,
        })
    }

    /// Names and addresses of the outputs that are wanted.
    pub(crate) fn addresses(&self) -> Vec<(&'static str, Range<usize>)> {
        let all = [
            ("increment", addresses(self.increment, self.points)),
            ("direction", addresses(self.direction, 3 * self.points)),
            ("d_pressure", addresses(self.d_pressure, self.points)),
            ("status", addresses(self.status, self.points)),
        ];
        all.into_iter().filter(|(_, range)| range.start != 0).collect()
    }

    /// The arrays, for one call.
    ///
    /// # Safety
    /// They are as long as the solver has said, overlap nothing, and nobody else uses them meanwhile.
    pub(crate) unsafe fn outputs<'a>(&self) -> Outputs<'a> {
        /// # Safety
        /// As for `outputs`.
        unsafe fn part<'a, T>(first: *mut T, length: usize) -> Option<&'a mut [T]> {
            // SAFETY: as the caller says.
            (!first.is_null()).then(|| unsafe { std::slice::from_raw_parts_mut(first, length) })
        }
        // SAFETY: as the caller says.
        unsafe {
            Outputs {
                increment: part(self.increment, self.points).unwrap_or_default(),
                direction: part(self.direction, 3 * self.points),
                state: None,
                status: part(self.status, self.points),
                d_pressure: part(self.d_pressure, self.points),
            }
        }
    }
}
