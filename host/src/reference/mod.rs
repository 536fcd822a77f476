//! Exact answers: library functions that name their derivation, and the registry of named ones.
//! Here is Archard wear under prescribed pressure and velocity, in closed form and by quadrature.
//! Not here: what a run computed and how far off it is, and answers that a scene brings as a file.

pub mod archard;
mod named;
pub mod pieces;
pub mod quadrature;

pub use named::NamedReference;
pub use pieces::Piece;
