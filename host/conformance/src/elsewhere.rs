//! What stands in for the checker on systems that have no worker processes as it needs them.

use std::sync::atomic::AtomicBool;

use super::{CheckOptions, ConformanceError, Event, Report};

/// Says that this system cannot do it.
///
/// # Errors
/// Always.
pub fn run(
    _options: &CheckOptions,
    _on: &mut (dyn FnMut(Event<'_>) + Send),
    _stop: &AtomicBool,
) -> Result<Report, ConformanceError> {
    Err(ConformanceError::Platform)
}

/// Ends with the exit code of wrong input: there are no workers on this system.
pub fn worker_main(_arguments: &[String]) -> i32 {
    2
}
