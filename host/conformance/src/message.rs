//! What passes between the checker and its worker: a task, and the answer to it.

use std::path::PathBuf;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::check::Check;
use super::outcome::Finding;
use wearlaw_law::Source;

/// What a worker is to do: one check of one law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Task {
    pub(super) check: Check,
    pub(super) source: Source,
    /// Name of the law, where a library holds several.
    pub(super) law: Option<String>,
    /// Options text for the law.
    pub(super) options: Option<String>,
    pub(super) seed: u64,
    /// Less is tried where much would be.
    pub(super) quick: bool,
    /// Table of known values.
    pub(super) expected: Option<PathBuf>,
    /// Seconds after which a loop of many calls is cut short.
    pub(super) budget: f64,
    /// Number of a call before which each of its points is called alone, to find the one that matters.
    pub(super) narrow: Option<u64>,
    /// Bits of the answers of another process, to compare with.
    pub(super) bits: Vec<u64>,
}

/// What a body makes of a law.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum Verdict {
    Pass(Option<String>),
    Warn(Finding),
    Fail(Finding),
    Skip(String),
}

/// The answer to a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Answer {
    pub(super) verdict: Verdict,
    /// Names of the library's laws, where the task was to look.
    pub(super) laws: Vec<String>,
    /// Bits of answers, for a comparison with another process.
    pub(super) bits: Vec<u64>,
    /// A panic of the checker itself.
    pub(super) fault: Option<String>,
}

impl From<Verdict> for Answer {
    fn from(verdict: Verdict) -> Self {
        Self { verdict, laws: Vec::new(), bits: Vec::new(), fault: None }
    }
}

impl Serialize for Check {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Check {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Check::named(&name).ok_or_else(|| D::Error::custom(format!("no check `{name}`")))
    }
}

/// How a body ends early; `?` on it gives the verdict.
pub(super) type Judged<T = Verdict> = Result<T, Box<Verdict>>;

/// The verdict of a broken rule, to return early with.
pub(super) fn broken<T>(finding: Finding) -> Judged<T> {
    Err(Box::new(Verdict::Fail(finding)))
}

/// The verdict that a check does not apply, to return early with.
pub(super) fn skip<T>(reason: impl Into<String>) -> Judged<T> {
    Err(Box::new(Verdict::Skip(reason.into())))
}
