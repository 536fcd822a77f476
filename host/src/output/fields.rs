//! The fields of a run in the formats a scene asks for, a file per time and format.

use super::{OutputError, csv, npz, vtk, write_file};
use crate::record::{Geometry, Snapshot};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A format of field files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FieldFormat {
    /// A row per point, a column per component.
    Csv,
    /// NumPy arrays.
    Npz,
    /// XML VTK, for ParaView: `.vtp` for points, `.vti` for grids.
    Vtk,
}

impl FieldFormat {
    fn ending(self, geometry: &Geometry<'_>) -> &'static str {
        match (self, geometry) {
            (FieldFormat::Csv, _) => "csv",
            (FieldFormat::Npz, _) => "npz",
            (FieldFormat::Vtk, Geometry::Points(_)) => "vtp",
            (FieldFormat::Vtk, Geometry::Grid(_)) => "vti",
        }
    }
}

/// Writes the fields of one time as `fields-STEP.ENDING` into `folder`; gives the path.
///
/// The fields go to the file in pieces of 32 KiB; nothing of their size is allocated.
///
/// # Errors
/// `FieldLength` or `TwoOfOneName` before anything is written, `Io` with the path.
pub fn write_fields(
    folder: &Path,
    format: FieldFormat,
    snapshot: &Snapshot<'_>,
    geometry: &Geometry<'_>,
) -> Result<PathBuf, OutputError> {
    check(snapshot, geometry)?;
    let ending = format.ending(geometry);
    let path = folder.join(format!("fields-{:06}.{ending}", snapshot.step_index));
    write_file(&path, |to| match format {
        FieldFormat::Csv => csv::field_rows(snapshot, geometry, to),
        FieldFormat::Npz => npz::write_arrays(snapshot, geometry, to),
        FieldFormat::Vtk => vtk::write_vtk(snapshot, geometry, to),
    })?;
    Ok(path)
}

/// Writes the fields of all times of a run into one folder, and the `.pvd` that ParaView opens as
/// a series in time.
#[derive(Debug)]
pub struct FieldSeries {
    folder: PathBuf,
    formats: Vec<FieldFormat>,
    /// All files so far with their times.
    files: Vec<(f64, String)>,
}

impl FieldSeries {
    /// Opens the series in `folder`, which is made when there is none.
    ///
    /// # Errors
    /// `Io` when the folder cannot be made.
    pub fn begin(folder: &Path, formats: &[FieldFormat]) -> Result<Self, OutputError> {
        fs::create_dir_all(folder).map_err(OutputError::io("create", folder))?;
        Ok(Self { folder: folder.into(), formats: formats.to_vec(), files: Vec::new() })
    }

    /// Goes on with a series whose earlier files (`files` of the run that was stopped) are or will be in the same folder.
    pub fn resume(&mut self, files: impl IntoIterator<Item = (f64, String)>) {
        self.files.splice(0..0, files);
    }

    /// Writes the fields of one time in every format; a step written before is replaced.
    ///
    /// # Errors
    /// As `write_fields`.
    pub fn write(&mut self, snapshot: &Snapshot<'_>, geometry: &Geometry<'_>) -> Result<(), OutputError> {
        for &format in &self.formats {
            let path = write_fields(&self.folder, format, snapshot, geometry)?;
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            self.files.retain(|(_, earlier)| *earlier != name);
            self.files.push((snapshot.time, name));
        }
        Ok(())
    }

    /// The folder that it writes into.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// The files written so far with their times, which a resumed run needs for its series.
    #[must_use]
    pub fn files(&self) -> &[(f64, String)] {
        &self.files
    }

    /// Writes `fields.pvd` where there are VTK files.
    ///
    /// # Errors
    /// `Io` with the path.
    pub fn finish(self) -> Result<(), OutputError> {
        let is_vtk = |(_, name): &(f64, String)| name.ends_with(".vtp") || name.ends_with(".vti");
        let vtk_files: Vec<(f64, String)> = self.files.into_iter().filter(is_vtk).collect();
        if vtk_files.is_empty() {
            return Ok(());
        }
        vtk::write_series(&self.folder.join("fields.pvd"), &vtk_files)
    }
}

fn check(snapshot: &Snapshot<'_>, geometry: &Geometry<'_>) -> Result<(), OutputError> {
    let points = geometry.count();
    let length = |name: &str, found: usize, components: usize| {
        let expected = points * components;
        if found == expected && components > 0 {
            return Ok(());
        }
        Err(OutputError::FieldLength { name: name.into(), found, expected, points, components })
    };
    let mut taken: HashSet<String> = ["point", "x", "y", "z"].map(String::from).into();
    taken.extend(["time", "step", "cells", "size", "origin"].map(String::from));
    if let Geometry::Points(place) = geometry
        && let Some(coordinates) = &place.coordinates
    {
        length("coordinates", coordinates.len(), 3)?;
    }
    for field in &snapshot.fields {
        length(&field.name, field.data.len(), field.components)?;
        let mut names = field.component_names();
        if field.components > 1 {
            names.push(field.name.clone());
        }
        for name in names {
            if !taken.insert(name.clone()) {
                return Err(OutputError::TwoOfOneName { name });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Field, PointIds, Points};

    fn bare(count: usize) -> Geometry<'static> {
        let ids = PointIds::Counted { first: 0, count };
        Geometry::Points(Points { ids, coordinates: None, dimension: 3 })
    }

    fn snapshot(time: f64, step_index: u64, fields: Vec<Field<'_>>) -> Snapshot<'_> {
        Snapshot { time, step_index, fields }
    }

    #[test]
    fn a_series_has_a_file_per_time_and_format() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("fields");
        let formats = [FieldFormat::Csv, FieldFormat::Npz, FieldFormat::Vtk];
        let mut series = FieldSeries::begin(&folder, &formats).unwrap();
        series.resume([(-1.0, "fields-earlier.vtp".to_owned())]);
        for (time, step) in [(0.0, 0), (0.5, 12)] {
            let fields = vec![Field::scalar("wear", vec![time; 3], "m")];
            series.write(&snapshot(time, step, fields), &bare(3)).unwrap();
        }
        series.finish().unwrap();
        let mut names: Vec<_> =
            fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        let expected = [
            "fields-000000.csv",
            "fields-000000.npz",
            "fields-000000.vtp",
            "fields-000012.csv",
            "fields-000012.npz",
            "fields-000012.vtp",
            "fields.pvd",
        ];
        assert_eq!(names, expected);
        let pvd = fs::read_to_string(folder.join("fields.pvd")).unwrap();
        assert!(pvd.find("fields-earlier.vtp") < pvd.find("fields-000000.vtp"));
        assert!(pvd.contains("timestep=\"0.5\"") && pvd.contains("file=\"fields-000012.vtp\""));
    }

    #[test]
    fn wrong_lengths_and_names_are_refused_before_a_file_exists() {
        let place = tempfile::tempdir().unwrap();
        let refused = |fields: Vec<Field<'_>>, geometry: &Geometry<'_>| {
            let of = snapshot(0.0, 0, fields);
            let error = write_fields(place.path(), FieldFormat::Csv, &of, geometry).unwrap_err();
            assert_eq!(fs::read_dir(place.path()).unwrap().count(), 0);
            error.to_string()
        };
        let short = vec![Field::scalar("wear", vec![0.0; 2], "m")];
        assert_eq!(refused(short, &bare(3)), "`wear` holds 2 numbers, expected 3 (3 points, 1 each)");
        let twice = vec![Field::scalar("slip_x", vec![0.0; 3], "m"), Field::vector("slip", vec![0.0; 9], "m")];
        assert!(refused(twice, &bare(3)).contains("two fields are called `slip_x`"));
        let ids = PointIds::Counted { first: 0, count: 3 };
        let coordinates = Some(vec![0.0; 8].into());
        let placed = Geometry::Points(Points { ids, coordinates, dimension: 3 });
        assert!(refused(Vec::new(), &placed).contains("`coordinates` holds 8 numbers"));
    }
}
