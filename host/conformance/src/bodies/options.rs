//! Options that a law can be given besides those of its user: what makes no sense to any, and what leads one that looks for
//! a file, a number or a name in its options further than that.
#![allow(unsafe_code)] // reason: makes files that have no place in any folder.

use std::ffi::CString;
use std::fs::File;
use std::io::Write;
use std::os::fd::{AsRawFd, FromRawFd};

use super::super::message::Task;

/// Bytes of a file named in the options that are read.
const MOST: usize = 1 << 20;

/// A text of options, and what to call it.
pub(super) struct Strange {
    pub(super) label: String,
    /// None: NULL.
    pub(super) words: Option<CString>,
    /// What the text leads to lives as long.
    _file: Option<File>,
}

impl Strange {
    fn new(words: Option<&str>) -> Self {
        let label = words.map_or_else(|| "NULL".to_owned(), |words| format!("{words:.60?}"));
        Self { label, words: words.and_then(|words| CString::new(words).ok()), _file: None }
    }

    /// The text `before` with a file that holds those bytes.
    fn leading(before: &str, bytes: &[u8], what: &str) -> Option<Self> {
        let file = nowhere(bytes)?;
        let words = CString::new(format!("{before}/proc/self/fd/{}", file.as_raw_fd())).ok();
        Some(Self { label: format!("{before:?} and the name of {what}"), words, _file: Some(file) })
    }
}

/// Everything besides the user's own options: what makes no sense to any law, and what comes of his.
pub(super) fn others(task: &Task) -> Vec<Strange> {
    senseless().into_iter().chain(altered(task)).collect()
}

/// What makes no sense to any law.
pub(super) fn senseless() -> Vec<Strange> {
    let long = "no-such-option = 1; ".repeat(500);
    let texts = [None, Some(""), Some("no such option"), Some("no-such-file.csv"), Some("=%s%n\u{1}"), Some(&long)];
    texts.into_iter().map(Strange::new).collect()
}

/// What comes of the user's own options when their last value (behind the last `=`, or the whole text) is another: a file
/// that is not there, a folder, files that are empty, binary or half of the one named, a number that is none, far too many
/// characters; none where no options were given.
pub(super) fn altered(task: &Task) -> Vec<Strange> {
    let Some(given) = task.options.as_deref() else { return Vec::new() };
    let (before, value) = given
        .rsplit_once('=')
        .map_or(("", given), |(before, value)| (given.get(..=before.len()).unwrap_or_default(), value));
    let long = "x".repeat(10_000);
    let half: String = value.chars().take(value.chars().count() / 2).collect();
    let values = ["", "no-such-file.csv", "%s%n.csv", ".", "/", "-1", "nan", "1e999", &half, &long];
    let mut all: Vec<Strange> = values.iter().map(|value| Strange::new(Some(&format!("{before}{value}")))).collect();
    let binary: Vec<u8> = (0..4096_u32).map(|at| (at * 37 % 256) as u8).collect();
    all.extend(Strange::leading(before, b"", "an empty file"));
    all.extend(Strange::leading(before, &binary, "a file of all bytes"));
    all.extend(Strange::leading(before, &[b'9'; 20_000], "a file of one long number"));
    if let Ok(whole) = std::fs::read(value.trim())
        && whole.len() <= MOST
    {
        let part = &whole[..whole.len() / 4 * 3];
        let line = part.iter().rposition(|byte| *byte == b'\n').map_or(part, |at| &part[..=at]);
        all.extend(Strange::leading(before, line, "three quarters of the file, by lines"));
        all.extend(Strange::leading(
            before,
            &[line, b"nonsense\n"].concat(),
            "three quarters of the file and a line of nonsense",
        ));
        all.extend(Strange::leading(
            before,
            &whole[..whole.len().saturating_sub(2)],
            "the file without its last bytes",
        ));
        all.extend(Strange::leading(
            before,
            &other_digits(&whole),
            "the file with other last digits in its later lines",
        ));
    }
    all
}

/// A text whose later lines have another last digit each: a table of the same form with other numbers.
fn other_digits(text: &[u8]) -> Vec<u8> {
    let mut other = text.to_vec();
    let middle = other.len() / 2;
    for line in other[middle..].split_mut(|byte| *byte == b'\n') {
        if let Some(digit) = line.iter_mut().rev().find(|byte| byte.is_ascii_digit()) {
            *digit = b'0' + (*digit - b'0' + 3) % 10;
        }
    }
    other
}

/// A file that is in no folder and goes with its last descriptor, so that nothing is left of a worker that is ended.
fn nowhere(bytes: &[u8]) -> Option<File> {
    // SAFETY: the name is a text with its NUL.
    let descriptor = unsafe { libc::memfd_create(c"options".as_ptr(), libc::MFD_CLOEXEC) };
    if descriptor < 0 {
        return None;
    }
    // SAFETY: the descriptor is new and this process's own.
    let mut file = unsafe { File::from_raw_fd(descriptor) };
    file.write_all(bytes).ok()?;
    Some(file)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Check;
    use wearlaw_law::Source;

    fn task(options: Option<&str>) -> Task {
        Task {
            check: Check::FaultsCreate,
            source: Source::Embedded("archard".to_owned()),
            law: None,
            options: options.map(str::to_owned),
            seed: 1,
            quick: false,
            expected: None,
            budget: 1.0,
            narrow: None,
            bits: Vec::new(),
        }
    }

    #[test]
    fn the_last_value_of_the_options_is_another_and_a_file_of_its_half_can_be_read() {
        let folder = tempfile::tempdir().unwrap();
        let table = folder.path().join("table.csv");
        std::fs::write(&table, "1,2\n3,4\n5,6\n7,8\n").unwrap();
        let given = format!("law=a;table={}", table.display());
        let all = altered(&task(Some(&given)));
        let texts: Vec<&str> = all.iter().map(|one| one.words.as_ref().unwrap().to_str().unwrap()).collect();
        assert!(texts.iter().all(|text| text.starts_with("law=a;table=")), "{texts:?}");
        assert!(texts.contains(&"law=a;table=no-such-file.csv") && texts.contains(&"law=a;table="));
        let by_lines = all.iter().position(|one| one.label.contains("by lines")).unwrap();
        let path = texts[by_lines].strip_prefix("law=a;table=").unwrap();
        assert_eq!(std::fs::read_to_string(path).unwrap(), "1,2\n3,4\n5,6\n");
        assert_eq!(other_digits(b"x,y\n1,2\n3,2.5e-9\n4,8 \n"), b"x,y\n1,2\n3,2.5e-2\n4,1 \n");
        assert!(altered(&task(None)).is_empty());
        assert!(altered(&task(Some("fast"))).iter().any(|one| one.words.as_deref() == Some(c"fa")));
    }
}
