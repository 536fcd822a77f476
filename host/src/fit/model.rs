//! The scene at trial values of what is varied, and what it says where something was measured.

use std::path::Path;

use super::FitError;
use super::data::{Across, Data, Quantity};
use crate::law::{Evaluator, LawDescriptor};
use crate::plan::Plan;
use crate::record::{End, Event, History, Observer, Record, Wish};
use crate::scene::{Accuracy, Override, Scene};
use crate::solve::{Run, SolveError};

/// Runs are at least so exact, so that their own errors are small beside those of measurements.
const TOLERANCE: f64 = 1e-5;

/// One number of the scene that is varied.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Varied {
    /// As the user named it.
    pub(super) name: String,
    /// Its key.
    pub(super) key: String,
    pub(super) start: f64,
}

/// The scene, run at trial values.
pub(super) struct Model<'a> {
    pub(super) file: &'a Path,
    pub(super) own: &'a [Override],
    pub(super) law: &'a dyn Evaluator,
    pub(super) data: &'a Data,
    pub(super) varied: Vec<Varied>,
    pub(super) goes_on: &'a (dyn Fn() -> bool + Sync),
    /// Beside the values: how exact, and when there are rows.
    more: Vec<String>,
    /// Times of the measurements; empty for a profile.
    times: Vec<f64>,
}

/// What the run of a fit hears: nothing but that it is to end.
struct Watch<'a>(&'a (dyn Fn() -> bool + Sync));

impl Observer for Watch<'_> {
    fn observe(&mut self, _: Event<'_>) -> Wish {
        if (self.0)() { Wish::GoOn } else { Wish::Stop }
    }
}

impl<'a> Model<'a> {
    /// Finds what is varied, and runs the scene once to learn when the measurements were taken.
    pub(super) fn new(
        file: &'a Path,
        own: &'a [Override],
        law: &'a dyn Evaluator,
        data: &'a Data,
        names: &[String],
        goes_on: &'a (dyn Fn() -> bool + Sync),
    ) -> Result<Model<'a>, FitError> {
        let scene = Scene::read(file, own)?;
        let document = serde_json::to_value(&scene).unwrap_or_default();
        let mut varied: Vec<Varied> = Vec::new();
        for name in names {
            let one = varied_of(name, &document, law.descriptor())?;
            if varied.iter().any(|other| other.key == one.key) {
                let (found, expected) = ("it twice".to_owned(), "each once".to_owned());
                return Err(FitError::Vary { name: name.clone(), found, expected });
            }
            varied.push(one);
        }
        let mut more = vec!["output.fields=[]".to_owned()];
        if let Accuracy::Tolerance(own) = scene.integrator.accuracy
            && own > TOLERANCE
        {
            more.push(format!("integrator.tolerance={TOLERANCE:e}"));
        }
        let mut model = Model { file, own, law, data, varied, goes_on, more, times: Vec::new() };
        if data.across != Across::Place {
            let start: Vec<f64> = model.varied.iter().map(|one| one.start).collect();
            let record = model.run(&start).map_err(|reason| model.failed(&start, reason))?;
            model.times = times(&record.history, data)?;
            let listed: Vec<String> = model.times.iter().map(|time| format!("{time:?}")).collect();
            model.more.push(format!("output.times=[{}]", listed.join(", ")));
        }
        Ok(model)
    }

    /// What the scene says where something was measured.
    pub(super) fn answers(&self, values: &[f64]) -> Result<Vec<f64>, FitError> {
        let record = self.run(values).map_err(|reason| self.failed(values, reason))?;
        if self.data.across == Across::Place {
            return profile(&record, self.data);
        }
        let (rows, close) = (&record.history.rows, record.history.rows.last().map_or(0.0, |row| 1e-9 * row.time));
        let each = self.data.points.iter().zip(&self.times).map(|(_, time)| {
            let at = rows.partition_point(|row| row.time < time - close);
            let row = rows.get(at).or(rows.last());
            let found = row.and_then(|row| match self.data.quantity {
                Quantity::Volume => row.wear_volume,
                _ => Some(row.max_wear_depth),
            });
            found.ok_or_else(|| {
                let expected = "a scene whose points have areas".to_owned();
                FitError::Data { path: self.data.path.clone(), line: None, found: "volumes".to_owned(), expected }
            })
        });
        each.collect()
    }

    fn run(&self, values: &[f64]) -> Result<Record<SolveError>, String> {
        let set = self.varied.iter().zip(values).map(|(one, value)| format!("{}={value:?}", one.key));
        let all = self
            .own
            .iter()
            .cloned()
            .chain(set.chain(self.more.iter().cloned()).map(|text| Override::from(text.as_str())));
        let scene = Scene::read(self.file, &all.collect::<Vec<_>>()).map_err(|error| error.to_string())?;
        let plan = Plan::new(&scene, self.law.descriptor()).map_err(|error| error.to_string())?;
        let run = Run::prepare(&plan, self.law).map_err(|error| error.to_string())?;
        let record = run.go(1, &mut Watch(self.goes_on));
        match &record.end {
            End::Done | End::Stopped(_) => Ok(record),
            End::Interrupted => Err(String::new()),
            End::Failed(error) => Err(error.to_string()),
        }
    }

    fn failed(&self, values: &[f64], reason: String) -> FitError {
        if !(self.goes_on)() {
            return FitError::Interrupted;
        }
        let values = self.varied.iter().zip(values).map(|(one, value)| format!("{} = {value:e}", one.name));
        FitError::Run { values: values.collect::<Vec<_>>().join(", "), reason }
    }
}

/// Finds the number that a name means, `K` or `contact.modulus`.
fn varied_of(name: &str, document: &serde_json::Value, law: &LawDescriptor) -> Result<Varied, FitError> {
    let of = |key: &str| {
        let mut parts = key.split('.');
        let found = parts.try_fold(document, |at, part| match at {
            serde_json::Value::Array(list) => list.get(part.parse::<usize>().ok()?),
            table => table.get(part),
        });
        found.and_then(serde_json::Value::as_f64)
    };
    let varied = |key: String, start: f64| Ok(Varied { name: name.to_owned(), key, start });
    if name.contains('.') {
        if let Some(start) = of(name) {
            return varied(name.to_owned(), start);
        }
        let expected = "a key of the scene that holds a number".to_owned();
        return Err(FitError::Vary { name: name.to_owned(), found: "no number under it".to_owned(), expected });
    }
    let Some(index) = law.constants.iter().position(|constant| constant.name == name) else {
        let known: Vec<&str> = law.constants.iter().map(|constant| constant.name.as_str()).collect();
        let expected =
            format!("a constant of the law ({}) or a key of the scene, such as contact.modulus", known.join(", "));
        return Err(FitError::Vary { name: name.to_owned(), found: "nothing of that name".to_owned(), expected });
    };
    for key in [format!("law.constants.{name}"), format!("law.constants.{index}")] {
        if let Some(start) = of(&key) {
            return varied(key, start);
        }
    }
    let by_name = document["law"]["constants"].is_object();
    match law.constants[index].default {
        Some(default) if by_name => varied(format!("law.constants.{name}"), default),
        _ => {
            let expected = "a number to start from under law.constants".to_owned();
            Err(FitError::Vary { name: name.to_owned(), found: "none in the scene".to_owned(), expected })
        }
    }
}

/// When the measurements were taken, by a run of the scene.
fn times(history: &History, data: &Data) -> Result<Vec<f64>, FitError> {
    let across = |index: usize| {
        let row = &history.rows[index];
        match data.across {
            Across::Distance => row.sliding_distance,
            Across::Cycles => row.cycle,
            _ => row.time,
        }
    };
    let count = history.rows.len();
    let end = if count == 0 { 0.0 } else { across(count - 1) };
    let mut times = Vec::new();
    for point in &data.points {
        if point.at > end * (1.0 + 1e-9) {
            return Err(FitError::Beyond { across: data.across.name(), at: point.at, end });
        }
        let (mut low, mut high) = (0, count.saturating_sub(1));
        while high - low > 1 {
            let middle = low.midpoint(high);
            if across(middle) <= point.at { low = middle } else { high = middle }
        }
        let (a, b) = (across(low), across(high));
        let part = if b > a { ((point.at - a) / (b - a)).clamp(0.0, 1.0) } else { 1.0 };
        let (from, to) = (history.rows[low].time, history.rows[high].time);
        times.push(from + part * (to - from));
    }
    // Two of one moment share a row.
    Ok(times)
}

/// The wear of the surface's line at the end, where it was measured.
fn profile(record: &Record<SolveError>, data: &Data) -> Result<Vec<f64>, FitError> {
    let wrong = |found: String, expected: &str| FitError::Data {
        path: data.path.clone(),
        line: None,
        found,
        expected: expected.to_owned(),
    };
    let line = record.profile.as_ref().filter(|line| line.axis == "x");
    let line = line.ok_or_else(|| wrong("a profile over x".to_owned(), "a scene whose points lie along x"))?;
    let (x, wear) = (&line.coordinate, &line.wear_end);
    let each = data.points.iter().map(|point| {
        let (first, last) = (x[0], x[x.len() - 1]);
        let room = 1e-9 * (last - first);
        if point.at < first - room || point.at > last + room {
            return Err(wrong(
                format!("x = {}", point.at),
                &format!("one on the scene's line, from {first} to {last}"),
            ));
        }
        let after = x.partition_point(|x| *x <= point.at).clamp(1, x.len() - 1);
        let part = ((point.at - x[after - 1]) / (x[after] - x[after - 1])).clamp(0.0, 1.0);
        Ok(wear[after - 1] + part * (wear[after] - wear[after - 1]))
    });
    each.collect()
}
