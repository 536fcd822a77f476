//! The Archard wear law, the reference plugin of wearlaw.
//!
//! [`Archard`] says what the law is and checks its inputs; the arithmetic is in [`power`]. Tables of constants, nodal
//! stresses, averaging and the wear direction (C5 to C8 of the documented model) are settings of the host and not here.

mod law;
pub mod power;

pub use law::Archard;

wearlaw_plugin_api::export_laws!(Archard);
