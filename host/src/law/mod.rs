//! Everything about loading and calling a wear law.
//!
//! Here are the facts a library file shows before any of its code runs, the guard of the floating-point
//! environment, and the way from sources to a library. Contact, wear and scenes are not here.

pub mod build;
pub mod file_facts;
pub mod float_env;
#[cfg(feature = "layout-check")]
pub mod layout_check;
