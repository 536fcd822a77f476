//! What the bodies of checks work with, in the worker: a library, calls of its laws, inputs, and what surrounds them.
//!
//! A call is built anew for every evaluation, so that a law that writes where it should not spoils one call and not
//! the next. What is judged is in `bodies`.

pub(super) mod arrays;
pub(super) mod call;
pub(super) mod closeness;
mod columns;
pub(super) mod fault_note;
mod layout;
pub(super) mod subject;
pub(super) mod surroundings;

pub(super) use crate::sampling::{answer, known, points, random, sample, ulps};
