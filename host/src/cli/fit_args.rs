//! What `wearlaw fit` is asked for.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::args::SceneArguments;

#[derive(Debug, Clone, Args)]
pub(super) struct FitArguments {
    /// The scene file (TOML)
    pub(super) scene: PathBuf,
    #[command(flatten)]
    pub(super) shared: SceneArguments,
    /// Measurements (CSV): distance, time or cycle with depth or volume, or x with wear; and sigma, if it is known
    #[arg(long, value_name = "FILE")]
    pub(super) data: PathBuf,
    /// What is searched for: constants of the law by name, or keys of the scene, such as K,m or contact.modulus
    #[arg(long, value_name = "NAMES", value_delimiter = ',', required = true)]
    pub(super) vary: Vec<String>,
    /// How measurements scatter, where the file has no sigma
    #[arg(long, value_enum, default_value_t = FitNoise::Relative)]
    pub(super) noise: FitNoise,
    /// Folder for the results [default: the scene's name with .fit, here]
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
}

/// How measurements scatter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum FitNoise {
    /// In proportion to what is measured
    Relative,
    /// By the same amount everywhere
    Absolute,
}

pub(super) const FITTING: &str = "\
The scene is run at trial values until what it says of wear comes nearest to what was measured, in the least squares of the
deviations over the standard deviation of each. Empty cells are gaps. Intervals are of 95 % confidence; where the data cannot
tell two values apart, that is said, with what of them is known. The scene's own values are where the search begins.

Examples:
  wearlaw fit wear_test.toml --data measured.csv --vary K,m
  wearlaw fit wear_test.toml --data profile.csv --vary K,contact.modulus --noise absolute";
