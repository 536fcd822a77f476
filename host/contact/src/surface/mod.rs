//! The initial gap of a pair over its cells, for every shape that a scene can name, and what is measured on a gap.
//! Here are the smooth shapes, waves, self-affine roughness, height maps from files, the length that contact errors are
//! measured with and the mirrors of a gap. Not here: wear, which adds to a gap, and the contact models that close it.

mod error;
pub mod height_map;
mod height_text;
mod measure;
pub mod rough;
mod shape;
mod smooth;
#[cfg(test)]
mod tests;

pub use error::SurfaceError;
pub use measure::{Mirror, mirrors, std_of_gap};
pub use shape::{Shape, Surface};
