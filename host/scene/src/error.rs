//! What can be wrong with a scene.

use std::path::PathBuf;

use super::bound::Bound;
use super::constants::RowShape;
use super::contact::ModelKind;
use super::phrase::{Because, Entries, Hint, List, Most, Point, Stranger};
use super::place::Located;

/// A problem of a scene with its place in the file or in an override.
pub type SceneError = Located<Problem>;

/// What is wrong: what was found and what was expected; the place is beside it in [`SceneError`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file could not be read.
    #[error("could not read the scene {path}: {}", plain(*kind))]
    Read {
        /// The file as it was named.
        path: PathBuf,
        /// What the system said.
        kind: std::io::ErrorKind,
    },
    /// The file is not text.
    #[error("found bytes that are not UTF-8, expected a text file")]
    NotUtf8,
    /// The text is not TOML.
    #[error("not valid TOML: {message}")]
    Syntax {
        /// What the TOML parser expected.
        message: String,
    },
    /// A key nobody knows at this place.
    #[error("found the unknown key `{key}` in {section}{}", Hint(nearest, valid))]
    UnknownKey {
        /// The key as written.
        key: String,
        /// The section it stands in, in words.
        section: String,
        /// The nearest key that is valid there.
        nearest: Option<String>,
        /// All keys that are valid there.
        valid: Vec<String>,
    },
    /// A key of another contact model.
    #[error("found `{key}` in a scene with contact.model = \"{model}\", expected it only with {}", List(models))]
    OtherModel {
        /// The key.
        key: String,
        /// The scene's model.
        model: ModelKind,
        /// The models it belongs to.
        models: Vec<ModelKind>,
    },
    /// A key of another surface shape or kind of entry.
    #[error("found `{key}` where {setting} = \"{found}\", expected it only with {}", List(expected))]
    OtherSetting {
        /// The key.
        key: String,
        /// The key that decides.
        setting: String,
        /// What that key says.
        found: String,
        /// What it would have to say.
        expected: Vec<String>,
    },
    /// A value of the wrong type.
    #[error("found {found} for `{key}`, expected {expected}")]
    WrongType {
        /// The key.
        key: String,
        /// The value, described.
        found: String,
        /// The type that belongs there.
        expected: &'static str,
    },
    /// NaN or infinity.
    #[error("found {found} for `{key}`, expected a finite number")]
    NotFinite {
        /// The key.
        key: String,
        /// The value.
        found: f64,
    },
    /// A number outside the range of its key.
    #[error("found {found:?} for `{key}`, expected {bound}")]
    OutOfRange {
        /// The key.
        key: String,
        /// The value.
        found: f64,
        /// The range.
        bound: Bound,
    },
    /// A whole number outside the range of its key.
    #[error("found {found} for `{key}`, expected a whole number not below {least}{}", Most(*most))]
    CountOutOfRange {
        /// The key.
        key: String,
        /// The value.
        found: i128,
        /// The smallest allowed value.
        least: u64,
        /// The largest allowed value.
        most: u64,
    },
    /// A word that is none of the key's words.
    #[error("found \"{found}\" for `{key}`{}", Hint(nearest, words))]
    UnknownWord {
        /// The key.
        key: String,
        /// The word as written.
        found: String,
        /// The nearest valid word.
        nearest: Option<String>,
        /// All valid words.
        words: Vec<String>,
    },
    /// An empty string where a name or path is needed.
    #[error("found an empty string for `{key}`, expected {expected}")]
    EmptyText {
        /// The key.
        key: String,
        /// What belongs there.
        expected: &'static str,
    },
    /// A required key is missing.
    #[error("found no `{key}` in {section}, expected one{}", Because(reason))]
    Missing {
        /// The key, or keys with "or" between them.
        key: String,
        /// The section, in words.
        section: String,
        /// What makes it required; empty if it always is.
        reason: &'static str,
    },
    /// Two keys that exclude each other.
    #[error("found both `{first}` and `{second}`, expected one of them")]
    Both {
        /// One key.
        first: String,
        /// The other key.
        second: String,
    },
    /// A key that means something only beside another.
    #[error("found `{key}` without `{partner}`, expected both or neither")]
    Alone {
        /// The key.
        key: String,
        /// The key that is missing.
        partner: &'static str,
    },
    /// A key that needs something else of the scene.
    #[error("found `{key}`, expected it only {condition}")]
    Misplaced {
        /// The key.
        key: String,
        /// When it means something.
        condition: &'static str,
    },
    /// A list of the wrong length.
    #[error(
        "found {} for `{key}`, expected {expected}{}",
        Entries(*found), Because(reason)
    )]
    WrongLength {
        /// The key.
        key: String,
        /// Its length.
        found: usize,
        /// The length that fits.
        expected: usize,
        /// Why that length.
        reason: &'static str,
    },
    /// More cells than can be counted.
    #[error("found {cells:?} for `{key}`, expected at most {most} cells in all")]
    TooManyCells {
        /// The key.
        key: String,
        /// Cells in each direction.
        cells: Vec<usize>,
        /// The most there can be.
        most: u64,
    },
    /// Shares that do not make up the whole.
    #[error("found shares that sum to {sum:?} for `{key}`, expected them to sum to 1")]
    ShareSum {
        /// The key.
        key: String,
        /// The sum.
        sum: f64,
    },
    /// A digest that is not one.
    #[error("found {length} characters{} for `{key}`, expected 64 hexadecimal digits", Stranger(stranger))]
    Digest {
        /// The key.
        key: String,
        /// Its length in characters.
        length: usize,
        /// The first character that is no hexadecimal digit.
        stranger: Option<char>,
    },
    /// A direction of no length.
    #[error("found a direction of length {length:?} for `{key}`, expected one that points somewhere")]
    NoDirection {
        /// The key.
        key: String,
        /// Its length.
        length: f64,
    },
    /// A direction that leaves the plane of a 2-D scene.
    #[error("found a y component of {y:?} for `{key}` in a scene with contact.dimension = 2, expected [x, z]")]
    LeavesPlane {
        /// The key.
        key: String,
        /// The y component.
        y: f64,
    },
    /// Times that do not increase.
    #[error("found {found:?} after {before:?} in `{key}`, expected times that increase")]
    TimesGoBack {
        /// The key.
        key: String,
        /// The time that is too early.
        found: f64,
        /// The time before it.
        before: f64,
    },
    /// A row of a table that says neither when nor how warm.
    #[error("found a row of `law.table` with neither `time` nor `temperature`, expected one of them or both")]
    RowWithoutPoint,
    /// Rows of a table with different axes.
    #[error("found a row of `law.table` with {found}, expected {expected} as in the first row")]
    RowAxes {
        /// The axes of this row.
        found: &'static str,
        /// The axes of the first row.
        expected: &'static str,
    },
    /// Rows of a table with different constants.
    #[error("found a row of `law.table` with {found}, expected {expected} as in the first row")]
    RowConstants {
        /// The constants of this row.
        found: RowShape,
        /// The constants of the first row.
        expected: RowShape,
    },
    /// Two rows for one point.
    #[error("found a second row of `law.table` at {}, expected one row a point", Point(time, temperature))]
    RowRepeated {
        /// Its time.
        time: Option<f64>,
        /// Its temperature.
        temperature: Option<f64>,
    },
    /// A table over time and temperature with a hole.
    #[error("found no row of `law.table` at {}, expected a full grid of {times} times and {temperatures} temperatures", Point(&Some(*time), &Some(*temperature)))]
    TableHole {
        /// The missing time.
        time: f64,
        /// The missing temperature.
        temperature: f64,
        /// Number of times in the table.
        times: usize,
        /// Number of temperatures in the table.
        temperatures: usize,
    },
    /// A ramp of a quantity the step does not give.
    #[error("found `{quantity}` in `{key}`, expected a quantity that this step gives")]
    RampWithoutEnd {
        /// The key.
        key: String,
        /// The quantity.
        quantity: String,
    },
    /// A ramp from a step that does not give the quantity.
    #[error("found `{quantity}` in `{key}`, expected `{before}` to give it too, because a ramp starts from there")]
    RampWithoutStart {
        /// The key.
        key: String,
        /// The quantity.
        quantity: String,
        /// The step before.
        before: String,
    },
    /// An override that is not `key=value`.
    #[error("found \"{text}\", expected key=value, for instance step.0.load=5")]
    OverrideForm {
        /// The override as given.
        text: String,
    },
    /// An override of an entry that does not exist.
    #[error(
        "found entry {index} of `{list}`, which has {count} (counted from 0), expected one that the scene has (`[[{list}]]` in the scene adds one)"
    )]
    NoSuchEntry {
        /// The list.
        list: String,
        /// The entry asked for.
        index: String,
        /// How many there are.
        count: usize,
    },
    /// An override of a list where an entry is meant.
    #[error("found `{key}` of the list `{list}`, expected the number of an entry first, as in {list}.0.{key}")]
    EntryNeeded {
        /// The list.
        list: String,
        /// The key asked for.
        key: String,
    },
    /// An override that goes into a plain value.
    #[error("found `{key}` of `{parent}`, which is {found}, expected a section")]
    NotASection {
        /// The key asked for.
        key: String,
        /// The value it was asked of.
        parent: String,
        /// What that value is.
        found: String,
    },
}

/// What the system said, in the words of a shell.
fn plain(kind: std::io::ErrorKind) -> String {
    match kind {
        std::io::ErrorKind::NotFound => "no such file".to_owned(),
        other => other.to_string(),
    }
}
