//! The two places a command speaks to: results on standard output, everything else on standard error.

use std::io::{ErrorKind, IsTerminal, Write};

use serde::Serialize;

use super::standard_output;
use crate::error::{Error, printable};
use crate::exit_code::ExitCode;

/// How a command speaks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Console {
    pub(super) json: bool,
    pub(super) quiet: bool,
    /// Colors on standard error.
    color: bool,
    /// Bold words on standard output.
    bold: bool,
}

impl Console {
    pub(super) fn new(json: bool, quiet: bool) -> Self {
        let wanted = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
            && std::env::var_os("TERM").is_none_or(|value| value != "dumb");
        Self {
            json,
            quiet,
            color: wanted && std::io::stderr().is_terminal(),
            bold: wanted && std::io::stdout().is_terminal(),
        }
    }

    /// A headline of a result.
    pub(super) fn headline(&self, text: &str) -> String {
        if self.bold { format!("\u{1b}[1m{text}\u{1b}[0m") } else { text.to_owned() }
    }

    /// Prints a result; a reader that has seen enough (`| head`) is no error.
    pub(super) fn result(&self, text: &str) -> Result<(), Error> {
        match standard_output::write(text.as_bytes()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Error::Stdout(error)),
            _ => Ok(()),
        }
    }

    /// Prints the document of `--json`.
    pub(super) fn document(&self, document: &impl Serialize) -> Result<(), Error> {
        let mut text = serde_json::to_string_pretty(document).map_err(|error| Error::Stdout(error.into()))?;
        text.push('\n');
        self.result(&text)
    }

    /// Says something beside the result, unless told to be quiet.
    pub(super) fn note(&self, text: &str) {
        if !self.quiet {
            self.beside(&printable(text));
        }
    }

    /// Passes on what a compiler said, as it is.
    pub(super) fn messages(&self, text: &str) {
        let text = text.trim_end();
        if !text.is_empty() {
            self.beside(text);
        }
    }

    /// Whether a progress bar makes sense.
    pub(super) fn shows_progress(&self) -> bool {
        !self.quiet && std::io::stderr().is_terminal()
    }

    /// Says what went wrong and gives the exit code.
    pub(super) fn error(&self, error: &Error) -> ExitCode {
        let code = error.exit_code();
        if self.json {
            let document = serde_json::json!({ "error": error.to_json(), "exit_code": code.number() });
            if self.document(&document).is_ok() {
                return code;
            }
        }
        self.beside(error.render(self.color).trim_end());
        code
    }

    /// A standard error that is closed leaves nobody to tell.
    fn beside(&self, text: &str) {
        let _ = writeln!(std::io::stderr().lock(), "{text}");
    }
}
