//! Skeleton.
pub mod apdl;
pub mod scene;
