//! A line for each check, and what its author needs to know where it failed.

use std::fmt::Write;

use super::super::outcome::{CheckResult, Finding, Outcome};
use super::super::{CheckOptions, Report};

/// Width of the longest name of a check, and of an outcome.
const NAME: usize = 29;
const OUTCOME: usize = 9;
/// Width of the labels under a failed check.
const LABEL: usize = 8;
/// Columns before the words of a check.
pub const WORDS: usize = 2 + OUTCOME + 2 + NAME + 2;
/// Columns before the words of its evidence.
pub const EVIDENCE: usize = 6 + LABEL + 2;
/// Most characters of a line of evidence.
const MOST: usize = 1000;
/// Inputs on one line.
const LINE: usize = 100;

/// The line of one check: outcome, name, and what was seen or why it was not run.
pub fn line(result: &CheckResult) -> String {
    let facts = result.check.facts();
    let shown = shown(&result.outcome);
    let words = match &result.outcome {
        Outcome::Pass(Some(note)) => format!("{} ({note})", facts.description),
        Outcome::Skipped(reason) => reason.clone(),
        Outcome::Blocked(by) => format!("says nothing since {} failed", by.name()),
        _ => facts.description.to_owned(),
    };
    format!("  {shown:<OUTCOME$}  {:<NAME$}  {words}\n", facts.name)
}

/// The whole report; `law` is how the user calls the library, for the commands to type next.
pub fn text(report: &Report, options: &CheckOptions, law: &str) -> String {
    let mut text = String::new();
    let mut of: Option<&Option<String>> = None;
    for result in &report.results {
        if of != Some(&result.law) {
            match &result.law {
                Some(name) => {
                    let _ = writeln!(text, "law {}", readable(name));
                }
                None => text.push_str("library\n"),
            }
            of = Some(&result.law);
        }
        text.push_str(&line(result));
        if let Some(finding) = result.outcome.finding() {
            text.push_str(&evidence(result, finding, law, options));
        }
    }
    if !options.left_out.is_empty() {
        let names: Vec<&str> = options.left_out.iter().map(|check| check.name()).collect();
        let _ = writeln!(text, "left out by --quick: {}", names.join(", "));
    }
    let short =
        report.results.iter().filter(|result| result.outcome.falls_short() && result.outcome.finding().is_some());
    let short: Vec<&str> = short.map(|result| result.check.name()).collect();
    if !short.is_empty() {
        let _ = writeln!(text, "to mend, each shown above: {}", short.join(", "));
    }
    text.push_str(&summary(report));
    text
}

/// The report of somebody who wants no word on what is good: a line for each check that found a fault or warns, and the
/// last line.
pub fn quiet(report: &Report) -> String {
    let mut text = String::new();
    for result in &report.results {
        let Some(finding) = result.outcome.finding() else { continue };
        let law = result.law.as_deref().filter(|_| report.laws.len() > 1);
        let law = law.map_or_else(String::new, |law| format!("law {law}: "));
        let what = finding.what.lines().next().unwrap_or_default();
        let _ = writeln!(text, "  {:<OUTCOME$}  {:<NAME$}  {law}{what}", shown(&result.outcome), result.check.name());
    }
    text.push_str(&summary(report));
    text
}

/// The name of an outcome; what needs attention stands out without color.
fn shown(outcome: &Outcome) -> String {
    if outcome.falls_short() { outcome.name().to_uppercase() } else { outcome.name().to_owned() }
}

/// What its author needs to know of a check that failed or warned.
fn evidence(result: &CheckResult, finding: &Finding, law: &str, options: &CheckOptions) -> String {
    let facts = result.check.facts();
    let mut text = String::new();
    let mut row = |label: &str, words: &str| {
        for (index, line) in words.lines().enumerate() {
            let label = if index == 0 { label } else { "" };
            let _ = writeln!(text, "      {label:<LABEL$}  {}", readable(line));
        }
    };
    row("what", &finding.what);
    if !finding.input.is_empty() {
        row("input", &inputs(&finding.input));
    }
    if let Some(found) = &finding.found {
        row("found", found);
    }
    if let Some(expected) = &finding.expected {
        row("expected", expected);
    }
    if let Some(printed) = &finding.printed {
        row("printed", printed);
    }
    row("rule", &format!("{} (include/README.md, \"{}\")", facts.rule, facts.section));
    let name = result.law.as_deref().filter(|_| !law.contains('#'));
    let law = name.map_or_else(
        || law.to_owned(),
        |name| if law.ends_with(".so") { format!("{law}#{name}") } else { law.to_owned() },
    );
    match &result.replay {
        Some(path) => {
            row("again", &format!("wearlaw check {} --replay {}", quoted(&law), quoted(&path.display().to_string())))
        }
        None => {
            let seed = options.seed;
            let seed = if seed == CheckOptions::SEED { String::new() } else { format!(" --seed {seed}") };
            let words =
                options.options.as_ref().map_or_else(String::new, |words| format!(" --options {}", quoted(words)));
            row("again", &format!("wearlaw check {} --only {}{seed}{words}", quoted(&law), facts.name));
        }
    }
    text
}

/// A line as a terminal can show it: a law may have printed anything, or have names of anything.
fn readable(line: &str) -> String {
    let mut shown = String::new();
    for character in line.chars().take(MOST) {
        if character.is_control() && character != '\t' {
            shown.extend(character.escape_default());
        } else {
            shown.push(character);
        }
    }
    if line.chars().nth(MOST).is_some() {
        shown.push_str(" ..");
    }
    shown
}

/// Inputs as `name value`, as many on a line as fit.
fn inputs(input: &[(String, String)]) -> String {
    let mut lines = vec![String::new()];
    for (name, value) in input {
        let pair = format!("{name} {value}");
        let last = lines.last_mut().filter(|line| line.is_empty() || line.len() + pair.len() < LINE);
        match last {
            Some(line) => {
                if !line.is_empty() {
                    line.push_str(", ");
                }
                line.push_str(&pair);
            }
            None => lines.push(pair),
        }
    }
    lines.join("\n")
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+:,@%#".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// The last line: how many of each, the time and the seed.
pub fn summary(report: &Report) -> String {
    let names = ["pass", "warn", "fail", "crashed", "timed-out", "blocked", "skipped"];
    let counts: Vec<String> = names
        .iter()
        .map(|name| (name, report.count(name)))
        .filter(|(name, count)| *count > 0 || **name == "pass")
        .map(|(name, count)| format!("{count} {name}"))
        .collect();
    let verdict = match report.untested() {
        Some(reason) => format!("{}\nnot tested", readable(reason)),
        None if report.passes() => "passes".to_owned(),
        None => "falls short".to_owned(),
    };
    format!("{verdict}: {} ({:.1} s, seed {})\n", counts.join(", "), report.seconds, report.seed)
}

#[cfg(test)]
mod tests {
    use super::super::super::check::Check;
    use super::*;
    use wearlaw_law::Source;

    fn report() -> (Report, CheckOptions) {
        let options = CheckOptions::new(Source::File("a.so".into()));
        let result = |law: Option<&str>, check, outcome| CheckResult {
            law: law.map(str::to_owned),
            check,
            outcome,
            seconds: 0.1,
            replay: None,
        };
        let input = vec![("pressure".to_owned(), "5e7".to_owned()), ("dt".to_owned(), "0".to_owned())];
        let finding = Finding::new("a substep of no length wears").with("increment 1e-9", "increment 0").at(input);
        let results = vec![
            result(None, Check::LoadOpens, Outcome::Pass(Some("1 law".to_owned()))),
            result(Some("a"), Check::ValuesZeroDt, Outcome::Fail(finding)),
            result(Some("a"), Check::StateEnd, Outcome::Skipped("the law has no state variables".to_owned())),
            result(Some("a"), Check::BatchOdd, Outcome::Blocked(Check::BatchSingles)),
        ];
        (Report { laws: vec!["a".to_owned()], results, seed: 7, seconds: 1.25 }, options)
    }

    #[test]
    fn a_failure_tells_input_answer_rule_and_what_to_type_next() {
        let (report, options) = report();
        let text = text(&report, &options, "my laws/a.so");
        for words in [
            "library\n  pass       load/opens",
            "law a\n  FAIL       values/zero-dt",
            "      input     pressure 5e7, dt 0\n",
            "      found     increment 1e-9\n      expected  increment 0\n",
            "rule      a substep of no length, dt = 0 and no slip, wears nothing",
            "(include/README.md, \"The contract\")",
            "again     wearlaw check 'my laws/a.so#a' --only values/zero-dt\n",
            "the law has no state variables",
            "says nothing since batch/singles failed",
            "falls short: 1 pass, 1 fail, 1 blocked, 1 skipped (1.2 s, seed 7)",
        ] {
            assert!(text.contains(words), "{words}\nin\n{text}");
        }
    }

    #[test]
    fn a_command_keeps_the_seed_and_nothing_steers_the_terminal() {
        let (mut report, mut options) = report();
        options.seed = 2;
        let found = Finding::new("it says \0\u{1b}[31mred").with("x".repeat(5000), "less");
        report.results[1].outcome = Outcome::Warn(found);
        let text = text(&report, &options, "a.so");
        assert!(text.contains("--only values/zero-dt --seed 2\n"), "{text}");
        assert!(text.contains("it says \\u{0}\\u{1b}[31mred\n"), "{text}");
        assert!(text.lines().all(|line| line.len() < 1100 && !line.contains(['\0', '\u{1b}'])), "{text}");
    }

    #[test]
    fn a_quick_run_says_what_it_left_out() {
        let (report, mut options) = report();
        options.selected = vec![Check::ValuesZeroDt, Check::StateEnd];
        assert!(!text(&report, &options, "a.so").contains("left out"), "nothing that was meant");
        options.left_out = vec![Check::LoadTwice, Check::StateRestart];
        assert!(text(&report, &options, "a.so").contains("left out by --quick: load/twice, state/restart\n"));
    }

    #[test]
    fn a_quiet_report_names_each_failure_in_a_line() {
        let (mut report, _) = report();
        let lines = "  FAIL       values/zero-dt                 a substep of no length wears\nfalls short: 1 pass, ";
        assert!(quiet(&report).starts_with(lines), "{}", quiet(&report));
        report.laws.push("b".to_owned());
        assert!(quiet(&report).contains("law a: a substep of no length wears\n"), "{}", quiet(&report));
        report.results.retain(|result| !result.outcome.falls_short());
        assert!(quiet(&report).starts_with("passes: "), "{}", quiet(&report));
        report.results[0].outcome = Outcome::Warn(Finding::new("slow"));
        let warned = format!("  warn       {:<NAME$}  slow\npasses: ", report.results[0].check.name());
        assert!(quiet(&report).starts_with(&warned), "{}", quiet(&report));
    }

    #[test]
    fn names_fit_their_column() {
        assert_eq!(Check::ALL.iter().map(|check| check.name().len()).max(), Some(NAME));
    }
}
