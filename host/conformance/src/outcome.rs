//! What a check comes to, and the evidence for it.

use serde::{Deserialize, Serialize};

use super::check::Check;

/// How the reason begins why a check was skipped for want of an instance.
pub(super) const NOT_STARTED: &str = "the law refuses to start";

/// Evidence against a law: enough for its author to see what happened and to do it again.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// One sentence: what is wrong.
    pub what: String,
    /// The call: each input by its name, numbers so that they can be read back.
    pub input: Vec<(String, String)>,
    /// What came out.
    pub found: Option<String>,
    /// What the contract wants instead.
    pub expected: Option<String>,
    /// What the law printed, its last lines.
    pub printed: Option<String>,
}

impl Finding {
    /// A finding of one sentence.
    pub fn new(what: impl Into<String>) -> Self {
        Self { what: what.into(), ..Self::default() }
    }

    /// With what came out and what was expected.
    pub fn with(mut self, found: impl Into<String>, expected: impl Into<String>) -> Self {
        (self.found, self.expected) = (Some(found.into()), Some(expected.into()));
        self
    }

    /// With the inputs of the call.
    pub fn at(mut self, input: Vec<(String, String)>) -> Self {
        self.input = input;
        self
    }
}

/// How a check ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The law keeps the rule; with a word on what was seen, where there is one.
    Pass(Option<String>),
    /// Worth the author's attention, but no failure.
    Warn(Finding),
    /// The law breaks the rule.
    Fail(Finding),
    /// The law ended the worker process.
    Crashed(Finding),
    /// The law did not come back in time.
    TimedOut(Finding),
    /// It does not apply, for this reason.
    Skipped(String),
    /// Another check failed, and this one says nothing without it.
    Blocked(Check),
}

impl Outcome {
    /// The outcome's name in every format.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Pass(_) => "pass",
            Self::Warn(_) => "warn",
            Self::Fail(_) => "fail",
            Self::Crashed(_) => "crashed",
            Self::TimedOut(_) => "timed-out",
            Self::Skipped(_) => "skipped",
            Self::Blocked(_) => "blocked",
        }
    }

    /// True if the law falls short by it.
    pub fn falls_short(&self) -> bool {
        matches!(self, Self::Fail(_) | Self::Crashed(_) | Self::TimedOut(_) | Self::Blocked(_))
    }

    /// True if the check was run to an end.
    pub fn has_run(&self) -> bool {
        !matches!(self, Self::Skipped(_) | Self::Blocked(_))
    }

    /// The evidence, where there is some.
    pub fn finding(&self) -> Option<&Finding> {
        match self {
            Self::Warn(finding) | Self::Fail(finding) | Self::Crashed(finding) | Self::TimedOut(finding) => {
                Some(finding)
            }
            Self::Pass(_) | Self::Skipped(_) | Self::Blocked(_) => None,
        }
    }
}

/// One check of one law, done.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckResult {
    /// Name of the law; none for what concerns the whole library.
    pub law: Option<String>,
    /// The check.
    pub check: Check,
    /// How it ended.
    pub outcome: Outcome,
    /// Wall time, s.
    pub seconds: f64,
    /// The file that brings a failure back, where one was written.
    pub replay: Option<std::path::PathBuf>,
}
