//! How large steps may be, and what becomes of them.
//!
//! Here are the stiffness of a contact against wear ([`stiffness`]), what is seen of a step afterwards ([`judge`]) and the
//! answers of a law to extreme input ([`extremes`]). Taking the steps, and looking a law's derivative up at the pressures
//! of a contact, is not here (solve).

pub mod extremes;
pub mod judge;
pub mod stiffness;

/// Largest stable explicit step in units of 1 / stiffness: forward Euler multiplies a mode that decays at the rate s by
/// 1 - s dt, which is below 1 in size up to s dt = 2.
pub const EXPLICIT_LIMIT: f64 = 2.0;

/// The largest stable explicit step for a stiffness; infinite where nothing decays.
#[must_use]
pub fn explicit_limit(stiffness: f64) -> f64 {
    if stiffness > 0.0 { EXPLICIT_LIMIT / stiffness } else { f64::INFINITY }
}
