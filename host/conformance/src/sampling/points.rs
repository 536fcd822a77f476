//! The points of a call as plain numbers, before they are laid out in columns.

use serde::{Deserialize, Serialize};

use wearlaw_law::fields::Shape;
use wearlaw_law::{CallNumbers, Field, LawDescriptor};

/// Real fields of the ABI: the first in the order of the bits.
pub const REALS: usize = 17;

/// The inputs at one point; everything has a value, whether the law asks for it or not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    real: [[f64; 3]; REALS],
    index: [i64; 3],
    /// Further inputs of the law.
    pub inputs: Vec<f64>,
    /// State variables at the start.
    pub state: Vec<f64>,
}

/// The place of a field among all: they are declared in that order.
fn place(field: Field) -> usize {
    field as usize
}

impl Point {
    /// A point at which everything is zero.
    pub fn zero(law: &LawDescriptor) -> Self {
        let (inputs, state) = (vec![0.0; law.inputs.len()], vec![0.0; law.state.len()]);
        Self { real: [[0.0; 3]; REALS], index: [0; 3], inputs, state }
    }

    /// The components of a real field; a scalar is the first.
    pub fn real(&self, field: Field) -> [f64; 3] {
        self.real.get(place(field)).copied().unwrap_or_default()
    }

    /// A scalar field.
    pub fn scalar(&self, field: Field) -> f64 {
        self.real(field)[0]
    }

    /// An integer field.
    pub fn index(&self, field: Field) -> i64 {
        place(field).checked_sub(REALS).and_then(|at| self.index.get(at)).copied().unwrap_or_default()
    }

    /// Sets a component of a real field.
    pub fn set(&mut self, field: Field, component: usize, value: f64) {
        if let Some(place) = self.real.get_mut(place(field)).and_then(|vector| vector.get_mut(component)) {
            *place = value;
        }
    }

    /// Sets a vector field.
    pub fn set_vector(&mut self, field: Field, value: [f64; 3]) {
        for (component, value) in value.into_iter().enumerate() {
            self.set(field, component, value);
        }
    }

    /// Sets an integer field.
    pub fn set_index(&mut self, field: Field, value: i64) {
        if let Some(place) = place(field).checked_sub(REALS).and_then(|at| self.index.get_mut(at)) {
            *place = value;
        }
    }

    /// Multiplies all components of a field.
    pub fn scale(&mut self, field: Field, factor: f64) {
        self.set_vector(field, self.real(field).map(|value| value * factor));
    }
}

/// One call: numbers, constants and points; point i is `points[i % points.len()]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// Times, numbers and units of the call.
    pub numbers: CallNumbers,
    /// Constants that hold at every point.
    pub constants: Vec<f64>,
    /// Constants of each point, where they differ.
    pub constants_at: Option<Vec<Vec<f64>>>,
    /// Different points, at least one.
    pub points: Vec<Point>,
    /// Number of points.
    pub count: usize,
}

impl Case {
    /// A call of these points.
    pub fn new(numbers: CallNumbers, constants: Vec<f64>, points: Vec<Point>) -> Self {
        let count = points.len();
        Self { numbers, constants, constants_at: None, points, count }
    }

    /// The inputs at a point.
    pub fn point(&self, index: usize) -> &Point {
        &self.points[index % self.points.len()]
    }

    /// The constants at a point.
    pub fn constants(&self, index: usize) -> &[f64] {
        match &self.constants_at {
            Some(each) if !each.is_empty() => &each[index % each.len()],
            _ => &self.constants,
        }
    }

    /// The same call with other points, by their indices.
    pub fn pick(&self, indices: &[usize]) -> Self {
        let points: Vec<Point> = indices.iter().map(|index| self.point(*index).clone()).collect();
        let constants_at =
            self.constants_at.is_some().then(|| indices.iter().map(|index| self.constants(*index).to_vec()).collect());
        Self { constants_at, count: points.len(), points, ..self.clone_numbers() }
    }

    /// One point alone, with its own constants as the call's.
    pub fn single(&self, index: usize) -> Self {
        let constants = self.constants(index).to_vec();
        Self {
            constants,
            constants_at: None,
            points: vec![self.point(index).clone()],
            count: 1,
            ..self.clone_numbers()
        }
    }

    /// The same points over and over, `count` in all.
    pub fn repeated(&self, count: usize) -> Self {
        Self { count, ..self.clone() }
    }

    /// The same call with its points changed.
    pub fn map(&self, mut change: impl FnMut(&mut Point)) -> Self {
        let mut case = self.clone();
        case.points.iter_mut().for_each(&mut change);
        case
    }

    fn clone_numbers(&self) -> Self {
        Self {
            numbers: self.numbers,
            constants: self.constants.clone(),
            constants_at: None,
            points: Vec::new(),
            count: 0,
        }
    }

    /// The inputs at a point by name, as a report shows them: what the law reads, constants, `dt`, and absolute zero where
    /// it is not at 0.
    pub fn named(&self, law: &LawDescriptor, index: usize) -> Vec<(String, String)> {
        if self.count == 0 || self.points.is_empty() {
            return vec![("points".to_owned(), "0".to_owned())];
        }
        let point = self.point(index);
        let mut named = Vec::new();
        for field in law.fields().iter() {
            let value = match (field.shape(), field.shape().width()) {
                (Shape::Index, _) => point.index(field).to_string(),
                (_, 3) => vector_text(point.real(field)),
                _ => number_text(point.scalar(field)),
            };
            named.push((field.name().to_owned(), value));
        }
        let values = self.constants(index).iter().chain(&point.inputs);
        for (quantity, value) in law.constants.iter().chain(&law.inputs).zip(values) {
            named.push((quantity.name.clone(), number_text(*value)));
        }
        for (variable, value) in law.state.iter().zip(&point.state) {
            named.push((format!("{} (start)", variable.name), number_text(*value)));
        }
        named.push(("dt".to_owned(), number_text(self.numbers.dt)));
        if self.numbers.absolute_zero != 0.0 {
            named.push(("absolute_zero".to_owned(), number_text(self.numbers.absolute_zero)));
        }
        named
    }
}

/// A number with as few digits as read back to the same.
pub fn number_text(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e6).contains(&size) || !value.is_finite() {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A vector of such numbers.
pub fn vector_text(vector: [f64; 3]) -> String {
    let [x, y, z] = vector.map(number_text);
    format!("({x}, {y}, {z})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integer_fields_are_the_last() {
        for (at, field) in Field::ALL.iter().enumerate() {
            assert_eq!(field.shape() == Shape::Index, at >= REALS, "{}", field.name());
        }
        assert_eq!(Field::ALL.len(), REALS + 3);
    }

    #[test]
    fn numbers_read_back_to_the_same() {
        for value in [0.0, -0.0, 0.1, 5e7, -1e-12, 5e-324, f64::MAX, 123456.789, 2.0_f64.sqrt() * 1e9] {
            assert_eq!(number_text(value).parse::<f64>().unwrap().to_bits(), value.to_bits(), "{value}");
        }
        assert_eq!(number_text(f64::NAN), "NaN");
    }
}
