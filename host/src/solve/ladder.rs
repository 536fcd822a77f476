//! What came of every integrator in steps of many lengths.

use serde::Serialize;

use crate::stability::judge::Seen;

/// What presses while steps are tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pressed {
    /// The load of that moment.
    #[default]
    Load,
    /// The approach of that moment.
    Approach,
}

impl Pressed {
    /// Its word in messages.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Pressed::Load => "load",
            Pressed::Approach => "approach",
        }
    }
}

/// The state that steps were tried from; in the scene's units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Moment {
    /// Represented time.
    pub time: f64,
    /// Load.
    pub load: f64,
    /// Approach.
    pub approach: f64,
    /// Sliding velocity.
    pub velocity: f64,
    /// Temperature.
    pub temperature: f64,
    /// Cells in contact.
    pub cells_in_contact: usize,
    /// Largest contact pressure.
    pub largest_pressure: f64,
    /// Mean contact pressure over the contact.
    pub mean_pressure: f64,
}

impl Moment {
    /// What a point in contact is under on average.
    #[must_use]
    pub fn ordinary(&self) -> Ordinary {
        let &Moment { mean_pressure: pressure, velocity, temperature, .. } = self;
        Ordinary { pressure, velocity: velocity.abs(), temperature }
    }
}

/// What a point of a scene is under that stands for its contact: the most loaded one of a prescribed scene, the mean of a
/// solved contact; in the scene's units, 0 where the scene gives nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ordinary {
    /// Contact pressure.
    pub pressure: f64,
    /// Sliding velocity.
    pub velocity: f64,
    /// Temperature.
    pub temperature: f64,
}

/// The stiffness under one control; times in the scene's unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Stiff {
    /// The control.
    pub control: Pressed,
    /// Largest rate at which unevenness decays; `None`: there is none.
    pub stiffness_per_s: Option<f64>,
    /// Largest stable explicit step.
    pub explicit_limit_s: Option<f64>,
    /// Points left out of the measure, because the law's derivative grows without bound at no pressure.
    pub points_left_out: usize,
    /// Why there is no stiffness.
    pub without: Option<String>,
}

/// What steps of one length came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// They were taken.
    Seen(Seen),
    /// They could not be taken.
    Failed(String),
    /// They were not tried, or led beyond the grid.
    NotTried(String),
}

impl Outcome {
    /// What is wrong, in words; `None`: positive, smooth and bounded, or not tried.
    #[must_use]
    pub fn trouble(&self) -> Option<String> {
        match self {
            Outcome::Seen(seen) => {
                let faults = seen.faults();
                let words = faults.iter().map(|fault| fault.words()).collect::<Vec<_>>().join(", ");
                (!faults.is_empty()).then_some(words)
            }
            Outcome::Failed(error) => Some(format!("failed ({error})")),
            Outcome::NotTried(_) => None,
        }
    }
}

/// One method in steps of one length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// What presses.
    pub control: Pressed,
    /// Whether nothing touches outside the cells that touched at the start, so that long steps under a load stay on the
    /// grid.
    pub held: bool,
    /// The method.
    pub method: String,
    /// Length of a step in units of 1 / stiffness: the explicit limit lies at 2.
    pub ratio: f64,
    /// Length of a step; the scene's time.
    pub step: f64,
    /// What came of it.
    pub outcome: Outcome,
}

/// The scene's own method.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OwnMethod {
    /// Its name in the rows.
    pub method: String,
    /// Whether it is fine.
    pub fine: bool,
    /// Why.
    pub words: String,
    /// What it does under the control that the scene does not have, if that is not fine.
    pub beside: Option<String>,
}

/// The whole ladder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ladder {
    /// The state it stands on.
    pub moment: Moment,
    /// What the scene gives.
    pub control: Pressed,
    /// The stiffness under both controls.
    pub stiff: Vec<Stiff>,
    /// Steps of each trial.
    pub steps: u32,
    /// Its rows.
    pub rows: Vec<Row>,
    /// The scene's own method.
    pub own: OwnMethod,
}

impl Ladder {
    /// The stiffness under the scene's own control.
    #[must_use]
    pub fn own_stiffness(&self) -> Option<&Stiff> {
        self.stiff.iter().find(|stiff| stiff.control == self.control)
    }

    /// The explicit limit under the scene's own control; `None`: there is none.
    #[must_use]
    pub fn limit(&self) -> Option<f64> {
        self.own_stiffness().and_then(|stiff| stiff.explicit_limit_s)
    }
}
