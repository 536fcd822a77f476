//! Ctrl-C: the first asks the work to end well, the second ends the program at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

use crate::error::Error;
use crate::exit_code::ExitCode;

/// The wish to end.
#[derive(Debug, Clone, Default)]
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens for Ctrl-C and requests to end from now on.
    pub(super) fn watch() -> Self {
        let interrupt = Self::default();
        for signal in [SIGINT, SIGTERM] {
            // In this order: the first signal finds the flag down and only raises it. Without a handler, the system's
            // own way of ending a program stays.
            let code = i32::from(ExitCode::Interrupted.number());
            if register_conditional_shutdown(signal, code, Arc::clone(&interrupt.0)).is_ok() {
                let _ = register(signal, Arc::clone(&interrupt.0));
            }
        }
        interrupt
    }

    /// Whether the work should end.
    pub(super) fn asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag itself, for work that looks at it.
    pub(super) fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }

    /// An error once the work should end; what fails because of the interruption is not an error of its own.
    pub(super) fn over<T>(&self, result: Result<T, Error>) -> Result<T, Error> {
        if self.asked() { Err(Error::Interrupted) } else { result }
    }
}
