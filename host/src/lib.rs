//! Skeleton.

pub mod scene;
