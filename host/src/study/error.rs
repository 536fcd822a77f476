//! Why a study cannot be made.

use crate::plan::PlanError;
use crate::scene::SceneError;
use crate::solve::SolveError;

/// Why a study cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene asks for what it cannot have.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The scene cannot be prepared, or its yardstick fails.
    #[error(transparent)]
    Solve(Box<SolveError>),
    /// What is varied is not there to be varied.
    #[error("found {found}, but {reason}; expected a study without that")]
    NotThere {
        /// What was asked for.
        found: String,
        /// Why the scene has none.
        reason: String,
    },
    /// The yardstick alone takes longer than the budget.
    #[error(
        "the run that others would be compared with was not done in {allowed_s:.3} s, its part of the budget of \
         {budget_s:.3} s; expected a larger `--budget`, or a scene that is less dear"
    )]
    Budget {
        /// The budget; s.
        budget_s: f64,
        /// The part of it for the yardstick; s.
        allowed_s: f64,
    },
    /// The yardstick cannot be had.
    #[error("no run to compare others with: {0}")]
    Yardstick(String),
    /// It was interrupted before anything could be compared.
    #[error("interrupted")]
    Interrupted,
}

impl From<SolveError> for StudyError {
    fn from(error: SolveError) -> StudyError {
        StudyError::Solve(Box::new(error))
    }
}
