//! How a command ends, as a number that scripts can rely on.

use std::io::ErrorKind;

use crate::apdl::DeckError;
use crate::bench::BenchError;
use crate::conformance::ConformanceError;
use crate::contact::prescribed::HistoryError;
use crate::contact::surface::SurfaceError;
use crate::error::Error;
use crate::fit::FitError;
use crate::integrator::AdvanceError;
use crate::law::EvaluateError;
use crate::law::LoadError;
use crate::law::build::BuildError;
use crate::law::file_facts::FileFactsError;
use crate::law::isolate::IsolateError;
use crate::output::OutputError;
use crate::plan::PlanProblem;
use crate::scene::Problem;
use crate::solve::{PointError, ReferenceError, SolveError};
use crate::study::StudyError;
use crate::sweep::SweepError;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum ExitCode {
    /// Done.
    Done = 0,
    /// The thing checked falls short: a check failed, or a bar in the scene was missed.
    FallsShort = 1,
    /// The input is wrong: arguments, scene, command file, sources, or a file that is no law.
    InputWrong = 2,
    /// The law failed: a bad status, a crash, a hang, a broken contract.
    LawFailed = 3,
    /// The numbers failed: no convergence, or an instability that was refused.
    NumbersFailed = 4,
    /// Reading or writing failed.
    ReadWriteFailed = 5,
    /// A fault of this program.
    ProgramFault = 70,
    /// Interrupted; what was done so far is written.
    Interrupted = 130,
}

impl ExitCode {
    /// All of them, ascending.
    pub const ALL: [ExitCode; 8] = [
        Self::Done,
        Self::FallsShort,
        Self::InputWrong,
        Self::LawFailed,
        Self::NumbersFailed,
        Self::ReadWriteFailed,
        Self::ProgramFault,
        Self::Interrupted,
    ];

    /// The number that the process ends with.
    pub fn number(self) -> u8 {
        self as u8
    }

    /// One word for it, the same in JSON and in the help.
    pub fn word(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::FallsShort => "falls-short",
            Self::InputWrong => "input",
            Self::LawFailed => "law",
            Self::NumbersFailed => "numbers",
            Self::ReadWriteFailed => "files",
            Self::ProgramFault => "fault",
            Self::Interrupted => "interrupted",
        }
    }

    /// What it means, for the help.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::FallsShort => "the thing checked falls short",
            Self::InputWrong => "the input is wrong: arguments, scene, command file, not a law",
            Self::LawFailed => "the law failed",
            Self::NumbersFailed => "the numbers failed",
            Self::ReadWriteFailed => "reading or writing failed",
            Self::ProgramFault => "a fault of this program",
            Self::Interrupted => "interrupted",
        }
    }

    /// The exit code of an error: the one place that decides it.
    pub fn of(error: &Error) -> Self {
        match error {
            Error::Scene(error) => match &*error.problem {
                Problem::Read { kind, .. } => of_reading(*kind),
                _ => Self::InputWrong,
            },
            Error::Deck(error) => match error {
                DeckError::Read { cause, .. } => of_reading(cause.kind()),
                _ => Self::InputWrong,
            },
            Error::Resume(_)
            | Error::Instructions(_)
            | Error::Lower { .. }
            | Error::Usage(_)
            | Error::Lookup(_)
            | Error::Shim(_) => Self::InputWrong,
            Error::Build(error) => of_build(error),
            Error::File(error) => of_file(error),
            Error::LawFile(error) => of_file(&error.problem),
            Error::Load(error) => of_loading(error),
            Error::Isolate(error) => of_isolating(error),
            Error::Bench(error) => of_measuring(error),
            Error::Evaluate(error) => of_evaluating(error),
            Error::Plan(error) => match &*error.problem {
                PlanProblem::History(error) => of_history(error),
                PlanProblem::Deck(DeckError::Read { cause, .. }) => of_reading(cause.kind()),
                _ => Self::InputWrong,
            },
            Error::Solve(error) => of_solving(error),
            Error::History(error) => of_history(error),
            Error::Output(error) => match error {
                OutputError::NotAResult { .. }
                | OutputError::ForeignReport { .. }
                | OutputError::NotAFolder { .. }
                | OutputError::InTheWay { .. }
                | OutputError::NotACheckpoint { .. }
                | OutputError::CheckpointVersion { .. } => Self::InputWrong,
                OutputError::FieldLength { .. } | OutputError::TwoOfOneName { .. } => Self::ProgramFault,
                OutputError::Io { .. }
                | OutputError::Drawing { .. }
                | OutputError::CheckpointDamaged { .. }
                | OutputError::EarlierFields { .. } => Self::ReadWriteFailed,
            },
            Error::Conformance(error) => of_checking(error),
            Error::Sweep(SweepError::Cases { source, .. }) => match source.kind() {
                csv::ErrorKind::Io(error) => of_reading(error.kind()),
                _ => Self::InputWrong,
            },
            Error::Sweep(_) => Self::InputWrong,
            Error::Study(error) => match **error {
                StudyError::Yardstick(_) => Self::NumbersFailed,
                _ => Self::InputWrong,
            },
            Error::Fit(error) => of_fitting(error),
            Error::Template(error) if error.is_io() => Self::ReadWriteFailed,
            Error::Template(_) => Self::InputWrong,
            Error::Stdout(_) | Error::Temporary { .. } | Error::Threads { .. } => Self::ReadWriteFailed,
            Error::Interrupted => Self::Interrupted,
            Error::Fault { .. } => Self::ProgramFault,
        }
    }
}

fn of_history(error: &HistoryError) -> ExitCode {
    if error.is_io() { ExitCode::ReadWriteFailed } else { ExitCode::InputWrong }
}

fn of_loading(error: &LoadError) -> ExitCode {
    match error {
        LoadError::File(error) => of_file(error),
        _ if error.code_has_run() => ExitCode::LawFailed,
        _ => ExitCode::InputWrong,
    }
}

fn of_isolating(error: &IsolateError) -> ExitCode {
    match error {
        IsolateError::Load(error) => of_loading(error),
        IsolateError::Start { .. } => ExitCode::ReadWriteFailed,
        _ if error.code_has_run() => ExitCode::LawFailed,
        _ => ExitCode::InputWrong,
    }
}

fn of_measuring(error: &BenchError) -> ExitCode {
    match error {
        BenchError::Load(error) => of_loading(error),
        BenchError::Isolate(error) => of_isolating(error),
        BenchError::Evaluate(error) => of_evaluating(error),
        BenchError::NoInputs { .. } | BenchError::CutStep { .. } => ExitCode::LawFailed,
        BenchError::Expected { .. } => ExitCode::InputWrong,
        BenchError::Threads { .. } => ExitCode::ReadWriteFailed,
        BenchError::Batch(_) => ExitCode::ProgramFault,
        BenchError::Interrupted => ExitCode::Interrupted,
    }
}

fn of_checking(error: &ConformanceError) -> ExitCode {
    match error {
        ConformanceError::Platform
        | ConformanceError::NoSuchCheck { .. }
        | ConformanceError::NothingRun { .. }
        | ConformanceError::Waiver { .. }
        | ConformanceError::Replay { .. } => ExitCode::InputWrong,
        ConformanceError::Read { source, .. } => of_reading(source.kind()),
        ConformanceError::Write { .. } | ConformanceError::Start { .. } => ExitCode::ReadWriteFailed,
        ConformanceError::Fault { .. } => ExitCode::ProgramFault,
        ConformanceError::Interrupted => ExitCode::Interrupted,
    }
}

fn of_evaluating(error: &EvaluateError) -> ExitCode {
    match error {
        EvaluateError::OtherLaw { .. } | EvaluateError::OutputLength { .. } | EvaluateError::NotWritten { .. } => {
            ExitCode::ProgramFault
        }
        _ => ExitCode::LawFailed,
    }
}

fn of_solving(error: &SolveError) -> ExitCode {
    match error {
        SolveError::History(error) => of_history(error),
        SolveError::Checkpoint(_)
        | SolveError::NoDuration { .. }
        | SolveError::HistoryTooShort { .. }
        | SolveError::NoSuchTime { .. }
        | SolveError::NothingTouches { .. } => ExitCode::InputWrong,
        SolveError::Interrupted => ExitCode::Interrupted,
        SolveError::Advance { source, .. } => match &**source {
            AdvanceError::Evaluate(PointError::Law(error)) => of_evaluating(error),
            AdvanceError::Evaluate(PointError::Batch(_)) => ExitCode::ProgramFault,
            AdvanceError::Evaluate(PointError::Direction { by_law: false, .. }) => ExitCode::InputWrong,
            AdvanceError::Evaluate(
                PointError::Direction { .. }
                | PointError::SmallestStep(_)
                | PointError::NotLinear { .. }
                | PointError::NotProportional { .. }
                | PointError::NotMonotone { .. },
            )
            | AdvanceError::SmallestStep { .. } => ExitCode::LawFailed,
            AdvanceError::Evaluate(PointError::Contact(_) | PointError::Newton { .. })
            | AdvanceError::Tolerance { .. }
            | AdvanceError::Stalled { .. }
            | AdvanceError::ManySubsteps { .. } => ExitCode::NumbersFailed,
        },
        SolveError::Surface(error) => of_surface(error),
        SolveError::BeyondLimit { .. } | SolveError::DomainFull { .. } => ExitCode::NumbersFailed,
        SolveError::Threads { .. } | SolveError::Contents { .. } => ExitCode::ReadWriteFailed,
        SolveError::Reference(ReferenceError::Read { source, .. }) => match source.kind() {
            csv::ErrorKind::Io(cause) => of_reading(cause.kind()),
            _ => ExitCode::InputWrong,
        },
        SolveError::Reference(_) => ExitCode::InputWrong,
    }
}

fn of_surface(error: &SurfaceError) -> ExitCode {
    if error.is_io() { ExitCode::ReadWriteFailed } else { ExitCode::InputWrong }
}

/// A name that leads nowhere was typed wrongly; anything else is the machine's.
fn of_reading(kind: ErrorKind) -> ExitCode {
    match kind {
        ErrorKind::NotFound | ErrorKind::IsADirectory | ErrorKind::NotADirectory => ExitCode::InputWrong,
        _ => ExitCode::ReadWriteFailed,
    }
}

fn of_build(error: &BuildError) -> ExitCode {
    match error {
        BuildError::SourceUnreadable { source, .. } => of_reading(source.kind()),
        BuildError::OutputNotWritable { source, .. } => of_reading(source.kind()),
        BuildError::TemporaryFiles { .. } | BuildError::NotStarted { .. } => ExitCode::ReadWriteFailed,
        _ => ExitCode::InputWrong,
    }
}

fn of_fitting(error: &FitError) -> ExitCode {
    match error {
        FitError::Read { source, .. } => match source.kind() {
            csv::ErrorKind::Io(error) => of_reading(error.kind()),
            _ => ExitCode::InputWrong,
        },
        FitError::Run { .. } | FitError::Search(_) => ExitCode::NumbersFailed,
        FitError::Interrupted => ExitCode::Interrupted,
        _ => ExitCode::InputWrong,
    }
}

fn of_file(error: &FileFactsError) -> ExitCode {
    match error {
        FileFactsError::Unreadable { .. } => ExitCode::ReadWriteFailed,
        _ => ExitCode::InputWrong,
    }
}

impl From<ExitCode> for std::process::ExitCode {
    fn from(code: ExitCode) -> Self {
        Self::from(code.number())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_the_documented_ones() {
        let numbers = ExitCode::ALL.map(ExitCode::number);
        assert_eq!(numbers, [0, 1, 2, 3, 4, 5, 70, 130]);
    }

    #[test]
    fn a_law_that_ran_is_told_from_a_file_that_is_none() {
        let none = LoadError::File(FileFactsError::Empty { path: "a.so".into() });
        assert_eq!(ExitCode::of(&none.into()), ExitCode::InputWrong);
        let ran = LoadError::NoLaws { library: "a.so".into() };
        assert_eq!(ExitCode::of(&ran.into()), ExitCode::LawFailed);
        let name = LoadError::Ambiguous { library: "a.so".into(), known: vec!["a".into(), "b".into()] };
        assert_eq!(ExitCode::of(&name.into()), ExitCode::InputWrong);
    }

    #[test]
    fn a_missing_file_is_wrong_input_and_a_locked_one_is_not() {
        let error = |kind| FileFactsError::Unreadable { path: "a.so".into(), source: std::io::Error::from(kind) };
        assert_eq!(ExitCode::of(&error(ErrorKind::PermissionDenied).into()), ExitCode::ReadWriteFailed);
        let source = std::io::Error::from(ErrorKind::NotFound);
        let missing = BuildError::SourceUnreadable { path: "a.c".into(), source };
        assert_eq!(ExitCode::of(&missing.into()), ExitCode::InputWrong);
    }
}
