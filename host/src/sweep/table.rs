//! What came of each case: a file for each, from which a table is made at any time.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::{Sweep, SweepError};
use crate::output::{OutputError, write_file};
use crate::record::Identity;

/// Quantities of the result that are columns of the table, as `report.json` names them.
pub const RESULTS: [&str; 8] =
    ["time", "sliding_distance", "load", "approach", "max_pressure", "contact_area", "max_wear_depth", "wear_volume"];

/// What came of a case that could be run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// How the run ended: "done", "failed", or why it ended early.
    pub ended: String,
    /// The quantities of [`RESULTS`]; `None`: the scene cannot give it.
    pub results: Vec<Option<f64>>,
    /// The error, if it is known.
    pub error: Option<f64>,
    /// What the error is relative to: a reference, or an estimate.
    pub reference: String,
    /// Accepted steps.
    pub steps: u64,
    /// Wall time of the run; s.
    pub run_time_s: f64,
}

/// A case and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of the case.
    pub case: usize,
    /// Values of the varied keys.
    pub values: Vec<String>,
    /// What it was a run of; `None` where the case could not be run.
    pub identity: Option<Identity>,
    /// Exit code that a run of the case alone would have.
    pub exit_code: u8,
    /// What came out; `None`: nothing did.
    pub found: Option<Found>,
    /// Why not, or why not all; empty where all went well.
    pub message: String,
}

/// The file of a case in the folder of a sweep.
fn path(folder: &Path, case: usize) -> PathBuf {
    folder.join(format!("{case:07}.json"))
}

/// Writes the file of a case.
///
/// # Errors
/// A file that cannot be written.
pub fn write_row(folder: &Path, row: &Row) -> Result<(), OutputError> {
    write_file(&path(folder, row.case), |to| {
        to.write_all(&serde_json::to_vec(row)?)?;
        to.write_all(b"\n")
    })
}

/// Reads the file of a case; `None`: there is none.
///
/// # Errors
/// A file that is none of a case, or of another one.
pub fn read_row(folder: &Path, case: usize) -> Result<Option<Row>, SweepError> {
    let path = path(folder, case);
    let Ok(text) = std::fs::read_to_string(&path) else { return Ok(None) };
    let wrong = |reason: String| SweepError::Row { path: path.clone(), reason };
    let row: Row = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    if row.case != case || row.found.as_ref().is_some_and(|found| found.results.len() != RESULTS.len()) {
        return Err(wrong(format!("it holds case {}", row.case)));
    }
    Ok(Some(row))
}

/// Writes the table: a row for each case that is there, in the order of their numbers. Numbers have the digits that give
/// the same bits back.
///
/// # Errors
/// A file that cannot be written.
pub fn write_table(sweep: &Sweep, rows: &[Row], path: &Path) -> Result<(), OutputError> {
    write_file(path, |to| {
        let mut writer = csv::Writer::from_writer(to);
        let keys = sweep.keys.iter().map(String::as_str);
        let behind = ["error", "reference", "steps", "run_time_s", "ended", "exit_code", "message"];
        writer.write_record(std::iter::once("case").chain(keys).chain(RESULTS).chain(behind))?;
        for row in rows {
            let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
            let found = row.found.as_ref();
            let mut cells = vec![row.case.to_string()];
            cells.extend(row.values.iter().cloned());
            cells.extend((0..RESULTS.len()).map(|k| number(found.and_then(|found| found.results[k]))));
            cells.push(number(found.and_then(|found| found.error)));
            cells.push(found.map_or_else(String::new, |found| found.reference.clone()));
            cells.push(found.map_or_else(String::new, |found| found.steps.to_string()));
            cells.push(number(found.map(|found| found.run_time_s)));
            cells.push(found.map_or_else(String::new, |found| found.ended.clone()));
            cells.push(row.exit_code.to_string());
            cells.push(row.message.clone());
            writer.write_record(&cells)?;
        }
        writer.flush()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Vary;

    fn row(case: usize) -> Row {
        let found = Found {
            ended: "done".to_owned(),
            results: vec![Some(0.1), None, Some(1e-300), None, None, None, Some(2.5e-7), None],
            error: Some(1e-3),
            reference: "self".to_owned(),
            steps: 12,
            run_time_s: 0.5,
        };
        let found = (case != 2).then_some(found);
        let message = if case == 2 { "a, \"b\"" } else { "" };
        Row { case, values: vec!["5".into()], identity: None, exit_code: 0, found, message: message.into() }
    }

    #[test]
    fn a_case_comes_back_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        for case in [1, 2] {
            write_row(folder.path(), &row(case)).unwrap();
            assert_eq!(read_row(folder.path(), case).unwrap(), Some(row(case)));
        }
        assert_eq!(read_row(folder.path(), 3).unwrap(), None);
        std::fs::copy(path(folder.path(), 1), path(folder.path(), 3)).unwrap();
        assert!(read_row(folder.path(), 3).unwrap_err().to_string().contains("it holds case 1"));
        std::fs::write(path(folder.path(), 4), "{").unwrap();
        assert!(read_row(folder.path(), 4).unwrap_err().to_string().contains("remove it"));
    }

    #[test]
    fn the_table_has_a_row_for_each_case() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("cases.csv");
        let sweep = Sweep::grid(vec![Vary::parse("step.0.load=5,6").unwrap()]).unwrap();
        write_table(&sweep, &[row(1), row(2)], &file).unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].starts_with("case,step.0.load,time,sliding_distance"), "{text}");
        assert_eq!(lines[1], "1,5,0.1,,1e-300,,,,2.5e-7,,0.001,self,12,0.5,done,0,");
        assert_eq!(lines[2], "2,5,,,,,,,,,,,,,,0,\"a, \"\"b\"\"\"");
    }
}
