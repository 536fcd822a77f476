//! Skeleton.

pub mod law;
