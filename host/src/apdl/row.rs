//! One row of a wear table while it is being filled: its point, its constants and where each of them stands.

use super::deck::TableRow;
use super::lexer::Span;

#[derive(Debug)]
pub(super) struct Row {
    pub time: Option<f64>,
    pub temperature: Option<f64>,
    pub constants: Vec<Option<(f64, Span)>>,
    /// The first TBDATA of the row.
    pub span: Span,
}

impl Row {
    pub fn values(&self) -> Vec<Option<f64>> {
        let value = |c: &Option<(f64, Span)>| c.map(|(value, _)| value);
        self.constants.iter().map(value).collect()
    }

    /// Where a constant stands, from 1; the row's own place if it is blank.
    pub fn span_of(&self, location: usize) -> Span {
        let constant = self.constants.get(location - 1).copied().flatten();
        constant.map_or(self.span, |(_, span)| span)
    }

    /// Bits that are equal where the points are; no finite number has the bits that stand for "none".
    pub fn key(&self) -> [u64; 2] {
        // adding zero turns -0 into 0
        let bits = |value: Option<f64>| value.map_or(u64::MAX, |value| (value + 0.0).to_bits());
        [bits(self.time), bits(self.temperature)]
    }

    /// What the row runs over, as it completes "constants given ..".
    pub fn variables(&self) -> &'static str {
        match (self.time, self.temperature) {
            (None, None) => "without a field value",
            (Some(_), None) => "by time",
            (None, Some(_)) => "by temperature",
            (Some(_), Some(_)) => "by time and temperature",
        }
    }

    /// `time = 1, temperature = 20`, or nothing.
    pub fn point(&self) -> String {
        let named = [("time", self.time), ("temperature", self.temperature)];
        let parts = named.iter().filter_map(|(name, value)| value.map(|value| format!("{name} = {value}")));
        parts.collect::<Vec<_>>().join(", ")
    }
}

impl From<Row> for TableRow {
    fn from(row: Row) -> Self {
        TableRow { time: row.time, temperature: row.temperature, constants: row.values(), span: row.span }
    }
}
