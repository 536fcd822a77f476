//! Contact pressure from load and gap, one module per contact model, and the generator that rough surfaces are drawn with
//! ([`splitmix`]).
//!
//! Here are the prescribed model, whose pressure and motion are data read from a history, and the models that answer
//! back: the initial gap that they start from ([`surface`]), what they are asked ([`Problem`]), what they answer
//! ([`Solution`]) and the trait they share ([`ContactModel`]).
//! Not here: what wear does with the pressure (integrator) and which columns a scene needs (plan).

mod cells;
mod error;
pub mod foundation;
pub mod halfspace;
mod npy;
pub mod prescribed;
mod problem;
mod root_mean;
pub mod splitmix;
pub mod surface;
mod traction;

pub use cells::Cells;
pub use error::ContactError;
pub use npy::ArrayFault;
pub use problem::{ContactModel, Control, Diagonal, Problem, Solution};
pub use root_mean::RootMean;
pub use traction::{averaged_twice, corners_and_back, nodal_traction};
pub use wearlaw_transforms::{INSTRUCTIONS_VARIABLE, Instructions, InstructionsError};
