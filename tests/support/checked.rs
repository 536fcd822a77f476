//! The JSON report of `wearlaw check`, by check and by outcome.

use serde_json::Value;

/// The object of one check in a JSON report.
pub fn of<'d>(document: &'d Value, check: &str) -> &'d Value {
    let checks = document["checks"].as_array().into_iter().flatten();
    checks.into_iter().find(|found| found["check"] == check).unwrap_or_else(|| panic!("no {check} in {document:#}"))
}

/// The checks that ended so.
pub fn outcomes<'d>(document: &'d Value, outcome: &str) -> Vec<&'d str> {
    let checks = document["checks"].as_array().into_iter().flatten();
    checks.filter(|check| check["outcome"] == outcome).filter_map(|check| check["check"].as_str()).collect()
}
