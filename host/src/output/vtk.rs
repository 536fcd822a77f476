//! XML VTK files that ParaView opens: VTP for points, VTI for regular grids, PVD for a series.
//!
//! Format: "VTK File Formats" (Kitware), XML formats with appended raw data: a little-endian
//! `UInt64` byte count before every block, offsets counted from the byte after the `_`.

use super::little_endian::{write_counts, write_floats};
use super::{OutputError, write_file};
use crate::record::{Field, Geometry, Grid, Points, Snapshot};
use std::io::{self, Write};
use std::path::Path;

/// Writes the fields of one time: points with a cell that shows them all, or a grid with cell
/// data. Points without coordinates lie on a line, at x = their index. The caller has checked the
/// lengths (`write_fields` does).
pub(super) fn write_vtk(snapshot: &Snapshot<'_>, geometry: &Geometry<'_>, to: &mut impl Write) -> io::Result<()> {
    match geometry {
        Geometry::Points(points) => write_points(snapshot, points, to),
        Geometry::Grid(grid) => write_grid(snapshot, grid, to),
    }
}

fn write_points(snapshot: &Snapshot<'_>, points: &Points<'_>, to: &mut impl Write) -> io::Result<()> {
    let count = points.ids.count();
    // One poly-vertex for all points: a vertex each would double the size of a scalar field.
    let cells = usize::from(count > 0);
    let mut offsets = Offsets(0);
    begin(to, "PolyData")?;
    writeln!(to, "<PolyData>")?;
    write_time(to, snapshot.time)?;
    writeln!(
        to,
        "<Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{cells}\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">"
    )?;
    writeln!(to, "<PointData{}>", active(&snapshot.fields))?;
    if !points.ids.are_indices() {
        declare(to, "Int64", "point", 1, "", offsets.next(count))?;
    }
    for field in &snapshot.fields {
        declare_field(to, field, &mut offsets)?;
    }
    writeln!(to, "</PointData>\n<Points>")?;
    declare(to, "Float64", "Points", 3, "", offsets.next(3 * count))?;
    writeln!(to, "</Points>\n<Verts>")?;
    declare(to, "Int64", "connectivity", 1, "", offsets.next(count))?;
    declare(to, "Int64", "offsets", 1, "", offsets.next(cells))?;
    writeln!(to, "</Verts>\n</Piece>\n</PolyData>")?;
    begin_blocks(to)?;
    if !points.ids.are_indices() {
        write_block_of_counts(to, count, (0..count).map(|i| points.ids.id(i)))?;
    }
    for field in &snapshot.fields {
        write_block(to, field.data.len(), field.data.iter().copied())?;
    }
    match &points.coordinates {
        Some(at) => write_block(to, 3 * count, at.iter().copied())?,
        None => write_block(to, 3 * count, (0..count).flat_map(|i| [i as f64, 0.0, 0.0]))?,
    }
    write_block_of_counts(to, count, 0..count as u64)?;
    write_block_of_counts(to, cells, (0..cells).map(|_| count as u64))?;
    end(to)
}

fn write_grid(snapshot: &Snapshot<'_>, grid: &Grid, to: &mut impl Write) -> io::Result<()> {
    let [nx, ny] = grid.cells;
    // One row of cells is drawn as a line: a strip as wide as the grid is long shows nothing.
    let extent = format!("0 {nx} 0 {} 0 0", if ny > 1 { ny } else { 0 });
    let [dx, dy] = grid.spacing();
    let dy = if dy > 0.0 { dy } else { dx };
    let [x, y] = grid.origin;
    let mut offsets = Offsets(0);
    begin(to, "ImageData")?;
    writeln!(to, "<ImageData WholeExtent=\"{extent}\" Origin=\"{x:?} {y:?} 0\" Spacing=\"{dx:?} {dy:?} {dx:?}\">")?;
    write_time(to, snapshot.time)?;
    writeln!(to, "<Piece Extent=\"{extent}\">\n<CellData{}>", active(&snapshot.fields))?;
    for field in &snapshot.fields {
        declare_field(to, field, &mut offsets)?;
    }
    writeln!(to, "</CellData>\n</Piece>\n</ImageData>")?;
    begin_blocks(to)?;
    for field in &snapshot.fields {
        write_block(to, field.data.len(), field.data.iter().copied())?;
    }
    end(to)
}

/// Writes a `.pvd` that lists files (relative to its own folder) by their time.
///
/// # Errors
/// `Io` with the path; then nothing is left of the file.
pub fn write_series(path: &Path, files: &[(f64, String)]) -> Result<(), OutputError> {
    write_file(path, |to| {
        begin(to, "Collection")?;
        writeln!(to, "<Collection>")?;
        for (time, file) in files {
            let file = escaped(file);
            writeln!(to, "<DataSet timestep=\"{time:?}\" group=\"\" part=\"0\" file=\"{file}\"/>")?;
        }
        writeln!(to, "</Collection>\n</VTKFile>")
    })
}

/// Where the blocks of appended data begin.
struct Offsets(u64);

impl Offsets {
    /// The offset of the next block, which holds `words` numbers of 8 bytes.
    fn next(&mut self, words: usize) -> u64 {
        let here = self.0;
        self.0 += 8 + 8 * words as u64;
        here
    }
}

fn begin(to: &mut impl Write, kind: &str) -> io::Result<()> {
    writeln!(to, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>")?;
    writeln!(to, "<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">")
}

fn write_time(to: &mut impl Write, time: f64) -> io::Result<()> {
    writeln!(
        to,
        "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" \
         format=\"ascii\">{time:?}</DataArray>\n</FieldData>"
    )
}

/// The attribute that makes ParaView colour by the first scalar when it opens the file.
fn active(fields: &[Field<'_>]) -> String {
    match fields.iter().find(|field| field.components == 1) {
        Some(field) => format!(" Scalars=\"{}\"", escaped(&field.name)),
        None => String::new(),
    }
}

fn declare_field(to: &mut impl Write, field: &Field<'_>, offsets: &mut Offsets) -> io::Result<()> {
    let offset = offsets.next(field.data.len());
    declare(to, "Float64", &field.name, field.components, &field.unit, offset)
}

fn declare(to: &mut impl Write, kind: &str, name: &str, components: usize, unit: &str, offset: u64) -> io::Result<()> {
    let name = escaped(name);
    write!(
        to,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"appended\" offset=\"{offset}\""
    )?;
    if unit.is_empty() {
        return writeln!(to, "/>");
    }
    let unit = escaped(unit);
    writeln!(
        to,
        ">\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{unit}</InformationKey>\n</DataArray>"
    )
}

fn begin_blocks(to: &mut impl Write) -> io::Result<()> {
    write!(to, "<AppendedData encoding=\"raw\">\n_")
}

fn write_block(to: &mut impl Write, words: usize, numbers: impl Iterator<Item = f64>) -> io::Result<()> {
    write_counts(to, [8 * words as u64])?;
    write_floats(to, numbers)
}

fn write_block_of_counts(to: &mut impl Write, words: usize, numbers: impl Iterator<Item = u64>) -> io::Result<()> {
    write_counts(to, [8 * words as u64])?;
    write_counts(to, numbers)
}

fn end(to: &mut impl Write) -> io::Result<()> {
    write!(to, "\n</AppendedData>\n</VTKFile>\n")
}

fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests;
