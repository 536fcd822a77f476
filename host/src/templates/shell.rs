//! Words as a shell takes them.

use std::ffi::OsStr;

/// The word in quotes where a shell would otherwise make something else of it.
pub fn quoted(word: &OsStr) -> String {
    let word = word.to_string_lossy();
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=+,:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.into_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn blanks_and_quotes_survive_a_shell() {
        assert_eq!(quoted("laws/my-law.c".as_ref()), "laws/my-law.c");
        assert_eq!(quoted("my laws".as_ref()), "'my laws'");
        assert_eq!(quoted("it's".as_ref()), "'it'\\''s'");
    }
}
