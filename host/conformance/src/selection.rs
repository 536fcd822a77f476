//! Which checks are meant by the names on the command line.

use super::check::{Check, Group};
use super::error::{ConformanceError, nearest};

/// The checks that `names` stand for, all if there are none.
///
/// A name is a check's (`values/finite`) or a group's (`values`, or `values/*`); several may stand in one word, with commas.
///
/// # Errors
/// A name that neither a check nor a group has.
pub fn select(names: &[String]) -> Result<Vec<Check>, ConformanceError> {
    let mut wanted: Vec<Check> = Vec::new();
    for word in names.iter().flat_map(|word| word.split(',')).map(str::trim).filter(|name| !name.is_empty()) {
        let name = word.strip_suffix("/*").unwrap_or(word);
        let found: Vec<Check> = Check::ALL
            .iter()
            .copied()
            .filter(|check| check.name() == name || check.facts().group.name() == name)
            .collect();
        if found.is_empty() {
            return Err(ConformanceError::NoSuchCheck { name: name.to_owned(), nearest: nearest_check(name) });
        }
        wanted.extend(found);
    }
    let all = names.is_empty();
    Ok(Check::ALL.iter().copied().filter(|check| all || wanted.contains(check)).collect())
}

/// The check or group that was probably meant.
pub(super) fn nearest_check(name: &str) -> Option<String> {
    let groups = Group::ALL.iter().map(|group| group.name());
    nearest(name, Check::ALL.iter().map(|check| check.name()).chain(groups))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(words: &[&str]) -> Vec<&'static str> {
        let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
        select(&words).unwrap().into_iter().map(Check::name).collect()
    }

    #[test]
    fn names_and_groups_select_in_the_order_of_the_report() {
        assert_eq!(names(&[]).len(), Check::ALL.len());
        assert_eq!(names(&["values/finite,load/opens"]), ["load/opens", "values/finite"]);
        assert_eq!(names(&["derivative", "derivative/kinks"]).len(), 3);
        assert_eq!(names(&["derivative/*"]), names(&["derivative"]));
    }

    #[test]
    fn an_unknown_name_suggests_the_nearest() {
        let error = select(&["values/finit".to_owned()]).unwrap_err().to_string();
        assert!(error.contains("`values/finit`") && error.contains("did you mean `values/finite`?"), "{error}");
        let error = select(&["nonsense".to_owned()]).unwrap_err().to_string();
        assert!(error.contains("--list") && !error.contains("did you mean"), "{error}");
    }
}
