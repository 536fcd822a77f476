//! Powers.
mod batch;
mod coefficients;
mod double;
mod exact;
mod kernel;
mod linear;
mod scale;
mod sweep;

pub use batch::{Column, Inputs, Instructions, increments, increments_by};
pub use scale::Scale;
