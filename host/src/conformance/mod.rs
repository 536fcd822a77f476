//! Does a law keep the contract? The checks, each in a process of its own, and what came of them.
//!
//! Not here: the command that prints it (`cli::check`), loading and calling laws for a run (`law`).

mod check;

pub use check::{Check, Facts, Group};
