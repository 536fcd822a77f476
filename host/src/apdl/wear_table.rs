//! Builds one wear table from its commands and checks it when the next table begins.
//!
//! As documented for the commands: STLOC defaults to the location after the last one filled, a TB, TBFIELD or
//! TBTEMP sets it back to 1, a later value replaces an earlier one, a blank leaves it; a field value holds until
//! the next one of its kind, and values ascend.

use std::collections::HashMap;

use super::command::{Data, FieldValue, MOST_CONSTANTS, OpenTable, TableOption, Variable};
use super::deck::{LawOption, Scaling, ScalingKind, TableRow};
use super::lexer::Span;
use super::problem::{Fault, Problem};
use super::row::Row;
use crate::scene::documented::{Controls, ControlsError, DOCUMENTED_CONSTANTS, controls};

/// The documented defaults of the scaling constants.
const DEFAULT_SAFETY: f64 = 0.1;
const DEFAULT_MAXIMUM: f64 = 1e5;

const ARCHARD_NAMES: [&str; 4] = ["wear coefficient K", "hardness H", "pressure exponent m", "velocity exponent n"];

/// What a table is worth once it is complete.
#[derive(Debug)]
pub(super) enum Finished {
    Law {
        option: LawOption,
        rows: Vec<TableRow>,
        /// C6 to C8 where they are used scaled to length 1.
        scaled_from: Option<[f64; 3]>,
    },
    Scaling(Scaling),
}

#[derive(Debug)]
pub(super) struct WearTable {
    open: OpenTable,
    rows: Vec<Row>,
    row_at: HashMap<[u64; 2], usize>,
    /// Whether the rows so far ascend in time first, in temperature first.
    ascending: [bool; 2],
    time: Option<FieldValue>,
    temperature: Option<FieldValue>,
    /// Values set since the last TBDATA.
    waiting: Vec<FieldValue>,
    first_field: Option<FieldValue>,
    next_location: usize,
}

impl WearTable {
    pub fn new(open: OpenTable) -> Self {
        WearTable {
            open,
            rows: Vec::new(),
            row_at: HashMap::new(),
            ascending: [true, true],
            time: None,
            temperature: None,
            waiting: Vec::new(),
            first_field: None,
            next_location: 1,
        }
    }

    pub fn open(&self) -> &OpenTable {
        &self.open
    }

    fn most_constants(&self) -> usize {
        match self.open.option {
            TableOption::Archard => DOCUMENTED_CONSTANTS,
            TableOption::User => self.open.constants.unwrap_or(MOST_CONSTANTS),
            TableOption::Auto | TableOption::Cycle => 2,
        }
    }

    fn title(&self) -> String {
        let option = self.open.option.name();
        match (self.open.option, self.open.constants) {
            (TableOption::User, Some(points)) => {
                format!("TB,WEAR with {option} and NPTS = {points}")
            }
            _ => format!("TB,WEAR with {option}"),
        }
    }

    pub fn field_value(&mut self, new: FieldValue) -> Result<(), Box<Fault>> {
        if !self.open.option.is_law() {
            let command = new.command.to_owned();
            return Err(Fault::new(Problem::ScalingTable { command }, new.span));
        }
        let first = *self.first_field.get_or_insert(new);
        if first.command != new.command {
            let fault = Fault::new(Problem::MixedTemperature, new.span);
            return Err(fault.beside(first.span, "the other command"));
        }
        if let Some(unused) = self.waiting.iter().find(|w| w.variable == new.variable) {
            return Err(no_data_at(unused));
        }
        match new.variable {
            Variable::Time => self.time = Some(new),
            Variable::Temperature => self.temperature = Some(new),
        }
        self.waiting.push(new);
        self.next_location = 1;
        Ok(())
    }

    pub fn data(&mut self, data: &Data) -> Result<(), Box<Fault>> {
        let most = self.most_constants();
        let first = match data.location {
            None => self.next_location,
            Some((location, _)) if location.fract() == 0.0 && (1.0..=most as f64).contains(&location) => {
                location as usize
            }
            Some((location, span)) => {
                let table = self.title();
                let problem = Problem::LocationOutOfRange { location, table, most };
                return Err(Fault::new(problem, span));
            }
        };
        if data.values.is_empty() {
            return Ok(());
        }
        if self.rows.is_empty() || !self.waiting.is_empty() {
            self.begin_row(data.span)?;
        }
        for &(place, value, span) in &data.values {
            let location = first + place;
            if location > most {
                let table = self.title();
                let problem = Problem::TooManyConstants { location, table, most };
                return Err(Fault::new(problem, span));
            }
            if let Some(row) = self.rows.last_mut() {
                if row.constants.len() < location {
                    row.constants.resize(location, None);
                }
                row.constants[location - 1] = Some((value, span));
            }
            self.next_location = location + 1;
        }
        Ok(())
    }

    /// Opens the row at the field values that hold now; the waiting values are thereby used.
    fn begin_row(&mut self, span: Span) -> Result<(), Box<Fault>> {
        let row = Row {
            time: self.time.map(|v| v.value),
            temperature: self.temperature.map(|v| v.value),
            constants: Vec::new(),
            span,
        };
        let waiting = std::mem::take(&mut self.waiting);
        let place = waiting.last().map_or(span, |v| v.span);
        if let (Some(first), Some(last)) = (self.rows.first(), self.rows.last()) {
            if first.variables() != row.variables() {
                let problem = Problem::OtherVariables {
                    found: row.variables().to_owned(),
                    expected: first.variables().to_owned(),
                };
                return Err(Fault::new(problem, place).beside(first.span, "the first constants"));
            }
            if let Some(&earlier) = self.row_at.get(&row.key()) {
                let fault = Fault::new(Problem::Repeats { point: row.point() }, place);
                return Err(fault.beside(self.rows[earlier].span, "the constants there"));
            }
            let time_first = (last.time, last.temperature) < (row.time, row.temperature);
            let temperature_first = (last.temperature, last.time) < (row.temperature, row.time);
            self.ascending[0] &= time_first;
            self.ascending[1] &= temperature_first;
            if self.ascending == [false, false] {
                let lower = |v: &&FieldValue| match v.variable {
                    Variable::Time => last.time > Some(v.value),
                    Variable::Temperature => last.temperature > Some(v.value),
                };
                let back = waiting.iter().find(lower).or(waiting.last());
                if let Some(FieldValue { variable, value, span, .. }) = back {
                    let variable = variable.name().to_owned();
                    let value = *value;
                    return Err(Fault::new(Problem::GoesBack { variable, value }, *span));
                }
            }
        }
        self.row_at.insert(row.key(), self.rows.len());
        self.rows.push(row);
        Ok(())
    }

    pub fn finish(self) -> Result<Finished, Box<Fault>> {
        if let Some(unused) = self.waiting.first() {
            return Err(no_data_at(unused));
        }
        match self.open.option {
            TableOption::Archard => self.finish_archard(),
            TableOption::User => self.finish_user(),
            TableOption::Auto => self.finish_scaling(ScalingKind::Auto),
            TableOption::Cycle => self.finish_scaling(ScalingKind::Cycle),
        }
    }

    fn finish_archard(self) -> Result<Finished, Box<Fault>> {
        self.check_rows(ARCHARD_NAMES.len(), |location| ARCHARD_NAMES[location - 1].to_owned())?;
        let mut first: Option<Controls> = None;
        for row in &self.rows {
            let found = controls(&row.values()).map_err(|error| {
                let location = match error {
                    ControlsError::UndocumentedFlag { .. } => 5,
                    ControlsError::NotFinite { position, .. } => position,
                    _ => 6,
                };
                Fault::new(error, row.span_of(location))
            })?;
            let first = first.get_or_insert(found);
            if !first.same_meaning(&found) {
                let fault = Fault::new(Problem::ControlsDiffer, row.span);
                return Err(fault.beside(self.rows[0].span, "the first row"));
            }
        }
        Ok(Finished::Law {
            option: LawOption::Archard,
            scaled_from: first.and_then(|c| c.direction_before_scaling),
            rows: self.into_rows(),
        })
    }

    fn finish_user(self) -> Result<Finished, Box<Fault>> {
        let highest = self.rows.iter().map(|row| row.constants.len()).max();
        let constants = self.open.constants.or(highest).unwrap_or(0);
        self.check_rows(constants, |_| format!("of {constants} of the law"))?;
        Ok(Finished::Law { option: LawOption::User { constants }, scaled_from: None, rows: self.into_rows() })
    }

    fn finish_scaling(self, kind: ScalingKind) -> Result<Finished, Box<Fault>> {
        let constant = |at: usize, default: f64| {
            let row = self.rows.first();
            let given = row.and_then(|row| row.constants.get(at).copied().flatten());
            given.unwrap_or((default, self.open.span))
        };
        let (safety, safety_span) = constant(0, DEFAULT_SAFETY);
        if !(safety > 0.0 && safety < 1.0) {
            return Err(Fault::new(Problem::Safety { value: safety }, safety_span));
        }
        let (maximum, maximum_span) = constant(1, DEFAULT_MAXIMUM);
        if !(maximum >= 1.0 && maximum.is_finite()) {
            let value = maximum;
            return Err(Fault::new(Problem::Maximum { value }, maximum_span));
        }
        Ok(Finished::Scaling(Scaling { kind, safety, maximum }))
    }

    /// Every row has its first `least` constants, and the rows form a full grid.
    fn check_rows(&self, least: usize, name: impl Fn(usize) -> String) -> Result<(), Box<Fault>> {
        if self.rows.is_empty() && least > 0 {
            let problem = Problem::NoConstants {
                material: self.open.material,
                option: self.open.option.name().to_owned(),
                least,
            };
            return Err(Fault::new(problem, self.open.span));
        }
        for row in &self.rows {
            let given = |location: &usize| matches!(row.constants.get(location - 1), Some(Some(_)));
            if let Some(location) = (1..=least).find(|location| !given(location)) {
                let place = match row.point() {
                    at if at.is_empty() => at,
                    at => format!(" at {at}"),
                };
                let problem = Problem::MissingConstant { location, name: name(location), place };
                return Err(Fault::new(problem, row.span));
            }
        }
        self.check_grid()
    }

    fn check_grid(&self) -> Result<(), Box<Fault>> {
        let distinct = |value: fn(&Row) -> Option<f64>| {
            let mut values: Vec<f64> = self.rows.iter().filter_map(value).collect();
            values.sort_unstable_by(f64::total_cmp);
            values.dedup();
            values
        };
        let times = distinct(|row| row.time);
        let temperatures = distinct(|row| row.temperature);
        if times.is_empty() || temperatures.is_empty() || times.len() * temperatures.len() == self.rows.len() {
            return Ok(());
        }
        let pairs = times.iter().flat_map(|time| temperatures.iter().map(move |t| (*time, *t)));
        for (time, temperature) in pairs {
            let missing =
                Row { time: Some(time), temperature: Some(temperature), constants: Vec::new(), span: self.open.span };
            if !self.row_at.contains_key(&missing.key()) {
                let problem = Problem::IncompleteGrid {
                    missing: missing.point(),
                    times: times.len(),
                    temperatures: temperatures.len(),
                    rows: self.rows.len(),
                };
                return Err(Fault::new(problem, self.open.span));
            }
        }
        Ok(())
    }

    fn into_rows(self) -> Vec<TableRow> {
        self.rows.into_iter().map(TableRow::from).collect()
    }
}

fn no_data_at(unused: &FieldValue) -> Box<Fault> {
    let variable = unused.variable.name().to_owned();
    let value = unused.value;
    Fault::new(Problem::NoDataAtPoint { variable, value }, unused.span)
}
