//! Powers.
mod batch;
mod coefficients;
mod constants;
mod double;
mod exact;
mod kernel;
mod linear;
mod scale;
mod sweep;
#[cfg(test)]
mod tests;

pub use batch::{Column, Inputs, Instructions, increments, increments_by};
pub use scale::Scale;
