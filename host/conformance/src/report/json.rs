//! A report as one JSON document.

use serde_json::{Value, json};

use super::super::Report;
use super::super::outcome::{CheckResult, Outcome};

/// The document: `passes`, `untested` (why no instance could be made; null where one was), `laws`, `seed`, `seconds`, `counts` by outcome, and `checks`, one object each.
pub fn json(report: &Report, law: &str) -> Value {
    let names = ["pass", "warn", "fail", "crashed", "timed-out", "skipped", "blocked"];
    let counts: serde_json::Map<String, Value> =
        names.iter().map(|name| ((*name).to_owned(), report.count(name).into())).collect();
    json!({
        "law": law,
        "laws": report.laws,
        "passes": report.passes() && report.untested().is_none(),
        "untested": report.untested(),
        "seed": report.seed,
        "seconds": report.seconds,
        "counts": counts,
        "checks": report.results.iter().map(check).collect::<Vec<_>>(),
    })
}

fn check(result: &CheckResult) -> Value {
    let facts = result.check.facts();
    let mut value = json!({
        "check": facts.name,
        "group": facts.group.name(),
        "law": result.law,
        "outcome": result.outcome.name(),
        "seconds": result.seconds,
        "description": facts.description,
    });
    match &result.outcome {
        Outcome::Pass(note) => value["note"] = note.clone().into(),
        Outcome::Skipped(reason) => value["reason"] = reason.clone().into(),
        Outcome::Blocked(by) => value["blocked_by"] = by.name().into(),
        Outcome::Warn(_) | Outcome::Fail(_) | Outcome::Crashed(_) | Outcome::TimedOut(_) => {}
    }
    if let Some(finding) = result.outcome.finding() {
        let input: serde_json::Map<String, Value> =
            finding.input.iter().map(|(name, value)| (name.clone(), value.clone().into())).collect();
        value["what"] = finding.what.clone().into();
        value["input"] = input.into();
        value["found"] = finding.found.clone().into();
        value["expected"] = finding.expected.clone().into();
        value["printed"] = finding.printed.clone().into();
        value["rule"] = json!({ "text": facts.rule, "section": facts.section });
        value["replay"] = result.replay.as_ref().map(|path| path.display().to_string()).into();
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Check, Finding};

    #[test]
    fn every_check_is_an_object_with_its_evidence() {
        let finding = Finding::new("wrong").with("1", "2").at(vec![("dt".to_owned(), "0.1".to_owned())]);
        let result =
            |outcome| CheckResult { law: None, check: Check::ValuesFinite, outcome, seconds: 0.5, replay: None };
        let results = vec![
            result(Outcome::Fail(finding)),
            result(Outcome::Blocked(Check::LoadOpens)),
            result(Outcome::Skipped("waived: old".to_owned())),
        ];
        let document = json(&Report { laws: vec![], results, seed: 1, seconds: 2.0 }, "a.so");
        assert_eq!((&document["passes"], &document["counts"]["fail"]), (&false.into(), &1.into()));
        let checks = document["checks"].as_array().unwrap();
        assert_eq!((&checks[0]["found"], &checks[0]["input"]["dt"]), (&"1".into(), &"0.1".into()));
        assert_eq!(checks[0]["rule"]["section"], "The contract");
        assert_eq!((&checks[1]["blocked_by"], &checks[2]["reason"]), (&"load/opens".into(), &"waived: old".into()));
    }
}
