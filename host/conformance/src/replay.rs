//! A file that brings a failure back: the check, its seed and all that the run depends on, and the inputs for people.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::check::Check;
use super::error::ConformanceError;
use super::outcome::{CheckResult, Finding};
use super::{CheckOptions, Expected};

/// Version of the file's form.
const VERSION: u32 = 1;

/// A failure, to be run again: the same check with the same seed makes the same calls in the same order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Replay {
    /// Version of the form.
    wearlaw_replay: u32,
    /// The check.
    pub check: Check,
    /// Seed of its random inputs.
    pub seed: u64,
    /// Whether less was tried.
    pub quick: bool,
    /// Name of the law.
    pub law: Option<String>,
    /// The options text that the law was created with.
    pub options: Option<String>,
    /// The table of known values, whose constants are tried too.
    pub expected: Option<PathBuf>,
    /// SHA-256 of the library that failed; none for a law of this program.
    pub sha256: Option<String>,
    /// How it failed.
    pub outcome: String,
    /// What was found.
    pub finding: Finding,
}

impl Replay {
    /// The replay of a failure; none if the result is none.
    pub(super) fn of(
        result: &CheckResult,
        options: &CheckOptions,
        expected: Option<PathBuf>,
        sha256: Option<String>,
    ) -> Option<Self> {
        if !result.outcome.falls_short() {
            return None;
        }
        Some(Self {
            wearlaw_replay: VERSION,
            check: result.check,
            seed: options.seed,
            quick: options.quick,
            law: result.law.clone().or_else(|| options.law.clone()),
            options: options.options.clone(),
            expected: expected.map(|path| std::path::absolute(&path).unwrap_or(path)),
            sha256,
            outcome: result.outcome.name().to_owned(),
            finding: result.outcome.finding()?.clone(),
        })
    }

    /// Writes the file into a folder, which is made if need be; the file appears whole.
    ///
    /// # Errors
    /// The folder or the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf, ConformanceError> {
        let law = self.law.as_deref().map_or_else(String::new, |law| format!("{}.", as_file_name(law)));
        let path = folder.join(format!("{law}{}.json", self.check.name().replace('/', "-")));
        let written = || -> std::io::Result<()> {
            std::fs::create_dir_all(folder)?;
            let mut aside = tempfile::NamedTempFile::new_in(folder)?;
            let mut text = serde_json::to_vec_pretty(self)?;
            text.push(b'\n');
            aside.write_all(&text)?;
            aside.persist(&path)?;
            Ok(())
        };
        written().map_err(|source| ConformanceError::Write { path: path.clone(), source })?;
        Ok(path)
    }

    /// Removes what an earlier run has written to a folder for the checks that are run now, and the folder if that was all.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub(super) fn clear(folder: &Path, options: &CheckOptions) -> Result<(), ConformanceError> {
        let Ok(entries) = std::fs::read_dir(folder) else { return Ok(()) };
        for path in
            entries.flatten().map(|entry| entry.path()).filter(|path| path.extension().is_some_and(|e| e == "json"))
        {
            // What is no replay file belongs to somebody else.
            let Ok(replay) = Self::read(&path) else { continue };
            let is_meant = options.law.is_none() || replay.law.is_none() || options.law == replay.law;
            if is_meant && options.selected.contains(&replay.check) {
                std::fs::remove_file(&path).map_err(|source| ConformanceError::Write { path, source })?;
            }
        }
        // Not where something is left.
        let _ = std::fs::remove_dir(folder);
        Ok(())
    }

    /// Reads the file.
    ///
    /// # Errors
    /// It cannot be read, is no replay file, or one of another version.
    pub fn read(path: &Path) -> Result<Self, ConformanceError> {
        let text =
            std::fs::read_to_string(path).map_err(|source| ConformanceError::Read { path: path.to_owned(), source })?;
        let replay: Self = serde_json::from_str(&text)
            .map_err(|error| ConformanceError::Replay { path: path.to_owned(), problem: error.to_string() })?;
        if replay.wearlaw_replay != VERSION {
            let problem = format!("it has version {}, expected {VERSION}", replay.wearlaw_replay);
            return Err(ConformanceError::Replay { path: path.to_owned(), problem });
        }
        Ok(replay)
    }

    /// Changes options so that they run this failure again, on whatever library they name.
    pub fn apply(&self, options: &mut CheckOptions) {
        options.selected = vec![self.check];
        options.seed = self.seed;
        options.quick = self.quick;
        options.patient = true;
        options.law = options.law.take().or_else(|| self.law.clone());
        options.options = options.options.take().or_else(|| self.options.clone());
        if let Some(path) = self.expected.as_ref().filter(|path| path.exists())
            && !matches!(options.expected, Expected::File(_))
        {
            options.expected = Expected::File(path.clone());
        }
    }
}

/// A law's name as part of a file name: whatever it is, the file stays in its folder.
fn as_file_name(law: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' };
    law.chars().take(64).map(plain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Outcome;
    use wearlaw_law::Source;

    #[test]
    fn a_failure_is_written_and_read_back_and_sets_the_options() {
        let options = CheckOptions { seed: 42, ..CheckOptions::new(Source::Embedded("archard".to_owned())) };
        let finding = Finding::new("it is wrong").at(vec![("pressure".to_owned(), "5e7".to_owned())]);
        let result = |outcome| CheckResult {
            law: Some("archard".to_owned()),
            check: Check::ValuesFinite,
            outcome,
            seconds: 0.5,
            replay: None,
        };
        assert_eq!(Replay::of(&result(Outcome::Pass(None)), &options, None, None), None);
        let replay = Replay::of(&result(Outcome::Fail(finding)), &options, None, None).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = replay.write(&folder.path().join("new")).unwrap();
        assert!(path.ends_with("new/archard.values-finite.json"), "{}", path.display());
        assert_eq!(Replay::read(&path).unwrap(), replay);
        let mut fresh = CheckOptions::new(Source::Embedded("archard".to_owned()));
        replay.apply(&mut fresh);
        assert_eq!((fresh.selected.as_slice(), fresh.seed), ([Check::ValuesFinite].as_slice(), 42));
        assert_eq!(fresh.law.as_deref(), Some("archard"));
    }

    #[test]
    fn a_law_of_any_name_leaves_its_file_in_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let options = CheckOptions::new(Source::Embedded("archard".to_owned()));
        for name in ["../oops", "archard/modified", "a\u{1b}[31m", "..", &"x".repeat(400)] {
            let (law, outcome) = (Some(name.to_owned()), Outcome::Fail(Finding::new("it is wrong")));
            let result = CheckResult { law, check: Check::DescriptorNames, outcome, seconds: 0.5, replay: None };
            let path = Replay::of(&result, &options, None, None).unwrap().write(folder.path()).unwrap();
            assert_eq!(path.parent(), Some(folder.path()), "{name}");
            assert_eq!(Replay::read(&path).unwrap().law.as_deref(), Some(name));
        }
    }

    #[test]
    fn what_an_earlier_run_has_left_goes() {
        let folder = tempfile::tempdir().unwrap();
        let left = |folder: &Path| std::fs::read_dir(folder).map_or(0, Iterator::count);
        let result = |law: &str, check| {
            let outcome = Outcome::Fail(Finding::new("it is wrong"));
            CheckResult { law: Some(law.to_owned()), check, outcome, seconds: 0.5, replay: None }
        };
        let mut options = CheckOptions::new(Source::Embedded("archard".to_owned()));
        let place = folder.path().join("archard.check");
        for (law, check) in [("a", Check::ValuesFinite), ("a", Check::BatchOdd), ("b", Check::ValuesFinite)] {
            Replay::of(&result(law, check), &options, None, None).unwrap().write(&place).unwrap();
        }
        std::fs::write(place.join("notes.json"), "{}").unwrap();
        (options.selected, options.law) = (vec![Check::ValuesFinite], Some("a".to_owned()));
        Replay::clear(&place, &options).unwrap();
        assert_eq!(left(&place), 3, "only what is run again");
        options = CheckOptions::new(Source::Embedded("archard".to_owned()));
        Replay::clear(&place, &options).unwrap();
        assert_eq!(left(&place), 1, "the notes stay");
        std::fs::remove_file(place.join("notes.json")).unwrap();
        Replay::clear(&place, &options).unwrap();
        assert!(!place.exists());
    }

    #[test]
    fn another_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        std::fs::write(&path, "{}").unwrap();
        assert!(Replay::read(&path).unwrap_err().to_string().contains("no replay file"));
        assert!(Replay::read(&folder.path().join("none")).unwrap_err().to_string().contains("could not be read"));
    }
}
