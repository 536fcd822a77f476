//! The search for the values, and what is known of them at its end.

use std::path::Path;

use rmpfit::{MPConfig, MPError, MPFitter, MPMaxFev, MPPar, MPResult, MPSide};

use super::data::{Data, Noise};
use super::model::{Model, Varied};
use super::{FitError, statistics};
use crate::law::Evaluator;
use crate::record::{FitParameter, FitPoint, FitRecord};
use crate::scene::Override;

/// Step of the differences that derivatives are made of, of a logarithm or of the value's own size: large beside the jitter
/// that a run to a tolerance has.
const STEP: f64 = 1e-2;
/// Rounds of the search.
const ROUNDS: usize = 60;

/// What is asked of a fit.
#[derive(Debug, Clone)]
pub struct Asked {
    /// Constants of the law by name, or keys of the scene that hold a number.
    pub vary: Vec<String>,
    /// How measurements scatter, where the file does not say.
    pub noise: Noise,
}

/// How a value is searched for: positive ones by their logarithm, others by their distance from the start.
#[derive(Clone, Copy)]
enum Scale {
    Log,
    Linear { start: f64, size: f64 },
}

impl Scale {
    fn of(one: &Varied) -> Scale {
        match one.start {
            start if start > 0.0 => Scale::Log,
            0.0 => Scale::Linear { start: 0.0, size: 1.0 },
            start => Scale::Linear { start, size: start.abs() },
        }
    }

    fn value(self, at: f64) -> f64 {
        match self {
            Scale::Log => at.exp(),
            Scale::Linear { start, size } => start + size * at,
        }
    }

    fn begin(self, one: &Varied) -> f64 {
        if let Scale::Log = self { one.start.ln() } else { 0.0 }
    }
}

struct Search<'m, 'a> {
    model: &'m Model<'a>,
    scales: Vec<Scale>,
    limits: Vec<MPPar>,
    config: MPConfig,
    runs: usize,
    tell: &'m mut dyn FnMut(usize),
    /// Why a run failed, the last that did.
    trouble: Option<FitError>,
}

impl Search<'_, '_> {
    fn values(&self, at: &[f64]) -> Vec<f64> {
        self.scales.iter().zip(at).map(|(scale, at)| scale.value(*at)).collect()
    }

    /// Measured less answered, over the standard deviation.
    fn deviates(&mut self, at: &[f64]) -> Result<Vec<f64>, FitError> {
        self.runs += 1;
        (self.tell)(self.runs);
        let answers = self.model.answers(&self.values(at))?;
        let points = self.model.data.points.iter().zip(answers);
        Ok(points.map(|(point, answer)| (point.measured - answer) / point.sigma).collect())
    }

    /// Derivatives of the deviates, by differences on both sides.
    fn derivatives(&mut self, at: &[f64]) -> Result<Vec<Vec<f64>>, FitError> {
        let mut columns = Vec::new();
        for index in 0..at.len() {
            let moved = |by: f64| {
                at.iter().enumerate().map(|(i, at)| if i == index { at + by } else { *at }).collect::<Vec<_>>()
            };
            let (above, below) = (self.deviates(&moved(STEP))?, self.deviates(&moved(-STEP))?);
            columns.push(above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * STEP)).collect::<Vec<f64>>());
        }
        let rows = self.model.data.points.len();
        Ok((0..rows).map(|row| columns.iter().map(|column| column[row]).collect()).collect())
    }
}

impl MPFitter for Search<'_, '_> {
    fn eval(&mut self, at: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        match self.deviates(at) {
            Ok(found) => {
                deviates.copy_from_slice(&found);
                Ok(())
            }
            Err(FitError::Run { values, reason }) if self.runs > 1 => {
                // A trial too far: the search takes a shorter step.
                self.trouble = Some(FitError::Run { values, reason });
                deviates.fill(1e10);
                Ok(())
            }
            Err(error) => {
                self.trouble = Some(error);
                Err(MPError::Eval)
            }
        }
    }

    fn number_of_points(&self) -> usize {
        self.model.data.points.len()
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.limits
    }
}

/// Searches for the values with which the scene comes nearest to the measurements.
///
/// The least squares of the deviations over their standard deviations, by Levenberg and Marquardt's method (More, 1978, as in
/// MINPACK). Confidence is that of the linearised model, 95 %, by Student's t; the scatter is taken from the residuals unless the
/// file gives standard deviations.
///
/// # Errors
/// See [`FitError`].
pub fn fit(
    file: &Path,
    own: &[Override],
    law: &dyn Evaluator,
    data: &Data,
    asked: &Asked,
    tell: &mut dyn FnMut(usize),
    goes_on: &(dyn Fn() -> bool + Sync),
) -> Result<FitRecord, FitError> {
    let (points, parameters) = (data.points.len(), asked.vary.len());
    if points <= parameters || parameters == 0 {
        let expected = format!("more than there are values to find: at least {}", parameters.max(1) + 1);
        return Err(FitError::Data {
            path: data.path.clone(),
            line: None,
            found: format!("{points} measurements"),
            expected,
        });
    }
    let model = Model::new(file, own, law, data, &asked.vary, goes_on)?;
    let scales: Vec<Scale> = model.varied.iter().map(Scale::of).collect();
    let limits: Vec<MPPar> = model.varied.iter().zip(&scales).map(|(one, scale)| limits(one, *scale, law)).collect();
    let mut config = MPConfig::new();
    config.ftol = 1e-10;
    config.xtol = 1e-8;
    config.max_iter = ROUNDS;
    config.max_fev = MPMaxFev::Limited(ROUNDS * (2 * parameters + 2));
    let mut at: Vec<f64> = model.varied.iter().zip(&scales).map(|(one, scale)| scale.begin(one)).collect();
    let mut search = Search { model: &model, scales, limits, config, runs: 0, tell, trouble: None };
    if let Err(error) = search.mpfit(&mut at) {
        return Err(search.trouble.take().unwrap_or_else(|| FitError::Search(error.to_string())));
    }
    let (derivatives, deviates) = (search.derivatives(&at)?, search.deviates(&at)?);
    let known = statistics::known(&derivatives, parameters);
    let freedom = points - (parameters - known.flat.len());
    let squares: f64 = deviates.iter().map(|one| one * one).sum();
    let variance = if data.has_sigma { 1.0 } else { squares / freedom as f64 };
    let t = if data.has_sigma { 1.959_963_984_540_054 } else { statistics::student(freedom) };
    let names: Vec<&str> = model.varied.iter().map(|one| one.name.as_str()).collect();
    let logs: Vec<bool> = search.scales.iter().map(|scale| matches!(scale, Scale::Log)).collect();
    let values = search.values(&at);
    let found = (0..parameters).map(|index| {
        let is_flat =
            known.flat.iter().any(|flat| flat[index].abs() > 1e-6 * flat.iter().fold(0.0, |a: f64, b| a.max(b.abs())));
        let error = (variance * known.covariance[index][index]).sqrt();
        let end = |times: f64| search.scales[index].value(at[index] + times * error);
        FitParameter {
            name: model.varied[index].name.clone(),
            key: model.varied[index].key.clone(),
            start: model.varied[index].start,
            value: values[index],
            interval: (!is_flat).then(|| [end(-t), end(t)]),
        }
    });
    let correlation = |a: usize, b: usize| {
        let c = &known.covariance;
        let size = (c[a][a] * c[b][b]).sqrt();
        if size > 0.0 { c[a][b] / size } else { 0.0 }
    };
    let undetermined = known.flat.iter().map(|flat| {
        words(flat, &names, &logs, &values, |pair| {
            let [a, b] = pair;
            let c = &known.covariance;
            t * (variance * (c[a][a] + c[b][b] - 2.0 * c[a][b]).max(0.0)).sqrt()
        })
    });
    let fitted = data.points.iter().zip(&deviates).map(|(point, deviate)| FitPoint {
        at: point.at,
        measured: point.measured,
        fitted: point.measured - deviate * point.sigma,
        sigma: if data.has_sigma { point.sigma } else { point.sigma * variance.sqrt() },
    });
    Ok(FitRecord {
        scene: file.display().to_string(),
        law: law.descriptor().name.clone(),
        data: data.path.display().to_string(),
        across: data.across.name().to_owned(),
        quantity: data.quantity.name().to_owned(),
        relative: asked.noise == Noise::Relative && !data.has_sigma,
        parameters: found.collect(),
        correlation: (0..parameters).map(|a| (0..parameters).map(|b| correlation(a, b)).collect()).collect(),
        undetermined: undetermined.collect(),
        points: fitted.collect(),
        scatter: variance.sqrt(),
        reduced_chi_squared: data.has_sigma.then_some(squares / freedom as f64),
        freedom,
        runs: search.runs,
    })
}

/// Where a value may be searched for: within the bounds of the law's constant.
fn limits(one: &Varied, scale: Scale, law: &dyn Evaluator) -> MPPar {
    let mut own = MPPar::new();
    own.step = STEP;
    own.side = MPSide::Both;
    let constant = law.descriptor().constants.iter().find(|constant| constant.name == one.name);
    let (low, high) =
        constant.map_or((f64::NEG_INFINITY, f64::INFINITY), |constant| (constant.minimum, constant.maximum));
    let inside = |bound: f64| match scale {
        Scale::Log => (bound > 0.0).then(|| bound.ln()),
        Scale::Linear { start, size } => Some((bound - start) / size),
    };
    if let Some(low) = Some(low).filter(|low| low.is_finite()).and_then(inside) {
        (own.limited_low, own.limit_low) = (true, low + 2.0 * STEP);
    }
    if let Some(high) = Some(high).filter(|high| high.is_finite()).and_then(inside) {
        (own.limited_up, own.limit_up) = (true, high - 2.0 * STEP);
    }
    own
}

/// What a flat direction means: which values the data cannot tell apart, and what of them they know.
fn words(flat: &[f64], names: &[&str], logs: &[bool], values: &[f64], within: impl Fn([usize; 2]) -> f64) -> String {
    let size = flat.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let moving: Vec<usize> = (0..flat.len()).filter(|index| flat[*index].abs() > 1e-3 * size).collect();
    match moving[..] {
        [only] => format!("`{}` has no effect on what was measured: it cannot be known", names[only]),
        [a, b] if logs[a] && logs[b] && (flat[a] / flat[b] - 1.0).abs() < 1e-2 => {
            let ratio = values[a] / values[b];
            let within = within([a, b]);
            format!(
                "`{}` and `{}` cannot be told apart: only {} / {} is known, {:.4e} ({:.4e} to {:.4e} with 95 % confidence)",
                names[a],
                names[b],
                names[a],
                names[b],
                ratio,
                ratio * (-within).exp(),
                ratio * within.exp()
            )
        }
        _ => {
            let per = |index: usize| {
                let by = flat[index] / size;
                match logs[index] {
                    true => format!("`{}` by {:+.3} %", names[index], by),
                    false => format!("`{}` by {:+.3e}", names[index], by * 0.01),
                }
            };
            let each: Vec<String> = moving.iter().map(|index| per(*index)).collect();
            format!(
                "moving {} together changes nothing that was measured: they cannot be told apart",
                each.join(" and ")
            )
        }
    }
}
