//! Why a surface has no initial gap.

use std::path::PathBuf;

use super::super::npy::ArrayFault;

/// Why an initial gap could not be made. Rows, columns and lines count from 1.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each field is named in the variant's message")]
pub enum SurfaceError {
    /// A number that gives no shape.
    #[error("`surface.{key}` is {found}, expected {expected}")]
    Number { key: &'static str, found: f64, expected: &'static str },
    /// A flat punch between the cells.
    #[error("no centre of a cell lies within the flat punch of width {width:e}, expected a width above {needed:e}")]
    NoCell { width: f64, needed: f64 },
    /// A place for the apex of a surface that has none.
    #[error("`surface.center` is given, but a surface of shape \"{shape}\" has no apex to place there; expected none")]
    Center { shape: &'static str },
    /// Waves that the cells cannot show.
    #[error(
        "`surface.{key}` asks for {found} waves over the {cells} cells in {axis}, expected at most {most}: a wave needs \
         two cells"
    )]
    TooManyWaves { key: &'static str, found: f64, axis: char, cells: usize, most: f64 },
    /// A spectrum without waves.
    #[error("`surface.cut_off` is {cut_off}, expected at least 1: no whole wave fits between 1 and it")]
    NoWave { cut_off: f64 },
    /// The file cannot be read.
    #[error("{}: the height map cannot be read: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    /// A file of a format that is not known.
    #[error("{}: found the ending {found:?}, expected a height map in .npy, .csv, .txt or .asc", path.display())]
    Ending { path: PathBuf, found: String },
    /// An array that is none, or not of real numbers.
    #[error("{}: {fault}", path.display())]
    Array { path: PathBuf, fault: ArrayFault },
    /// An array with too many indices.
    #[error("{}: found an array of {found} indices, expected a row of heights or a table [y][x]", path.display())]
    Indices { path: PathBuf, found: usize },
    /// A height map of another size than the grid.
    #[error(
        "{}: found {columns} x {rows} heights (in x and y), expected {} x {} as in `grid.cells`",
        path.display(), cells[0], cells[1]
    )]
    Size { path: PathBuf, columns: usize, rows: usize, cells: [usize; 2] },
    /// Rows of different lengths.
    #[error("{}: line {line}: found {found} heights, expected {expected} as in the rows above", path.display())]
    Ragged { path: PathBuf, line: usize, found: usize, expected: usize },
    /// A field that is no number.
    #[error("{}: line {line}, field {field}: found `{text}`, expected a number", path.display())]
    NotANumber { path: PathBuf, line: usize, field: usize, text: String },
    /// A height that is NaN, infinite or marked as missing.
    #[error("{}: the height in row {row}, column {column} is {found}, expected a finite number", path.display())]
    NotFinite { path: PathBuf, row: usize, column: usize, found: String },
    /// A line of an ESRI grid's header that is not as it should be.
    #[error("{}: line {line}: {problem}", path.display())]
    Header { path: PathBuf, line: usize, problem: String },
    /// Cells of an ESRI grid that have another length than the scene's.
    #[error(
        "{}: cells of length {found:e} in {axis}, expected {expected:e} as `grid.size` and `grid.cells` give (in the \
         scene's units)",
        path.display()
    )]
    CellLength { path: PathBuf, axis: char, found: f64, expected: f64 },
}

impl SurfaceError {
    /// Whether reading failed, as opposed to the surface or its file being wrong.
    #[must_use]
    pub fn is_io(&self) -> bool {
        use std::io::ErrorKind::{IsADirectory, NotADirectory, NotFound};
        matches!(self, SurfaceError::Io { source, .. }
            if !matches!(source.kind(), NotFound | IsADirectory | NotADirectory))
    }
}
