//! Values that the author computed independently: `expected.csv`, or the law's extension `wearlaw.selftest/1`.
#![allow(unsafe_code)] // reason: reads the text that an extension points at.

use std::ffi::{CStr, c_char};

use wearlaw_plugin_api::abi;

use super::super::harness::call::{Call, Given, Layout, good};
use super::super::harness::closeness::{Difference, ulps};
use super::super::harness::points::{Case, Point, number_text};
use super::super::harness::subject::Law;
use super::super::message::{Judged, Verdict, broken, skip};
use super::super::outcome::Finding;
use super::bench::Bench;
use crate::law::{CallNumbers, Field, Fields, LawDescriptor, OutputItem, Quantity};

/// Relative difference that a value may have: rounding, and nothing that a wrong equation gives.
const TOLERANCE: f64 = 1e-12;
/// The extension that holds the same table as a text closed by NUL.
const SELFTEST: &CStr = c"wearlaw.selftest/1";

/// A table of known values; an empty cell is a NaN.
#[derive(Debug, PartialEq)]
pub(super) struct Table {
    /// Where it came from.
    origin: String,
    heads: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// The table of a law, if it has one; a word on what is wrong with it otherwise.
    pub(super) fn of(bench: &Bench, law: &Law<'_>) -> Result<Option<Self>, String> {
        if let Some(path) = &bench.task.expected {
            let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
            return Self::parse(&text, &path.display().to_string()).map(Some);
        }
        let Some(address) = law.library.extension(&law.table, SELFTEST) else { return Ok(None) };
        // SAFETY: by the rules of this extension the address leads to a text closed by NUL that lives as long as the law.
        let text = unsafe { CStr::from_ptr(address.cast::<c_char>()) };
        Self::parse(&text.to_string_lossy(), "wearlaw.selftest/1").map(Some)
    }

    fn parse(text: &str, origin: &str) -> Result<Self, String> {
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
        let heads = reader.headers().map_err(|error| format!("{origin}: {error}"))?;
        let heads: Vec<String> = heads.iter().map(str::to_owned).collect();
        let mut rows = Vec::new();
        for (index, record) in reader.records().enumerate() {
            let record = record.map_err(|error| format!("{origin}: {error}"))?;
            let mut row = Vec::new();
            for cell in &record {
                let number = if cell.is_empty() { Ok(f64::NAN) } else { cell.parse() };
                row.push(number.map_err(|_| format!("{origin}, row {}: `{cell}` is no number", index + 1))?);
            }
            rows.push(row);
        }
        if rows.is_empty() {
            return Err(format!("{origin} has no rows"));
        }
        Ok(Self { origin: origin.to_owned(), heads, rows })
    }

    fn get(&self, row: usize, head: &str) -> Option<f64> {
        self.heads.iter().position(|name| name == head).and_then(|column| self.rows[row].get(column)).copied()
    }

    /// The status that a row has to be answered with.
    fn status(&self, row: usize) -> Result<i32, String> {
        let status = self.get(row, STATUS).filter(|value| !value.is_nan()).unwrap_or_default();
        let known = (abi::WL_OK..=abi::WL_FAILED).find(|known| f64::from(*known) == status);
        known.ok_or_else(|| {
            format!(
                "{}, row {}: status {}, expected {} to {}",
                self.origin,
                row + 1,
                status,
                abi::WL_OK,
                abi::WL_FAILED
            )
        })
    }

    /// The inputs of a row, as a report shows them: also the numbers of the call that the table gives.
    fn inputs(&self, row: usize, case: &Case, law: &LawDescriptor) -> Vec<(String, String)> {
        let mut named = case.named(law, 0);
        for head in NUMBERS {
            if let Some(value) =
                self.get(row, head).filter(|value| !value.is_nan() && !named.iter().any(|n| n.0 == head))
            {
                named.push((head.to_owned(), number_text(value)));
            }
        }
        named
    }

    /// The different sets of constants of the rows that are answered, where the table has all and they keep their bounds.
    pub(super) fn constants(&self, law: &LawDescriptor) -> Vec<Vec<f64>> {
        let mut sets: Vec<Vec<f64>> = Vec::new();
        for row in (0..self.rows.len()).filter(|row| self.status(*row).is_ok_and(good)) {
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
    fn misfit(&self, law: &LawDescriptor) -> Option<String> {
        let known = known_heads(law);
        if let Some(head) = self.heads.iter().find(|head| !known.contains(head)) {
            return Some(format!("{}: column `{head}` means nothing to law `{}`", self.origin, law.name));
        }
        let needed = law.reads.iter().map(first_head);
        let needed = needed.chain(law.constants.iter().filter(|c| c.default.is_none()).map(|c| c.name.clone()));
        let mut needed = needed.chain(law.inputs.iter().map(|input| input.name.clone()));
        let missing = needed.find(|head| !self.heads.contains(head))?;
        Some(format!("{}: no column `{missing}`, which law `{}` needs", self.origin, law.name))
    }

    /// The call of a row, and the fields that it does not give.
    fn case(&self, row: usize, law: &LawDescriptor) -> (Case, Fields) {
        let number = |head: &str| self.get(row, head).filter(|value| !value.is_nan());
        let mut point = Point::zero(law);
        let mut absent = Fields::EMPTY;
        for field in law.fields().iter() {
            if number(&first_head(field)).is_none() {
                absent = absent.with(field);
                continue;
            }
            if field.shape() == crate::law::fields::Shape::Index {
                point.set_index(field, number(field.name()).unwrap_or(0.0) as i64);
            }
            for (component, head) in heads_of(field.name(), field.shape().width()).iter().enumerate() {
                point.set(field, component, number(head).unwrap_or(0.0));
            }
        }
        let given = |quantity: &crate::law::Quantity, head: &str| number(head).or(quantity.default).unwrap_or(0.0);
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
}

fn heads_of(name: &str, width: usize) -> Vec<String> {
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

/// Whether every row comes out.
pub(super) fn expected(bench: &Bench) -> Judged {
    bench.with(|law, instance| {
        let about = &law.about;
        let table = match Table::of(bench, law) {
            Ok(Some(table)) => table,
            Ok(None) => return skip("there is no expected.csv beside the law, and it has no wearlaw.selftest/1"),
            Err(reason) => return broken(Finding::new(reason)),
        };
        if let Some(reason) = table.misfit(about) {
            return broken(Finding::new(reason));
        }
        let mut worst = 0;
        let mut compared = 0;
        for row in 0..table.rows.len() {
            let (case, absent) = table.case(row, about);
            let layout = Layout { given: Given::Declared, absent, ..Layout::plain(about) };
            let answers = Call::new(about, &case, &layout).answers(instance);
            let name = format!("{}, row {}", table.origin, row + 1);
            if let Some(refusal) = beyond(about, &case) {
                return broken(Finding::new(format!("{name}: {refusal}, so no host gives it to the law")));
            }
            let status = table.status(row).or_else(|reason| broken(Finding::new(reason)))?;
            let input = || table.inputs(row, &case, about);
            if answers.status != status {
                let how = match answers.status {
                    abi::WL_OK => "is answered",
                    abi::WL_UNRELIABLE => "is answered as unreliable",
                    _ => "is refused",
                };
                let finding = Finding::new(format!("{name} {how}")).at(input());
                let values = if good(status) { " and the values of the row" } else { "" };
                return broken(finding.with(format!("status {}", answers.status), format!("status {status}{values}")));
            }
            if !good(status) {
                compared += 1;
                continue;
            }
            for (head, found, direction) in named(about, &answers.at(0)) {
                let Some(expected) = table.get(row, &head).filter(|value| !value.is_nan()) else { continue };
                compared += 1;
                let allowed = if direction { TOLERANCE } else { TOLERANCE * expected.abs() };
                if (found - expected).abs() <= allowed {
                    worst = worst.max(if direction { 0 } else { ulps(found, expected) });
                    continue;
                }
                let item =
                    Difference { item: "", one: found, other: expected, ulps: ulps(found, expected), small: false };
                let finding = Finding::new(format!("{name}: {head} does not come out")).at(input());
                return broken(finding.with(
                    format!("{head} {}", number_text(item.one)),
                    format!("{head} {} to {TOLERANCE:e}", number_text(item.other)),
                ));
            }
        }
        if compared == 0 {
            return broken(Finding::new(format!("{} gives no answers, such as `increment`", table.origin)));
        }
        let rows = table.rows.len();
        Ok(Verdict::Pass(Some(format!("{rows} rows, {compared} values, at most {worst} ulp off"))))
    })
}

/// What of a row lies outside of the bounds that the law declares, in words.
fn beyond(law: &LawDescriptor, case: &Case) -> Option<String> {
    let constants = law.constants.iter().zip(&case.constants);
    let states = law.state.iter().zip(&case.point(0).state);
    let outside = |(quantity, value): &(&Quantity, &f64)| !quantity.allows(**value);
    let (quantity, value) = constants.chain(states).find(outside)?;
    Some(format!("{} = {} lies outside of its bounds", quantity.name, number_text(*value)))
}

/// The answers by the name of their column; whether each is a component of a direction.
fn named(law: &LawDescriptor, at: &super::super::harness::closeness::AtPoint) -> Vec<(String, f64, bool)> {
    let mut named = vec![("increment".to_owned(), at.increment, false)];
    if law.writes(OutputItem::DPressure) {
        named.extend(at.d_pressure.map(|slope| ("d_pressure".to_owned(), slope, false)));
    }
    let ends = law.state.iter().zip(&at.state);
    named.extend(ends.map(|(variable, value)| (format!("{}_end", variable.name), *value, false)));
    let directions = heads_of("direction", 3).into_iter().zip(&at.direction);
    named.extend(directions.map(|(head, value)| (head, *value, true)));
    named
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::{Plugin, embedded};

    fn archard() -> LawDescriptor {
        let plugin = Plugin::from_entry(embedded::entry("archard").unwrap()).unwrap();
        plugin.laws()[0].descriptor().clone()
    }

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
    }

    #[test]
    fn a_row_may_be_refused_and_is_shown_with_all_that_it_gives() {
        let law = archard();
        let text = "K,H,pressure,velocity,dt,time,absolute_zero,status,increment\n1,1,inf,1,1,3,-273.15,3,\n\
                    2,1,1,1,1,0,0,,2\n3,1,1,1,1,0,0,2.5,2\n";
        let table = Table::parse(text, "t").unwrap();
        assert_eq!(table.misfit(&law), None);
        assert_eq!((table.status(0), table.status(1)), (Ok(abi::WL_OUT_OF_DOMAIN), Ok(abi::WL_OK)));
        assert!(table.status(2).unwrap_err().contains("row 3: status 2.5"));
        assert_eq!(table.constants(&law), [[2.0, 1.0, 1.0, 1.0]], "those that something is known of");
        let shown = table.inputs(0, &table.case(0, &law).0, &law);
        for (name, value) in [("dt", "1"), ("time", "3"), ("absolute_zero", "-273.15")] {
            assert_eq!(shown.iter().filter(|(n, v)| n == name && v == value).count(), 1, "{name} in {shown:?}");
        }
    }

    #[test]
    fn a_row_outside_of_the_bounds_is_told() {
        let law = archard();
        let text = "K,H,pressure,velocity,dt,increment\n1e-4,2e9,5e7,0.2,1,5e-7\n-1,2e9,1,1,1,0\n";
        let table = Table::parse(text, "t").unwrap();
        assert_eq!(beyond(&law, &table.case(0, &law).0), None);
        let told = beyond(&law, &table.case(1, &law).0).unwrap();
        assert!(told.contains("K = -1"), "{told}");
    }

    #[test]
    fn a_table_that_does_not_fit_says_which_column() {
        let law = archard();
        let misfit = |text: &str| Table::parse(text, "t").unwrap().misfit(&law).unwrap();
        assert!(misfit("K,H,pressure,velocity,dt,increments\n1,1,1,1,1,1\n").contains("`increments`"));
        assert!(misfit("K,H,pressure,dt,increment\n1,1,1,1,1\n").contains("`velocity`"));
        assert!(Table::parse("K\nx\n", "t").unwrap_err().contains("row 1: `x`"));
        assert!(Table::parse("K\n", "t").unwrap_err().contains("no rows"));
    }
}
