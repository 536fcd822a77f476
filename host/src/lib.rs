//! Wear simulation with laws that are shared libraries.
//!
//! Data flows one way: [`scene`] (what was asked), [`plan`] (what will be done), [`solve`] (the only loop), [`record`]
//! (what happened), [`output`] (its readers). [`law`] loads and calls wear laws, [`contact`] gives what drives them,
//! [`conformance`] checks whether a law keeps its contract and [`mod@bench`] measures one by itself, [`integrator`] advances
//! wear in time, [`apdl`] reads the commands of an input deck, [`mod@reference`] holds exact answers, [`study`](mod@study) runs
//! a scene in many ways and [`mod@sweep`] many cases of one; [`mod@fit`] finds constants from measurements; [`shim`] writes user subroutines that call a law. [`cli`] is the program. The book (`host/book` in the repository)
//! shows on its page on embedding how a program of one's own runs a scene.

pub mod apdl;
pub mod bench;
pub mod cli;
pub mod error;
pub mod exit_code;
pub mod fit;
pub mod integrator;
pub mod output;
pub mod plan;
pub mod record;
pub mod reference;
pub mod shim;
pub mod solve;
pub mod stability;
pub mod study;
pub mod sweep;
pub mod templates;

/// The Rust program in the book's page on embedding runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../book/embedding.md")]
struct Embedding;

pub use error::Error;
pub use exit_code::ExitCode;
pub use wearlaw_conformance as conformance;
pub use wearlaw_contact as contact;
pub use wearlaw_law as law;
pub use wearlaw_scene as scene;
