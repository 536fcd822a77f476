//! The stable C ABI of wear laws, and a safe Rust side for their authors.
//!
//! [`abi`] is the binary contract that every language shares; `include/wearlaw.h` is generated from it.
//! [`sdk`] is for laws written in Rust: a trait for a law at one point, a trait for a whole batch, and the macro
//! [`export_laws!`] that makes a plugin of them.
//!
//! ```
//! use wearlaw_plugin_api::sdk::prelude::*;
//!
//! /// Wear in proportion to pressure and slip.
//! struct Proportional;
//!
//! impl About for Proportional {
//!     const NAME: &'static str = "proportional";
//!     const VERSION: &'static str = "1.0.0";
//!     const SUMMARY: &'static str = "wear in proportion to pressure and slip";
//!     const READS: i64 = WL_FIELD_PRESSURE | WL_FIELD_SLIP;
//!     const CLAIMS: i64 = WL_CLAIM_LINEAR_IN_DT | WL_CLAIM_ZERO_WITHOUT_SLIP;
//!     const CONSTANTS: &'static [Quantity] = &[Quantity::new("k", Unit::PER_PASCAL).at_least(0.0)];
//!     const INSTANCE: Option<Self> = Some(Proportional);
//! }
//!
//! impl PointLaw for Proportional {
//!     fn point(&self, at: &Point, out: &mut PointAnswer) -> Status {
//!         let [k] = at.constants();
//!         out.increment = k * at.pressure * at.slip;
//!         Status::Ok
//!     }
//! }
//!
//! export_laws!(Proportional);
//! # fn main() {}
//! ```

pub mod abi;
#[cfg(feature = "layout")]
pub mod layout;
pub mod sdk;
