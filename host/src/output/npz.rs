//! NPZ: an uncompressed zip of NPY arrays, as `numpy.load` reads it.
//!
//! Format: NEP 1 ("A Simple File Format for NumPy Arrays"), version 1.0, little-endian `f8` and
//! `u8`, C order. Nothing is compressed: wear fields hardly shrink, and a reader can map them.

use super::little_endian::{write_counts, write_floats};
use crate::record::{Geometry, Snapshot};
use std::io::{self, Seek, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Sizes from here on need the 64-bit form of a zip entry.
const LARGE: u64 = u32::MAX as u64 - 4096;

/// Writes the fields of one time: `time`, `step`, then for points `point` (where the numbers are
/// not simply 0, 1, ..) and `x`, `y`, `z` (where known), for a grid `cells`, `size`, `origin`, then
/// an array per field: `[point]` or `[point][component]`, over a grid `[y][x]` or
/// `[y][x][component]`. The caller has checked the lengths (`write_fields` does).
pub(super) fn write_arrays(
    snapshot: &Snapshot<'_>,
    geometry: &Geometry<'_>,
    to: &mut (impl Write + Seek),
) -> io::Result<()> {
    let mut archive = Archive(ZipWriter::new(to));
    archive.floats("time", &[], [snapshot.time])?;
    archive.counts("step", &[], [snapshot.step_index])?;
    let count = geometry.count();
    let mut shape = vec![count];
    match geometry {
        Geometry::Points(points) => {
            if !points.ids.are_indices() {
                archive.counts("point", &[count], (0..count).map(|i| points.ids.id(i)))?;
            }
            if let Some(at) = &points.coordinates {
                for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                    archive.floats(name, &[count], at.iter().skip(axis).step_by(3).copied())?;
                }
            }
        }
        Geometry::Grid(grid) => {
            archive.counts("cells", &[2], grid.cells.map(|n| n as u64))?;
            archive.floats("size", &[2], grid.size)?;
            archive.floats("origin", &[2], grid.origin)?;
            shape = vec![grid.cells[1], grid.cells[0]];
        }
    }
    for field in &snapshot.fields {
        let mut shape = shape.clone();
        if field.components > 1 {
            shape.push(field.components);
        }
        archive.floats(&field.name, &shape, field.data.iter().copied())?;
    }
    archive.0.finish()?;
    Ok(())
}

struct Archive<W: Write + Seek>(ZipWriter<W>);

impl<W: Write + Seek> Archive<W> {
    fn floats(&mut self, name: &str, shape: &[usize], numbers: impl IntoIterator<Item = f64>) -> io::Result<()> {
        self.start(name, "<f8", shape)?;
        write_floats(&mut self.0, numbers)
    }

    fn counts(&mut self, name: &str, shape: &[usize], numbers: impl IntoIterator<Item = u64>) -> io::Result<()> {
        self.start(name, "<u8", shape)?;
        write_counts(&mut self.0, numbers)
    }

    fn start(&mut self, name: &str, kind: &str, shape: &[usize]) -> io::Result<()> {
        let header = npy_header(kind, shape);
        let bytes = header.len() as u64 + 8 * shape.iter().product::<usize>() as u64;
        // One fixed date: the same record gives the same bytes.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default())
            .large_file(bytes >= LARGE);
        self.0.start_file(format!("{name}.npy"), options)?;
        self.0.write_all(&header)
    }
}

/// The magic number, version and dictionary of an array, padded to 64 bytes.
fn npy_header(kind: &str, shape: &[usize]) -> Vec<u8> {
    let mut tuple = String::new();
    for length in shape {
        tuple += &format!("{length}, ");
    }
    // One length keeps its comma: (3,) is a tuple, (3) is not.
    let tuple = if shape.len() == 1 { tuple.trim_end() } else { tuple.trim_end_matches(", ") };
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({tuple}), }}");
    let prefix = 10;
    while !(prefix + text.len() + 1).is_multiple_of(64) {
        text.push(' ');
    }
    text.push('\n');
    let mut header = b"\x93NUMPY\x01\x00".to_vec();
    header.extend((text.len() as u16).to_le_bytes());
    header.extend(text.as_bytes());
    header
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Field, Grid, PointIds, Points};
    use std::io::{Cursor, Read};

    /// Reads one array back: kind, shape as text, words.
    fn array(bytes: &[u8], name: &str) -> (String, Vec<u64>) {
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        let mut entry = archive.by_name(&format!("{name}.npy")).unwrap();
        assert_eq!(entry.compression(), CompressionMethod::Stored);
        let mut raw = Vec::new();
        entry.read_to_end(&mut raw).unwrap();
        assert_eq!(&raw[..8], b"\x93NUMPY\x01\x00");
        let end = 10 + usize::from(u16::from_le_bytes([raw[8], raw[9]]));
        assert_eq!(end % 64, 0);
        let header = std::str::from_utf8(&raw[10..end]).unwrap().trim_end().to_owned();
        let words = raw[end..].chunks_exact(8).map(|w| u64::from_le_bytes(w.try_into().unwrap())).collect();
        (header, words)
    }

    fn written(snapshot: &Snapshot<'_>, geometry: &Geometry<'_>) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        write_arrays(snapshot, geometry, &mut bytes).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn arrays_read_back_with_kind_shape_and_bits() {
        let wear: Vec<f64> = (0..5000).map(|i| f64::from(i) / 3.0).collect();
        let snapshot = Snapshot {
            time: 0.5,
            step_index: 9,
            fields: vec![Field::scalar("wear", &wear[..], "m"), Field::vector("slip", vec![1.5; 15000], "m")],
        };
        let geometry = Geometry::Points(Points {
            ids: PointIds::Counted { first: 1, count: 5000 },
            coordinates: Some((0..15000).map(f64::from).collect::<Vec<_>>().into()),
            dimension: 3,
        });
        let bytes = written(&snapshot, &geometry);
        let (header, words) = array(&bytes, "wear");
        assert_eq!(header, "{'descr': '<f8', 'fortran_order': False, 'shape': (5000,), }");
        assert_eq!(words, wear.iter().map(|w| w.to_bits()).collect::<Vec<_>>());
        let (header, words) = array(&bytes, "slip");
        assert!(header.contains("'shape': (5000, 3), "), "{header}");
        assert_eq!(words, [1.5_f64.to_bits(); 15000]);
        assert_eq!(array(&bytes, "y").1[2], 7.0_f64.to_bits());
        assert_eq!(array(&bytes, "point").1[4999], 5000);
        let (header, words) = array(&bytes, "time");
        assert!(header.contains("'shape': (), "), "{header}");
        assert_eq!(words, [0.5_f64.to_bits()]);
        assert_eq!(bytes, written(&snapshot, &geometry), "the same record gives the same bytes");
    }

    #[test]
    fn a_grid_has_rows_along_y() {
        let snapshot =
            Snapshot { time: 0.0, step_index: 0, fields: vec![Field::scalar("pressure", vec![0.0; 6], "Pa")] };
        let grid = Grid { cells: [3, 2], size: [3.0, 2.0], origin: [0.0, 0.0] };
        let bytes = written(&snapshot, &Geometry::Grid(grid));
        let (header, _) = array(&bytes, "pressure");
        assert!(header.contains("'descr': '<f8'") && header.contains("'shape': (2, 3), "));
        let (header, words) = array(&bytes, "cells");
        assert!(header.contains("'descr': '<u8'"), "{header}");
        assert_eq!(words, [3, 2]);
    }
}
