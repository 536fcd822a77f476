//! From what became of a worker to an outcome, with the evidence a report shows.

use std::time::Duration;

use super::attempt::{Attempt, Ended, fault};
use super::check::Check;
use super::message::Verdict;
use super::outcome::{Finding, Outcome};
use super::slate::{Crumb, Phase, Touched};

/// Lines of what was printed that a report shows.
const LINES: usize = 6;

/// The outcome of a check by what its worker answered, or by how it ended.
pub(super) fn outcome(check: Check, attempt: &Attempt, timeout: Duration) -> Outcome {
    let outcome = match &attempt.ended {
        Ended::Answered(answer) => of_verdict(answer.verdict.clone()),
        Ended::TimedOut => Outcome::TimedOut(lost(attempt, timeout)),
        Ended::Gone(_) | Ended::Silent | Ended::Interrupted => Outcome::Crashed(lost(attempt, timeout)),
    };
    match outcome {
        Outcome::Pass(_) if check == Check::LoadSilent && !attempt.printed.is_empty() => {
            let finding = Finding::new("it prints");
            let found = format!("{} bytes on standard output or standard error", attempt.printed.len());
            Outcome::Fail(Finding { printed: printed(&attempt.printed), ..finding.with(found, "nothing printed") })
        }
        other => other,
    }
}

fn of_verdict(verdict: Verdict) -> Outcome {
    match verdict {
        Verdict::Pass(note) => Outcome::Pass(note),
        Verdict::Warn(finding) => Outcome::Warn(finding),
        Verdict::Fail(finding) => Outcome::Fail(finding),
        Verdict::Skip(reason) => Outcome::Skipped(reason),
    }
}

/// The evidence of a worker that was lost.
pub(super) fn lost(attempt: &Attempt, timeout: Duration) -> Finding {
    let crumb = &attempt.crumb;
    let how = fault(attempt, timeout).map_or_else(|| "it gave no answer".to_owned(), |(_, words)| words);
    let mut what = format!("{how}, {}", place(crumb));
    if let Some(touched) = touched(crumb) {
        what = format!("{what}: {touched}");
    }
    let evaluating = crumb.phase == Phase::Evaluating;
    Finding {
        what,
        input: if evaluating { input(crumb) } else { Vec::new() },
        found: Some(how),
        expected: Some("the call comes back".to_owned()),
        printed: printed(&attempt.printed),
    }
}

/// Where the law was, in words.
fn place(crumb: &Crumb) -> String {
    let mut words = crumb.phase.words().to_owned();
    if crumb.phase == Phase::Evaluating {
        let points = if crumb.points == 1 { "1 point".to_owned() } else { format!("{} points", crumb.points) };
        words = format!("{words} (call {}, {points})", crumb.call);
    }
    if crumb.label.is_empty() { words } else { format!("{words}, with {}", crumb.label) }
}

fn touched(crumb: &Crumb) -> Option<String> {
    let Crumb { array, offset, .. } = crumb;
    match crumb.touched {
        Touched::Nothing | Touched::Elsewhere | Touched::Stack => None,
        Touched::Behind => Some(format!("it touched memory {offset} bytes behind the end of `{array}`")),
        Touched::Before => Some(format!("it touched memory {offset} bytes before the start of `{array}`")),
        Touched::ReadOnly => Some(format!("it wrote to `{array}`, {offset} bytes from its start")),
        Touched::Null => Some("it followed a NULL pointer, as a field or output has that is not given".to_owned()),
    }
}

/// The inputs as the worker noted them.
pub(super) fn input(crumb: &Crumb) -> Vec<(String, String)> {
    let pairs = crumb.input.lines().filter_map(|line| line.split_once('\t'));
    pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
}

/// The last lines of what was printed.
fn printed(text: &str) -> Option<String> {
    let lines: Vec<&str> = text.lines().map(str::trim_end).filter(|line| !line.is_empty()).collect();
    let last = lines.get(lines.len().saturating_sub(LINES)..)?.join("\n");
    (!last.is_empty()).then_some(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crumb() -> Crumb {
        Crumb {
            phase: Phase::Evaluating,
            call: 7,
            points: 16,
            label: String::new(),
            stayed: Duration::ZERO,
            input: "pressure\t5e7\ndt\t0.1\n".to_owned(),
            touched: Touched::Behind,
            array: "pressure".to_owned(),
            offset: 8,
        }
    }

    fn attempt(ended: Ended, printed: &str) -> Attempt {
        Attempt { ended, crumb: crumb(), printed: printed.to_owned() }
    }

    #[test]
    fn a_lost_worker_says_where_the_law_was_and_what_it_was_given() {
        let outcome = outcome(Check::MemoryAfter, &attempt(Ended::TimedOut, "a\n\nb\n"), Duration::from_secs(3));
        let Outcome::TimedOut(finding) = outcome else { panic!("{outcome:?}") };
        for words in ["within 3 s", "in evaluate (call 7, 16 points)", "8 bytes behind the end of `pressure`"] {
            assert!(finding.what.contains(words), "{}", finding.what);
        }
        assert_eq!(finding.input[0], ("pressure".to_owned(), "5e7".to_owned()));
        assert_eq!(finding.printed.as_deref(), Some("a\nb"));
    }

    #[test]
    fn no_answer_is_never_a_pass() {
        let outcome = outcome(Check::ValuesFinite, &attempt(Ended::Silent, ""), Duration::from_secs(3));
        assert!(outcome.falls_short(), "{outcome:?}");
    }

    #[test]
    fn what_was_printed_fails_the_one_check_that_asks() {
        let answer = || {
            let verdict: super::super::message::Answer = Verdict::Pass(None).into();
            Ended::Answered(Box::new(verdict))
        };
        let time = Duration::from_secs(3);
        assert!(outcome(Check::LoadSilent, &attempt(answer(), "hello"), time).falls_short());
        assert!(!outcome(Check::LoadSilent, &attempt(answer(), ""), time).falls_short());
        assert!(!outcome(Check::LoadOpens, &attempt(answer(), "hello"), time).falls_short());
    }
}
