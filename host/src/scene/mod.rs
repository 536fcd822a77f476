//! What was asked.
pub mod documented;
mod law;

pub use law::{Basis, Mode};
