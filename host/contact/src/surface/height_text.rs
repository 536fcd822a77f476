//! Heights in text files: tables of numbers, and ESRI ASCII grids.

use std::path::Path;

use super::super::Cells;
use super::SurfaceError;
use super::height_map::{fits, not_finite, size_error};

/// Lines that hold something, with their number from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let numbered = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

/// The fields of a line, at commas or semicolons where it has any, else at blanks.
fn fields(line: &str) -> Vec<&str> {
    match line.find([',', ';']) {
        Some(at) => line.split(&line[at..=at]).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    }
}

fn number(path: &Path, line: usize, field: usize, text: &str) -> Result<f64, SurfaceError> {
    let bad = || SurfaceError::NotANumber { path: path.into(), line, field, text: text.to_owned() };
    text.parse().map_err(|_| bad())
}

/// Lines of numbers.
pub(super) fn from_table(path: &Path, text: &str, cells: &Cells) -> Result<Vec<f64>, SurfaceError> {
    let mut heights = Vec::with_capacity(cells.count());
    let (mut rows, mut columns) = (0, 0);
    for (line, content) in lines(text) {
        let fields = fields(content);
        if rows > 0 && fields.len() != columns {
            return Err(SurfaceError::Ragged { path: path.into(), line, found: fields.len(), expected: columns });
        }
        (columns, rows) = (fields.len(), rows + 1);
        for (index, field) in fields.iter().enumerate() {
            heights.push(number(path, line, index + 1, field)?);
        }
    }
    if fits(columns, rows, cells) { Ok(heights) } else { Err(size_error(path, columns, rows, cells)) }
}

/// What the header of an ESRI ASCII grid says.
#[derive(Default)]
struct EsriHeader {
    columns: Option<usize>,
    rows: Option<usize>,
    lengths: [Option<f64>; 2],
    no_data: Option<f64>,
}

impl EsriHeader {
    /// Takes a line of the header; whether it was one.
    fn take(&mut self, path: &Path, line: usize, content: &str) -> Result<bool, SurfaceError> {
        let mut words = content.split_whitespace();
        let key = words.next().unwrap_or_default().to_lowercase();
        if !key.starts_with(|first: char| first.is_ascii_alphabetic()) || key == "nan" || key.starts_with("inf") {
            return Ok(false);
        }
        let value = words.next().unwrap_or_default();
        let count = || {
            let problem = || format!("found `{key} {value}`, expected a whole number of 1 or more behind `{key}`");
            let count = value.parse().ok().filter(|count| *count > 0);
            count.ok_or_else(|| SurfaceError::Header { path: path.into(), line, problem: problem() })
        };
        let number = || number(path, line, 2, value);
        match key.as_str() {
            "ncols" => self.columns = Some(count()?),
            "nrows" => self.rows = Some(count()?),
            "cellsize" => self.lengths = [Some(number()?); 2],
            "dx" => self.lengths[0] = Some(number()?),
            "dy" => self.lengths[1] = Some(number()?),
            "nodata_value" => self.no_data = Some(number()?),
            "xllcorner" | "yllcorner" | "xllcenter" | "yllcenter" => {}
            _ => {
                let known = "ncols, nrows, cellsize, dx, dy, nodata_value, xllcorner or yllcorner (or ..center)";
                let problem = format!("found `{key}`, expected {known}");
                return Err(SurfaceError::Header { path: path.into(), line, problem });
            }
        }
        Ok(true)
    }
}

/// An ESRI ASCII grid: heights follow each other whatever the line breaks, from the top row (largest y) downwards.
pub(super) fn from_esri_grid(path: &Path, text: &str, cells: &Cells) -> Result<Vec<f64>, SurfaceError> {
    let mut header = EsriHeader::default();
    let mut rest = lines(text).peekable();
    let mut last = 0;
    while let Some((line, content)) = rest.peek() {
        if !header.take(path, *line, content)? {
            break;
        }
        last = *line;
        rest.next();
    }
    let (Some(columns), Some(rows)) = (header.columns, header.rows) else {
        let problem = "the header ends without `ncols` and `nrows`, expected both".to_owned();
        return Err(SurfaceError::Header { path: path.into(), line: last + 1, problem });
    };
    if !fits(columns, rows, cells) {
        return Err(size_error(path, columns, rows, cells));
    }
    for axis in 0..usize::from(cells.dimension - 1) {
        let expected = cells.spacing[axis];
        let fits = |found: f64| (found / expected - 1.0).abs() <= 1e-6;
        if let Some(found) = header.lengths[axis].filter(|found| !fits(*found)) {
            return Err(SurfaceError::CellLength { path: path.into(), axis: ['x', 'y'][axis], found, expected });
        }
    }
    let mut heights = vec![0.0; cells.count()];
    let mut found = 0;
    for (line, content) in rest {
        for (index, field) in content.split_whitespace().enumerate() {
            let height = number(path, line, index + 1, field)?;
            if found < heights.len() {
                if header.no_data == Some(height) || !height.is_finite() {
                    return Err(not_finite(
                        path,
                        cells,
                        found,
                        if height.is_finite() {
                            format!("{field}, the mark of a missing one")
                        } else {
                            field.to_owned()
                        },
                    ));
                }
                heights[(rows - 1 - found / columns) * columns + found % columns] = height;
            }
            found += 1;
        }
    }
    if found != heights.len() {
        let problem = format!("found {found} heights, expected {columns} x {rows} as the header says");
        return Err(SurfaceError::Header { path: path.into(), line: text.lines().count(), problem });
    }
    Ok(heights)
}
