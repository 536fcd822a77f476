//! Wear laws in solvers written in C, C++ and Fortran: the host of the crate `wearlaw` behind a C interface.
//!
//! `include/wearlaw_host.h` is generated from [`abi`] and [`functions`] and is where the interface is described. A law
//! (`law`) is shared by all threads; a surface (`surface`) has the columns, constants and state variables of one thread.
//! What the solver hands over is looked at in `boundary` and `columns`; everything about laws is the crate's.

pub mod abi;
mod boundary;
mod columns;
mod error;
mod evaluate;
pub mod functions;
mod handle;
mod law;
mod surface;
mod written;
