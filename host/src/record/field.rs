//! Fields over the points at one time.

use std::borrow::Cow;

/// The numbers of a field, borrowed from the solver or owned, as `[point][component]`.
pub type FieldData<'a> = Cow<'a, [f64]>;

/// A named quantity at every point.
#[derive(Debug, Clone, PartialEq)]
pub struct Field<'a> {
    /// Name of the quantity, as in the scene's `output.fields`.
    pub name: String,
    /// Numbers per point: 1 for a scalar, 3 for a vector.
    pub components: usize,
    /// `[point][component]`, the points in the order of their geometry.
    pub data: FieldData<'a>,
    /// Label of the unit.
    pub unit: String,
}

impl<'a> Field<'a> {
    /// A field of one number per point.
    pub fn scalar(name: impl Into<String>, data: impl Into<FieldData<'a>>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), components: 1, data: data.into(), unit: unit.into() }
    }

    /// A field of three numbers per point, `[point][3]`.
    pub fn vector(name: impl Into<String>, data: impl Into<FieldData<'a>>, unit: impl Into<String>) -> Self {
        Self { components: 3, ..Self::scalar(name, data, unit) }
    }

    /// Names of the components where a file has a column for each: `wear`; `slip_x`, `slip_y`,
    /// `slip_z`; else numbered from 0.
    #[must_use]
    pub fn component_names(&self) -> Vec<String> {
        let axes = ["x", "y", "z"];
        match self.components {
            1 => vec![self.name.clone()],
            n @ 2..=3 => axes[..n].iter().map(|axis| format!("{}_{axis}", self.name)).collect(),
            n => (0..n).map(|i| format!("{}_{i}", self.name)).collect(),
        }
    }
}

/// The fields of one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot<'a> {
    /// Represented time.
    pub time: f64,
    /// Number of accepted steps up to this time; it names the files.
    pub step_index: u64,
    /// The fields that the scene asked for, in its order.
    pub fields: Vec<Field<'a>>,
}
