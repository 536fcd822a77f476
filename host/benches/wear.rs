//! Whole runs.
fn main() {}
