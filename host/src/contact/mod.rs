//! Contact pressure from load and gap, one module per contact model.
//! Here are the prescribed model, whose pressure and motion are data read from a history, and the models that answer
//! back: what they are asked ([`Problem`]), what they answer ([`Solution`]) and the trait they share ([`ContactModel`]).
//! Not here: what wear does with the pressure (integrator) and which columns a scene needs (plan).

mod cells;
mod error;
pub mod foundation;
pub mod halfspace;
pub mod prescribed;
mod problem;

pub use cells::Cells;
pub use error::ContactError;
pub use problem::{ContactModel, Control, Diagonal, Problem, Solution};
