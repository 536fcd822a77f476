//! A call of a law laid out in arrays: what a host would hand over, and room for the answers.

use crate::conformance::sampling::answer::AtPoint;
use crate::conformance::sampling::points::Case;
use crate::law::fields::Shape;
use crate::law::{
    Batch, BatchError, CallNumbers, EvaluateError, Evaluation, Evaluator, Field, Fields, Indices, LawDescriptor,
    OutputItem, Outputs, Values,
};

use super::placed::Placed;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Column {
    Field(Field),
    /// The further input of that place.
    Input(usize),
    State,
    Increment,
    Direction,
    StateEnd,
    DPressure,
}

/// The arrays of one call: every field that the law declares, every further input and the state differ from point to
/// point, constants hold for all.
pub(super) struct Laid {
    numbers: CallNumbers,
    constants: Vec<f64>,
    columns: Vec<Column>,
    placed: Placed,
    indices: Vec<(Field, Vec<i64>)>,
}

/// Numbers that a column has at a point.
fn width(column: Column, law: &LawDescriptor) -> usize {
    match column {
        Column::Field(field) => field.shape().width(),
        Column::State | Column::StateEnd => law.state.len(),
        Column::Direction => 3,
        Column::Input(_) | Column::Increment | Column::DPressure => 1,
    }
}

/// The columns of a call that asks for what a run asks for, and for the derivative if `derived`; no `absent` fields.
fn columns_of(law: &LawDescriptor, absent: Fields, derived: bool) -> Vec<Column> {
    let given = law.fields().iter().filter(|field| !absent.contains(*field) && field.shape() != Shape::Index);
    let mut columns: Vec<Column> = given.map(Column::Field).collect();
    columns.extend((0..law.inputs.len()).map(Column::Input));
    columns.push(Column::Increment);
    if law.writes(OutputItem::Direction) {
        columns.push(Column::Direction);
    }
    if !law.state.is_empty() {
        columns.extend([Column::State, Column::StateEnd]);
    }
    if derived && law.writes(OutputItem::DPressure) {
        columns.push(Column::DPressure);
    }
    columns
}

/// Bytes that a call moves at each point by what the law declares: its fields, further inputs and state in; increment,
/// direction and state out.
pub(super) fn bytes_per_point(law: &LawDescriptor) -> usize {
    let numbers: usize = columns_of(law, Fields::EMPTY, false).iter().map(|column| width(*column, law)).sum();
    let indices = law.fields().iter().filter(|field| field.shape() == Shape::Index).count();
    size_of::<f64>() * (numbers + indices)
}

impl Laid {
    /// Lays out `points` points of a case, without the `absent` fields; asks for the derivative too if `derived`.
    pub(super) fn new(law: &LawDescriptor, case: &Case, points: usize, absent: Fields, derived: bool) -> Self {
        let columns = columns_of(law, absent, derived);
        let lengths: Vec<usize> = columns.iter().map(|column| width(*column, law) * points).collect();
        let mut placed = Placed::new(&lengths);
        for (column, place) in columns.iter().zip(placed.columns()) {
            let width = width(*column, law);
            for (index, values) in place.chunks_exact_mut(width).enumerate() {
                let point = case.point(index);
                match *column {
                    Column::Field(field) => values.copy_from_slice(&point.real(field)[..width]),
                    Column::Input(input) => values[0] = point.inputs[input],
                    Column::State => values.copy_from_slice(&point.state),
                    // Answers are not zero, so that their pages are there before the first call.
                    _ => values.fill(f64::NAN),
                }
            }
        }
        let whole = law.fields().iter().filter(|field| field.shape() == Shape::Index && !absent.contains(*field));
        let indices = whole.map(|field| (field, (0..points).map(|at| case.point(at).index(field)).collect())).collect();
        Self { numbers: case.numbers, constants: case.constants.clone(), columns, placed, indices }
    }

    /// The call, and where its answers go.
    ///
    /// # Errors
    /// A field that the law needs and that was left out.
    pub(super) fn parts<'a>(&'a mut self, law: &'a LawDescriptor) -> Result<(Batch<'a>, Outputs<'a>), BatchError> {
        let points = self.columns.iter().zip(self.placed.columns());
        let points = points.filter(|(column, _)| **column == Column::Increment).map(|(_, place)| place.len()).sum();
        let mut batch = Batch::builder(law, points).numbers(self.numbers).constants(&self.constants);
        let mut outputs = Outputs::new(&mut []);
        let mut inputs = Vec::new();
        for (column, place) in self.columns.iter().zip(self.placed.columns()) {
            match *column {
                Column::Field(field) => batch = batch.field(field, Values::PerPoint(place)),
                Column::Input(_) => inputs.push(Values::PerPoint(place)),
                Column::State => batch = batch.state(Values::PerPoint(place)),
                Column::Increment => outputs.increment = place,
                Column::Direction => outputs.direction = Some(place),
                Column::StateEnd => outputs.state = Some(place),
                Column::DPressure => outputs.d_pressure = Some(place),
            }
        }
        for (field, numbers) in &self.indices {
            batch = batch.indices(*field, Indices::PerPoint(numbers));
        }
        Ok((batch.inputs(&inputs).build()?, outputs))
    }

    /// Calls a law once; what it answered at the first point, unless it wants a shorter substep.
    ///
    /// # Errors
    /// A field that the law needs and that was left out; whatever a call of it can end with.
    pub(super) fn ask(&mut self, law: &dyn Evaluator) -> Result<(Evaluation, AtPoint), AskError> {
        let about = law.descriptor();
        let (batch, mut outputs) = self.parts(about)?;
        let evaluation = law.evaluate(&batch, &mut outputs)?;
        let first = |values: &Option<&mut [f64]>, width: usize| {
            values.as_ref().map_or(Vec::new(), |values| values[..width].to_vec())
        };
        let answer = AtPoint {
            increment: outputs.increment[0],
            direction: first(&outputs.direction, 3),
            state: first(&outputs.state, about.state.len()),
            d_pressure: outputs.d_pressure.as_ref().map(|slopes| slopes[0]),
        };
        Ok((evaluation, answer))
    }
}

/// Why a law gives no answer to a call.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(super) enum AskError {
    #[error(transparent)]
    Batch(#[from] BatchError),
    #[error(transparent)]
    Law(#[from] EvaluateError),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conformance::sampling::points::Point;
    use crate::law::{LawInstance, Plugin, embedded};

    fn archard() -> LawInstance {
        let plugin = Plugin::from_entry(embedded::entry("archard").unwrap()).unwrap();
        plugin.laws()[0].create(None).unwrap()
    }

    fn case(law: &LawDescriptor) -> Case {
        let points = [5e7, 1e8].map(|pressure| {
            let mut point = Point::zero(law);
            point.set(Field::Pressure, 0, pressure);
            point.set(Field::Velocity, 0, 0.2);
            point
        });
        let numbers = CallNumbers { dt: 1.0, ..CallNumbers::default() };
        Case::new(numbers, vec![1e-4, 2e9, 1.0, 1.0], points.to_vec())
    }

    #[test]
    fn the_points_of_a_case_come_again_and_again() {
        let law = archard();
        let mut laid = Laid::new(law.descriptor(), &case(law.descriptor()), 5, Fields::EMPTY, false);
        let (batch, mut outputs) = laid.parts(law.descriptor()).unwrap();
        assert_eq!(law.evaluate(&batch, &mut outputs), Ok(Evaluation::Good));
        let increments = outputs.increment.to_vec();
        assert!((increments[0] / 5e-7 - 1.0).abs() < 1e-15 && increments[1] == 2.0 * increments[0], "{increments:?}");
        assert_eq!(increments[2..4], increments[..2]);
        assert!(outputs.d_pressure.is_none() && increments.len() == 5);
    }

    #[test]
    fn a_call_moves_what_the_law_declares() {
        let law = archard();
        let mut about = law.descriptor().clone();
        assert_eq!(bytes_per_point(&about), 24);
        about.reads = about.reads.with(Field::Normal).with(Field::PointId);
        about.writes = about.writes.with(OutputItem::Direction);
        about.state = about.constants[..2].to_vec();
        about.inputs = about.constants[..1].to_vec();
        assert_eq!(bytes_per_point(&about), 24 + 8 * (3 + 1 + 3 + 2 + 2 + 1));
    }

    #[test]
    fn a_field_that_is_left_out_is_missed() {
        let law = archard();
        let absent = Fields::EMPTY.with(Field::Velocity);
        let mut laid = Laid::new(law.descriptor(), &case(law.descriptor()), 1, absent, true);
        assert!(laid.ask(&law).unwrap_err().to_string().contains("`velocity`"));
        let mut laid = Laid::new(law.descriptor(), &case(law.descriptor()), 1, Fields::EMPTY, true);
        let (evaluation, answer) = laid.ask(&law).unwrap();
        assert_eq!(evaluation, Evaluation::Good);
        assert!(answer.d_pressure.is_some_and(|slope| (slope / 1e-14 - 1.0).abs() < 1e-15), "{answer:?}");
    }
}
