//! What a call of a law comes to, and the trait of everything that can be called.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::batch::{Batch, Outputs};
use super::descriptor::LawDescriptor;
use super::fields::Fields;
use super::number_text;

/// Something that evaluates a law: in this process or in a worker of its own.
pub trait Evaluator: Send + Sync {
    /// What the law is.
    fn descriptor(&self) -> &LawDescriptor;

    /// Evaluates the law at the points of `batch`; every output that is given is written, or an error says why not.
    ///
    /// It may be called from several threads at once on ranges of one batch; a serial law is then called in turn.
    ///
    /// # Errors
    /// A status that voids the values, an output that breaks the contract, or a worker that was lost.
    fn evaluate(&self, batch: &Batch<'_>, outputs: &mut Outputs<'_>) -> Result<Evaluation, EvaluateError>;

    /// Takes the warnings gathered since the last call, each text once in a lifetime.
    fn take_warnings(&self) -> Vec<String>;
}

/// The good and the retryable ends of a call.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Evaluation {
    /// The values are good.
    Good,
    /// The values may be used, with a warning.
    Unreliable {
        /// First such point and its inputs, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
    /// The values are void; a substep shorter by `factor` may work.
    CutStep {
        /// Factor in (0, 1) on the substep.
        factor: f64,
        /// First such point and its inputs, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
}

impl Evaluation {
    /// The worse of two ends of one substep: good, unreliable, cut; of two cuts the shorter substep.
    pub fn worse(self, other: Evaluation) -> Evaluation {
        match (&self, &other) {
            (_, Evaluation::Good) => self,
            (Evaluation::CutStep { factor: mine, .. }, Evaluation::CutStep { factor: yours, .. }) => {
                if yours < mine {
                    other
                } else {
                    self
                }
            }
            (Evaluation::CutStep { .. }, _) => self,
            (_, Evaluation::CutStep { .. }) | (Evaluation::Good, _) => other,
            (Evaluation::Unreliable { .. }, Evaluation::Unreliable { .. }) => self,
        }
    }
}

/// A point and what the law was given there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointInputs {
    /// Index from 0, counted in the batch that the caller built (not in a range of it).
    pub point: usize,
    /// Name and values (3 of a vector) of the fields, constants, inputs and state variables.
    pub values: Vec<NamedValues>,
}

/// One input at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NamedValues {
    /// Name of the field, constant, further input or state variable.
    pub name: String,
    /// One number, or the three of a vector.
    pub values: Vec<NumberText>,
}

impl NamedValues {
    /// Names some numbers.
    pub fn new(name: &str, values: &[f64]) -> Self {
        Self { name: name.to_owned(), values: values.iter().copied().map(NumberText).collect() }
    }
}

/// A double that survives JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct NumberText(#[serde(with = "number_text")] pub f64);

impl std::fmt::Display for PointInputs {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "point {} (", self.point)?;
        for (index, one) in self.values.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            match one.values.as_slice() {
                [value] => write!(out, "{comma}{} = {:e}", one.name, value.0)?,
                values => {
                    let values: Vec<f64> = values.iter().map(|value| value.0).collect();
                    write!(out, "{comma}{} = {values:?}", one.name)?;
                }
            }
        }
        out.write_str(")")
    }
}

/// Why the values of a call are void; a worker passes it on as JSON.
#[derive(Clone, Debug, PartialEq, Error, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EvaluateError {
    /// The batch was built for another law.
    #[error("law `{law}` was given a batch that was built for law `{found}`")]
    OtherLaw {
        /// The law that was called.
        law: String,
        /// The law of the batch.
        found: String,
    },
    /// An output array has the wrong length.
    #[error("output `{output}` of law `{law}` has {found} values, expected {expected}")]
    OutputLength {
        /// The law.
        law: String,
        /// The output.
        output: String,
        /// Its length.
        found: usize,
        /// The length for this batch.
        expected: usize,
    },
    /// An output was asked for that the law does not write.
    #[error("output `{output}` was asked for, but law `{law}` does not write it")]
    NotWritten {
        /// The law.
        law: String,
        /// The output.
        output: String,
    },
    /// The inputs are outside what the law can answer.
    #[error("law `{law}` cannot answer at {}{}", place(at), words(text))]
    OutOfDomain {
        /// The law.
        law: String,
        /// The first such point, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
    /// The law misses an input that it did not declare as needed.
    #[error("law `{law}` misses {} at {}{}", missing_names(*fields, *unknown), place(at), words(text))]
    MissingInput {
        /// The law.
        law: String,
        /// The fields it misses.
        fields: Fields,
        /// Bits of it that have no name here.
        unknown: i64,
        /// The first such point, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
    /// The law failed.
    #[error("law `{law}` failed at {}{}", place(at), words(text))]
    Failed {
        /// The law.
        law: String,
        /// The first such point, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
    /// The law answered a status that the ABI does not have.
    #[error("law `{law}` answered status {status}, which does not exist, at {}{}", place(at), words(text))]
    UnknownStatus {
        /// The law.
        law: String,
        /// What it answered.
        status: i32,
        /// The first such point, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
    /// The law asked for a shorter substep with a factor that does not shorten it.
    #[error("law `{law}` asked to cut the substep by the factor {}, expected one between 0 and 1, at {}{}", factor.0, place(at), words(text))]
    BadFactor {
        /// The law.
        law: String,
        /// The factor.
        factor: NumberText,
        /// The first such point, if it is known.
        at: Option<PointInputs>,
        /// The law's own words; may be empty.
        text: String,
    },
    /// An output is infinite or not a number.
    #[error("law `{law}` gave {output} = {} at {at}, expected a finite number", value.0)]
    NotFinite {
        /// The law.
        law: String,
        /// The output: `increment`, `direction`, `d_pressure` or the name of a state variable.
        output: String,
        /// What it gave.
        value: NumberText,
        /// The point.
        at: PointInputs,
    },
    /// The wear increment is negative, and the law claimed that it never is.
    #[error("law `{law}` gave increment = {:e} at {at}, but claims that it is never negative", value.0)]
    Negative {
        /// The law.
        law: String,
        /// What it gave.
        value: NumberText,
        /// The point.
        at: PointInputs,
    },
    /// The wear direction is not a unit vector.
    #[error("law `{law}` gave a direction of length {} at {at}, expected 1 within {:e}", length.0, tolerance.0)]
    DirectionLength {
        /// The law.
        law: String,
        /// Its length.
        length: NumberText,
        /// How far from 1 it may be.
        tolerance: NumberText,
        /// The point.
        at: PointInputs,
    },
    /// The worker process of the law was lost.
    #[error("law `{law}` {how} in call {call}, points {first} to {last}{}", at_place(at))]
    WorkerLost {
        /// The law.
        law: String,
        /// What became of it: `crashed (signal 11)`, `did not answer within 60 s`, ..
        how: String,
        /// Number of the call, from 1.
        call: u64,
        /// First point of the piece that was being evaluated.
        first: usize,
        /// Last point of that piece.
        last: usize,
        /// The point and its inputs, if running the piece again showed it.
        at: Option<PointInputs>,
    },
    /// The channel to the worker failed.
    #[error("the channel to the worker of law `{law}` failed in call {call}: {reason}")]
    Channel {
        /// The law.
        law: String,
        /// Number of the call, from 1.
        call: u64,
        /// What the system said.
        reason: String,
    },
}

impl Evaluation {
    /// The point that it names, if it names one.
    pub fn at_mut(&mut self) -> Option<&mut PointInputs> {
        match self {
            Self::Good => None,
            Self::Unreliable { at, .. } | Self::CutStep { at, .. } => at.as_mut(),
        }
    }
}

impl EvaluateError {
    /// The point that it names, if it names one.
    pub fn at_mut(&mut self) -> Option<&mut PointInputs> {
        match self {
            Self::OtherLaw { .. } | Self::OutputLength { .. } | Self::NotWritten { .. } | Self::Channel { .. } => None,
            Self::OutOfDomain { at, .. }
            | Self::MissingInput { at, .. }
            | Self::Failed { at, .. }
            | Self::UnknownStatus { at, .. }
            | Self::BadFactor { at, .. }
            | Self::WorkerLost { at, .. } => at.as_mut(),
            Self::NotFinite { at, .. } | Self::Negative { at, .. } | Self::DirectionLength { at, .. } => Some(at),
        }
    }
}

fn place(at: &Option<PointInputs>) -> String {
    match at {
        Some(at) => at.to_string(),
        None => "a point that it did not name".to_owned(),
    }
}

fn at_place(at: &Option<PointInputs>) -> String {
    at.as_ref().map(|at| format!(", at {at}")).unwrap_or_default()
}

fn words(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!(": {text}") }
}

fn missing_names(fields: Fields, unknown: i64) -> String {
    let mut names: Vec<String> = fields.names().iter().map(|name| format!("`{name}`")).collect();
    if unknown != 0 {
        names.push(format!("fields unknown here (bits {unknown:#x})"));
    }
    if names.is_empty() { "an input that it did not name".to_owned() } else { names.join(", ") }
}
