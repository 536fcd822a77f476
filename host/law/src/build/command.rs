//! Running a compiler and keeping what it said.

use std::ffi::OsStr;
use std::process::{Command, Output, Stdio};

use super::{BuildError, Language};

/// The commands run so far and what they said.
#[derive(Debug, Default)]
pub(super) struct Log {
    pub(super) commands: Vec<String>,
    pub(super) messages: String,
}

impl Log {
    /// Runs a command to its end; its standard error is kept as it is, its standard output is given back.
    pub(super) fn run(&mut self, mut command: Command, language: Language) -> Result<Vec<u8>, BuildError> {
        let line = as_typed(&command);
        self.commands.push(line.clone());
        let Output { status, stdout, stderr } = command.stdin(Stdio::null()).output().map_err(|source| {
            let command = command.get_program().to_string_lossy().into_owned();
            match source.kind() {
                std::io::ErrorKind::NotFound => BuildError::MissingCompiler { language, command },
                _ => BuildError::NotStarted { command, source },
            }
        })?;
        self.messages.push_str(&String::from_utf8_lossy(&stderr));
        if status.success() {
            return Ok(stdout);
        }
        let messages = std::mem::take(&mut self.messages);
        Err(BuildError::CompilerFailed { command: line, exit_code: status.code(), messages })
    }
}

/// A command as one would type it into a shell.
fn as_typed(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(quoted).collect::<Vec<_>>().join(" ")
}

fn quoted(word: &OsStr) -> String {
    let word = word.to_string_lossy();
    let plain = |c: char| c.is_alphanumeric() || "-_./=+,:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.into_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}
