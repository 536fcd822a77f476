//! How far a law's answers are from the values that its author computed.

use serde::Serialize;

use super::laid::Laid;
use crate::conformance::sampling::known::Table;
use crate::conformance::sampling::ulps::ulps;
use crate::law::{Evaluation, Evaluator};

/// Digits that a table must have for its values to be known to the last place.
const DIGITS: usize = 15;

/// The answers of a law against a table of known values.
#[derive(Clone, Debug, Serialize)]
pub struct Accuracy {
    /// Where the table came from.
    pub table: String,
    /// Its rows.
    pub rows: usize,
    /// Each answer that the table has.
    pub answers: Vec<Worst>,
}

/// The largest error of one answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// The answer, by its column: `increment`, `d_pressure`, `direction_x`, a state variable with `_end`.
    pub answer: String,
    /// Units in the last place of the known value, of a component of a direction in those of 1; none where the table has
    /// too few digits and the law agrees with all of them.
    pub ulp: Option<u64>,
    /// The row in which it is, from 1.
    pub row: usize,
    /// Most digits that the table writes such values with.
    pub digits: usize,
    /// What the law gave.
    pub found: f64,
    /// What the table has.
    pub expected: f64,
}

impl Accuracy {
    /// Asks a law for every row of a table.
    ///
    /// # Errors
    /// A table that does not fit the law, or a row that the law does not answer, in words.
    pub(super) fn of(law: &dyn Evaluator, table: &Table) -> Result<Self, String> {
        let about = law.descriptor();
        if let Some(reason) = table.misfit(about) {
            return Err(reason);
        }
        let mut answers: Vec<(Worst, f64)> = Vec::new();
        for row in 0..table.rows() {
            let (case, absent) = table.case(row, about);
            let name = table.row_name(row);
            if let Some(refusal) = Table::beyond(about, &case) {
                return Err(format!("{name}: {refusal}, so no host gives it to the law"));
            }
            let asked = Laid::new(about, &case, 1, absent, true).ask(law);
            let (evaluation, answer) = asked.map_err(|error| format!("{name} is refused: {error}"))?;
            if let Evaluation::CutStep { .. } = evaluation {
                return Err(format!("{name} is refused: the law wants a shorter substep"));
            }
            for (head, found, is_component) in answer.named(about) {
                let Some(cell) = table.cell(row, &head).filter(|cell| !cell.empty) else { continue };
                let digits = table.digits(&head);
                let expected = cell.value;
                let off = if is_component {
                    ((found - expected).abs() / f64::EPSILON).round() as u64
                } else {
                    ulps(found, expected)
                };
                let agrees = digits < DIGITS && (found - expected).abs() <= 1.01 * cell.half_unit;
                let error = if agrees { -1.0 } else { off as f64 };
                let ulp = (!agrees).then_some(off);
                let worst = Worst { answer: head, ulp, row: row + 1, digits, found, expected };
                match answers.iter_mut().find(|(known, _)| known.answer == worst.answer) {
                    Some(known) if error > known.1 => *known = (worst, error),
                    Some(_) => {}
                    None => answers.push((worst, error)),
                }
            }
        }
        if answers.is_empty() {
            return Err(format!("{} gives no answers, such as `increment`", table.origin()));
        }
        let answers = answers.into_iter().map(|(worst, _)| worst).collect();
        Ok(Self { table: table.origin().to_owned(), rows: table.rows(), answers })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::{Plugin, embedded};

    const HEADS: &str = "K,H,pressure,velocity,dt,increment,d_pressure\n";

    fn of(rows: &str) -> Result<Accuracy, String> {
        let plugin = Plugin::from_entry(embedded::entry("archard").unwrap()).unwrap();
        let law = plugin.laws()[0].create(None).unwrap();
        Accuracy::of(&law, &Table::parse(&format!("{HEADS}{rows}"), "t").unwrap())
    }

    /// Answer, error and row.
    fn short(accuracy: &Accuracy) -> Vec<(&str, Option<u64>, usize)> {
        accuracy.answers.iter().map(|worst| (worst.answer.as_str(), worst.ulp, worst.row)).collect()
    }

    #[test]
    fn the_largest_error_and_its_row_are_told() {
        let good = "1e-4,2e9,5e7,0.2,1,5.000000000000001e-07,1.0000000000000002e-14\n";
        let off = "1e-4,2e9,5e7,0.2,1,5.000000000000008e-07,1.0000000000000002e-14\n";
        let accuracy = of(&format!("{good}{off}{good}")).unwrap();
        assert_eq!(short(&accuracy), [("increment", Some(7), 2), ("d_pressure", Some(0), 1)]);
        assert_eq!((accuracy.rows, accuracy.answers[0].digits), (3, 16));
    }

    #[test]
    fn few_digits_say_nothing_of_the_last_place_unless_they_are_wrong() {
        let accuracy = of("1e-4,3e9,5e7,0.2,1,3.333e-07,6.8e-15\n").unwrap();
        let (first, second) = (&accuracy.answers[0], &accuracy.answers[1]);
        assert_eq!((first.ulp, first.digits), (None, 4));
        assert!(second.ulp.is_some_and(|ulp| ulp > 1_000_000_000_000), "{second:?}");
    }

    #[test]
    fn a_row_that_cannot_be_asked_is_told() {
        assert!(of("-1,2e9,5e7,0.2,1,1,1\n").unwrap_err().starts_with("t, line 2: K = -1"));
        assert!(of("1e-4,2e9,,0.2,1,1,1\n").unwrap_err().contains("`pressure`"));
    }
}
