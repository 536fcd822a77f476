//! What a law is tried on.
//!
//! Here are the points of a call as plain numbers, random inputs within the bounds that a law declares, the table of
//! values that its author computed, and what a law answers at a point. How a call is laid out and made is not here.

pub mod answer;
pub mod known;
pub mod points;
pub mod random;
pub mod sample;
pub mod ulps;

/// The description of the law of the program, for tests.
#[cfg(test)]
pub(crate) fn archard() -> wearlaw_law::LawDescriptor {
    use wearlaw_law::{Plugin, embedded};
    let plugin = Plugin::from_entry(embedded::entry("archard").unwrap()).unwrap();
    plugin.laws()[0].descriptor().clone()
}
