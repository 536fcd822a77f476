//! Skeleton.
pub mod output;
pub mod record;
