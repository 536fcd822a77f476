//! All cases of a sweep.

use std::collections::BTreeSet;
use std::path::Path;

use super::{SweepError, Vary};
use crate::scene::Override;

/// Most cases of a sweep.
const MOST: usize = 10_000_000;

/// One case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Its number, from 1.
    pub number: usize,
    /// The value of each varied key.
    pub values: Vec<String>,
}

/// Keys and the values that they take, case by case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sweep {
    /// The varied keys.
    pub keys: Vec<String>,
    kind: Kind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Kind {
    /// Every value of each key with every value of the others.
    Grid(Vec<Vec<String>>),
    /// Rows of a table.
    Rows(Vec<Vec<String>>),
}

impl Sweep {
    /// Every combination of values; the last key changes fastest.
    ///
    /// # Errors
    /// A key twice, more combinations than can be numbered.
    pub fn grid(varied: Vec<Vary>) -> Result<Sweep, SweepError> {
        let keys: Vec<String> = varied.iter().map(|vary| vary.key.clone()).collect();
        once(&keys)?;
        let count = varied.iter().fold(1_u128, |count, vary| count.saturating_mul(vary.values.len() as u128));
        if count > MOST as u128 {
            return Err(SweepError::Many { count, most: MOST });
        }
        Ok(Sweep { keys, kind: Kind::Grid(varied.into_iter().map(|vary| vary.values).collect()) })
    }

    /// The rows of a CSV file whose columns are keys.
    ///
    /// # Errors
    /// A file that cannot be read, a key twice or without a name, no row, an empty cell.
    pub fn read(path: &Path) -> Result<Sweep, SweepError> {
        let failed = |source: csv::Error| SweepError::Cases { path: path.to_owned(), source };
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_path(path).map_err(failed)?;
        let keys: Vec<String> = reader.headers().map_err(failed)?.iter().map(str::to_owned).collect();
        once(&keys)?;
        let cell = |line: u64, found: &str, expected: &'static str| SweepError::Cell {
            path: path.to_owned(),
            line,
            found: found.to_owned(),
            expected,
        };
        if keys.iter().any(String::is_empty) {
            return Err(cell(1, "a column without a name", "the key of the scene that it varies"));
        }
        let mut rows = Vec::new();
        for row in reader.records() {
            let row = row.map_err(failed)?;
            let line = row.position().map_or(0, csv::Position::line);
            if let Some(empty) = row.iter().position(str::is_empty) {
                return Err(cell(line, &format!("nothing for `{}`", keys[empty]), "a value in every cell"));
            }
            rows.push(row.iter().map(str::to_owned).collect());
        }
        if rows.is_empty() {
            return Err(cell(1, "no rows", "a row for each case"));
        }
        Ok(Sweep { keys, kind: Kind::Rows(rows) })
    }

    /// Number of cases.
    #[must_use]
    pub fn count(&self) -> usize {
        match &self.kind {
            Kind::Grid(values) => values.iter().map(Vec::len).product(),
            Kind::Rows(rows) => rows.len(),
        }
    }

    /// A case by its number, from 1 to their count.
    #[must_use]
    pub fn case(&self, number: usize) -> Case {
        let index = number - 1;
        let values = match &self.kind {
            Kind::Rows(rows) => rows[index].clone(),
            Kind::Grid(all) => {
                let mut left = index;
                let mut values: Vec<String> = all
                    .iter()
                    .rev()
                    .map(|values| {
                        let value = values[left % values.len()].clone();
                        left /= values.len();
                        value
                    })
                    .collect();
                values.reverse();
                values
            }
        };
        Case { number, values }
    }

    /// A case as changes to the scene.
    #[must_use]
    pub fn overrides(&self, case: &Case) -> Vec<Override> {
        let all = self.keys.iter().zip(&case.values);
        all.map(|(key, value)| Override(format!("{key}={value}"))).collect()
    }
}

fn once(keys: &[String]) -> Result<(), SweepError> {
    let mut seen = BTreeSet::new();
    match keys.iter().find(|key| !seen.insert(key.as_str())) {
        Some(key) => Err(SweepError::Twice { key: key.clone() }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_every_combination_once_the_last_key_fastest() {
        let varied = ["a=1,2", "b=x,y,z"].map(|text| Vary::parse(text).unwrap()).to_vec();
        let sweep = Sweep::grid(varied).unwrap();
        let all: Vec<String> = (1..=sweep.count()).map(|number| sweep.case(number).values.join("")).collect();
        assert_eq!(all, ["1x", "1y", "1z", "2x", "2y", "2z"]);
        let overrides = sweep.overrides(&sweep.case(6));
        assert_eq!(overrides, [Override("a=2".to_owned()), Override("b=z".to_owned())]);
        assert_eq!(Sweep::grid(Vec::new()).unwrap().count(), 1, "nothing varied: the scene itself");
    }

    #[test]
    fn a_key_is_varied_once_and_cases_can_be_counted() {
        let varied = |texts: &[&str]| texts.iter().map(|text| Vary::parse(text).unwrap()).collect::<Vec<_>>();
        let twice = Sweep::grid(varied(&["a=1", "a=2"])).unwrap_err().to_string();
        assert_eq!(twice, "`a` is varied twice, expected once");
        let many = Sweep::grid(varied(&["a=0..1:100000", "b=0..1:100000"])).unwrap_err().to_string();
        assert_eq!(many, "10000000000 cases, expected at most 10000000");
    }

    #[test]
    fn a_table_gives_its_rows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cases.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            Sweep::read(&path)
        };
        let sweep = read("# two\nstep.0.load, title\n5,\"a, b\"\n6, c\n").unwrap();
        assert_eq!((sweep.count(), sweep.case(1).values), (2, vec!["5".to_owned(), "a, b".to_owned()]));
        for (text, part) in [
            ("a,a\n1,2\n", "`a` is varied twice"),
            ("a,\n1,2\n", ":1: found a column without a name"),
            ("a,b\n1,2\n3,\n", ":3: found nothing for `b`"),
            ("a,b\n", "no rows"),
            ("a,b\n1\n", "could not read the cases"),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
