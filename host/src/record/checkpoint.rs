//! What a run has to know to go on where it was.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::{Cost, FieldData, History};

/// A moment of a run between two steps: everything that the rest of it depends on, to the bit.
///
/// What a solver keeps has names, so that files of it outlive a change of its order. Numbers are in the scene's units,
/// arrays are over the points as the solver lays them out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint<'a> {
    /// Represented time.
    pub time: f64,
    /// The rows so far.
    pub history: Cow<'a, History>,
    /// What was warned of so far.
    pub warnings: Cow<'a, [String]>,
    /// What the law or its process had to say beside its answers.
    pub asides: Cow<'a, [String]>,
    /// What it has cost so far.
    pub cost: Cost,
    /// Single numbers by name.
    pub numbers: BTreeMap<String, f64>,
    /// Arrays by name.
    pub arrays: BTreeMap<String, FieldData<'a>>,
}

/// A checkpoint that a run cannot go on from.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// A number or an array is not there.
    #[error("the checkpoint has no `{name}`, expected one of a run of this kind")]
    Missing {
        /// Its name.
        name: String,
    },
    /// An array of another size.
    #[error("`{name}` in the checkpoint holds {found} numbers, expected {expected}")]
    Length {
        /// Its name.
        name: String,
        /// Numbers in the checkpoint.
        found: usize,
        /// Numbers that the run needs.
        expected: usize,
    },
    /// A place in the loading that the scene does not have.
    #[error("the checkpoint is at {found}, expected a place in the scene's loading")]
    Place {
        /// The place, in words.
        found: String,
    },
}

impl<'a> Checkpoint<'a> {
    /// Notes a number.
    pub fn set(&mut self, name: &str, value: f64) {
        self.numbers.insert(name.to_owned(), value);
    }

    /// Notes an array, borrowed or owned.
    pub fn put(&mut self, name: &str, data: impl Into<FieldData<'a>>) {
        self.arrays.insert(name.to_owned(), data.into());
    }

    /// A number by its name.
    ///
    /// # Errors
    /// `Missing`.
    pub fn number(&self, name: &str) -> Result<f64, CheckpointError> {
        self.numbers.get(name).copied().ok_or_else(|| CheckpointError::Missing { name: name.to_owned() })
    }

    /// An array by its name.
    ///
    /// # Errors
    /// `Missing`.
    pub fn array(&self, name: &str) -> Result<&[f64], CheckpointError> {
        self.arrays.get(name).map(|data| &data[..]).ok_or_else(|| CheckpointError::Missing { name: name.to_owned() })
    }

    /// Copies an array into one of the same length.
    ///
    /// # Errors
    /// `Missing`, or `Length` where the lengths differ.
    pub fn copy(&self, name: &str, to: &mut [f64]) -> Result<(), CheckpointError> {
        let from = self.array(name)?;
        if from.len() != to.len() {
            return Err(CheckpointError::Length { name: name.to_owned(), found: from.len(), expected: to.len() });
        }
        to.copy_from_slice(from);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_there_or_of_another_size_is_named() {
        let mut checkpoint = Checkpoint::default();
        checkpoint.set("at", 2.5);
        checkpoint.put("wear", vec![1.0, 2.0]);
        assert_eq!(checkpoint.number("at").unwrap(), 2.5);
        let missing = checkpoint.number("to").unwrap_err().to_string();
        assert!(missing.contains("no `to`"), "{missing}");
        let short = checkpoint.copy("wear", &mut [0.0; 3]).unwrap_err().to_string();
        assert!(short.contains("`wear`") && short.contains("2 numbers, expected 3"), "{short}");
    }
}
