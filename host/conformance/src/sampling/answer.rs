//! What a law answers at one point.

use super::known::heads_of;
use wearlaw_law::{LawDescriptor, OutputItem};

/// The numbers of one point.
#[derive(Clone, Debug, PartialEq)]
pub struct AtPoint {
    /// The wear increment, m or as the law declares.
    pub increment: f64,
    /// The wear direction, three components; empty where none is written.
    pub direction: Vec<f64>,
    /// The state after the substep; empty where the law has none.
    pub state: Vec<f64>,
    /// The derivative by the pressure, where it is written.
    pub d_pressure: Option<f64>,
}

impl AtPoint {
    /// An increment alone.
    pub fn of_increment(increment: f64) -> Self {
        Self { increment, direction: Vec::new(), state: Vec::new(), d_pressure: None }
    }

    /// The answers by the name of their column in a table of known values; whether each is a component of a direction.
    pub fn named(&self, law: &LawDescriptor) -> Vec<(String, f64, bool)> {
        let mut named = vec![("increment".to_owned(), self.increment, false)];
        if law.writes(OutputItem::DPressure) {
            named.extend(self.d_pressure.map(|slope| ("d_pressure".to_owned(), slope, false)));
        }
        let ends = law.state.iter().zip(&self.state);
        named.extend(ends.map(|(variable, value)| (format!("{}_end", variable.name), *value, false)));
        let directions = heads_of("direction", 3).into_iter().zip(&self.direction);
        named.extend(directions.map(|(head, value)| (head, *value, true)));
        named
    }
}
