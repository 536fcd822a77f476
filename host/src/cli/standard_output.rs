//! Keeps standard output to the document of `--json`: whatever a law prints there goes to standard error.
#![allow(unsafe_code)] // reason: what a number of an open file leads to is exchanged by a system call alone.

use std::fs::File;
use std::io::{self, Write};
use std::sync::OnceLock;

/// Where standard output led before it was exchanged.
static DOCUMENT: OnceLock<File> = OnceLock::new();

/// Lets everything that this process and those that it starts write to standard output go to standard error, but for
/// what [`write`] is given. Where the system refuses, all stays as it is.
#[cfg(unix)]
pub(super) fn reserve() {
    use std::os::fd::{AsFd, AsRawFd};
    let (out, beside) = (io::stdout(), io::stderr());
    if DOCUMENT.get().is_some() || out.lock().flush().is_err() {
        return;
    }
    let Ok(copy) = out.as_fd().try_clone_to_owned() else { return };
    // SAFETY: both numbers are open files of this process, standard output and standard error, which nothing here closes;
    // where standard output led stays open as `copy`.
    if unsafe { libc::dup2(beside.as_fd().as_raw_fd(), out.as_fd().as_raw_fd()) } >= 0 {
        // It is set once, as looked at above; `main` is called by one thread.
        let _ = DOCUMENT.set(File::from(copy));
    }
}

/// Elsewhere a law can print between the document's lines.
#[cfg(not(unix))]
pub(super) fn reserve() {}

/// Writes to standard output, wherever it led when the program began.
pub(super) fn write(text: &[u8]) -> io::Result<()> {
    match DOCUMENT.get() {
        Some(mut file) => file.write_all(text),
        None => {
            let mut out = io::stdout().lock();
            out.write_all(text).and_then(|()| out.flush())
        }
    }
}
