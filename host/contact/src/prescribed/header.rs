//! What a history holds, found without reading its values.

use super::{Column, HistoryError, Needs, csv_file, npz_file};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// How a file arranges its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// CSV text, a row per time and point.
    Csv,
    /// NPZ arrays of equal length, an element per time and point.
    NpzLong,
    /// NPZ arrays over times and points.
    NpzGrid,
}

/// How a history describes the relative motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Neither velocity nor slip.
    None,
    /// The column `velocity`.
    Velocity,
    /// The column `slip`.
    Slip,
    /// The column `slip_x`, with or without `slip_y` and `slip_z`.
    SlipVector,
}

/// Names, and numbers of times and points where they are known without reading the values.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The file.
    pub path: PathBuf,
    /// How it is arranged.
    pub layout: Layout,
    /// Column names in the order of the file, `time` and `point` included.
    pub names: Vec<String>,
    /// Number of time rows; unknown for the long forms.
    pub times: Option<usize>,
    /// Number of points; unknown for the long forms.
    pub points: Option<usize>,
    /// Line of the header row in a CSV file, 0 in an NPZ file.
    pub line: u64,
}

impl Header {
    /// Reads the names of a history, without its values.
    ///
    /// # Errors
    /// A file that is missing, not a file, empty, or not readable as CSV or NPZ.
    pub fn read(path: &Path) -> Result<Header, HistoryError> {
        if is_archive(path)? { npz_file::header(path) } else { csv_file::header(path) }
    }

    /// Whether the file has a column of that name.
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|known| known == name)
    }

    /// Whether the file has the column.
    pub fn has_column(&self, column: Column) -> bool {
        column.fixed_name().is_some_and(|name| self.has(name))
    }

    /// How the file describes the relative motion.
    pub fn motion(&self) -> Motion {
        if self.has("velocity") {
            Motion::Velocity
        } else if self.has("slip") {
            Motion::Slip
        } else if self.has("slip_x") {
            Motion::SlipVector
        } else {
            Motion::None
        }
    }

    /// Whether nodal stresses are there.
    pub fn has_stress(&self) -> bool {
        self.has("sxx")
    }

    /// Checks the names against each other and against what is needed.
    ///
    /// `pressure` may be left out only where nodal stresses are there and it is not asked for.
    ///
    /// # Errors
    /// Unknown or repeated names, `time`, `point` or `pressure` missing, a needed column missing,
    /// velocity beside slip, slip beside its components, part of a vector.
    pub fn check(&self, needs: &Needs) -> Result<(), HistoryError> {
        self.check_names(needs)?;
        self.check_groups()?;
        if self.layout != Layout::NpzGrid && !self.has("point") {
            return Err(self.missing("point"));
        }
        if !self.has("time") {
            return Err(self.missing("time"));
        }
        if !self.has("pressure") && !self.has_stress() {
            return Err(self.missing("pressure"));
        }
        for column in needs.columns() {
            let name = needs.name(column);
            if !self.has(name) && !self.reads_as_zero(column) {
                return Err(self.missing(name));
            }
        }
        Ok(())
    }

    /// Whether a component that the file leaves out stands for zero, its vector being there.
    pub fn reads_as_zero(&self, column: Column) -> bool {
        let leader = match column {
            Column::SlipY | Column::SlipZ => "slip_x",
            Column::NormalY => "nx",
            Column::StressYy | Column::StressXy | Column::StressYz => "sxx",
            Column::Y | Column::Z => "x",
            _ => return false,
        };
        !self.has_column(column) && self.has(leader)
    }

    fn missing(&self, name: &str) -> HistoryError {
        HistoryError::MissingColumn { path: self.path.clone(), name: name.to_string(), found: self.names.clone() }
    }

    /// Checks that every name is known, by itself or to `needs`, and given once.
    ///
    /// # Errors
    /// Unknown or repeated names.
    pub fn check_names(&self, needs: &Needs) -> Result<(), HistoryError> {
        for (at, name) in self.names.iter().enumerate() {
            if self.names[..at].contains(name) {
                return Err(HistoryError::RepeatedColumn {
                    path: self.path.clone(),
                    name: name.clone(),
                    line: self.line,
                    column: at + 1,
                });
            }
            let further = needs.further().iter().chain(needs.allowed());
            let known = name == "time"
                || name == "point"
                || Column::from_name(name).is_some()
                || further.clone().any(|f| f == name);
            if !known {
                let fixed = Column::NAMED.iter().map(|(_, name)| *name);
                let candidates = fixed.chain(["time", "point"]).chain(further.map(String::as_str));
                return Err(HistoryError::UnknownColumn {
                    path: self.path.clone(),
                    name: name.clone(),
                    line: self.line,
                    column: at + 1,
                    nearest: nearest(name, candidates),
                });
            }
        }
        Ok(())
    }

    fn check_groups(&self) -> Result<(), HistoryError> {
        let slips = ["slip_x", "slip_y", "slip_z"];
        let pairs = ["slip"].iter().chain(&slips).map(|second| ("velocity", *second));
        for (first, second) in pairs.chain(slips.map(|second| ("slip", second))) {
            if self.has(first) && self.has(second) {
                let path = self.path.clone();
                return Err(HistoryError::Conflict { path, first, second });
            }
        }
        self.complete(&["nx", "nz"], &["ny"], "nx, ny, nz")?;
        let stress = "sxx, syy, szz, sxy, syz, sxz";
        self.complete(&["sxx", "szz", "sxz"], &["syy", "sxy", "syz"], stress)?;
        self.complete(&["slip_x"], &["slip_y"], "slip_x, slip_y")?;
        self.complete(&["slip_x"], &["slip_z"], "slip_x, slip_y, slip_z")?;
        self.complete(&["x"], &["y"], "x, y, z")?;
        self.complete(&["x"], &["z"], "x, y, z")
    }

    /// Every name of `base` or none; names of `rest` only all together and with `base`.
    fn complete(&self, base: &[&'static str], rest: &[&'static str], group: &'static str) -> Result<(), HistoryError> {
        let any = base.iter().chain(rest).find(|name| self.has(name));
        let Some(present) = any.copied() else {
            return Ok(());
        };
        let rest_present = rest.iter().find(|name| self.has(name)).copied();
        let lacks = |names: &[&'static str]| names.iter().find(|name| !self.has(name)).copied();
        let fault = match (lacks(base), rest_present) {
            (Some(missing), _) => Some((present, missing)),
            (None, Some(present)) => lacks(rest).map(|missing| (present, missing)),
            (None, None) => None,
        };
        match fault {
            None => Ok(()),
            Some((present, missing)) => {
                Err(HistoryError::PartOfVector { path: self.path.clone(), present, missing, group })
            }
        }
    }
}

/// The candidate nearest to a misspelt name, if one is near enough to be meant.
fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let lower = name.to_lowercase();
    let scored = candidates.map(|known| (strsim::jaro_winkler(&lower, known), known));
    let best = scored.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 >= 0.75).then(|| best.1.to_string())
}

/// Opens a regular file for reading.
pub(super) fn open(path: &Path) -> Result<File, HistoryError> {
    let fault = |source: std::io::Error| match source.kind() {
        std::io::ErrorKind::NotFound => HistoryError::Missing { path: path.into() },
        _ => HistoryError::Io { path: path.into(), source },
    };
    let metadata = std::fs::metadata(path).map_err(fault)?;
    if !metadata.is_file() {
        return Err(HistoryError::NotAFile { path: path.into() });
    }
    if metadata.len() == 0 {
        return Err(HistoryError::Empty { path: path.into() });
    }
    File::open(path).map_err(fault)
}

/// Whether a file is to be read as NPZ: by its first bytes, else by its ending.
pub(super) fn is_archive(path: &Path) -> Result<bool, HistoryError> {
    let mut start = [0_u8; 4];
    let file = open(path)?;
    let mut head = Vec::with_capacity(4);
    file.take(4).read_to_end(&mut head).map_err(|source| HistoryError::Io { path: path.into(), source })?;
    start[..head.len()].copy_from_slice(&head);
    let named = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("npz"));
    Ok(named || start.starts_with(b"PK\x03\x04") || start.starts_with(b"PK\x05\x06"))
}
