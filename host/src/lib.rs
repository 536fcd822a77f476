//! Skeleton.
pub mod contact;
pub mod reference;
