//! The arguments of `wearlaw study`, with their help.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};

use super::args::SceneArguments;

#[derive(Debug, Clone, Args)]
pub(super) struct StudyArguments {
    /// The scene file (TOML)
    pub(super) scene: PathBuf,
    #[command(flatten)]
    pub(super) shared: SceneArguments,
    /// Wall time that the study may take, such as 90s, 5m or 1h [default: 60s]
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(super) budget: Option<Duration>,
    /// Folder for the results [default: the scene's name with .study, here]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Also write study.html: verdict, picture, all cases and provenance in one file that needs nothing else
    #[arg(long)]
    pub(super) html: bool,
    /// Only these parts of the study
    #[arg(long, value_name = "PART", value_enum, value_delimiter = ',')]
    pub(super) only: Vec<StudyPart>,
    /// Only these integrators
    #[arg(long, value_name = "NAME", value_enum, value_delimiter = ',')]
    pub(super) methods: Vec<StudyMethod>,
    /// Fixed substeps per load step to try [default: doubled; explicit ones around their limit]
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub(super) substeps: Vec<u64>,
    /// Tolerances to try [default: 1e-1, 1e-2, ..]
    #[arg(long, value_name = "TOLERANCE", value_delimiter = ',', value_parser = part)]
    pub(super) tolerances: Vec<f64>,
    /// Safety factors C1 of the scaling to try [default: 0.5 to 0.01]
    #[arg(long, value_name = "C1", value_delimiter = ',', value_parser = part)]
    pub(super) safety: Vec<f64>,
    /// Cells of the grid along its first side to try [default: a quarter, half and all of the scene's]
    #[arg(long, value_name = "CELLS", value_delimiter = ',', value_parser = clap::value_parser!(u64).range(2..=65_536))]
    pub(super) grids: Vec<u64>,
    /// What the runs are compared with
    #[arg(long, value_enum, default_value_t = StudyReference::Scene)]
    pub(super) reference: StudyReference,
    /// Most timed runs of a case; those that fit are repeated after one to warm up
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(super) runs: u32,
    /// The clock of the picture, the front and the verdict
    #[arg(long, value_enum, default_value_t = StudyClock::Wall)]
    pub(super) clock: StudyClock,
    /// Number of threads of each run
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: u16,
}

/// The parts of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum StudyPart {
    Substeps,
    Tolerances,
    Scaling,
    Grids,
    Isolation,
}

/// The integrators of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum StudyMethod {
    Auto,
    ExplicitEuler,
    ImplicitEuler,
    #[value(name = "tr-bdf2")]
    TrBdf2,
    Sdirk2,
}

/// The clocks of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum StudyClock {
    /// Wall time
    Wall,
    /// Processor time of this process, which tells more where other work shares the machine
    Processor,
}

/// What the runs of a study are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum StudyReference {
    /// The scene's exact answer where it is one for the points themselves, else a self-converged run
    Scene,
    /// A self-converged run, whatever the scene says
    #[value(name = "self")]
    SelfConverged,
}

/// A time with its unit, seconds without: `90s`, `5m`, `1.5h`, `500ms`.
fn time(text: &str) -> Result<Duration, String> {
    let wrong = || "expected a time above 0 with its unit, such as 90s, 5m or 1h".to_owned();
    let units = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("min", 60.0), ("h", 3600.0)];
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = &text[digits.len()..];
    let size = match unit {
        "" => 1.0,
        _ => units.iter().find(|(name, _)| *name == unit).map(|(_, size)| *size).ok_or_else(wrong)?,
    };
    let number: f64 = digits.trim().parse().map_err(|_| wrong())?;
    Duration::try_from_secs_f64(number * size).ok().filter(|time| !time.is_zero()).ok_or_else(wrong)
}

/// A number between 0 and 1.
fn part(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.trim().parse().ok();
    number.filter(|number| *number > 0.0 && *number < 1.0).ok_or_else(|| "expected a number between 0 and 1".to_owned())
}

/// What `study --help` explains.
pub(super) const STUDYING: &str = "\
What is compared:
  The wear profile (L2 and largest), the contact pressure (L2), worn volume, depth at the apex and radius of the scar, with
  the scene's exact answer where it is one for the points themselves (archard-prescribed, winkler-discrete, winkler-point,
  mode-decay) or, for a prescribed scene, its file; else with the same scene to a much smaller tolerance, whose own error is
  estimated, stated and meant to be rather too large. An error below three times that is marked ~. What a grid is off by is
  told apart: against the exact answer of the continuum where the scene names one, and from a grid of half the cells.

What is timed:
  Each case after a run to warm up, least wall and processor time of up to --runs runs; a case that takes more than a
  fortieth of the budget in two runs runs once, and its time is marked '. Explicit steps share the contact solver, its start
  from the step before and its tolerance with all others, and what measuring their limit takes is taken off. Those beyond the limit are run, marked and counted out.

Examples:
  wearlaw study ball_on_flat.toml --budget 2m
  wearlaw study ball_on_flat.toml --set grid.cells=[128,128] --only substeps --methods tr-bdf2,explicit-euler";
