//! What a scene asks for and cannot have, found before anything is computed.

use thiserror::Error;

use crate::apdl::DeckError;
use crate::contact::prescribed::HistoryError;
use crate::law::ConstantsError;
use crate::scene::Located;
use crate::scene::documented::ControlsError;

/// A problem of a plan, with its place in the scene.
pub type PlanError = Located<PlanProblem>;

/// What is wrong.
#[derive(Debug, Error)]
pub enum PlanProblem {
    /// Automatic scaling without substeps of a known length.
    #[error(
        "found automatic scaling (AUTS) with `integrator.tolerance`, expected `integrator.substeps`: it is the wear of a substep of known length that is scaled"
    )]
    ScalingNeedsSubsteps,
    /// Automatic scaling under loading that changes within a step.
    #[error(
        "found automatic scaling (AUTS) in a load step that ramps, expected loading that is constant over each step: a scaled substep stands for many under the same load (kind = \"cycle\" scales whole cycles)"
    )]
    ScalingOfRamp,
    /// The law's constants are wrong.
    #[error(transparent)]
    Constants(#[from] ConstantsError),
    /// The documented constants C5 to C8 are wrong.
    #[error(transparent)]
    Controls(#[from] ControlsError),
    /// The input deck is wrong.
    #[error(transparent)]
    Deck(#[from] DeckError),
    /// The history's names are wrong, or the file cannot be read.
    #[error(transparent)]
    History(#[from] HistoryError),
    /// The deck's material is for another law.
    #[error(
        "the deck's material {material} is for the Archard law, but `law.use` names law `{law}`; expected `archard`"
    )]
    OtherLaw {
        /// Number of the material.
        material: i64,
        /// The law in use.
        law: String,
    },
    /// Two places set the same thing to different values.
    #[error("found `{key}` = {scene} in the scene and {other} from {place}, expected the same or only one of them")]
    Both {
        /// The scene's key.
        key: &'static str,
        /// What the scene says.
        scene: String,
        /// What the other place says.
        other: String,
        /// The other place.
        place: &'static str,
    },
    /// The rows of a table set C5 to C8 to different things.
    #[error(
        "row {row} of the table sets C5 to C8 to something else than the rows before, expected the same in every row"
    )]
    ControlsDiffer {
        /// Row, from 1.
        row: usize,
    },
    /// A law reads what the scene cannot give.
    #[error("law `{law}` reads {field}, which nothing in the scene gives; {remedy}")]
    Missing {
        /// The law.
        law: String,
        /// The field or further input.
        field: String,
        /// The key that would give it, in words.
        remedy: String,
    },
    /// The wear direction is set twice.
    #[error(
        "found a wear direction in the scene, but law `{law}` sets the direction itself; expected only one of them"
    )]
    DirectionTwice {
        /// The law.
        law: String,
    },
    /// An initial value for a state variable is needed and nobody gives it.
    #[error("state variable `{name}` of law `{law}` has no initial value")]
    NoInitialState {
        /// The law.
        law: String,
        /// The state variable.
        name: String,
    },
    /// A field asked for does not exist here.
    #[error("found field \"{found}\" in the output, expected one of {known}{}", nearest.as_ref().map(|near| format!("; did you mean \"{near}\"?")).unwrap_or_default())]
    UnknownField {
        /// What was found.
        found: String,
        /// What there is.
        known: String,
        /// The nearest name.
        nearest: Option<String>,
    },
    /// A field asked for needs a column that the scene does not have.
    #[error("field \"{field}\" was asked for, but {reason}")]
    FieldNotThere {
        /// The field.
        field: String,
        /// Why it is not there.
        reason: &'static str,
    },
    /// Automatic scaling makes no sense where pressure is given.
    #[error(
        "found automatic scaling (AUTS) with a prescribed pressure, which wear does not change: there is nothing to scale by, and quadrature in time is exact already; expected kind = \"none\""
    )]
    ScalingOfPrescribed,
    /// A second-order method for a law with a memory.
    #[error(
        "found method \"{method}\", but law `{law}` {reason}, so every call is one whole substep and a second-order method has no stages to evaluate; expected \"auto\", \"implicit-euler\" or \"explicit-euler\""
    )]
    NeedsRate {
        /// The method.
        method: &'static str,
        /// The law.
        law: String,
        /// Why it is no rate.
        reason: &'static str,
    },
    /// A reference that does not exist.
    #[error("found reference kind \"{found}\", expected one of {known}{}", nearest.as_ref().map(|near| format!("; did you mean \"{near}\"?")).unwrap_or_default())]
    UnknownReference {
        /// What was found.
        found: String,
        /// What there is.
        known: String,
        /// The nearest name.
        nearest: Option<String>,
    },
    /// Loading that does not go together.
    #[error(
        "found load steps beside cycles over a history, expected one or the other: a history is gone through from its start in every cycle"
    )]
    StepsAndCycles,
    /// A quantity in a load step and in the history.
    #[error("found `{key}` and a column `{column}` in `contact.history`, expected one of them")]
    GivenTwice {
        /// The scene's key.
        key: String,
        /// The history's column.
        column: &'static str,
    },
    /// A velocity for each point from a file.
    #[error(
        "found a file of velocities in a prescribed scene, expected a number or the column `velocity` of `contact.history`"
    )]
    VelocityFile,
    /// A grid that the machine has no memory for.
    #[error(
        "found {cells} cells in all, which take {:.1} GB at the least, expected no more than the {:.1} GB that this machine has",
        *least as f64 * 1e-9, *machine as f64 * 1e-9
    )]
    TooManyCells {
        /// Cells of the grid.
        cells: u64,
        /// Bytes that they take at the least.
        least: u64,
        /// Bytes that the machine has.
        machine: u64,
    },
}
