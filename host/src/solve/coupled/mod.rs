//! The run on a contact that answers back: wear changes the gap, the gap changes the pressure, the pressure wears.
//!
//! [`Coupled`] goes through the loading; a [`System`](system::System) solves the contact with the law in it at one moment,
//! and the formulas of [`crate::integrator`] make steps of such moments. Step control, the rule that keeps second-order
//! steps from wearing a gap open, and what is told on the way are here; solving a contact for given gaps is not.

mod averaged;
mod coarser;
mod controlled;
mod exact;
mod going;
mod ladder;
mod law_points;
mod limit;
mod loading;
mod neighbours;
mod newton;
mod place;
mod prepared;
mod present;
mod proportional;
mod reference;
mod rows;
mod run;
mod segment;
mod stepper;
mod system;
mod trial;

pub(super) use run::Coupled;
