//! Why a function of the C interface answers something else than 0, and the status of each reason.

use thiserror::Error;
use wearlaw::law::lookup::LookupError;
use wearlaw::law::{BatchError, ConstantsError, EvaluateError, IsolateError, LoadError};
use wearlaw_plugin_api::abi;

use crate::abi::{WLH_BAD_HANDLE, WLH_BAD_INPUT, WLH_BUSY, WLH_INTERNAL, WLH_NOT_LOADED};

/// Why a call from C is not done.
#[derive(Debug, Error)]
pub(crate) enum HostError {
    #[error("found a handle that is {found}, expected an open {expected}")]
    Handle { found: &'static str, expected: &'static str },
    #[error("the surface is in use by another thread, expected one thread at a time: open a surface for each")]
    Busy,
    #[error("an internal error: {0}")]
    Internal(String),
    #[error("`{0}` is NULL")]
    Null(&'static str),
    #[error("`{what}` is at address {address:#x}, expected a multiple of {align} as {kind} has")]
    Misaligned { what: String, address: usize, align: usize, kind: &'static str },
    #[error("`{name}.struct_size` is {found}, expected at least {least}: set it to sizeof({name})")]
    StructSize { name: &'static str, found: i64, least: usize },
    #[error("`{name}` sets members behind its byte {known}, which this library, being older, does not know")]
    UnknownMembers { name: &'static str, known: usize },
    #[error("`{what}` is not UTF-8 (byte {position})")]
    Text { what: &'static str, position: usize },
    #[error("{} is {found}, expected {expected}", quoted(.what))]
    Number { what: String, found: String, expected: String },
    #[error("field {bits:#x} is none, expected one WL_FIELD_ bit of wearlaw.h")]
    Field { bits: i64 },
    #[error("`{field}` is given as a column of {found}, expected one of {expected}: use {function}")]
    Kind { field: &'static str, found: &'static str, expected: &'static str, function: &'static str },
    #[error("`{field}` is set, but the solver's `provides` says that it does not provide it")]
    NotSaid { field: &'static str },
    #[error("law `{law}` needs `{field}`, which the solver's `provides` does not have: provide {constant} by {how}")]
    NotProvided { law: String, field: &'static str, constant: String, how: &'static str },
    #[error("law `{law}` needs `{name}`, which was not set: {remedy}")]
    NotSet { law: String, name: String, remedy: String },
    #[error("law `{law}` has no input `{name}`{}; it has {}", suggestion(.nearest), list(.known))]
    UnknownInput { law: String, name: String, nearest: Option<String>, known: Vec<String> },
    #[error("output `{output}` overlaps `{other}`, which must not change while the law reads it")]
    Overlap { output: &'static str, other: String },
    #[error("`{field}` of point {point} is {value}, expected a finite number: the table of constants depends on it")]
    Temperature { field: &'static str, point: usize, value: f64 },
    #[error("there is nothing to commit: no good evaluation since the last commit or roll back")]
    NothingToCommit,
    #[error("`{0}` is the source of a law, expected a library: build it with `wearlaw build {0}`")]
    IsSource(String),
    #[error("row {row}: {source}")]
    Row { row: usize, source: ConstantsError },
    #[error(transparent)]
    Constants(#[from] ConstantsError),
    #[error(transparent)]
    Lookup(#[from] LookupError),
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    Isolate(#[from] IsolateError),
    #[error(transparent)]
    Batch(#[from] BatchError),
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
}

impl HostError {
    /// What the function answers.
    pub(crate) fn status(&self) -> i32 {
        match self {
            Self::Handle { .. } => WLH_BAD_HANDLE,
            Self::Busy => WLH_BUSY,
            Self::Internal(_) => WLH_INTERNAL,
            Self::Lookup(_) | Self::IsSource(_) | Self::Load(_) | Self::Isolate(_) => WLH_NOT_LOADED,
            Self::Evaluate(error) => of_evaluation(error),
            _ => WLH_BAD_INPUT,
        }
    }
}

fn of_evaluation(error: &EvaluateError) -> i32 {
    match error {
        EvaluateError::OtherLaw { .. } | EvaluateError::OutputLength { .. } | EvaluateError::NotWritten { .. } => {
            WLH_BAD_INPUT
        }
        EvaluateError::OutOfDomain { .. } => abi::WL_OUT_OF_DOMAIN,
        EvaluateError::MissingInput { .. } => abi::WL_MISSING_INPUT,
        _ => abi::WL_FAILED,
    }
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default()
}

/// A name in quotes; words that quote one stay as they are.
fn quoted(what: &str) -> String {
    if what.contains('`') { what.to_owned() } else { format!("`{what}`") }
}

fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "none".to_owned();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
