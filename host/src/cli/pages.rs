//! `wearlaw completions SHELL` and `wearlaw man [COMMAND]`: what a shell and `man` want to know of the command line.

use clap::{Args, Command, CommandFactory};

use super::args::{Arguments, CompletionsArguments};
use super::console::Console;
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;

/// What `wearlaw man` is asked for.
#[derive(Debug, Clone, Args)]
pub(super) struct ManArguments {
    /// The command [default: the program as a whole]
    pub(super) command: Option<String>,
}

/// Prints the completions of a shell, as it wants to read them.
pub(super) fn completions(console: &Console, arguments: &CompletionsArguments) -> Result<ExitCode, Error> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "wearlaw", &mut script);
    printed(console, "script", &script)
}

/// Prints the manual page of the program or of one of its commands.
pub(super) fn man(console: &Console, arguments: &ManArguments) -> Result<ExitCode, Error> {
    let command = described(arguments.command.as_deref())?;
    let notes = command.get_after_long_help().map(|text| as_it_stands(&text.to_string()));
    let mut page = Vec::new();
    let bare = command.after_help(None).after_long_help(None);
    clap_mangen::Man::new(bare).render(&mut page).map_err(Error::Stdout)?;
    page.extend(notes.unwrap_or_default().bytes());
    printed(console, "page", &page)
}

/// A section of a page whose lines stay as they are: they hold tables.
fn as_it_stands(text: &str) -> String {
    let mut section = ".SH NOTES\n.nf\n".to_owned();
    for line in text.lines() {
        // No line is a command of the page, and what looks like one sign is not another.
        let line = line.replace('\\', "\\e").replace('-', "\\-").replace('\'', "\\(aq");
        section.push_str(if line.starts_with('.') { "\\&" } else { "" });
        section.push_str(&line);
        section.push('\n');
    }
    section + ".fi\n"
}

/// The whole program, or one command with its full name.
fn described(name: Option<&str>) -> Result<Command, Error> {
    let mut whole = Arguments::command();
    whole.build();
    let Some(name) = name else { return Ok(whole) };
    let Some(command) = whole.find_subcommand(name) else {
        let known = whole.get_subcommands().map(|command| command.get_name().to_owned()).collect();
        return Err(UsageError::NoCommand { name: name.to_owned(), known }.into());
    };
    Ok(command.clone().version(env!("CARGO_PKG_VERSION")))
}

fn printed(console: &Console, key: &str, text: &[u8]) -> Result<ExitCode, Error> {
    let text = String::from_utf8_lossy(text);
    if console.json {
        console.document(&serde_json::json!({ key: text }))?;
    } else {
        console.result(&text)?;
    }
    Ok(ExitCode::Done)
}

#[cfg(test)]
mod tests {
    use super::as_it_stands;

    #[test]
    fn no_line_of_a_text_becomes_a_command_of_the_page() {
        let text = "| key | what |\n.TH no 1\n'br\na\\fBold --set";
        let wanted = ".SH NOTES\n.nf\n| key | what |\n\\&.TH no 1\n\\(aqbr\na\\efBold \\-\\-set\n.fi\n";
        assert_eq!(as_it_stands(text), wanted);
    }
}
