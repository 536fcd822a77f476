//! The safe side for laws written in Rust.
//!
//! A law says what it is in [`About`] and what it does in [`PointLaw`] (one point; the batch loop is made for it) or
//! [`Law`] (a whole batch). [`crate::export_laws!`] turns such types into the plugin's entry, with null checks and a
//! guard that lets no panic out. Loading plugins is the host's business and not here.

mod about;
mod answer;
mod batch;
pub mod export;
mod point;

#[cfg(test)]
mod tests;

pub use about::{About, Degree, Law, Quantity, SELFTEST, Status, Unit};
pub use answer::Answer;
pub use batch::{Batch, Column, Indices};
pub use point::{Point, PointAnswer, PointLaw};

/// Everything that a law's source needs, with the ABI's masks.
pub mod prelude {
    pub use super::{About, Answer, Batch, Column, Degree, Law, Point, PointAnswer, PointLaw, Quantity, Status, Unit};
    pub use crate::abi::*;
    pub use crate::export_laws;
}
