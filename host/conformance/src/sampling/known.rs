//! Values that the author of a law computed independently: `expected.csv`, or the law's extension
//! `wearlaw.selftest/1`.
#![allow(unsafe_code)] // reason: reads the text that an extension points at.

use std::ffi::{CStr, c_char, c_void};
use std::path::{Path, PathBuf};

use wearlaw_plugin_api::abi;
pub use wearlaw_plugin_api::sdk::SELFTEST;

use super::super::error::{nearest, suggestion};
use super::points::{Case, Point, number_text};
use wearlaw_law::fields::Shape;
use wearlaw_law::{CallNumbers, Field, Fields, LawDescriptor, Quantity};

/// The table that a law brings itself; a word on what is wrong with it otherwise.
///
/// # Safety
/// `address` is what a law that is loaded answered for [`SELFTEST`].
pub unsafe fn selftest(address: *const c_void) -> Result<Table, String> {
    // SAFETY: by the rules of this extension the address leads to a text closed by NUL that lives as long as the law.
    let text = unsafe { CStr::from_ptr(address.cast::<c_char>()) };
    Table::parse(&text.to_string_lossy(), "wearlaw.selftest/1")
}

/// Where the table of known values of a law is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expected {
    /// There is none, but for the law's own extension.
    Nowhere,
    /// In this file.
    File(PathBuf),
    /// In this folder, if there: `expected.csv`, or `expected-NAME.csv` where a library holds several laws.
    Beside(PathBuf),
}

impl Expected {
    /// The file for one of `laws` laws, if there is one.
    pub fn file(&self, law: Option<&str>, laws: usize) -> Option<PathBuf> {
        match self {
            Self::Nowhere => None,
            Self::File(path) => Some(path.clone()),
            Self::Beside(folder) => {
                let name = match law {
                    Some(law) if laws > 1 => format!("expected-{law}.csv"),
                    _ => "expected.csv".to_owned(),
                };
                Some(folder.join(name)).filter(|path| path.is_file())
            }
        }
    }
}

/// A number of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// NaN for an empty cell, or for one that says so.
    pub value: f64,
    /// True if nothing is written.
    pub empty: bool,
    /// Digits that it is written with, zeros in front not counted.
    pub digits: usize,
    /// Half a unit of the last digit that is written.
    pub half_unit: f64,
}

impl Cell {
    /// The number that a text is, if it is one.
    fn read(text: &str) -> Option<Self> {
        let value = if text.is_empty() { f64::NAN } else { text.parse().ok()? };
        let (mantissa, power) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let digits = mantissa.chars().filter(char::is_ascii_digit).skip_while(|digit| *digit == '0').count();
        let power = power.parse::<i32>().unwrap_or(0) - decimals as i32;
        // Read as text, the power of ten is rounded once.
        let half_unit = format!("5e{}", power - 1).parse().unwrap_or(f64::NAN);
        Some(Self { value, empty: text.is_empty(), digits, half_unit })
    }

    /// The number of a status, by its value or its name.
    fn read_status(text: &str) -> Option<Self> {
        let by_name = STATUSES.iter().position(|name| *name == text);
        Self::read(&by_name.map_or_else(|| text.to_owned(), |value| value.to_string()))
    }
}

/// The statuses by their names, in the order of their values.
const STATUSES: [&str; 6] =
    ["WL_OK", "WL_UNRELIABLE", "WL_CUT_STEP", "WL_OUT_OF_DOMAIN", "WL_MISSING_INPUT", "WL_FAILED"];

/// A table of known values; an empty cell is a NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Where it came from.
    origin: String,
    heads: Vec<String>,
    rows: Vec<Vec<Cell>>,
    /// The line of each row.
    lines: Vec<u64>,
}

impl Table {
    /// The table in a file; a word on what is wrong with it otherwise.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        Self::parse(&text, &path.display().to_string())
    }

    /// The table in a text; a word on what is wrong with it otherwise.
    pub fn parse(text: &str, origin: &str) -> Result<Self, String> {
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
        let heads = reader.headers().map_err(|error| format!("{origin}: {error}"))?;
        let heads: Vec<String> = heads.iter().map(str::to_owned).collect();
        let (mut rows, mut lines) = (Vec::new(), Vec::new());
        for record in reader.records() {
            let record = record.map_err(|error| uneven(&error, origin))?;
            let line = record.position().map_or(0, csv::Position::line);
            lines.push(line);
            let mut row = Vec::new();
            for (head, cell) in heads.iter().zip(&record) {
                let read = if head == STATUS { Cell::read_status(cell) } else { Cell::read(cell) };
                let read = read.ok_or_else(|| {
                    let expected = if head == STATUS { "one such as 3 or WL_OUT_OF_DOMAIN" } else { "a number" };
                    format!("{origin}, line {line}: `{cell}` below `{head}`, expected {expected}")
                })?;
                if read.value.is_nan() && !read.empty && is_answer(head) {
                    let words = "expected a number, or nothing where the row is refused (`status`)";
                    return Err(format!("{origin}, line {line}: `{cell}` below `{head}`, {words}"));
                }
                row.push(read);
            }
            rows.push(row);
        }
        if rows.is_empty() {
            return Err(format!("{origin} has no rows"));
        }
        Ok(Self { origin: origin.to_owned(), heads, rows, lines })
    }

    /// The number in a row below a head; none for an empty cell, and for a head that the table has not.
    pub fn get(&self, row: usize, head: &str) -> Option<f64> {
        self.cell(row, head).filter(|cell| !cell.empty).map(|cell| cell.value)
    }

    /// The number in a row below a head, and how many of its digits are written.
    pub fn cell(&self, row: usize, head: &str) -> Option<Cell> {
        self.heads.iter().position(|name| name == head).and_then(|column| self.rows[row].get(column)).copied()
    }

    /// Most digits that a number below a head is written with; 0 for a head that the table has not.
    pub fn digits(&self, head: &str) -> usize {
        (0..self.rows.len()).filter_map(|row| self.cell(row, head)).map(|cell| cell.digits).max().unwrap_or(0)
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Where the table came from.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// A row in the words of a report: its line.
    pub fn row_name(&self, row: usize) -> String {
        format!("{}, line {}", self.origin, self.lines.get(row).copied().unwrap_or_default())
    }

    /// The status that a row has to be answered with; a word on what is wrong with it otherwise.
    pub fn status(&self, row: usize) -> Result<i32, String> {
        let status = self.get(row, STATUS).unwrap_or_default();
        let known = (abi::WL_OK..=abi::WL_FAILED).find(|known| f64::from(*known) == status);
        let (name, last) = (self.row_name(row), abi::WL_FAILED);
        known.ok_or_else(|| format!("{name}: status {status}, expected {} to {last}", abi::WL_OK))
    }

    /// The inputs of a row, as a report shows them: also the numbers of the call that the table gives.
    pub fn inputs(&self, row: usize, case: &Case, law: &LawDescriptor) -> Vec<(String, String)> {
        let mut named = case.named(law, 0);
        for head in NUMBERS {
            let given = self.get(row, head).filter(|_| !named.iter().any(|n| n.0 == head));
            named.extend(given.map(|value| (head.to_owned(), number_text(value))));
        }
        named
    }

    /// The different sets of constants of the rows that are answered, where the table has all and they keep their bounds.
    pub fn constants(&self, law: &LawDescriptor) -> Vec<Vec<f64>> {
        let mut sets: Vec<Vec<f64>> = Vec::new();
        let answered =
            |row: &usize| self.status(*row).is_ok_and(|status| matches!(status, abi::WL_OK | abi::WL_UNRELIABLE));
        for row in (0..self.rows.len()).filter(answered) {
            let set: Option<Vec<f64>> = law
                .constants
                .iter()
                .map(|constant| self.get(row, &constant.name).or(constant.default).filter(|v| constant.allows(*v)))
                .collect();
            sets.extend(set.filter(|set| !sets.contains(set)));
        }
        sets
    }

    /// A column that means nothing to the law, or one that it needs and that is not there.
    pub fn misfit(&self, law: &LawDescriptor) -> Option<String> {
        let known = known_heads(law);
        if let Some(head) = self.heads.iter().find(|head| !known.contains(head)) {
            let hint = meant(head, &known);
            return Some(format!("{}: column `{head}` means nothing to law `{}`{hint}", self.origin, law.name));
        }
        if let Some(head) = self.heads.iter().find(|head| known.iter().filter(|one| one == head).count() > 1) {
            let words = "stands for two of its quantities: one of them needs another name";
            return Some(format!("{}: column `{head}` of law `{}` {words}", self.origin, law.name));
        }
        let needed = law.reads.iter().map(first_head);
        let needed = needed.chain(law.constants.iter().filter(|c| c.default.is_none()).map(|c| c.name.clone()));
        let mut needed = needed.chain(law.inputs.iter().map(|input| input.name.clone()));
        let missing = needed.find(|head| !self.heads.contains(head))?;
        Some(format!("{}: no column `{missing}`, which law `{}` needs", self.origin, law.name))
    }

    /// The call of a row, and the fields that it does not give.
    pub fn case(&self, row: usize, law: &LawDescriptor) -> (Case, Fields) {
        let number = |head: &str| self.get(row, head);
        let mut point = Point::zero(law);
        let mut absent = Fields::EMPTY;
        for field in law.fields().iter() {
            if number(&first_head(field)).is_none() {
                absent = absent.with(field);
                continue;
            }
            if field.shape() == Shape::Index {
                point.set_index(field, number(field.name()).unwrap_or(0.0) as i64);
            }
            for (component, head) in heads_of(field.name(), field.shape().width()).iter().enumerate() {
                point.set(field, component, number(head).unwrap_or(0.0));
            }
        }
        let given = |quantity: &Quantity, head: &str| number(head).or(quantity.default).unwrap_or(0.0);
        point.inputs = law.inputs.iter().map(|input| given(input, &input.name)).collect();
        point.state = law.state.iter().map(|v| given(v, &format!("{}_start", v.name))).collect();
        let constants = law.constants.iter().map(|constant| given(constant, &constant.name)).collect();
        let numbers = CallNumbers {
            dt: number("dt").unwrap_or(1.0),
            time: number("time").unwrap_or(0.0),
            absolute_zero: number("absolute_zero").unwrap_or(0.0),
            reference_temperature: number("reference_temperature").unwrap_or(0.0),
            ..CallNumbers::default()
        };
        (Case::new(numbers, constants, vec![point]), absent)
    }

    /// What of a row lies outside of the bounds that the law declares, in words.
    pub fn beyond(law: &LawDescriptor, case: &Case) -> Option<String> {
        let constants = law.constants.iter().zip(&case.constants);
        let states = law.state.iter().zip(&case.point(0).state);
        let outside = |(quantity, value): &(&Quantity, &f64)| !quantity.allows(**value);
        let (quantity, value) = constants.chain(states).find(outside)?;
        Some(format!("{} = {} lies outside of its bounds", quantity.name, number_text(*value)))
    }
}

/// The heads of a value with so many components.
pub(super) fn heads_of(name: &str, width: usize) -> Vec<String> {
    match width {
        3 => ["_x", "_y", "_z"].map(|component| format!("{name}{component}")).to_vec(),
        _ => vec![name.to_owned()],
    }
}

fn first_head(field: Field) -> String {
    heads_of(field.name(), field.shape().width()).remove(0)
}

/// Numbers of the call that a table may give.
const NUMBERS: [&str; 4] = ["dt", "time", "absolute_zero", "reference_temperature"];

/// What is wrong with the rows of a table, in words.
fn uneven(error: &csv::Error, origin: &str) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map(|pos| format!(", line {}", pos.line())).unwrap_or_default();
            format!("{origin}{line}: {len} cells, expected {expected_len} as in the line of the names")
        }
        _ => format!("{origin}: {error}"),
    }
}

/// What was probably meant by a head that is not known, or why it is not.
fn meant(head: &str, known: &[String]) -> String {
    let ending = format!("{head}_");
    let longer: Vec<String> =
        known.iter().filter(|one| one.starts_with(&ending)).map(|one| format!("`{one}`")).collect();
    if !longer.is_empty() {
        return format!("; did you mean {}?", longer.join(", "));
    }
    let reads = |field: &Field| heads_of(field.name(), field.shape().width()).iter().any(|one| one == head);
    if Field::ALL.iter().any(reads) {
        return ", which does not read that field".to_owned();
    }
    suggestion(&nearest(head, known.iter().map(String::as_str)))
}

/// Whether a column holds what a law answers.
fn is_answer(head: &str) -> bool {
    ["increment", "d_pressure"].contains(&head) || head.starts_with("direction_") || head.ends_with("_end")
}

/// The column of the status that a row is answered with; there is none: all are good.
const STATUS: &str = "status";

fn known_heads(law: &LawDescriptor) -> Vec<String> {
    let mut known: Vec<String> = NUMBERS.map(str::to_owned).to_vec();
    known.extend([STATUS, "increment", "d_pressure"].map(str::to_owned));
    known.extend(law.constants.iter().chain(&law.inputs).map(|quantity| quantity.name.clone()));
    known.extend(law.fields().iter().flat_map(|field| heads_of(field.name(), field.shape().width())));
    known.extend(heads_of("direction", 3));
    known.extend(law.state.iter().flat_map(|v| ["_start", "_end"].map(|end| format!("{}{end}", v.name))));
    known
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::archard;

    #[test]
    fn a_table_gives_calls_and_sets_of_constants() {
        let law = archard();
        let text = "# by hand\nK,H,pressure,velocity,dt,increment\n1e-4,2e9,5e7,0.2,1,5e-7\n1e-4,2e9,,0.2,1,0\n-1,2e9,1,1,1,0\n";
        let table = Table::parse(text, "expected.csv").unwrap();
        assert_eq!(table.misfit(&law), None);
        assert_eq!(table.constants(&law), [[1e-4, 2e9, 1.0, 1.0]]);
        let (case, absent) = table.case(0, &law);
        assert_eq!((case.constants[0], case.point(0).scalar(Field::Pressure), case.numbers.dt), (1e-4, 5e7, 1.0));
        assert!(absent.is_empty());
        assert!(table.case(1, &law).1.contains(Field::Pressure));
        // What is no number is given, as such.
        let table = Table::parse("K,H,pressure,velocity,dt,status\n1,1,nan,1,1,3\n", "t").unwrap();
        let (case, absent) = table.case(0, &law);
        assert!(absent.is_empty() && case.point(0).scalar(Field::Pressure).is_nan());
    }

    #[test]
    fn a_column_that_stands_for_two_quantities_is_told() {
        let mut law = archard();
        law.state = vec![Quantity { name: "slip".to_owned(), ..law.constants[0].clone() }];
        law.constants[0].name = "slip_start".to_owned();
        let table = Table::parse("slip_start,H,pressure,velocity,dt,increment\n1,1,1,1,1,1\n", "t").unwrap();
        assert!(table.misfit(&law).unwrap().contains("`slip_start` of law `archard` stands for two"));
    }

    #[test]
    fn a_row_may_be_refused_and_is_shown_with_all_that_it_gives() {
        let law = archard();
        let text = "K,H,pressure,velocity,dt,time,absolute_zero,status,increment\n1,1,inf,1,1,3,-273.15,3,\n\
                    2,1,1,1,1,0,0,,2\n3,1,1,1,1,0,0,2.5,2\n";
        let table = Table::parse(text, "t").unwrap();
        assert_eq!(table.misfit(&law), None);
        assert_eq!((table.status(0), table.status(1)), (Ok(abi::WL_OUT_OF_DOMAIN), Ok(abi::WL_OK)));
        assert!(table.status(2).unwrap_err().contains("line 4: status 2.5"));
        assert_eq!(table.constants(&law), [[2.0, 1.0, 1.0, 1.0]], "those that something is known of");
        let shown = table.inputs(0, &table.case(0, &law).0, &law);
        let named = Table::parse("K,status\n1,WL_OUT_OF_DOMAIN\n1,WL_OK\n", "t").unwrap();
        assert_eq!((named.status(0), named.status(1)), (Ok(abi::WL_OUT_OF_DOMAIN), Ok(abi::WL_OK)));
        for (name, value) in [("dt", "1"), ("time", "3"), ("absolute_zero", "-273.15")] {
            assert_eq!(shown.iter().filter(|(n, v)| n == name && v == value).count(), 1, "{name} in {shown:?}");
        }
    }

    #[test]
    fn a_cell_knows_its_digits() {
        let cell = |text: &str| Cell::read(text).map(|cell| (cell.value, cell.digits, cell.half_unit));
        assert_eq!(cell("5.000000000000001e-07"), Some((5.000000000000001e-7, 16, 5e-23)));
        assert_eq!(cell("-0.0250"), Some((-0.025, 3, 5e-5)));
        assert_eq!(cell("1200"), Some((1200.0, 4, 0.5)));
        assert_eq!(cell("0.0"), Some((0.0, 0, 0.05)));
        assert!(cell("").is_some_and(|(value, digits, _)| value.is_nan() && digits == 0));
        assert_eq!((cell("x"), cell("inf").map(|cell| cell.1)), (None, Some(0)));
        let text = "K,H,pressure,velocity,dt,increment\n1,1,1,1,1,0.25\n1,1,1,1,1,0.1250000000000001\n";
        let table = Table::parse(text, "t").unwrap();
        assert_eq!((table.digits("increment"), table.digits("K"), table.digits("d_pressure")), (16, 1, 0));
    }

    #[test]
    fn a_row_outside_of_the_bounds_is_told() {
        let law = archard();
        let text = "K,H,pressure,velocity,dt,increment\n1e-4,2e9,5e7,0.2,1,5e-7\n-1,2e9,1,1,1,0\n";
        let table = Table::parse(text, "t").unwrap();
        assert_eq!(Table::beyond(&law, &table.case(0, &law).0), None);
        let told = Table::beyond(&law, &table.case(1, &law).0).unwrap();
        assert!(told.contains("K = -1"), "{told}");
    }

    #[test]
    fn a_table_that_does_not_fit_says_which_column() {
        let law = archard();
        let misfit = |text: &str| Table::parse(text, "t").unwrap().misfit(&law).unwrap();
        assert!(misfit("K,H,pressure,velocity,dt,increments\n1,1,1,1,1,1\n").contains("`increments`"));
        assert!(misfit("K,H,pressure,dt,increment\n1,1,1,1,1\n").contains("`velocity`"));
        for (head, words) in [
            ("increments", "; did you mean `increment`?"),
            ("direction", "; did you mean `direction_x`, `direction_y`, `direction_z`?"),
            ("slip", ", which does not read that field"),
            ("nonsense", "means nothing to law `archard`"),
        ] {
            let told = misfit(&format!("K,H,pressure,velocity,{head}\n1,1,1,1,1\n"));
            assert!(told.ends_with(words), "{told}");
        }
        assert!(Table::parse("K\nx\n", "t").unwrap_err().contains("t, line 2: `x` below `K`"));
        let refused = |text: &str| Table::parse(text, "t").unwrap_err();
        assert_eq!(refused("K,H\n1,1\n1\n"), "t, line 3: 1 cells, expected 2 as in the line of the names");
        assert!(refused("K,status\n1,WL_WRONG\n").contains("`WL_WRONG` below `status`, expected one such as 3"));
        assert!(refused("K,increment\n1,nan\n").contains("t, line 2: `nan` below `increment`"));
        assert!(Table::parse("K\n", "t").unwrap_err().contains("no rows"));
    }
}
