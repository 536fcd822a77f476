//! Wear simulation with laws that are shared libraries.
//!
//! Data flows one way: [`scene`] (what was asked), [`plan`] (what will be done), [`solve`] (the only loop), [`record`]
//! (what happened), [`output`] (its readers). [`law`] loads and calls wear laws, [`contact`] gives what drives them,
//! [`conformance`] checks whether a law keeps its contract, [`mod@bench`] measures one by itself, [`integrator`] advances wear in time, [`apdl`] reads the commands of an input deck, [`mod@reference`] holds exact answers.
//! [`cli`] is the program.

pub mod apdl;
pub mod bench;
pub mod cli;
pub mod conformance;
pub mod contact;
pub mod error;
pub mod exit_code;
pub mod integrator;
pub mod law;
pub mod output;
pub mod plan;
pub mod record;
pub mod reference;
mod sampling;
pub mod scene;
pub mod solve;
mod splitmix;
pub mod stability;
pub mod templates;

pub use error::Error;
pub use exit_code::ExitCode;
