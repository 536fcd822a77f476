//! Constants of a law from measurements: the scene is run until what it says of wear comes nearest to what was measured.
//!
//! `data` reads the measurements, `model` runs the scene at trial values, `search` is the least-squares search (a kept crate)
//! and `statistics` says how well the data know what was found, and what they cannot tell apart. The outcome is a
//! [`FitRecord`](crate::record::FitRecord); nothing here prints or draws.

mod data;
mod error;
mod model;
mod search;
mod statistics;

pub use data::{Data, Noise};
pub use error::FitError;
pub use search::{Asked, fit};
