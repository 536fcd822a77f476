//! What can be wrong with a history, with the file and the place in it.

use std::path::PathBuf;

/// A history that cannot be read or does not make sense.
///
/// Lines count from 1 in the file, comments included; columns count from 1 within the line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each field is named in the variant's message")]
pub enum HistoryError {
    /// No file of that name.
    #[error("{}: no such file, expected a history in CSV or NPZ", path.display())]
    Missing { path: PathBuf },
    /// A directory or another thing that is not a file.
    #[error("{}: found a directory or device, expected a history file in CSV or NPZ", path.display())]
    NotAFile { path: PathBuf },
    /// The operating system failed to read the file.
    #[error("{}: cannot be read: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    /// A file of zero bytes or of comments only.
    #[error("{}: empty file, expected a header row such as time,point,pressure", path.display())]
    Empty { path: PathBuf },
    /// Column names without rows, or arrays without elements.
    #[error("{}: no rows, expected at least one time and one point", path.display())]
    NoRows { path: PathBuf },
    /// A column name that is neither documented nor an input of the law.
    #[error(
        "{}: unknown column `{name}`{}{}",
        path.display(),
        place(*line, *column),
        suggestion(nearest)
    )]
    UnknownColumn { path: PathBuf, name: String, line: u64, column: usize, nearest: Option<String> },
    /// The same name twice.
    #[error("{}: column `{name}` is given twice{}", path.display(), place(*line, *column))]
    RepeatedColumn { path: PathBuf, name: String, line: u64, column: usize },
    /// A column that is always needed, or that the plan asked for, is not there.
    #[error("{}: no column `{name}`{}, found {}", path.display(), purpose(name), list(found))]
    MissingColumn { path: PathBuf, name: String, found: Vec<String> },
    /// Two columns that say the same thing in different ways.
    #[error("{}: both `{first}` and `{second}` are given, expected one of them", path.display())]
    Conflict { path: PathBuf, first: &'static str, second: &'static str },
    /// Part of a vector or tensor.
    #[error(
        "{}: `{present}` without `{missing}`, expected all of {group} (in 2-D, the x-z plane, all without y)",
        path.display()
    )]
    PartOfVector { path: PathBuf, present: &'static str, missing: &'static str, group: &'static str },
    /// A row with too many or too few fields.
    #[error("{}: line {line}: found {found} fields, expected {expected} as in the header", path.display())]
    FieldCount { path: PathBuf, line: u64, found: usize, expected: usize },
    /// A field that is not a number.
    #[error("{}: line {line}, column {column} (`{name}`): found `{text}`, expected a number", path.display())]
    NotANumber { path: PathBuf, line: u64, column: usize, name: String, text: String },
    /// A point id that is not an integer.
    #[error("{}: line {line}, column {column} (`point`): found `{text}`, expected an integer", path.display())]
    NotAnId { path: PathBuf, line: u64, column: usize, text: String },
    /// NaN, infinity or a number too large for a double, in a CSV file.
    #[error(
        "{}: line {line}, column {column} (`{name}`): found `{text}`, expected a finite number",
        path.display()
    )]
    NotFinite { path: PathBuf, line: u64, column: usize, name: String, text: String },
    /// NaN or infinity in an array.
    #[error("{}: array `{name}`, element {element}: found {value}, expected a finite number", path.display())]
    NotFiniteElement { path: PathBuf, name: String, element: usize, value: f64 },
    /// A point id in an array that is not an integer.
    #[error("{}: array `point`, element {element}: found {value}, expected an integer", path.display())]
    NotAnIdElement { path: PathBuf, element: usize, value: f64 },
    /// Times that decrease.
    #[error("{}{}: time goes back from {before} to {time} (point {point})", path.display(), at(*line))]
    TimeGoesBack { path: PathBuf, line: u64, before: f64, time: f64, point: i64 },
    /// Times of a grid that decrease.
    #[error("{}: array `time`, element {element}: time goes back from {before} to {time}", path.display())]
    TimesGoBack { path: PathBuf, element: usize, before: f64, time: f64 },
    /// A time of a grid that occurs more than twice.
    #[error(
        "{}: array `time`, element {element}: time {time} is given more than twice, expected once, or twice for a jump",
        path.display()
    )]
    TimeThrice { path: PathBuf, element: usize, time: f64 },
    /// A time that occurs more than twice; twice is a jump.
    #[error(
        "{}{}: time {time} is given more than twice (point {point}), expected once, or twice for a jump",
        path.display(),
        at(*line)
    )]
    TimeRepeated { path: PathBuf, line: u64, time: f64, point: i64 },
    /// A point without a row at a time where others have one.
    #[error(
        "{}: point {point} has no row at time {time}, where point {other} has one; expected every point at every time",
        path.display()
    )]
    PointMissing { path: PathBuf, point: i64, time: f64, other: i64 },
    /// A point twice at a time that others have once.
    #[error(
        "{}{}: point {point} is given twice at time {time}, where point {other} is given once; expected once, or twice for every point (a jump)",
        path.display(),
        at(*line)
    )]
    PointTwice { path: PathBuf, line: u64, point: i64, time: f64, other: i64 },
    /// The same id twice in the `point` array of a grid.
    #[error("{}: array `point` holds the id {point} twice", path.display())]
    RepeatedId { path: PathBuf, point: i64 },
    /// An area of zero or less, or a coefficient of friction below zero.
    #[error("{}{}: {column} {value} of point {point} at time {time}, expected {expected}", path.display(), at(*line))]
    Value { path: PathBuf, line: u64, column: &'static str, value: f64, point: i64, time: f64, expected: &'static str },
    /// A normal of length zero.
    #[error("{}{}: normal of length 0 at point {point}, time {time}", path.display(), at(*line))]
    ZeroNormal { path: PathBuf, line: u64, point: i64, time: f64 },
    /// Not an archive, or one that is cut off or damaged.
    #[error("{}: not a readable NPZ archive: {reason}", path.display())]
    Archive { path: PathBuf, reason: String },
    /// A member of the archive that is not an array as documented.
    #[error("{}: array `{name}`: {fault}", path.display())]
    Array { path: PathBuf, name: String, fault: super::super::npy::ArrayFault },
    /// An array whose shape fits neither the times nor the points.
    #[error("{}: array `{name}` has shape {}, expected {expected}", path.display(), shape_text(shape))]
    Shape { path: PathBuf, name: String, shape: Vec<usize>, expected: String },
    /// More than memory can hold.
    #[error("{}: array `{name}` needs {bytes} bytes, more than this machine gives", path.display())]
    TooLarge { path: PathBuf, name: String, bytes: u64 },
}

impl HistoryError {
    /// Whether reading failed, as opposed to the file being wrong.
    pub fn is_io(&self) -> bool {
        matches!(self, HistoryError::Io { .. })
    }
}

fn place(line: u64, column: usize) -> String {
    if line == 0 { String::new() } else { format!(" at line {line}, column {column}") }
}

fn at(line: u64) -> String {
    if line == 0 { String::new() } else { format!(": line {line}") }
}

fn suggestion(nearest: &Option<String>) -> String {
    match nearest {
        Some(name) => format!("; did you mean `{name}`?"),
        None => "; the law declares no input of that name".to_string(),
    }
}

/// What a column is for that a law may do without.
fn purpose(name: &str) -> &'static str {
    if name == "pressure" {
        " (above zero it says where there is contact, whether or not the law reads it)"
    } else {
        ""
    }
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_string() } else { names.join(", ") }
}

fn shape_text(shape: &[usize]) -> String {
    let inner: Vec<String> = shape.iter().map(usize::to_string).collect();
    match inner.len() {
        1 => format!("({},)", inner[0]),
        _ => format!("({})", inner.join(", ")),
    }
}
