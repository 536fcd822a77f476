//! A panic anywhere ends the program with one sentence and its own exit code.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;

use crate::error::Error;

static FIRST: Mutex<Option<String>> = Mutex::new(None);

/// Runs `work`; a panic in it becomes [`Error::Fault`] with its place, and prints nothing itself.
pub(super) fn guarded<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    std::panic::set_hook(Box::new(|panic| {
        let payload = panic.payload();
        let text = payload.downcast_ref::<&str>().copied();
        let words = text.or(payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no words");
        let what = match panic.location() {
            Some(place) => format!("{words}, at {}:{}", place.file(), place.line()),
            None => words.to_owned(),
        };
        let mut first = FIRST.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        first.get_or_insert(what);
    }));
    let result = caught(work);
    let _ = std::panic::take_hook();
    result
}

/// Runs a part of guarded work; a panic in it becomes [`Error::Fault`], and the rest goes on.
pub(super) fn caught<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    // Nothing of `work` is used after a panic, so nothing half-changed can be seen.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let what = FIRST.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).take();
        Err(Error::Fault { what: what.unwrap_or_else(|| "a panic without words".to_owned()) })
    })
}

#[cfg(test)]
mod tests {
    use super::guarded;
    use crate::error::Error;

    #[test]
    fn a_panic_is_a_fault_with_its_place_and_words() {
        let result: Result<(), Error> = guarded(|| panic!("index 7 of 3"));
        let error = result.unwrap_err();
        assert_eq!(error.exit_code().number(), 70);
        let text = error.to_string();
        assert!(text.contains("index 7 of 3, at ") && text.contains("guard.rs:"), "{text}");
        let count = 7;
        let result: Result<(), Error> = guarded(|| panic!("{count} words"));
        assert!(result.unwrap_err().to_string().contains("7 words, at "));
        assert_eq!(guarded(|| Ok(3)).unwrap(), 3);
    }
}
