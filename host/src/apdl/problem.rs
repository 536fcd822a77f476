//! What can be wrong with the wear commands of a deck, and where it is wrong.

use thiserror::Error;

use super::expression::ExpressionError;
use super::lexer::Span;
use crate::scene::documented::ControlsError;

/// What is wrong: what was found and what was expected; the place is kept beside it.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the message of each variant names its fields")]
pub enum Problem {
    #[error("expected `,` after `{command}`")]
    MissingComma { command: String },
    #[error("`{command}` has {limit} fields here, found another")]
    ExtraField { command: String, limit: usize },
    #[error("unknown TBOPT `{found}` of TB,WEAR: expected ARCD, USER, AUTS or CBCS{}", suggestion(.nearest))]
    UnknownOption { found: String, nearest: Option<String> },
    #[error("TB,WEAR without TBOPT: expected ARCD, USER, AUTS or CBCS in its sixth field")]
    MissingOption,
    #[error("`{command}` before any TB: expected a TB,WEAR above it")]
    NoTable { command: String },
    #[error("`{command}` changes a wear table in a way that is not read: expected TB, TBDATA, TBFIELD or TBTEMP")]
    UnreadTableCommand { command: String },
    #[error(
        "`{command}` stands inside {block} of line {line}, which is not evaluated: expected wear commands outside of blocks"
    )]
    InsideBlock { command: String, block: String, line: usize },
    #[error("{what}: {error}")]
    Expression { what: String, error: ExpressionError },
    #[error("{what} = {value} is not a whole number from {least} to {most}")]
    NotWhole { what: String, value: f64, least: i64, most: i64 },
    #[error("STLOC = {location} is out of range: {table} has constants C1 to C{most}")]
    LocationOutOfRange { location: f64, table: String, most: usize },
    #[error("found constant C{location}: {table} has constants C1 to C{most}")]
    TooManyConstants { location: usize, table: String, most: usize },
    #[error("C{location} ({name}) has no value and no default{place}")]
    MissingConstant { location: usize, name: String, place: String },
    #[error("TB,WEAR,{material} with {option} has no TBDATA: expected constants C1 to C{least}")]
    NoConstants { material: i64, option: String, least: usize },
    #[error("material {material} has {option} already: expected one wear law and one scaling per material")]
    DuplicateOption { material: i64, option: String },
    #[error(
        "material {material} scales the wear increment but has no law: expected TB,WEAR,{material} with ARCD or USER"
    )]
    ScalingWithoutLaw { material: i64 },
    #[error("unknown field variable `{found}` of a wear table: expected TIME or TEMP")]
    UnknownVariable { found: String },
    #[error("{what} has no value")]
    MissingValue { what: String },
    #[error("TBTEMP and TBFIELD in the same table: expected TBFIELD,TEMP or TBTEMP throughout")]
    MixedTemperature,
    #[error("`{command}` in a table of scaling factors: expected TBDATA only")]
    ScalingTable { command: String },
    #[error("{variable} = {value} has no TBDATA: expected constants before the next value")]
    NoDataAtPoint { variable: String, value: f64 },
    #[error("constants given {found}, those above {expected}: expected the same field variables throughout")]
    OtherVariables { found: String, expected: String },
    #[error(
        "{variable} = {value} goes back or is out of order: expected ascending values, each variable's whole range before the other's next value"
    )]
    GoesBack { variable: String, value: f64 },
    #[error("the point {point} is given already: expected ascending values")]
    Repeats { point: String },
    #[error("the table is not a full grid: no constants at {missing} ({times} times x {temperatures} temperatures, found {rows} of {} points)", .times * .temperatures)]
    IncompleteGrid { missing: String, times: usize, temperatures: usize, rows: usize },
    #[error("KMOD of TBTEMP is not read: expected the temperature only")]
    ModifiedTemperature,
    #[error("{0}")]
    Controls(#[from] ControlsError),
    #[error("C5 to C8 differ from those of the first row: expected the same controls in every row of a table")]
    ControlsDiffer,
    #[error("wear scaling factor C1 = {value}: expected more than 0 and less than 1")]
    Safety { value: f64 },
    #[error("maximum scale factor C2 = {value}: expected at least 1")]
    Maximum { value: f64 },
}

/// `; did you mean ..?` or nothing.
pub(super) fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

/// The candidate that differs from `found` in the fewest letters, if it is close enough to be a slip.
pub(super) fn nearest<'a>(found: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let found = found.to_ascii_uppercase();
    let allowed = (found.chars().count() / 3).max(1);
    candidates
        .map(|c| (strsim::damerau_levenshtein(&found, c), c))
        .filter(|(distance, _)| *distance <= allowed)
        .min()
        .map(|(_, c)| c.to_owned())
}

/// A problem and its place, before the text around it is looked up.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fault {
    pub problem: Problem,
    pub span: Span,
    /// Another place that explains this one, and what to say there.
    pub related: Option<(Span, &'static str)>,
}

impl Fault {
    pub fn new(problem: impl Into<Problem>, span: Span) -> Box<Self> {
        Box::new(Fault { problem: problem.into(), span, related: None })
    }

    pub fn beside(mut self: Box<Self>, span: Span, label: &'static str) -> Box<Self> {
        self.related = Some((span, label));
        self
    }
}
