//! The memory that the columns of a batch lie in, for sending it to another process.
#![allow(unsafe_code)] // reason: reads the caller's arrays through the ABI's pointers.

use super::super::fields::Shape;
use super::columns::{advance, column_of, index_column_of};
use super::{Batch, behind};

/// The memory of one column, as raw 64-bit words, and words from point to point.
pub(crate) struct Span<'b> {
    pub(crate) words: &'b [u64],
    pub(crate) step: usize,
}

impl Batch<'_> {
    /// Fields of the law in the order of their bits, constants, inputs and, if there are any, the state variables.
    pub(crate) fn spans(&self) -> Vec<Option<Span<'_>>> {
        let law = self.descriptor();
        let mut view = self.store.view;
        let mut spans = Vec::new();
        for field in law.fields().iter() {
            advance(&mut view, field, self.first);
            let found = if field.shape() == Shape::Index {
                index_column_of(&mut view, field).map(|column| (column.ptr.cast::<u64>(), column.step))
            } else {
                column_of(&mut view, field).map(|column| (column.ptr.cast::<u64>(), column.step))
            };
            spans.push(found.and_then(|(first, step)| self.span(first, step, field.shape().width())));
        }
        for column in &self.store.columns {
            let column = behind(*column, self.first);
            spans.push(self.span(column.ptr.cast(), column.step, 1));
        }
        if !law.state.is_empty() {
            let column = behind(view.state, self.first);
            spans.push(self.span(column.ptr.cast(), column.step, law.state.len()));
        }
        spans
    }

    fn span(&self, first: *const u64, step: i64, width: usize) -> Option<Span<'_>> {
        if first.is_null() {
            return None;
        }
        let step = step as usize;
        let length = self.points().checked_sub(1).map_or(0, |steps| steps * step + width);
        // SAFETY: the builder checked that the column reaches over its points; doubles and 64-bit integers have the size
        // and alignment of u64, any bits are a u64, and the arrays are borrowed as shared as long as the batch lives.
        let words = unsafe { std::slice::from_raw_parts(first, length) };
        Some(Span { words, step })
    }
}
