//! The list of all checks, for the terminal, for other programs and for the documentation.

use std::fmt::Write;

use serde_json::{Value, json};

use super::super::check::{Check, Group};

/// The list as `--list` prints it; a star marks what `--quick` runs.
pub fn list_text() -> String {
    let mut text = String::new();
    for group in Group::ALL {
        let _ = writeln!(text, "{}", group.name());
        for facts in Check::ALL.iter().map(|check| check.facts()).filter(|facts| facts.group == group) {
            let mark = if facts.quick { ' ' } else { '†' };
            let _ = writeln!(text, "  {mark} {:<29}  {}", facts.name, facts.description);
        }
    }
    let full = Check::ALL.iter().filter(|check| !check.facts().quick).count();
    let _ = writeln!(text, "{} checks; --quick leaves out the {full} marked with †", Check::ALL.len());
    text
}

/// The list as JSON: an array of objects.
pub fn list_json() -> Value {
    let facts = Check::ALL.iter().map(|check| check.facts());
    let objects = facts.map(|facts| {
        json!({
            "check": facts.name,
            "group": facts.group.name(),
            "quick": facts.quick,
            "description": facts.description,
            "rule": { "text": facts.rule, "section": facts.section },
        })
    });
    objects.collect()
}

/// The table in `include/README.md`, which a test holds to the checks.
pub fn page() -> String {
    let mut text = String::from("| check | what is tested | rule |\n| --- | --- | --- |\n");
    for facts in Check::ALL.iter().map(|check| check.facts()) {
        let mark = if facts.quick { "" } else { " \u{2020}" };
        let (name, anchor) = (facts.name, facts.section.to_lowercase().replace(' ', "-"));
        let _ = writeln!(
            text,
            "| `{name}`{mark} | {} | {} ([{}](#{anchor})) |",
            facts.description, facts.rule, facts.section
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_check_is_in_every_list() {
        let (text, json, page) = (list_text(), list_json(), page());
        assert_eq!(json.as_array().map(Vec::len), Some(Check::ALL.len()));
        for check in Check::ALL {
            let facts = check.facts();
            assert!(text.contains(facts.name) && text.contains(facts.description), "{}", facts.name);
            assert!(page.contains(&format!("| `{}`", facts.name)), "{}", facts.name);
        }
    }
}
