//! The files of a study: `study.csv`, a row per case; `study.json`, everything; `study.svg`, the picture;
//! `study.html`, a page of all that.

use super::html::{StudyPage, write_study_page};
use super::{OutputError, plot, write_file};
use crate::record::{Case, Kind, Status, StudyRecord};
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The mark of a finished study: placed last.
const DOCUMENT: &str = "study.json";
const TABLE: &str = "study.csv";
const PAGE: &str = "study.html";
/// Name of the picture of a study.
pub const STUDY_PICTURE: &str = "study.svg";

/// Checks that a study may go to the folder `path`: it is new, holds an earlier study, or none of its files.
///
/// # Errors
/// `NotAFolder` for a file, `InTheWay` for a file of a study's name without a study beside it.
pub fn check_study_folder(path: &Path) -> Result<(), OutputError> {
    if path.exists() && !path.is_dir() {
        return Err(OutputError::NotAFolder { path: path.into() });
    }
    if path.join(DOCUMENT).exists() {
        return Ok(());
    }
    match [TABLE, STUDY_PICTURE, PAGE].iter().map(|name| path.join(name)).find(|file| file.exists()) {
        Some(path) => Err(OutputError::InTheWay { path }),
        None => Ok(()),
    }
}

/// Writes the files of a study into the folder `path`, which is made; each appears whole, `study.json` last. The page is
/// written if there is a provenance for it (label and text), and one of an earlier study goes if there is none.
///
/// # Errors
/// As [`check_study_folder`]; `Io` and `Drawing` with the path.
pub fn write_study(
    study: &StudyRecord,
    provenance: Option<&[(String, String)]>,
    path: &Path,
) -> Result<(), OutputError> {
    check_study_folder(path)?;
    fs::create_dir_all(path).map_err(OutputError::io("create", path))?;
    write_file(&path.join(TABLE), |to| rows(study, to))?;
    plot::write_study_plot(study, &path.join(STUDY_PICTURE))?;
    let page = path.join(PAGE);
    match provenance {
        Some(provenance) => write_study_page(&StudyPage { study, provenance }, &page)?,
        None if page.exists() => fs::remove_file(&page).map_err(OutputError::io("remove", &page))?,
        None => {}
    }
    write_file(&path.join(DOCUMENT), |to| {
        to.write_all(&serde_json::to_vec_pretty(study).map_err(io::Error::from)?)?;
        writeln!(to)
    })
}

/// The word of a kind of line, as JSON and CSV have it.
fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Substeps => "substeps",
        Kind::Tolerance => "tolerance",
        Kind::Scaling => "scaling",
        Kind::Grid => "grid",
    }
}

/// The word of a status, and the reason.
pub(super) fn status_words(status: &Status) -> (&'static str, &str) {
    match status {
        Status::Done => ("done", ""),
        Status::Unstable => ("unstable", ""),
        Status::Refused(reason) => ("refused", reason),
        Status::Failed(reason) => ("failed", reason),
        Status::LeftOut(reason) => ("left-out", reason),
    }
}

/// A header, then a row per case; what is not known is an empty cell.
fn rows(study: &StudyRecord, to: &mut impl Write) -> io::Result<()> {
    let norms: Vec<&str> = study.norms.keys().map(String::as_str).collect();
    let mut table = csv::Writer::from_writer(to);
    let before = ["line", "kind", "method", "isolated", "value", "status", "wall_s", "wall_spread", "processor_s"];
    let work = ["steps", "contact_solves", "contact_iterations", "fft_pairs", "law_calls", "points_evaluated"];
    let columns = before.iter().chain(&["runs", "warmed_up"]).chain(&work).chain(&norms);
    let header: Vec<&str> = columns.chain(&["unresolved", "on_front", "reason", "overrides"]).copied().collect();
    table.write_record(&header)?;
    for (index, case) in study.cases.iter().enumerate() {
        table.write_record(row(case, &norms, study.front.contains(&index)))?;
    }
    table.flush()
}

fn row(case: &Case, norms: &[&str], on_front: bool) -> Vec<String> {
    let number = |number: Option<f64>| number.map_or_else(String::new, |number| format!("{number:?}"));
    let (word, reason) = status_words(&case.status);
    let timing = case.timing.as_ref();
    let mut row = vec![
        case.line.clone(),
        kind(case.kind).to_owned(),
        case.method.clone(),
        case.isolated.to_string(),
        number(Some(case.value)),
        word.to_owned(),
        number(timing.map(|timing| timing.wall_s)),
        number(timing.map(|timing| timing.wall_spread)),
        number(timing.map(|timing| timing.processor_s)),
        timing.map_or_else(String::new, |timing| timing.runs.to_string()),
        timing.map_or_else(String::new, |timing| timing.warmed_up.to_string()),
    ];
    let counts = case.work.as_ref().map(|work| {
        [
            work.steps,
            work.contact_solves,
            work.contact_iterations,
            work.fft_pairs,
            work.law_calls,
            work.points_evaluated,
        ]
    });
    row.extend((0..6).map(|index| counts.map_or_else(String::new, |counts| counts[index].to_string())));
    row.extend(norms.iter().map(|norm| number(case.errors.get(*norm).copied())));
    row.extend([case.unresolved.join(" "), on_front.to_string(), reason.to_owned(), case.overrides.join(" ; ")]);
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_no_study_wrote_stay() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("a.study");
        check_study_folder(&place).unwrap();
        fs::create_dir(&place).unwrap();
        fs::write(place.join("notes.txt"), "mine").unwrap();
        check_study_folder(&place).unwrap();
        fs::write(place.join(TABLE), "mine").unwrap();
        assert!(matches!(check_study_folder(&place), Err(OutputError::InTheWay { path }) if path.ends_with(TABLE)));
        fs::write(place.join(DOCUMENT), "{}").unwrap();
        check_study_folder(&place).unwrap();
        let file = place.join("notes.txt");
        assert!(matches!(check_study_folder(&file), Err(OutputError::NotAFolder { .. })));
    }
}
