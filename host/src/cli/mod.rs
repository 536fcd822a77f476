//! The program: its arguments, what it prints, and how it ends; one file per command.
//!
//! Results go to standard output, everything else to standard error. With `--json` standard output holds one document
//! and nothing else: the command's, or `{ "error": { "kind", "message", .. }, "exit_code": n }`. What a command does is
//! in the modules of the library; nothing there imports from here.

mod apdl;
mod args;
mod bench;
mod build;
mod check;
mod console;
mod description;
mod fit;
mod fit_args;
mod guard;
mod inspect;
mod interrupt;
mod machine;
mod new;
mod opening;
mod pages;
mod plan;
mod progress;
mod restart;
mod run;
mod shim;
mod shim_args;
mod stability;
mod standard_output;
mod study;
mod study_args;
mod study_table;
mod summary;
mod sweep;
mod table;
mod unit_text;
mod writing;

use std::ffi::OsString;
use std::io::IsTerminal;

use clap::{CommandFactory, FromArgMatches};

use crate::conformance;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::law::embedded;
use crate::law::isolate::{WORKER_COMMAND, worker_main};
use args::{Arguments, Command};
use console::Console;

/// Columns of help that goes to a file or another program: no line of the page on scenes is longer.
const FILE_WIDTH: usize = 130;

/// Runs the program with these arguments, the first one being its own name.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if arguments.get(1).is_some_and(|word| word == WORKER_COMMAND) {
        let words: Vec<String> = arguments[2..].iter().map(|word| word.to_string_lossy().into_owned()).collect();
        // A worker speaks to its parent alone, by its channel and its exit code.
        std::process::exit(worker_main(&words, &embedded::entry));
    }
    if arguments.get(1).is_some_and(|word| word == conformance::WORKER_COMMAND) {
        let words: Vec<String> = arguments[2..].iter().map(|word| word.to_string_lossy().into_owned()).collect();
        std::process::exit(conformance::worker_main(&words));
    }
    let mut line = Arguments::command();
    if !std::io::stdout().is_terminal() {
        line = line.term_width(FILE_WIDTH);
    }
    let parsed = line.try_get_matches_from_mut(&arguments).and_then(|found| Arguments::from_arg_matches(&found));
    let parsed = match parsed {
        Ok(parsed) => parsed,
        Err(error) => return args::refuse(&error, &arguments),
    };
    let console = Console::new(parsed.how.json, parsed.how.quiet);
    if console.json {
        standard_output::reserve();
    }
    match guard::guarded(|| dispatch(&console, parsed.command)) {
        Ok(code) => code,
        Err(error) => console.error(&error),
    }
}

fn dispatch(console: &Console, command: Command) -> Result<ExitCode, Error> {
    match command {
        Command::Run(arguments) => run::command(console, arguments),
        Command::Sweep(arguments) => sweep::command(console, &arguments),
        Command::Stability(arguments) => stability::command(console, arguments),
        Command::Study(arguments) => study::command(console, arguments),
        Command::Fit(arguments) => fit::command(console, &arguments),
        Command::Plan(arguments) => plan::command(console, arguments),
        Command::Build(arguments) => build::command(console, &arguments),
        Command::New(arguments) => new::command(console, &arguments),
        Command::Inspect(arguments) => inspect::command(console, &arguments),
        Command::Check(arguments) => check::command(console, &arguments),
        Command::Bench(arguments) => bench::command(console, &arguments),
        Command::Shim(arguments) => shim::command(console, &arguments),
        Command::Apdl(arguments) => apdl::command(console, &arguments),
        Command::Completions(arguments) => pages::completions(console, &arguments),
        Command::Man(arguments) => pages::man(console, &arguments),
    }
}
