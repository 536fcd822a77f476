//! A study of one scene: error against run time over integrators, steps, tolerances, scaling, grids and isolation.
//!
//! Every case is the scene under overrides that a user could type, run by [`crate::solve`] and compared with one
//! `yardstick`; `lines` says which cases there are, `cases` runs them from cheap to dear as `pick` picks them, and `verdict`
//! says what it comes to. Nothing here prints or draws: the outcome is a [`StudyRecord`](crate::record::StudyRecord).

mod asked;
mod budget;
mod cases;
mod conduct;
mod error;
mod frame;
mod front;
mod grids;
mod lines;
mod orders;
mod pick;
mod processor;
mod setup;
mod verdict;
mod yardstick;

pub use asked::{Asked, Compare, Part};
pub use conduct::{Laws, Watcher, study};
pub use error::StudyError;
