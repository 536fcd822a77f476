//! The machine and the moment of a run, for whoever reads its page later.

use std::time::{SystemTime, UNIX_EPOCH};

/// Label and text of each.
pub(super) fn facts(threads: Option<usize>) -> Vec<(String, String)> {
    let here = std::thread::available_parallelism().map_or(1, usize::from);
    let fact = |label: &str, text: String| (label.to_owned(), text);
    let mut facts = vec![
        fact("machine", format!("{} {}, {here} threads", std::env::consts::OS, std::env::consts::ARCH)),
        fact("threads of the run, at most", threads.unwrap_or(here).to_string()),
    ];
    if let Some(processor) = processor(&std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default()) {
        facts.push(fact("processor", processor));
    }
    if let Ok(since) = SystemTime::now().duration_since(UNIX_EPOCH) {
        facts.push(fact("written", date(since.as_secs())));
    }
    facts
}

/// The processor's name as Linux tells it.
fn processor(text: &str) -> Option<String> {
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// Seconds since 1970 as a date and a time, UTC. The days of the Gregorian calendar are counted from 1 March of the year 0,
/// in eras of 400 years (E. G. Richards, Explanatory Supplement to the Astronomical Almanac, 2013, section 15.11).
fn date(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400 + 719_468, seconds % 86_400);
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = era * 400 + year + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02} {:02}:{:02} UTC", rest / 3_600, rest % 3_600 / 60)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_dates() {
        for (seconds, known) in [
            (0, "1970-01-01 00:00 UTC"),
            (951_782_399, "2000-02-28 23:59 UTC"),
            (951_782_400, "2000-02-29 00:00 UTC"),
            (951_868_800, "2000-03-01 00:00 UTC"),
            (4_107_542_400, "2100-03-01 00:00 UTC"),
            (1_796_083_199, "2026-11-30 23:59 UTC"),
        ] {
            assert_eq!(date(seconds), known);
        }
    }

    #[test]
    fn a_processor_has_its_name() {
        assert_eq!(processor("processor\t: 0\nmodel name\t: A B: C\n").as_deref(), Some("A B: C"));
        assert_eq!(processor(""), None);
    }
}
