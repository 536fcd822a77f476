//! Skeleton.

pub mod integrator;
pub mod scene;
