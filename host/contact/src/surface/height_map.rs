//! Height maps from files: one height per cell, of the body above and measured downwards, in the scene's units.
//!
//! - `.npy`: an array of shape `[ny][nx]`, or `[n]` in 2-D, of real numbers;
//! - `.csv`, `.txt`: ny lines of nx numbers, along x, y growing from line to line, separated by commas, semicolons or
//!   blanks; lines that are empty or begin with `#` are passed over. In 2-D also a number per line;
//! - `.asc`: an ESRI ASCII grid, which instruments and geographic programs write: `ncols`, `nrows`, `cellsize` (or `dx`
//!   and `dy`) and optionally `nodata_value`, then the heights from the top row, that is from the largest y, downwards.
//!   Its cells have to be as long as the scene's. The origin is not read.
//!
//! The binary formats of instruments (.x3p, .sur, .sdf) are not read: at the time of writing no crate for any of them was
//! found on crates.io, and a reader for one would be more than the rest of this folder. Their programs export text.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use super::super::Cells;
use super::super::npy::ArrayHeader;
use super::SurfaceError;
use super::height_text;

/// Reads the heights `[cells]`, x fastest.
///
/// # Errors
/// A file that cannot be read, of another size than the grid, or with a height that is no finite number.
pub fn read(path: &Path, cells: &Cells) -> Result<Vec<f64>, SurfaceError> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default();
    let heights = match ending.as_str() {
        "npy" => from_array(path, cells)?,
        "csv" | "txt" => height_text::from_table(path, &text(path)?, cells)?,
        "asc" => height_text::from_esri_grid(path, &text(path)?, cells)?,
        _ => return Err(SurfaceError::Ending { path: path.into(), found: ending }),
    };
    match heights.iter().position(|height| !height.is_finite()) {
        Some(at) => Err(not_finite(path, cells, at, heights[at].to_string())),
        None => Ok(heights),
    }
}

/// The error for a height, by its place in the cells.
pub(super) fn not_finite(path: &Path, cells: &Cells, at: usize, found: String) -> SurfaceError {
    let (row, column) = (at / cells.counts[0] + 1, at % cells.counts[0] + 1);
    SurfaceError::NotFinite { path: path.into(), row, column, found }
}

/// Whether a table of this size fits the cells; a profile may stand upright.
pub(super) fn fits(columns: usize, rows: usize, cells: &Cells) -> bool {
    [columns, rows] == cells.counts || (cells.dimension == 2 && columns == 1 && rows == cells.counts[0])
}

pub(super) fn size_error(path: &Path, columns: usize, rows: usize, cells: &Cells) -> SurfaceError {
    SurfaceError::Size { path: path.into(), columns, rows, cells: cells.counts }
}

fn text(path: &Path) -> Result<String, SurfaceError> {
    let mut bytes = Vec::new();
    let io = |source| SurfaceError::Io { path: path.into(), source };
    File::open(path).map_err(io)?.read_to_end(&mut bytes).map_err(io)?;
    // Bytes that are no text end up in a field, which is then no number.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn from_array(path: &Path, cells: &Cells) -> Result<Vec<f64>, SurfaceError> {
    let io = |source| SurfaceError::Io { path: path.into(), source };
    let file = File::open(path).map_err(io)?;
    if file.metadata().map_err(io)?.is_dir() {
        return Err(io(std::io::ErrorKind::IsADirectory.into()));
    }
    let mut reader = BufReader::new(file);
    let fault = |fault| SurfaceError::Array { path: path.into(), fault };
    let header = ArrayHeader::read(&mut reader).map_err(fault)?;
    let (columns, rows) = match header.shape.as_slice() {
        [columns] => (*columns, 1),
        [rows, columns] => (*columns, *rows),
        other => return Err(SurfaceError::Indices { path: path.into(), found: other.len() }),
    };
    if !fits(columns, rows, cells) {
        return Err(size_error(path, columns, rows, cells));
    }
    let mut heights = Vec::with_capacity(cells.count());
    header.each(&mut reader, |height| heights.push(height)).map_err(fault)?;
    if header.in_c_order() {
        return Ok(heights);
    }
    let place = |at: usize| at % columns * rows + at / columns;
    Ok((0..heights.len()).map(|at| heights[place(at)]).collect())
}
