//! A report in the XML of JUnit, which build servers read.

use std::fmt::Write;

use super::super::Report;
use super::super::check::Group;
use super::super::outcome::{CheckResult, Outcome};

/// The document: a suite for each group, a case for each check.
pub fn junit(report: &Report, law: &str) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let of = |group: Group| report.results.iter().filter(move |result| result.check.facts().group == group);
    let all = Counts::of(report.results.iter());
    let _ = writeln!(text, "<testsuites name=\"wearlaw check {}\" {all} time=\"{:.3}\">", escaped(law), report.seconds);
    for group in Group::ALL.iter().copied().filter(|group| of(*group).next().is_some()) {
        let counts = Counts::of(of(group));
        let seconds: f64 = of(group).map(|result| result.seconds).sum();
        let _ = writeln!(text, "  <testsuite name=\"{}\" {counts} time=\"{seconds:.3}\">", group.name());
        of(group).for_each(|result| case(&mut text, result));
        text.push_str("  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
}

struct Counts {
    tests: usize,
    failures: usize,
    errors: usize,
    skipped: usize,
}

impl Counts {
    fn of<'r>(results: impl Iterator<Item = &'r CheckResult>) -> Self {
        let mut counts = Self { tests: 0, failures: 0, errors: 0, skipped: 0 };
        for result in results {
            counts.tests += 1;
            match result.outcome {
                Outcome::Fail(_) => counts.failures += 1,
                Outcome::Crashed(_) | Outcome::TimedOut(_) => counts.errors += 1,
                Outcome::Skipped(_) | Outcome::Blocked(_) => counts.skipped += 1,
                Outcome::Pass(_) | Outcome::Warn(_) => {}
            }
        }
        counts
    }
}

impl std::fmt::Display for Counts {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { tests, failures, errors, skipped } = self;
        write!(out, "tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"{skipped}\"")
    }
}

fn case(text: &mut String, result: &CheckResult) {
    let class = result.law.as_deref().unwrap_or("library");
    let name = result.check.name();
    let _ =
        write!(text, "    <testcase classname=\"{}\" name=\"{name}\" time=\"{:.3}\"", escaped(class), result.seconds);
    let body = match &result.outcome {
        Outcome::Pass(_) => {
            text.push_str("/>\n");
            return;
        }
        Outcome::Warn(finding) => {
            format!("<system-out>warning: {}</system-out>", escaped(&details(result, &finding.what)))
        }
        Outcome::Fail(finding) => problem("failure", result, &finding.what),
        Outcome::Crashed(finding) | Outcome::TimedOut(finding) => problem("error", result, &finding.what),
        Outcome::Skipped(reason) => format!("<skipped message=\"{}\"/>", escaped(reason)),
        Outcome::Blocked(by) => format!("<skipped message=\"blocked by {}\"/>", by.name()),
    };
    let _ = writeln!(text, ">\n      {body}\n    </testcase>");
}

fn problem(tag: &str, result: &CheckResult, what: &str) -> String {
    let kind = result.outcome.name();
    format!("<{tag} type=\"{kind}\" message=\"{}\">{}</{tag}>", escaped(what), escaped(&details(result, what)))
}

fn details(result: &CheckResult, what: &str) -> String {
    let mut lines = vec![what.to_owned()];
    if let Some(finding) = result.outcome.finding() {
        let pairs: Vec<String> = finding.input.iter().map(|(name, value)| format!("{name} {value}")).collect();
        if !pairs.is_empty() {
            lines.push(format!("input: {}", pairs.join(", ")));
        }
        let rest = [("found", &finding.found), ("expected", &finding.expected), ("printed", &finding.printed)];
        lines.extend(rest.iter().filter_map(|(label, text)| text.as_ref().map(|text| format!("{label}: {text}"))));
    }
    lines.push(format!("rule: {}", result.check.facts().rule));
    lines.join("\n")
}

/// A text as XML takes it; characters that XML has no place for are shown by their number.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push('\n'),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.extend(c.escape_unicode()),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Check, Finding};

    #[test]
    fn every_kind_of_outcome_has_its_place() {
        let result =
            |check, outcome| CheckResult { law: Some("a<b".to_owned()), check, outcome, seconds: 0.5, replay: None };
        let finding = || Finding::new("1 < 2 & \u{7}").with("x", "y");
        let results = vec![
            result(Check::LoadOpens, Outcome::Pass(None)),
            result(Check::ValuesFinite, Outcome::Fail(finding())),
            result(Check::ValuesZeroDt, Outcome::TimedOut(finding())),
            result(Check::ValuesBounds, Outcome::Warn(finding())),
            result(Check::StateEnd, Outcome::Blocked(Check::LoadOpens)),
        ];
        let text = junit(&Report { laws: vec![], results, seed: 1, seconds: 2.0 }, "a.so");
        for words in [
            "<testsuites name=\"wearlaw check a.so\" tests=\"5\" failures=\"1\" errors=\"1\" skipped=\"1\" time=\"2.000\">",
            "<testsuite name=\"values\" tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\"",
            "<testcase classname=\"a&lt;b\" name=\"load/opens\" time=\"0.500\"/>",
            "<failure type=\"fail\" message=\"1 &lt; 2 &amp; \\u{7}\">",
            "<error type=\"timed-out\"",
            "<skipped message=\"blocked by load/opens\"/>",
            "<system-out>warning: 1 &lt; 2",
        ] {
            assert!(text.contains(words), "{words}\nin\n{text}");
        }
        assert_eq!(text.matches("<testcase").count(), 5);
        assert_eq!(text.matches("</testsuite>").count(), 3);
    }
}
