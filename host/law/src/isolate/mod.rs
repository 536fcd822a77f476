//! A law in a worker process of the same program: a crash, a hang or an exit ends the worker and nothing else.
//!
//! Here are the worker's side, the parent's side and what passes between them: arrays in shared memory, one byte on a
//! pipe as the signal. The worker calls the law as the parent would, so the bits are the same. Linux only.

mod error;
#[cfg(target_os = "linux")]
mod parent;
#[cfg(target_os = "linux")]
pub mod process;
#[cfg(target_os = "linux")]
mod protocol;
#[cfg(target_os = "linux")]
mod search;
#[cfg(target_os = "linux")]
mod shared;
#[cfg(target_os = "linux")]
mod worker;

#[cfg(not(target_os = "linux"))]
mod elsewhere;

#[cfg(not(target_os = "linux"))]
pub use elsewhere::{IsolatedLaw, worker_main};
pub use error::IsolateError;
#[cfg(target_os = "linux")]
pub use parent::IsolatedLaw;
#[cfg(target_os = "linux")]
pub use worker::worker_main;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::entry::Entry;

/// First argument that makes the program a worker.
pub const WORKER_COMMAND: &str = "__worker";

/// Seconds that a call may take unless the user says otherwise: far beyond any call, and short enough to wait for.
pub const DEADLINE: Duration = Duration::from_secs(60);

/// Where an isolated law comes from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// A library file.
    File(PathBuf),
    /// A law of this program, by the name that [`worker_main`]'s caller knows it under.
    Embedded(String),
}

/// Which law a worker opens, and how it is run.
#[derive(Clone, Debug, PartialEq)]
pub struct IsolateOptions {
    /// Where the law comes from.
    pub source: Source,
    /// SHA-256 that the file must have.
    pub sha256: Option<String>,
    /// Name of the law, where a library holds several.
    pub law: Option<String>,
    /// The scene's options text for the law.
    pub options: Option<String>,
    /// Longest time for one call.
    pub deadline: Duration,
    /// The program that is the worker; none: this one.
    pub program: Option<PathBuf>,
}

impl IsolateOptions {
    /// The law of a source, with nothing else said.
    pub fn new(source: Source) -> Self {
        Self { source, sha256: None, law: None, options: None, deadline: DEADLINE, program: None }
    }
}

/// Finds a law of this program by its name, for a worker.
pub type FindEmbedded<'a> = &'a dyn Fn(&str) -> Option<Arc<dyn Entry>>;
