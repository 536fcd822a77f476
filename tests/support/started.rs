//! Starts the built program and reads how it ended, for the supports that say what should come of it.

#![allow(dead_code)] // every test target takes its own part of this file

use std::ffi::OsStr;
use std::fmt::Debug;
use std::process::{Command, Output, Stdio};

/// How the program ended.
pub struct Ended {
    /// Its exit code.
    pub code: i32,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
}

/// The program with these words, nothing to read and an environment that no user's settings reach.
pub fn program<W: AsRef<OsStr>>(words: &[W]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wearlaw"));
    command.args(words).stdin(Stdio::null());
    for name in ["CC", "CXX", "FC", "CFLAGS", "CXXFLAGS", "FFLAGS", "NO_COLOR", "RUST_BACKTRACE"] {
        command.env_remove(name);
    }
    command
}

/// What a process came to; a signal that ends the program itself is a failure of every test.
pub fn ended<W: Debug>(output: Output, words: &[W]) -> Ended {
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
    let code = output.status.code().unwrap_or_else(|| panic!("{words:?} ended by {:?}", output.status));
    Ended { code, stdout: text(output.stdout), stderr: text(output.stderr) }
}
