//! Skeleton.
pub mod power;
