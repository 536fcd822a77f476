//! The C ABI of wear laws, major version 1.
//!
//! Everything here is `repr(C)`, has no behaviour, and is what `include/wearlaw.h` is generated from.
//! The safe side for laws written in Rust is in [`crate::sdk`]; loading a law is the host's business and not here.

mod descriptor;
mod masks;
mod status;
mod version;
mod views;

pub use descriptor::{Host, LawTable, Quantity};
pub use masks::*;
pub use status::*;
pub use version::*;
pub use views::{Column, IndexColumn, Output, View};

/// The one function a plugin exports, under the name [`ENTRY_SYMBOL`].
///
/// Called with `index` 0, 1, .. until it answers [`WL_NO_MORE`]; each call fills one [`LawTable`] that the host has
/// allocated, zeroed and given its `struct_size`.
pub type EntryFn = unsafe extern "C" fn(index: i32, host: *const Host, law: *mut LawTable) -> i32;
