//! The errors of all modules in one type, which also says how the program ends.

use std::path::PathBuf;

use crate::apdl::{DeckError, Diagnostic, LowerError};
use crate::bench::BenchError;
use crate::conformance::ConformanceError;
use crate::contact::InstructionsError;
use crate::contact::prescribed::HistoryError;
use crate::exit_code::ExitCode;
use crate::fit::FitError;
use crate::law::build::BuildError;
use crate::law::file_facts::FileFactsError;
use crate::law::isolate::IsolateError;
use crate::law::lookup::LookupError;
use crate::law::{EvaluateError, LoadError};
use crate::output::OutputError;
use crate::plan::{PlanError, PlanProblem};
use crate::record::Difference;
use crate::scene::{Located, Location, SceneError};
use crate::shim::ShimError;
use crate::solve::SolveError;
use crate::study::StudyError;
use crate::sweep::SweepError;
use crate::templates::TemplateError;

/// Whatever can end a command early.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Arguments that the command line parser takes and the command cannot.
    #[error(transparent)]
    Usage(#[from] UsageError),
    /// A scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A command file is wrong.
    #[error(transparent)]
    Deck(#[from] DeckError),
    /// A material of a command file has no law section.
    #[error("{}: {error}", file.display())]
    Lower {
        /// The command file.
        file: PathBuf,
        /// What is wrong with the material.
        error: LowerError,
    },
    /// The name of a law leads nowhere; at the scene's key where it stands in one.
    #[error(transparent)]
    Lookup(#[from] Located<LookupError>),
    /// No constants were found from measurements.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// No user subroutine can call the law.
    #[error(transparent)]
    Shim(#[from] ShimError),
    /// A law could not be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A file is no wear-law library.
    #[error(transparent)]
    File(#[from] FileFactsError),
    /// A file that a scene names is no wear-law library.
    #[error(transparent)]
    LawFile(#[from] Located<FileFactsError>),
    /// A library gives no law.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A law could not be opened in a process of its own.
    #[error(transparent)]
    Isolate(#[from] IsolateError),
    /// A law failed at a point.
    #[error(transparent)]
    Evaluate(#[from] EvaluateError),
    /// The scene asks for what it cannot have.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The run ended before its time.
    #[error(transparent)]
    Solve(Box<SolveError>),
    /// A prescribed history is wrong.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// Results could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A run cannot go on from a checkpoint of another run.
    #[error(transparent)]
    Resume(#[from] Difference),
    /// The environment asks for instructions that the processor does not have.
    #[error(transparent)]
    Instructions(#[from] InstructionsError),
    /// A law could not be checked at all.
    #[error(transparent)]
    Conformance(#[from] ConformanceError),
    /// A sweep has no cases, or no table of them.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A study could not be made.
    #[error(transparent)]
    Study(Box<StudyError>),
    /// A law could not be measured.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// A new law's folder could not be made.
    #[error(transparent)]
    Template(#[from] TemplateError),
    /// Standard output does not take what a command prints.
    #[error("standard output could not be written: {0}")]
    Stdout(std::io::Error),
    /// There is no room for a law that is built on the way.
    #[error("temporary folder in `{}` could not be made: {source}", path.display())]
    Temporary {
        /// The folder for temporary files.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The system gave no threads.
    #[error("{threads} threads could not be started: {reason}")]
    Threads {
        /// How many.
        threads: usize,
        /// What the thread pool said.
        reason: String,
    },
    /// Ctrl-C, or a request to end.
    #[error("interrupted")]
    Interrupted,
    /// A panic.
    #[error(
        "a fault of wearlaw itself ({what}); please report it with the command you typed at {}/issues",
        env!("CARGO_PKG_REPOSITORY")
    )]
    Fault {
        /// Where, and the panic's own words.
        what: String,
    },
}

/// What the command line parser takes and the command cannot.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UsageError {
    /// `check` without a law.
    #[error("no law given, expected a library, a source file, a crate's folder or a name")]
    NoLaw,
    /// `new` without a language.
    #[error("no language given, expected one of --lang {}", known.join(", --lang "))]
    NoLanguage {
        /// The languages.
        known: Vec<String>,
    },
    /// The manual page of a command that there is not.
    #[error("there is no command `{name}`, expected one of {}", known.join(", "))]
    NoCommand {
        /// What was asked for.
        name: String,
        /// The commands.
        known: Vec<String>,
    },
    /// `--params` that name nothing.
    #[error("--params: {what}")]
    Parameters {
        /// What was found, and what was expected.
        what: String,
    },
    /// `--static` for a law that is no file.
    #[error("`{law}` is part of this program, so there is no file for --static to read")]
    NoFile {
        /// The law.
        law: String,
    },
    /// `--law NAME` for a file that nobody asked to load.
    #[error("--law names a law of a loaded library, but --static loads nothing; expected one of them")]
    StaticLaw,
    /// A scene's library with several laws.
    #[error("`{origin}` holds {} laws, expected the name of one behind a `#`, such as `{origin}#{}`; it has {}",
        known.len(), known.first().map_or("", String::as_str), known.join(", "))]
    SeveralLaws {
        /// The library, as the scene or the command line names it.
        origin: String,
        /// The names of its laws.
        known: Vec<String>,
    },
    /// One table of known values for several laws.
    #[error("--expected gives the values of one law, but {laws} were named")]
    ExpectedOfSeveral {
        /// How many.
        laws: usize,
    },
    /// A law where a scene belongs.
    #[error(
        "`{0}` is {what} of a law, expected a scene: a TOML file that says under what load and how the law wears, with \
         [law] use = \"{0}\"; `wearlaw new NAME --lang c` writes one, `wearlaw run SCENE --law {0}` takes the law in place of \
         a scene's own", path.display()
    )]
    LawNotScene {
        /// The path as typed.
        path: PathBuf,
        /// `a library` or `source code`.
        what: &'static str,
    },
    /// Sources where a library belongs.
    #[error("`{}` is source code, expected a library: build it first with `wearlaw build`", path.display())]
    SourceNotLibrary {
        /// The path as typed.
        path: PathBuf,
    },
}

impl From<SolveError> for Error {
    fn from(error: SolveError) -> Error {
        Error::Solve(Box::new(error))
    }
}

impl From<StudyError> for Error {
    fn from(error: StudyError) -> Error {
        match error {
            StudyError::Scene(error) => error.into(),
            StudyError::Plan(error) => error.into(),
            StudyError::Solve(error) => Error::Solve(error),
            StudyError::Interrupted => Error::Interrupted,
            other => Error::Study(Box::new(other)),
        }
    }
}

impl Error {
    /// How the program ends with this error.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::of(self)
    }

    /// The error as a terminal shows it: the source underlined where there is one; several lines, none empty at the end.
    pub fn render(&self, color: bool) -> String {
        match self {
            Self::Scene(error) => error.render(color),
            Self::Plan(error) => match &*error.problem {
                // The deck's own line says more than the scene's that names the deck.
                PlanProblem::Deck(deck @ DeckError::Command(_)) => deck.render(),
                _ => error.render(color),
            },
            Self::Lookup(error) => error.render(color),
            Self::LawFile(error) => error.render(color),
            Self::Deck(error @ DeckError::Command(_)) => error.render(),
            other => Located::new(printable(&other.to_string()), None).render(color),
        }
    }

    /// The error as JSON: `kind` (the exit code's word), `message`, and the place where it has one.
    pub fn to_json(&self) -> serde_json::Value {
        let mut json = serde_json::json!({ "kind": self.exit_code().word(), "message": self.to_string() });
        let deck = self.deck();
        if let Some(found) = deck {
            json["message"] = found.problem.to_string().into();
            set_place(&mut json, &found.source, found.line, found.column);
        }
        if let Some((message, location)) = self.located() {
            if deck.is_none() {
                json["message"] = message.into();
            }
            if let Some(location) = location {
                if !location.in_override() && deck.is_none() {
                    set_place(&mut json, location.file(), location.line(), location.column());
                }
                if !location.key().is_empty() {
                    json["key"] = location.key().into();
                }
            }
        }
        if let Self::Build(error) = self
            && !error.messages().is_empty()
        {
            json["compiler"] = error.messages().into();
        }
        json
    }

    /// The problem without its place, and its place in the scene.
    fn located(&self) -> Option<(String, Option<&Location>)> {
        match self {
            Self::Scene(error) => Some((error.problem.to_string(), error.location.as_ref())),
            Self::Lookup(error) => Some((error.problem.to_string(), error.location.as_ref())),
            Self::LawFile(error) => Some((error.problem.to_string(), error.location.as_ref())),
            Self::Plan(error) => Some((error.problem.to_string(), error.location.as_ref())),
            _ => None,
        }
    }

    /// What is wrong with a command file, read for itself or for a scene.
    fn deck(&self) -> Option<&Diagnostic> {
        match self {
            Self::Deck(DeckError::Command(found)) => Some(found),
            Self::Plan(error) => match &*error.problem {
                PlanProblem::Deck(DeckError::Command(found)) => Some(found),
                _ => None,
            },
            _ => None,
        }
    }
}

fn set_place(json: &mut serde_json::Value, file: &str, line: usize, column: usize) {
    json["file"] = file.into();
    json["line"] = line.into();
    json["column"] = column.into();
}

/// A text from elsewhere with its control characters made visible, so that no file steers the terminal.
pub fn printable(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() && character != '\n' {
            plain.extend(character.escape_default());
        } else {
            plain.push(character);
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_scene_error_underlines_its_line_and_says_its_place_in_json() {
        let error = Error::from(Scene::parse("titel = 1\n", "a.toml", &[]).unwrap_err());
        let shown = error.render(false);
        assert!(shown.starts_with("error: ") && shown.contains("a.toml:1:1") && shown.contains("^^^^^"), "{shown}");
        let json = error.to_json();
        assert_eq!((json["line"].as_u64(), json["column"].as_u64()), (Some(1), Some(1)));
        assert_eq!((json["kind"].as_str(), json["file"].as_str()), (Some("input"), Some("a.toml")));
        assert!(error.render(true).contains('\u{1b}'));
    }

    #[test]
    fn other_errors_are_one_sentence_without_control_characters() {
        let error = Error::from(FileFactsError::NotFound { path: "a\u{1b}[2J.so".into() });
        let shown = error.render(false);
        assert_eq!(shown, "error: no file `a\\u{1b}[2J.so`, expected a wear-law library");
        assert_eq!(error.exit_code(), ExitCode::InputWrong);
    }

    #[test]
    fn a_fault_asks_for_a_report() {
        let error = Error::Fault { what: "at a.rs:1: no".into() };
        assert!(error.to_string().contains("please report"));
        assert_eq!(error.exit_code().number(), 70);
    }
}
