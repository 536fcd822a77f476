//! What a fit found.

use serde::Serialize;

/// A value that was searched for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitParameter {
    /// As the user named it.
    pub name: String,
    /// Its key in the scene.
    pub key: String,
    /// Where the search began.
    pub start: f64,
    /// What was found.
    pub value: f64,
    /// Interval of 95 % confidence; `None` where the data cannot know the value by itself.
    pub interval: Option<[f64; 2]>,
}

/// A measurement and what the fitted scene says there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitPoint {
    /// Where or when it was measured.
    pub at: f64,
    /// What was measured.
    pub measured: f64,
    /// What the scene says.
    pub fitted: f64,
    /// Standard deviation: as the file gives it, else as the residuals have it.
    pub sigma: f64,
}

/// Everything a fit found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FitRecord {
    /// The scene's file.
    pub scene: String,
    /// Name of the law.
    pub law: String,
    /// The file of the measurements.
    pub data: String,
    /// What they are over: `sliding distance`, `time`, `cycle` or `x`.
    pub across: String,
    /// What was measured: `wear depth`, `worn volume` or `wear`.
    pub quantity: String,
    /// Whether measurements are taken to scatter in proportion to what is measured.
    pub relative: bool,
    /// The values.
    pub parameters: Vec<FitParameter>,
    /// Correlations of the values (of the logarithms of positive ones) `[parameters][parameters]`.
    pub correlation: Vec<Vec<f64>>,
    /// What the data cannot tell apart, a sentence each.
    pub undetermined: Vec<String>,
    /// The measurements.
    pub points: Vec<FitPoint>,
    /// Standard deviation of the residuals, over what stands for that of a measurement: of relative scatter a part of 1.
    pub scatter: f64,
    /// Squares of the deviations over the file's standard deviations, per degree of freedom; about 1 where they are right.
    pub reduced_chi_squared: Option<f64>,
    /// Measurements less the values that they know.
    pub freedom: usize,
    /// Runs of the scene.
    pub runs: usize,
}
