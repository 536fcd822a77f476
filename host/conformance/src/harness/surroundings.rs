//! What a library shares with the program around it, as it is at one time.
#![allow(unsafe_code)] // reason: asks the C library for signal handlers and the locale.

use std::ffi::{CStr, OsString};
use std::path::PathBuf;

use wearlaw_law::isolate::process::descendants;

/// What a law must leave as it found it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surroundings {
    pub(crate) working_directory: Option<PathBuf>,
    pub(crate) locale: String,
    /// Handler and flags of each signal that can be asked for.
    pub(crate) signals: Vec<(i32, usize, i32)>,
    /// Signals that are blocked in this thread.
    pub(crate) blocked: Vec<i32>,
    pub(crate) environment: Vec<(OsString, OsString)>,
}

/// The last signal's number.
const LAST_SIGNAL: i32 = 64;

impl Surroundings {
    /// As they are now.
    pub(crate) fn now() -> Self {
        Self {
            working_directory: std::env::current_dir().ok(),
            locale: locale(),
            signals: (1..=LAST_SIGNAL).filter_map(signal).collect(),
            blocked: blocked(),
            environment: environment(),
        }
    }

    /// The signals whose handler or flags differ, or that are blocked in one and not in the other.
    pub(crate) fn signals_changed(&self, after: &Self) -> Vec<i32> {
        let handled = self.signals.iter().zip(&after.signals).filter(|(a, b)| a != b).map(|(a, _)| a.0);
        let masked = (1..=LAST_SIGNAL).filter(|s| self.blocked.contains(s) != after.blocked.contains(s));
        let mut changed: Vec<i32> = handled.chain(masked).collect();
        changed.sort_unstable();
        changed.dedup();
        changed
    }

    /// The names of variables that were set, changed or removed.
    pub(crate) fn environment_changed(&self, after: &Self) -> Vec<String> {
        let in_one = self.environment.iter().filter(|pair| !after.environment.contains(pair));
        let in_other = after.environment.iter().filter(|pair| !self.environment.contains(pair));
        let mut names: Vec<String> =
            in_one.chain(in_other).map(|(name, _)| name.to_string_lossy().into_owned()).collect();
        names.sort_unstable();
        names.dedup();
        names
    }
}

/// Number of threads of this process.
pub(crate) fn threads() -> usize {
    std::fs::read_dir("/proc/self/task").map_or(0, Iterator::count)
}

/// Number of files this process has open, of the first few thousand; takes no memory itself.
pub(crate) fn open_files() -> usize {
    // SAFETY: takes integers; a number that is no open file is an error and nothing else.
    (0..4096).filter(|descriptor| unsafe { libc::fcntl(*descriptor, libc::F_GETFD) } >= 0).count()
}

/// Number of processes that this one has started, or that it has inherited from those, and that are not gone.
pub(crate) fn processes() -> usize {
    descendants(std::process::id() as libc::pid_t).len()
}

fn locale() -> String {
    // SAFETY: asks only; the text stays until the locale is set again, and is copied here.
    unsafe {
        let name = libc::setlocale(libc::LC_ALL, std::ptr::null());
        if name.is_null() { String::new() } else { CStr::from_ptr(name).to_string_lossy().into_owned() }
    }
}

fn signal(number: i32) -> Option<(i32, usize, i32)> {
    // SAFETY: asks only; the struct is whole and lives through the call.
    unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        let known = libc::sigaction(number, std::ptr::null(), &mut action) == 0;
        known.then_some((number, action.sa_sigaction, action.sa_flags))
    }
}

fn blocked() -> Vec<i32> {
    // SAFETY: asks only; the set is whole and lives through the calls.
    unsafe {
        let mut set: libc::sigset_t = std::mem::zeroed();
        if libc::pthread_sigmask(libc::SIG_BLOCK, std::ptr::null(), &mut set) != 0 {
            return Vec::new();
        }
        (1..=LAST_SIGNAL).filter(|number| libc::sigismember(&set, *number) == 1).collect()
    }
}

fn environment() -> Vec<(OsString, OsString)> {
    let mut all: Vec<_> = std::env::vars_os().collect();
    all.sort_unstable();
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stays_the_same_compares_equal_and_changes_are_named() {
        let before = Surroundings::now();
        assert!(before.signals.len() > 50 && threads() >= 1 && open_files() >= 3);
        assert!(before.working_directory.is_some() && !before.locale.is_empty());
        let mut after = before.clone();
        assert!(before.signals_changed(&after).is_empty() && before.environment_changed(&after).is_empty());
        after.signals[1].1 ^= 1;
        after.blocked.push(10);
        after.environment.push(("A".into(), "b".into()));
        assert_eq!(before.signals_changed(&after), [2, 10]);
        assert_eq!(before.environment_changed(&after), ["A"]);
    }
}
