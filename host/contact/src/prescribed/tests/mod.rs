//! Tests of the history readers: text in `text`, archives in `arrays`, random bytes in `random`.
//! Here is what they share: files of given content in a folder of their own.
//! Not here: the scenes' own histories, which `tests/histories.rs` covers.

mod arrays;
mod random;
mod text;

use super::{Column, History, HistoryError, Needs};
use std::path::PathBuf;
use tempfile::TempDir;

/// A file of the given content in a folder that goes with the guard.
fn file(name: &str, content: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join(name);
    std::fs::write(&path, content).expect("a file in it");
    (folder, path)
}

fn pressure_and_velocity() -> Needs {
    Needs::of(&[Column::Pressure, Column::Velocity])
}

/// All values of a column, time after time.
fn values(history: &History, column: Column) -> Vec<f64> {
    let view = history.column(column).expect("the column was asked for");
    let points = history.points();
    let each = (0..history.times().len()).flat_map(|k| (0..points).map(move |i| (k, i)));
    each.map(|(k, i)| view.value(k, i)).collect()
}

/// The message of the error that reading ends with, without the folder.
fn fault(name: &str, content: &[u8], needs: &Needs) -> String {
    let (folder, path) = file(name, content);
    let error: HistoryError = History::read(&path, needs).expect_err("an error");
    error.to_string().replace(&format!("{}/", folder.path().display()), "")
}
