//! The stable C ABI of wear laws, and a safe Rust side for their authors.
//!
//! [`abi`] is the binary contract that every language shares; `include/wearlaw.h` is generated from it.

pub mod abi;
