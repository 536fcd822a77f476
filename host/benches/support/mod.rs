//! What the benchmarks share: timing of things side by side, the laws that they call, and scenes at any size.
//!
//! Every comparison is made in one process with its sides taking turns, since a machine's speed changes from second to
//! second; the smallest time of a side is what it takes undisturbed, the median is shown beside it.
#![allow(dead_code)] // no benchmark uses all of it

pub mod laws;
pub mod processor;
pub mod raw;
#[path = "../../../tests/support/rust_law.rs"]
pub mod rust_law;
pub mod scenes;
pub mod timing;
