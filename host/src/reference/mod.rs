//! Exact answers: library functions that name their derivation, and the registry of named ones.
//! Here are Archard wear under prescribed pressure and velocity, Hertz contact and the scar that grows from it, worn elastic
//! foundations, the decay of waves, the limit around a stick zone and published fretting depths.
//! Not here: what a run computed and how far off it is, and answers that a scene brings as a file.

mod answer;
pub mod archard;
pub mod foundation;
pub mod hertz;
pub mod mccoll;
pub mod modes;
mod named;
pub mod pieces;
pub mod quadrature;
pub mod scar;
pub mod stick;

pub use answer::{Indenter, PointAnswer, QuantityError};
pub use named::NamedReference;
pub use pieces::Piece;
