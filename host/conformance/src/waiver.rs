//! Checks that are switched off, each with a written reason that the report shows.

use std::collections::BTreeMap;
use std::path::Path;

use super::check::Check;
use super::error::{ConformanceError, suggestion};
use super::selection::nearest_check;

/// Checks that are switched off, and why.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waivers {
    reasons: BTreeMap<Check, String>,
}

impl Waivers {
    /// Reads a waiver file: TOML, a line for each check, `"group/name" = "the reason"`.
    ///
    /// # Errors
    /// The file cannot be read, is no such TOML, names a check that does not exist, or gives no reason.
    pub fn read(path: &Path) -> Result<Self, ConformanceError> {
        let text =
            std::fs::read_to_string(path).map_err(|source| ConformanceError::Read { path: path.to_owned(), source })?;
        Self::parse(&text).map_err(|problem| ConformanceError::Waiver { path: path.to_owned(), problem })
    }

    fn parse(text: &str) -> Result<Self, String> {
        let table: toml::Table = toml::from_str(text).map_err(|error| error.to_string().trim_end().to_owned())?;
        let mut reasons = BTreeMap::new();
        for (name, value) in table {
            let Some(check) = Check::named(&name) else {
                let hint = suggestion(&nearest_check(&name));
                return Err(format!("found no check `{name}`{hint}"));
            };
            match value.as_str().map(str::trim) {
                Some(reason) if !reason.is_empty() => reasons.insert(check, reason.to_owned()),
                _ => return Err(format!("`{name}` has no reason, expected a text that says why it is switched off")),
            };
        }
        Ok(Self { reasons })
    }

    /// The reason for which a check is switched off, if it is.
    pub fn reason(&self, check: Check) -> Option<&str> {
        self.reasons.get(&check).map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_waiver_names_a_check_and_gives_a_reason() {
        let waivers = Waivers::parse("\"derivative/kinks\" = \"smooth at any scale that matters\"\n").unwrap();
        assert_eq!(waivers.reason(Check::DerivativeKinks), Some("smooth at any scale that matters"));
        assert_eq!(waivers.reason(Check::DerivativePressure), None);
        for (text, words) in [
            ("\"derivative/kink\" = \"x\"", "did you mean `derivative/kinks`?"),
            ("\"derivative/kinks\" = \" \"", "no reason"),
            ("\"derivative/kinks\" = 3", "no reason"),
            ("derivative/kinks", "TOML"),
        ] {
            let error = Waivers::parse(text).unwrap_err();
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
