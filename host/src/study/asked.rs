//! What a study is asked for.

use std::time::Duration;

use crate::record::Clock;
use crate::scene::Method;

/// A part of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Integrators in fixed substeps.
    Substeps,
    /// Integrators to a tolerance.
    Tolerances,
    /// Scaled substeps (AUTS) and cycles (CBCS).
    Scaling,
    /// Grids.
    Grids,
    /// The law in a process of its own.
    Isolation,
}

/// What runs are compared with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compare {
    /// The scene's reference where it is one for the points themselves, else a self-converged run.
    #[default]
    Scene,
    /// A self-converged run, whatever the scene says.
    SelfConverged,
}

/// What a study is asked for; empty lists stand for what suits the scene.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Wall time that it may take.
    pub budget: Duration,
    /// Threads of each run; 0: as many as the machine has.
    pub threads: usize,
    /// Most timed runs of a case, at least 1.
    pub runs: u32,
    /// Its parts; empty: all.
    pub parts: Vec<Part>,
    /// The integrators.
    pub methods: Vec<Method>,
    /// Substeps per load step.
    pub substeps: Vec<u64>,
    /// Tolerances.
    pub tolerances: Vec<f64>,
    /// Safety factors C1.
    pub safety: Vec<f64>,
    /// Cells of the grid along its first side.
    pub grids: Vec<u64>,
    /// What runs are compared with.
    pub compare: Compare,
    /// The clock of the picture, the front and the verdict.
    pub clock: Clock,
}

impl Asked {
    /// Wall time of a study, where nobody says.
    pub const BUDGET: Duration = Duration::from_secs(60);
    /// Most timed runs of a case, where nobody says.
    pub const RUNS: u32 = 5;

    /// Whether a part is wanted.
    #[must_use]
    pub fn wants(&self, part: Part) -> bool {
        self.parts.is_empty() || self.parts.contains(&part)
    }
}

impl Default for Asked {
    fn default() -> Self {
        Self {
            budget: Self::BUDGET,
            threads: 1,
            runs: Self::RUNS,
            parts: Vec::new(),
            methods: Vec::new(),
            substeps: Vec::new(),
            tolerances: Vec::new(),
            safety: Vec::new(),
            grids: Vec::new(),
            compare: Compare::Scene,
            clock: Clock::Wall,
        }
    }
}

/// A method as a scene names it.
pub(super) fn name(method: Method) -> &'static str {
    match method {
        Method::Auto => "auto",
        Method::ExplicitEuler => "explicit-euler",
        Method::ImplicitEuler => "implicit-euler",
        Method::TrBdf2 => "tr-bdf2",
        Method::Sdirk2 => "sdirk2",
    }
}
