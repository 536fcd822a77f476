//! The points of one surface under a law: where its columns are, its constants, its state variables.

use std::sync::Arc;

use wearlaw::law::constants::nearest;
use wearlaw::law::fields::Shape;
use wearlaw::law::{BatchError, ConstantsError, Field, GivenConstants, LawDescriptor};
use wearlaw::plan::{ConstantTable, Row};

use crate::boundary::count;
use crate::columns::Column;
use crate::error::HostError;
use crate::handle::Kind;
use crate::law::OpenLaw;

/// The points of a surface; one thread uses it at a time.
pub(crate) struct Surface {
    pub(crate) law: Arc<OpenLaw>,
    pub(crate) points: usize,
    pub(crate) reals: [Option<Column<f64>>; Field::ALL.len()],
    pub(crate) integers: [Option<Column<i64>>; Field::ALL.len()],
    pub(crate) inputs: Vec<Option<Column<f64>>>,
    /// Until some are set, the defaults, if there is one for each.
    pub(crate) constants: Result<ConstantTable, ConstantsError>,
    /// State variables at the start and at the end of the substep `[points][variables]`.
    pub(crate) start: Vec<f64>,
    pub(crate) end: Vec<f64>,
    /// Variables that have no initial value and were not set.
    pub(crate) without_start: Option<String>,
    /// Whether `end` is what a good evaluation gave.
    pub(crate) may_commit: bool,
    /// Constants of the points, where they depend on temperature `[constants][points]`.
    pub(crate) room: Vec<f64>,
}

impl Kind for Surface {
    const MAGIC: u64 = u64::from_ne_bytes(*b"wl_surf1");
    const NAME: &'static str = "surface";
}

impl Surface {
    /// A surface with nothing set.
    ///
    /// # Errors
    /// There is no memory for the state variables.
    pub(crate) fn new(law: Arc<OpenLaw>, points: usize) -> Result<Surface, HostError> {
        let descriptor = law.evaluator.descriptor();
        let units = law.numbers.units;
        let defaults = descriptor.resolve_constants(GivenConstants::ByPosition(&[]), units);
        let row = |constants| ConstantTable::new(&[Row { time: None, temperature: None, constants }]);
        let initial: Vec<f64> = descriptor
            .state
            .iter()
            .map(|variable| variable.default.unwrap_or(f64::NAN) / units.factor(variable.exponents))
            .collect();
        let missing = descriptor.state.iter().find(|variable| variable.default.is_none());
        let mut start = room(points, initial.len())?;
        (0..points).for_each(|_| start.extend_from_slice(&initial));
        let mut end = room(points, initial.len())?;
        end.resize(start.len(), f64::NAN);
        Ok(Surface {
            points,
            reals: [None; Field::ALL.len()],
            integers: [None; Field::ALL.len()],
            inputs: vec![None; descriptor.inputs.len()],
            constants: defaults.map(row),
            end,
            start,
            without_start: missing.map(|variable| variable.name.clone()),
            may_commit: false,
            room: Vec::new(),
            law,
        })
    }

    pub(crate) fn descriptor(&self) -> &LawDescriptor {
        self.law.evaluator.descriptor()
    }

    /// The law's constants at each time and temperature of a grid; `times` and `temperatures` are empty for no axis.
    pub(crate) fn set_constants(
        &mut self,
        names: Option<&[&str]>,
        values: &[f64],
        times: &[f64],
        temperatures: &[f64],
        count: usize,
    ) -> Result<(), HostError> {
        rising("wlh_constants.times", times)?;
        rising("wlh_constants.temperatures", temperatures)?;
        let expected = count.saturating_mul(times.len().max(1)).saturating_mul(temperatures.len().max(1));
        if values.len() != expected {
            return Err(HostError::Number {
                what: "wlh_constants.value_count".to_owned(),
                found: values.len().to_string(),
                expected: format!("{expected}, `count` values for each time and temperature"),
            });
        }
        let axis = |points: &[f64]| match points {
            [] => vec![None],
            points => points.iter().copied().map(Some).collect::<Vec<_>>(),
        };
        let (times, temperatures) = (axis(times), axis(temperatures));
        let places = times.iter().flat_map(|time| temperatures.iter().map(move |temperature| (*time, *temperature)));
        let mut rows = Vec::new();
        for (index, (time, temperature)) in places.enumerate() {
            let given = &values[count * index..count * (index + 1)];
            let constants = self.row(names, given).map_err(|source| match expected == count {
                true => HostError::Constants(source),
                false => HostError::Row { row: index + 1, source },
            })?;
            rows.push(Row { time, temperature, constants });
        }
        self.constants = Ok(ConstantTable::new(&rows));
        self.may_commit = false;
        Ok(())
    }

    fn row(&self, names: Option<&[&str]>, values: &[f64]) -> Result<Vec<f64>, ConstantsError> {
        let (law, units) = (self.descriptor(), self.law.numbers.units);
        match names {
            Some(names) => {
                let pairs: Vec<(String, f64)> =
                    names.iter().zip(values).map(|(name, value)| ((*name).to_owned(), *value)).collect();
                law.resolve_constants(GivenConstants::ByName(&pairs), units)
            }
            None => {
                let given: Vec<Option<f64>> = values.iter().copied().map(Some).collect();
                law.resolve_constants(GivenConstants::ByPosition(&given), units)
            }
        }
    }

    /// Whether the solver has said that it provides a field.
    fn said(&self, field: Field) -> Result<(), HostError> {
        if self.law.provides.contains(field) { Ok(()) } else { Err(HostError::NotSaid { field: field.name() }) }
    }

    /// Puts an array of reals in the place of a field; NULL takes it away.
    pub(crate) fn set_reals(&mut self, field: Field, array: (*const f64, i64, i64)) -> Result<(), HostError> {
        self.said(field)?;
        let width = match field.shape() {
            Shape::Scalar => 1,
            Shape::Vector => 3,
            Shape::Index => return Err(kind(field, "reals", "integers", "wlh_set_index_field")),
        };
        self.reals[field as usize] = Column::new(array, width, self.points, field.name())?;
        self.may_commit = false;
        Ok(())
    }

    /// Puts an array of integers in the place of a field; NULL takes it away.
    pub(crate) fn set_integers(&mut self, field: Field, array: (*const i64, i64, i64)) -> Result<(), HostError> {
        self.said(field)?;
        if field.shape() != Shape::Index {
            return Err(kind(field, "integers", "reals", "wlh_set_field"));
        }
        self.integers[field as usize] = Column::new(array, 1, self.points, field.name())?;
        self.may_commit = false;
        Ok(())
    }

    /// Puts an array of reals in the place of a further input that the law declares by name.
    pub(crate) fn set_input(&mut self, name: &str, array: (*const f64, i64, i64)) -> Result<(), HostError> {
        let law = self.descriptor();
        let Some(index) = law.inputs.iter().position(|input| input.name == name) else {
            return Err(HostError::UnknownInput {
                law: law.name.clone(),
                name: name.to_owned(),
                nearest: nearest(name, &law.inputs),
                known: law.inputs.iter().map(|input| input.name.clone()).collect(),
            });
        };
        self.inputs[index] = Column::new(array, 1, self.points, name)?;
        self.may_commit = false;
        Ok(())
    }

    /// State variables at the start of the substep `[points][variables]`.
    ///
    /// # Errors
    /// The caller's room is not as long, or some have no initial value and were not set.
    pub(crate) fn state(&self, room: i64) -> Result<&[f64], HostError> {
        self.has_length(count("length", room)?)?;
        self.has_start().map(|()| self.start.as_slice())
    }

    fn has_length(&self, found: usize) -> Result<(), HostError> {
        let expected = self.start.len();
        if found == expected {
            Ok(())
        } else {
            Err(BatchError::Length { field: "state".to_owned(), found, expected }.into())
        }
    }

    /// Sets [`Surface::state`].
    pub(crate) fn set_state(&mut self, values: &[f64]) -> Result<(), HostError> {
        self.has_length(values.len())?;
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            let variable = &self.descriptor().state[index % self.descriptor().state.len()].name;
            return Err(HostError::Number {
                what: format!("`{variable}` of point {}", index / self.descriptor().state.len()),
                found: values[index].to_string(),
                expected: "a finite number".to_owned(),
            });
        }
        self.start.copy_from_slice(values);
        (self.without_start, self.may_commit) = (None, false);
        Ok(())
    }

    pub(crate) fn has_start(&self) -> Result<(), HostError> {
        match &self.without_start {
            Some(variable) if self.points > 0 => Err(HostError::NotSet {
                law: self.descriptor().name.clone(),
                name: variable.clone(),
                remedy: "the state variable has no initial value, give one by wlh_set_state".to_owned(),
            }),
            _ => Ok(()),
        }
    }

    /// The end of the substep becomes the start of the next.
    pub(crate) fn commit(&mut self) -> Result<(), HostError> {
        if !self.may_commit {
            return Err(HostError::NothingToCommit);
        }
        std::mem::swap(&mut self.start, &mut self.end);
        self.may_commit = false;
        Ok(())
    }

    /// Forgets the end of the substep.
    pub(crate) fn roll_back(&mut self) {
        self.may_commit = false;
    }
}

/// Memory for state variables.
fn room(points: usize, variables: usize) -> Result<Vec<f64>, HostError> {
    let mut room = Vec::new();
    let reserved = room.try_reserve_exact(points.saturating_mul(variables));
    reserved.map(|()| room).map_err(|_| HostError::Number {
        what: "points".to_owned(),
        found: points.to_string(),
        expected: format!("so many that memory holds {variables} state variables of each, twice"),
    })
}

fn kind(field: Field, found: &'static str, expected: &'static str, function: &'static str) -> HostError {
    HostError::Kind { field: field.name(), found, expected, function }
}

fn rising(what: &str, axis: &[f64]) -> Result<(), HostError> {
    let wrong = |index: usize, expected: &str| HostError::Number {
        what: format!("`{what}[{index}]`"),
        found: axis[index].to_string(),
        expected: expected.to_owned(),
    };
    if let Some(index) = axis.iter().position(|point| !point.is_finite()) {
        return Err(wrong(index, "a finite number"));
    }
    match axis.windows(2).position(|pair| pair[0] >= pair[1]) {
        Some(index) => Err(wrong(index + 1, &format!("a number above the one before, {}", axis[index]))),
        None => Ok(()),
    }
}
