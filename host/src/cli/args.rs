//! The command line: every argument with its help.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand, ValueEnum};

use super::study_args::{STUDYING, StudyArguments};
use crate::error::printable;
use crate::exit_code::ExitCode;
use crate::law::build::Language;

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "wearlaw",
    version,
    about = "Wear simulation with wear laws that are shared libraries, written in C, C++, Fortran or Rust.",
    after_help = FIRST_STEPS,
    after_long_help = LONG_HELP,
    disable_help_subcommand = true,
    max_term_width = 100,
    arg_required_else_help = true
)]
pub(super) struct Arguments {
    #[command(flatten)]
    pub(super) how: How,
    #[command(subcommand)]
    pub(super) command: Command,
}

/// How every command speaks.
#[derive(Debug, Args)]
pub(super) struct How {
    /// Print one JSON document on standard output and nothing else there
    ///
    /// An error is a document as well: { "error": { "kind", "message", .. }, "exit_code": n }.
    #[arg(long, global = true, display_order = 100)]
    pub(super) json: bool,
    /// Say less: no progress bar, notes, hints or summary
    #[arg(short, long, global = true, display_order = 101)]
    pub(super) quiet: bool,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Run a scene; `wearlaw run --help` shows every key of one
    #[command(after_long_help = SCENES)]
    Run(RunArguments),
    /// Show what a scene will compute and what it leaves out; run nothing
    Plan(PlanArguments),
    /// Run many cases of a scene over all cores into one table; what is done already is kept
    Sweep(SweepArguments),
    /// Measure how stiff the contact is against wear, and what each integrator does beyond the explicit limit
    ///
    /// Ends with 4 if the scene's own method is not fine.
    Stability(StabilityArguments),
    /// Run a scene in many ways: error against run time over integrators, steps, tolerances, scaling and grids
    ///
    /// Every case is the scene under overrides; they run from cheap to dear until the budget is spent, and what is left out
    /// is listed. Writes study.csv, study.json and study.svg.
    #[command(after_long_help = STUDYING)]
    Study(StudyArguments),
    /// Find constants of a law from measurements: what a scene says of wear comes as near to them as it can
    #[command(after_long_help = super::fit_args::FITTING)]
    Fit(super::fit_args::FitArguments),
    /// Compile sources or a Rust crate into a wear-law library
    Build(BuildArguments),
    /// Make a folder with a working wear law of your own to start from
    New(NewArguments),
    /// Show what a library is: its file, then the law in it
    Inspect(InspectArguments),
    /// Check that a law keeps the contract: each check in a process of its own
    #[command(after_long_help = CHECKING)]
    Check(CheckArguments),
    /// Measure laws by themselves: ns per point, part of the memory's bandwidth, accuracy; one column per law
    #[command(after_long_help = MEASURING)]
    Bench(BenchArguments),
    /// Write a user subroutine in Fortran that loads a law and calls it, for a solver that calls no libraries
    #[command(after_long_help = super::shim_args::SHIMS)]
    Shim(super::shim_args::ShimArguments),
    /// Turn the TB,WEAR commands of an input deck into the law section of a scene
    Apdl(ApdlArguments),
    /// Print the completions of a shell
    #[command(after_long_help = COMPLETING)]
    Completions(CompletionsArguments),
    /// Print the manual page of the program or of a command, for `man -l -`
    Man(super::pages::ManArguments),
}

/// What `run` and `plan` share.
#[derive(Debug, Clone, Args)]
pub(super) struct SceneArguments {
    /// Take this law instead of the scene's: a library, a source file, a crate's folder or a name
    #[arg(long, value_name = "PATH")]
    pub(super) law: Option<String>,
    /// Change a key of the scene, such as step.0.load=5; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(super) overrides: Vec<String>,
    /// Run the law in a process of its own, so that a crash or a hang of it harms nothing else
    #[arg(long)]
    pub(super) isolate: bool,
    /// Seconds that one call of an isolated law may take before its process is ended [default: 60]
    #[arg(long, value_name = "SECONDS", requires = "isolate", value_parser = seconds)]
    pub(super) deadline: Option<Duration>,
}

#[derive(Debug, Clone, Args)]
pub(super) struct RunArguments {
    /// The scene file (TOML)
    #[arg(required_unless_present = "references")]
    pub(super) scene: Option<PathBuf>,
    #[command(flatten)]
    pub(super) shared: SceneArguments,
    /// Folder for the results [default: the scene's name with .out, here]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Number of threads [default: as many as the machine has]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
    /// Go on from the checkpoint in the folder of the results, or begin if there is none
    ///
    /// The results are the same to the bit (all but `cost`) as those of a run that was never stopped. A finished run goes
    /// on when the scene has become longer: a longer last step, a higher count of the last cycle, more steps or cycles.
    /// Anything else that changes what is computed is refused. Every run leaves its last checkpoint among the results;
    /// `output.checkpoint = SECONDS` writes them while it goes on, for runs that are killed.
    #[arg(long)]
    pub(super) resume: bool,
    /// Also write report.html: summary, plan, picture and provenance in one file that needs nothing else
    #[arg(long)]
    pub(super) html: bool,
    /// List the built-in exact answers for [reference] kind, and run nothing
    #[arg(long, conflicts_with_all = ["scene", "law", "overrides", "isolate", "deadline", "out", "threads", "resume", "html"])]
    pub(super) references: bool,
}

#[derive(Debug, Clone, Args)]
pub(super) struct PlanArguments {
    /// The scene file (TOML)
    pub(super) scene: PathBuf,
    #[command(flatten)]
    pub(super) shared: SceneArguments,
}

#[derive(Debug, Clone, Args)]
pub(super) struct SweepArguments {
    /// The scene file (TOML)
    pub(super) scene: PathBuf,
    /// Vary a key: KEY=VALUE,VALUE,.. or KEY=FIRST..LAST:COUNT or KEY=FIRST..LAST:COUNT:log; may be repeated
    ///
    /// Several keys give every combination of their values.
    #[arg(long, value_name = "KEY=VALUES", required_unless_present = "cases", conflicts_with = "cases")]
    pub(super) vary: Vec<String>,
    /// Take the cases from a CSV file: its columns are keys of the scene, a row is a case
    #[arg(long, value_name = "FILE")]
    pub(super) cases: Option<PathBuf>,
    /// Run every Nth case only, from the Ith on: for arrays of jobs that write into one folder
    #[arg(long, value_name = "I/N")]
    pub(super) shard: Option<String>,
    #[command(flatten)]
    pub(super) shared: SceneArguments,
    /// Folder for the table and the cases [default: the scene's name with .sweep, here]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Number of cases that run at a time [default: as many as the machine has threads]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
}

#[derive(Debug, Clone, Args)]
pub(super) struct StabilityArguments {
    /// The scene file (TOML)
    pub(super) scene: PathBuf,
    #[command(flatten)]
    pub(super) shared: SceneArguments,
    /// Look at the contact at this time; the scene is run up to it [default: 0]
    #[arg(long, value_name = "TIME")]
    pub(super) at: Option<f64>,
}

#[derive(Debug, Clone, Args)]
pub(super) struct BuildArguments {
    /// Source files (.c, .cpp, .f90 ..), or one Rust crate: its folder or its Cargo.toml
    #[arg(required = true, value_name = "SRC")]
    pub(super) sources: Vec<PathBuf>,
    /// The library to write [default: lib + the first source's name, here]
    #[arg(short, long, value_name = "LIB")]
    pub(super) output: Option<PathBuf>,
    /// The first source holds a user subroutine of another solver, which becomes a law as it stands
    #[arg(long, value_name = "FORM", value_parser = ["uwearindex"])]
    pub(super) adapt: Option<String>,
    /// Names of the elements of the subroutine's `param`, each with its unit where it has one: K,H:pascal
    #[arg(long, value_name = "NAMES", requires = "adapt")]
    pub(super) params: Option<String>,
}

#[derive(Debug, Clone, Args)]
pub(super) struct NewArguments {
    /// Name of the law, and of the folder that is made for it
    #[arg(value_name = "NAME")]
    pub(super) folder: PathBuf,
    /// Language of the law
    #[arg(long, value_enum)]
    pub(super) lang: Option<NewLanguage>,
}

/// The languages that `new` writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum NewLanguage {
    C,
    #[value(alias = "c++", alias = "cxx")]
    Cpp,
    #[value(alias = "f90")]
    Fortran,
    Rust,
}

impl From<NewLanguage> for Language {
    fn from(language: NewLanguage) -> Self {
        match language {
            NewLanguage::C => Self::C,
            NewLanguage::Cpp => Self::Cpp,
            NewLanguage::Fortran => Self::Fortran,
            NewLanguage::Rust => Self::Rust,
        }
    }
}

#[derive(Debug, Clone, Args)]
pub(super) struct InspectArguments {
    /// A library, or the name of a law (archard; embedded:archard for this program's own)
    #[arg(value_name = "LIB")]
    pub(super) library: String,
    /// Stop after the facts of the file; no code of it runs
    #[arg(long = "static")]
    pub(super) only_file: bool,
    /// Describe only the law of this name, where a library holds several
    #[arg(long, value_name = "NAME")]
    pub(super) law: Option<String>,
}

#[derive(Debug, Clone, Args)]
pub(super) struct CheckArguments {
    /// A library, a source file, a crate's folder, or the name of a law; LIB#NAME for one law of several
    #[arg(value_name = "LIB", required_unless_present = "list")]
    pub(super) law: Option<String>,
    /// Show every check and run none
    #[arg(long)]
    pub(super) list: bool,
    /// Run only these checks or groups, such as values/finite or memory; may be repeated
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub(super) only: Vec<String>,
    /// Leave out the checks that take long (a † in --list marks them)
    #[arg(long)]
    pub(super) quick: bool,
    /// Seed of the random inputs
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) seed: u64,
    /// Seconds that a check may take before its process is ended [default: 20]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(super) timeout: Option<Duration>,
    /// Switch checks off: a file with a line "group/name" = "reason" for each
    #[arg(long, value_name = "FILE")]
    pub(super) waive: Option<PathBuf>,
    /// Run a failure again from the file that was written for it
    #[arg(long, value_name = "FILE", conflicts_with_all = ["only", "quick", "waive", "list"])]
    pub(super) replay: Option<PathBuf>,
    /// How the report is written
    #[arg(long, value_enum, default_value_t = ReportFormat::Text)]
    pub(super) format: ReportFormat,
    /// Known values to reproduce [default: expected.csv beside the law]
    #[arg(long, value_name = "FILE")]
    pub(super) expected: Option<PathBuf>,
    /// Options text that the law is created with, as [law] options of a scene
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub(super) options: Option<String>,
    /// Checks that run at the same time [default: as many as the machine has processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
}

/// How a report of checks is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ReportFormat {
    Text,
    Json,
    Junit,
}

#[derive(Debug, Clone, Args)]
pub(super) struct BenchArguments {
    /// Libraries, source files, crates' folders, or names of laws; LIB#NAME for one law of several
    #[arg(value_name = "LIB", required = true)]
    pub(super) laws: Vec<String>,
    /// Points of a call [default: 1 to a million by tens, then four million]
    #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    pub(super) points: Vec<u32>,
    /// Threads that share a call [default: 1 and as many as the machine has]
    #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Vec<u16>,
    /// Seconds for all timing; what would take longer is left out [default: 10]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(super) budget: Option<Duration>,
    /// Seconds that one call of an isolated law may take before its process is ended [default: 60]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(super) deadline: Option<Duration>,
    /// Known values to compare with [default: expected.csv beside the law]
    #[arg(long, value_name = "FILE")]
    pub(super) expected: Option<PathBuf>,
    /// Options text that the laws are created with, as [law] options of a scene
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub(super) options: Option<String>,
    /// Seed of the random inputs
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(super) seed: u64,
}

#[derive(Debug, Clone, Args)]
pub(super) struct ApdlArguments {
    /// The input deck, or the part of it that defines the material
    pub(super) file: PathBuf,
    /// Number of the material [default: the only one with a wear law]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(super) material: Option<i64>,
}

/// A positive number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let wrong = || "expected a number of seconds above 0, such as 0.5".to_owned();
    let number: f64 = text.parse().map_err(|_| wrong())?;
    Duration::try_from_secs_f64(number).ok().filter(|duration| !duration.is_zero()).ok_or_else(wrong)
}

#[derive(Debug, Clone, Args)]
pub(super) struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    pub(super) shell: clap_complete::Shell,
}

const FIRST_STEPS: &str = "\
First steps:
  wearlaw new my-law --lang c     a wear law of your own, with the three commands to type next
  wearlaw inspect archard         what a wear law says of itself
  wearlaw run SCENE               run a scene; `wearlaw plan SCENE` shows beforehand what it does

`wearlaw COMMAND --help` explains a command, `wearlaw --help` lists the exit codes.";

const CHECKING: &str = "\
Outcomes:
  pass, warn   the law keeps the rule; a warning is worth a look
  fail         it breaks the rule
  crashed      it ended its process; timed-out: it did not come back
  blocked      another check failed, and this one says nothing without it
  skipped      it does not apply to this law, or is waived

What fails leaves a file in NAME.check/, which --replay runs again. Ends with 0 if every check passes, 1 if one does not,
2 if the file is no law, no check was run or the law does not start with these options, 70 for a fault of the checker.

A law that needs options is tested with those of --options, and with what comes of them when their last value is another:
a file that is missing, empty or cut short, a number that is none, a very long text.";

const COMPLETING: &str = "\
Where the completions go:
  bash   wearlaw completions bash > ~/.local/share/bash-completion/completions/wearlaw
  zsh    wearlaw completions zsh > a folder of $fpath, as _wearlaw
  fish   wearlaw completions fish > ~/.config/fish/completions/wearlaw.fish";

const MEASURING: &str = "\
How it measures:
  Inputs are ordinary points within the bounds that a law declares; every field it declares differs from point to point.
  Each law is called in this process and in one of its own, on one thread and on several, in turns; the table shows the
  least wall time of a call and, in brackets, the median.
  The bandwidth is that of a triad (a = b + s c) that moves as many bytes on as many threads, in turns with the law. Arrays
  that fit a large cache are measured against that cache: --points 20000000 goes past it.
  The accuracy is the largest difference to expected.csv in units of the last place, and its row.

Ends with 0 if every law was measured, 2 if a file is no law, 3 if a law failed; the others are measured then.";

/// Every key of a scene and every column of a history: the page beside the scenes.
const SCENES: &str = include_str!("../../scenes/README.md");
const LONG_HELP: &str = "\
First steps:
  wearlaw new my-law --lang c     a wear law of your own, with the three commands to type next
  wearlaw inspect archard         what a wear law says of itself
  wearlaw run SCENE               run a scene; `wearlaw plan SCENE` shows beforehand what it does

Exit codes:
    0  done
    1  the thing checked falls short: a check failed, or the error is above the scene's bar
    2  the input is wrong: arguments, scene, input deck, sources, or a file that is no law
    3  the law failed: a bad status, a crash, a hang, a broken contract
    4  the numbers failed: a tolerance that cannot be met, or explicit steps beyond their
       stability limit
    5  reading or writing failed
   70  a fault of wearlaw itself
  130  interrupted; what was done so far is written

Environment:
  CC, CXX, FC, CARGO              the compilers of `build`
  CFLAGS, CXXFLAGS, FFLAGS        further flags for them
  NO_COLOR                        no colors";

/// Prints what the parser has to say: help and version on standard output, a mistake like any other error.
pub(super) fn refuse(error: &clap::Error, arguments: &[OsString]) -> ExitCode {
    let json = arguments.iter().take_while(|word| *word != "--").any(|word| word == "--json");
    let asked_for = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    if asked_for || !json {
        // A closed pipe behind the help is nobody's fault.
        let _ = error.print();
        return if asked_for { ExitCode::Done } else { ExitCode::InputWrong };
    }
    let text = error.render().to_string();
    let sentence: Vec<&str> = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let sentence = sentence.join(" ");
    let code = ExitCode::InputWrong;
    let document = serde_json::json!({
        "error": { "kind": code.word(), "message": printable(sentence.trim_start_matches("error: ")) },
        "exit_code": code.number(),
    });
    super::Console::new(true, false).document(&document).map_or(ExitCode::ReadWriteFailed, |()| code)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_parser_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn the_help_lists_every_exit_code() {
        for code in ExitCode::ALL {
            let line = format!("{:5}  ", code.number());
            assert!(LONG_HELP.lines().any(|found| found.starts_with(&line)), "{line}");
            let word = code.meaning().split(':').next().unwrap();
            assert!(LONG_HELP.contains(word.trim_end_matches(" of this program")), "{word}");
        }
    }
}
