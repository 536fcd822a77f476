//! What `wearlaw shim` is asked for.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

#[derive(Debug, Clone, Args)]
pub(super) struct ShimArguments {
    /// The subroutine that the solver calls
    #[arg(value_enum, value_name = "FORM")]
    pub(super) form: ShimForm,
    /// The law's library, LIB#LAW for one of several, or the name of a law in this program
    #[arg(value_name = "LIB")]
    pub(super) library: String,
    /// Constants of the law in the solver's units, for a form that is given none: K=1e-4,H=2e3
    #[arg(long, value_name = "NAME=VALUE", value_delimiter = ',')]
    pub(super) constants: Vec<String>,
    /// The solver's units
    #[arg(long, value_enum, value_name = "UNITS")]
    pub(super) units: Option<ShimUnits>,
    /// The file to write [default: the form's name with .f90, here]
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

/// Forms of user subroutines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ShimForm {
    /// Moves nodes of an adaptive mesh: reads pressure and slip, answers the mesh's velocity
    Umeshmotion,
    /// Answers the rate of wear of a node in contact
    Uwearindex,
}

/// Consistent units that solvers are fed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(super) enum ShimUnits {
    /// Metre, kilogram, second: pascal
    #[default]
    Si,
    /// Millimetre, tonne, second: newton and megapascal
    MmTS,
}

impl ShimUnits {
    /// Units of length, mass and time.
    pub(super) fn in_si(self) -> [f64; 3] {
        match self {
            ShimUnits::Si => [1.0, 1.0, 1.0],
            ShimUnits::MmTS => [1e-3, 1e3, 1.0],
        }
    }
}

pub(super) const SHIMS: &str = "\
The file holds all that is needed but the library wearlaw_host, which `cargo build --release -p wearlaw-host` makes in a
checkout. A node remembers the law's state at the start of its increment: called again for the same increment, after a cut-back
or in another sweep of the mesh, it starts from there. Wear goes along the normal. The book has the table of arguments and what
cannot be mapped.

Examples:
  wearlaw shim uwearindex ./libwear.so -o uwearindex.f90
  wearlaw shim umeshmotion archard --constants K=1e-4,H=2e3 --units mm-t-s";
