//! Measurements: depth or volume over distance, time or cycles, or a profile of the wear at the end.

use std::path::{Path, PathBuf};

use super::FitError;

/// How far measurements scatter, where the file does not say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Noise {
    /// In proportion to what is measured.
    Relative,
    /// By the same amount everywhere.
    Absolute,
}

/// What measurements are taken over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Across {
    Distance,
    Time,
    Cycles,
    /// Coordinates of the surface, at the end.
    Place,
}

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    Depth,
    Volume,
    Profile,
}

/// One measurement.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Point {
    /// Distance, time, cycles or x.
    pub(super) at: f64,
    pub(super) measured: f64,
    /// Its standard deviation, or what stands for it.
    pub(super) sigma: f64,
}

/// Measurements.
#[derive(Debug, Clone, PartialEq)]
pub struct Data {
    pub(super) path: PathBuf,
    pub(super) across: Across,
    pub(super) quantity: Quantity,
    pub(super) points: Vec<Point>,
    /// Whether the file gives standard deviations.
    pub(super) has_sigma: bool,
}

/// The names of columns: those of `history.csv`, and short ones.
const ACROSS: [(&str, Across); 6] = [
    ("sliding_distance", Across::Distance),
    ("distance", Across::Distance),
    ("time", Across::Time),
    ("cycle", Across::Cycles),
    ("cycles", Across::Cycles),
    ("x", Across::Place),
];
const QUANTITIES: [(&str, Quantity); 5] = [
    ("max_wear_depth", Quantity::Depth),
    ("depth", Quantity::Depth),
    ("wear_volume", Quantity::Volume),
    ("volume", Quantity::Volume),
    ("wear", Quantity::Profile),
];
const EXPECTED: &str =
    "a column distance, time or cycle with one of depth or volume, or x with wear; and sigma, if it is known";

impl Data {
    /// Reads a CSV file with a header. Empty cells are gaps; lines of `#` are skipped.
    ///
    /// # Errors
    /// `Read`, `Data` with the line.
    pub fn read(path: &Path, noise: Noise) -> Result<Data, FitError> {
        let reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_path(path);
        let mut reader = reader.map_err(|source| FitError::Read { path: path.into(), source })?;
        let wrong = |line: Option<u64>, found: String, expected: &str| FitError::Data {
            path: path.into(),
            line,
            found,
            expected: expected.to_owned(),
        };
        let header = reader.headers().map_err(|source| FitError::Read { path: path.into(), source })?.clone();
        let names: Vec<String> = header.iter().map(str::to_lowercase).collect();
        let of = |wanted: &str| names.iter().position(|name| name == wanted);
        let all = || format!("the columns {}", if names.is_empty() { "none".to_owned() } else { names.join(", ") });
        let known = |name: &String| {
            ACROSS.iter().any(|(known, _)| known == name)
                || QUANTITIES.iter().any(|(known, _)| known == name)
                || name == "sigma"
        };
        if let Some(name) = names.iter().find(|name| !known(name)) {
            return Err(wrong(Some(1), format!("the column `{name}`"), EXPECTED));
        }
        let over = ACROSS.iter().find_map(|(name, across)| Some((of(name)?, *across)));
        let quantities: Vec<(usize, Quantity)> =
            QUANTITIES.iter().filter_map(|(name, quantity)| Some((of(name)?, *quantity))).collect();
        let (Some((x, across)), [(value, quantity)]) = (over, &quantities[..]) else {
            return Err(wrong(Some(1), all(), EXPECTED));
        };
        if (across == Across::Place) != (*quantity == Quantity::Profile) {
            return Err(wrong(Some(1), all(), EXPECTED));
        }
        let sigma = of("sigma");
        let mut points: Vec<Point> = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|source| FitError::Read { path: path.into(), source })?;
            let line = record.position().map(csv::Position::line);
            let cell = |column: usize| record.get(column).unwrap_or_default();
            let number = |column: usize| {
                let text = cell(column);
                let found: Option<f64> = text.parse().ok();
                found.filter(|found| found.is_finite()).ok_or_else(|| {
                    wrong(
                        line,
                        format!("`{text}` in column `{}`", names[column]),
                        "a finite number, or an empty cell for a gap",
                    )
                })
            };
            if cell(x).is_empty() || cell(*value).is_empty() {
                continue;
            }
            let (at, measured) = (number(x)?, number(*value)?);
            if measured < 0.0 {
                return Err(wrong(
                    line,
                    format!("{} in column `{}`", cell(*value), names[*value]),
                    "wear of 0 or more: depths count into the worn body",
                ));
            }
            if across != Across::Place && at < 0.0 {
                return Err(wrong(line, format!("{} in column `{}`", cell(x), names[x]), "0 or more"));
            }
            let sigma = match sigma {
                Some(column) => number(column)?,
                None if noise == Noise::Absolute => 1.0,
                // Nothing scatters in proportion to nothing: the start says nothing then.
                None if measured == 0.0 => continue,
                None => measured,
            };
            if sigma <= 0.0 {
                return Err(wrong(line, format!("a sigma of {sigma}"), "one above 0"));
            }
            points.push(Point { at, measured, sigma });
        }
        points.sort_by(|a, b| a.at.total_cmp(&b.at));
        Ok(Data { path: path.into(), across, quantity: *quantity, points, has_sigma: sigma.is_some() })
    }
}

impl Across {
    pub(super) fn name(self) -> &'static str {
        match self {
            Across::Distance => "sliding distance",
            Across::Time => "time",
            Across::Cycles => "cycle",
            Across::Place => "x",
        }
    }
}

impl Quantity {
    pub(super) fn name(self) -> &'static str {
        match self {
            Quantity::Depth => "wear depth",
            Quantity::Volume => "worn volume",
            Quantity::Profile => "wear",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, noise: Noise) -> Result<Data, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m.csv");
        std::fs::write(&path, text).unwrap();
        Data::read(&path, noise).map_err(|error| error.to_string().replace(&path.display().to_string(), "m.csv"))
    }

    #[test]
    fn gaps_and_the_start_are_left_out_and_the_rest_is_in_order() {
        let data = read("# by hand\ndistance, depth\n2, 3e-6\n\n0, 0\n1, 2e-6\n3,\n", Noise::Relative).unwrap();
        assert_eq!((data.across, data.quantity, data.has_sigma), (Across::Distance, Quantity::Depth, false));
        let found: Vec<(f64, f64, f64)> =
            data.points.iter().map(|point| (point.at, point.measured, point.sigma)).collect();
        assert_eq!(found, [(1.0, 2e-6, 2e-6), (2.0, 3e-6, 3e-6)]);
        assert_eq!(read("time,volume\n0,0\n1,2\n", Noise::Absolute).unwrap().points.len(), 2);
        let with = read("x,wear,sigma\n-1,2,0.5\n", Noise::Relative).unwrap();
        assert!(with.has_sigma && with.points[0].sigma == 0.5 && with.points[0].at == -1.0);
    }

    #[test]
    fn what_is_no_measurement_is_told_with_its_line() {
        for (text, expected) in [
            ("distance,depth\n1,-2e-6\n", "m.csv:2: found -2e-6 in column `depth`"),
            ("distance,depth\n1,2e-6\n-1,2e-6\n", "m.csv:3: found -1 in column `distance`"),
            ("distance,depth\n1,nan\n", "m.csv:2: found `nan` in column `depth`"),
            ("distance,depth\n1,2 um\n", "m.csv:2: found `2 um` in column `depth`"),
            ("distance,hardness\n1,2\n", "m.csv:1: found the column `hardness`"),
            ("distance,depth,volume\n1,2,3\n", "m.csv:1: found the columns distance, depth, volume"),
            ("x,depth\n1,2\n", "m.csv:1: found the columns x, depth"),
            ("depth\n1\n", "m.csv:1: found the columns depth"),
            ("distance,depth,sigma\n1,2,0\n", "m.csv:2: found a sigma of 0"),
            ("distance,depth\n1,2,3\n", "m.csv"),
        ] {
            let said = read(text, Noise::Relative).unwrap_err();
            assert!(said.starts_with(expected), "{said}");
        }
    }
}
