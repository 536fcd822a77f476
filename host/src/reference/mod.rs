//! Exact answers: library functions that name their derivation, and the registry of named ones.
//! Here is Archard wear under prescribed pressure and velocity, in closed form and by quadrature.
//! Not here: what a run computed and how far off it is, and answers that a scene brings as a file.

mod answer;
pub mod archard;
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
