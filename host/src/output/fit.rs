//! The files of a fit: `fit.json`, everything; `fit.csv`, measurements beside what the scene says; `fit.svg`, the picture.

use super::{OutputError, plot, write_file};
use crate::record::FitRecord;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The mark of a finished fit: placed last.
const DOCUMENT: &str = "fit.json";
const TABLE: &str = "fit.csv";
/// Name of the picture of a fit.
pub const FIT_PICTURE: &str = "fit.svg";

/// Checks that a fit may go to the folder `path`: it is new, holds an earlier fit, or none of its files.
///
/// # Errors
/// `NotAFolder` for a file, `InTheWay` for a file of a fit's name without a fit beside it.
pub fn check_fit_folder(path: &Path) -> Result<(), OutputError> {
    if path.exists() && !path.is_dir() {
        return Err(OutputError::NotAFolder { path: path.into() });
    }
    if path.join(DOCUMENT).exists() {
        return Ok(());
    }
    match [TABLE, FIT_PICTURE].iter().map(|name| path.join(name)).find(|file| file.exists()) {
        Some(path) => Err(OutputError::InTheWay { path }),
        None => Ok(()),
    }
}

/// Writes the files of a fit into the folder `path`, which is made; each appears whole, `fit.json` last.
///
/// # Errors
/// As [`check_fit_folder`]; `Io` and `Drawing` with the path.
pub fn write_fit(fit: &FitRecord, path: &Path) -> Result<(), OutputError> {
    check_fit_folder(path)?;
    fs::create_dir_all(path).map_err(OutputError::io("create", path))?;
    write_file(&path.join(TABLE), |to| {
        writeln!(to, "at,measured,fitted,sigma")?;
        fit.points.iter().try_for_each(|point| {
            writeln!(to, "{:?},{:?},{:?},{:?}", point.at, point.measured, point.fitted, point.sigma)
        })
    })?;
    plot::write_fit_plot(fit, &path.join(FIT_PICTURE))?;
    write_file(&path.join(DOCUMENT), |to| {
        to.write_all(&serde_json::to_vec_pretty(fit).map_err(io::Error::from)?)?;
        writeln!(to)
    })
}
