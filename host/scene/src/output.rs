//! `[output]` and `[reference]`: what is written, and what the answer should be.

use std::path::PathBuf;

use serde::{Serialize, Serializer};

use super::bound::{Bound, LARGEST_COUNT};
use super::contact::ModelKind;
use super::error::{Problem, SceneError};
use super::reader::{Section, Word};

/// `[output]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Output {
    /// Names of the fields to write. Without the key: pressure and wear where the section says when (`every`, `times`)
    /// or how (`formats`) to write, else none, because nobody asked.
    pub fields: Vec<String>,
    /// When fields are written: `every` or `times`.
    #[serde(flatten)]
    pub every: Every,
    /// Files the fields are written to; CSV and VTK by default.
    pub formats: Vec<Format>,
    /// Seconds of wall time between checkpoints; `None`: none but the last.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub checkpoint: Option<f64>,
    /// Whether the errors of steps and grid are estimated by further runs.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub error_estimate: bool,
}

/// When fields are written.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Every {
    /// At the end only.
    #[default]
    End,
    /// Every so many accepted steps, and at the end.
    Steps(u64),
    /// At these times, which increase and are not negative.
    Times(Vec<f64>),
}

/// File formats of fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Format {
    /// Comma-separated values.
    Csv,
    /// Zipped NumPy arrays.
    Npz,
    /// VTK, for ParaView.
    Vtk,
}

/// `[reference]`: what the answer should be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reference {
    /// What the result is compared with: `kind` or `file`.
    #[serde(flatten)]
    pub target: Target,
    /// Largest error that passes; a larger one ends the run with exit code 1. `None`: the error is only reported.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bar: Option<f64>,
}

/// What a result is compared with.
#[derive(Debug, Clone, PartialEq)]
pub enum Target {
    /// A built-in exact answer by name; the plan knows which there are.
    Exact(String),
    /// The same scene, refined (`kind = "self"`).
    Refined,
    /// Values in a file.
    File(PathBuf),
}

impl Word for Format {
    const ALL: &'static [(&'static str, Self)] = &[("csv", Self::Csv), ("npz", Self::Npz), ("vtk", Self::Vtk)];
}

impl Default for Output {
    fn default() -> Self {
        Self {
            fields: Vec::new(),
            every: Every::End,
            formats: vec![Format::Csv, Format::Vtk],
            checkpoint: None,
            error_estimate: false,
        }
    }
}

impl Serialize for Every {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::End => serializer.collect_map([("every", "end")]),
            Self::Steps(steps) => serializer.collect_map([("every", steps)]),
            Self::Times(times) => serializer.collect_map([("times", times)]),
        }
    }
}

impl Serialize for Target {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Exact(kind) => serializer.collect_map([("kind", kind)]),
            Self::Refined => serializer.collect_map([("kind", "self")]),
            Self::File(file) => serializer.collect_map([("file", file)]),
        }
    }
}

impl Output {
    pub(super) fn read(section: &Section<'_>, model: ModelKind) -> Result<Self, SceneError> {
        let keys = ["fields", "every", "times", "formats", "checkpoint", "error_estimate"];
        section.keys(&keys.map(|key| (key, &[][..])), model)?;
        section.at_most_one(&["every", "times"])?;
        let asked = ["every", "times", "formats"].iter().any(|key| section.get(key).is_some());
        let fields = match section.get("fields") {
            Some(item) => {
                let names = item.list("a list of field names")?;
                names.iter().map(|name| name.name("the name of a field")).collect::<Result<_, _>>()?
            }
            None if asked => vec!["pressure".to_owned(), "wear".to_owned()],
            None => Vec::new(),
        };
        let formats = match section.get("formats") {
            Some(item) => item.list("a list of formats")?.iter().map(|word| word.word()).collect::<Result<_, _>>()?,
            None => Self::default().formats,
        };
        let checkpoint = section.get("checkpoint").map(|item| item.number(Bound::Above(0.0))).transpose()?;
        let error_estimate = section.get("error_estimate").map(|item| item.boolean()).transpose()?.unwrap_or(false);
        Ok(Self { fields, every: Every::read(section)?, formats, checkpoint, error_estimate })
    }
}

impl Every {
    fn read(section: &Section<'_>) -> Result<Self, SceneError> {
        if let Some(item) = section.get("every") {
            return match item.text() {
                Ok(word) if word == "end" => Ok(Self::End),
                Ok(word) => Err(item.unknown_word(&word, &["end"])),
                Err(_) => match item.count(1, LARGEST_COUNT) {
                    Err(error) if matches!(*error.problem, Problem::WrongType { .. }) => {
                        Err(item.wrong("\"end\" or a number of steps"))
                    }
                    count => count.map(Self::Steps),
                },
            };
        }
        let Some(item) = section.get("times") else {
            return Ok(Self::End);
        };
        let mut times: Vec<f64> = Vec::new();
        for entry in item.list("a list of times")? {
            let found = entry.number(Bound::AtLeast(0.0))?;
            if let Some(&before) = times.last()
                && found <= before
            {
                return Err(entry.error(Problem::TimesGoBack { key: item.path.clone(), found, before }));
            }
            times.push(found);
        }
        Ok(Self::Times(times))
    }
}

impl Reference {
    pub(super) fn read(section: &Section<'_>, model: ModelKind) -> Result<Self, SceneError> {
        section.keys(&[("kind", &[]), ("file", &[]), ("bar", &[])], model)?;
        section.at_most_one(&["kind", "file"])?;
        let target = match (section.get("kind"), section.get("file")) {
            (Some(item), _) => match item.name("the name of an exact answer, or \"self\"")? {
                kind if kind == "self" => Target::Refined,
                kind => Target::Exact(kind),
            },
            (None, Some(item)) => Target::File(item.path()?),
            (None, None) => return Err(section.missing("kind` or `file", "to compare with")),
        };
        Ok(Self { target, bar: section.get("bar").map(|item| item.number(Bound::Above(0.0))).transpose()? })
    }
}
