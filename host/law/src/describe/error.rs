//! What can be malformed in a law's description.

use thiserror::Error;
use wearlaw_plugin_api::abi;

/// More constants, state variables or inputs than any law has: a count beyond it is a mistake.
pub const MOST_QUANTITIES: i64 = 4096;

/// What is malformed in a law's description.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DescribeError {
    /// A text without its closing NUL.
    #[error("{what} is not closed by a NUL within its {size} bytes")]
    Unterminated {
        /// Which text.
        what: String,
        /// Bytes it has.
        size: usize,
    },
    /// A text in another encoding.
    #[error("{what} is not UTF-8: {found:?}")]
    NotUtf8 {
        /// Which text.
        what: String,
        /// As much of it as can be read.
        found: String,
    },
    /// A text with line breaks or other control characters.
    #[error("{what} is not one line of text: {found:?}")]
    NotOneLine {
        /// Which text.
        what: String,
        /// The text.
        found: String,
    },
    /// A name with characters that it must not have.
    #[error("{what} is {found:?}, expected {expected}")]
    Name {
        /// Which name.
        what: String,
        /// The name.
        found: String,
        /// What it may be made of.
        expected: &'static str,
    },
    /// Two of a kind with the same name.
    #[error("two {kind}s are called `{name}`")]
    Duplicate {
        /// Constant, state variable or input.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// An input with the name of a field of the ABI.
    #[error("input `{name}` has the name of a field, which a law declares in `reads` or `uses`")]
    FieldName {
        /// The name.
        name: String,
    },
    /// A count below zero or beyond reason.
    #[error("{what} is {found}, expected 0 to {MOST_QUANTITIES}")]
    Count {
        /// Which count.
        what: &'static str,
        /// The count.
        found: i64,
    },
    /// A mask with bit 63 set.
    #[error("{what} is negative ({found})")]
    NegativeMask {
        /// Which mask.
        what: &'static str,
        /// The mask.
        found: i64,
    },
    /// A field that this host does not know.
    #[error("it needs the field {}, which this host does not know (ABI 1.{host_minor}; the law was built for ABI 1.{law_minor})", field_words(name, *bit))]
    UnknownField {
        /// The law's own name of the field, if it gave one.
        name: Option<String>,
        /// Number of its bit.
        bit: u32,
        /// Minor version of the host.
        host_minor: i64,
        /// Minor version of the law.
        law_minor: i64,
    },
    /// A table whose size the law changed, which is the host's to state.
    #[error("it set the `struct_size` of its table to {found}, expected the {expected} that the host gave it")]
    TableSize {
        /// What the law wrote.
        found: i64,
        /// Bytes that the host gave.
        expected: i64,
    },
    /// No evaluate function.
    #[error("it has no `evaluate` function")]
    NoEvaluate,
    /// No describe function though there is something to describe.
    #[error(
        "it declares {constants} constants, {state} state variables and {inputs} inputs, but has no `describe` function"
    )]
    NoDescribe {
        /// Constants declared.
        constants: i64,
        /// State variables declared.
        state: i64,
        /// Inputs declared.
        inputs: i64,
    },
    /// `describe` stopped early or failed.
    #[error("`describe` answered {status} for {kind} {index}, expected {}", abi::WL_OK)]
    Describe {
        /// Constant, state variable or input.
        kind: &'static str,
        /// Index, from 0.
        index: i64,
        /// The answer.
        status: i32,
    },
    /// A number that is not finite where it must be.
    #[error("{what} is {found}, expected {expected}")]
    Number {
        /// Which number.
        what: String,
        /// The number.
        found: f64,
        /// What it may be.
        expected: &'static str,
    },
    /// Bounds that no number keeps.
    #[error("{kind} `{name}` has the bounds {minimum} and {maximum}, which no number keeps")]
    Bounds {
        /// Constant, state variable or input.
        kind: &'static str,
        /// Its name.
        name: String,
        /// The minimum.
        minimum: f64,
        /// The maximum.
        maximum: f64,
    },
    /// A default outside its own bounds.
    #[error("{kind} `{name}` has the default {default}, outside its bounds {interval}")]
    Default {
        /// Constant, state variable or input.
        kind: &'static str,
        /// Its name.
        name: String,
        /// The default.
        default: f64,
        /// The bounds.
        interval: String,
    },
    /// A state variable or input that closes the units.
    #[error("{kind} `{name}` is said to close the units, which only a constant can")]
    ClosesUnits {
        /// State variable or input.
        kind: &'static str,
        /// Its name.
        name: String,
    },
    /// Two constants that close the units.
    #[error("constants `{first}` and `{second}` both close the units, at most one may")]
    TwoCloseUnits {
        /// The first.
        first: String,
        /// The second.
        second: String,
    },
    /// A pressure degree in two ways.
    #[error("the pressure degree is claimed twice: {value}, and by constant {index}")]
    TwoDegrees {
        /// The value.
        value: f64,
        /// The index.
        index: i64,
    },
    /// A pressure degree held by a constant that does not exist.
    #[error("the pressure degree is held by constant {index}, expected -1 or an index below {count}")]
    DegreeIndex {
        /// The index.
        index: i64,
        /// Number of constants.
        count: i64,
    },
    /// State variables that are never written.
    #[error("it has {count} state variables, but does not write `state`")]
    StateNotWritten {
        /// Number of state variables.
        count: i64,
    },
}

fn field_words(name: &Option<String>, bit: u32) -> String {
    match name {
        Some(name) => format!("`{name}` (bit {bit})"),
        None => format!("of bit {bit}, which it does not name"),
    }
}
