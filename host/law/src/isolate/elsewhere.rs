//! What stands in for isolation on systems that have none of it.

use super::super::batch::{Batch, Outputs};
use super::super::descriptor::LawDescriptor;
use super::super::evaluation::{EvaluateError, Evaluation, Evaluator};
use super::{FindEmbedded, IsolateError, IsolateOptions};

/// A law in a process of its own; never made on this system.
#[derive(Debug)]
pub enum IsolatedLaw {}

impl IsolatedLaw {
    /// Says that this system cannot do it.
    ///
    /// # Errors
    /// Always.
    pub fn open(_options: &IsolateOptions) -> Result<Self, IsolateError> {
        Err(IsolateError::Platform)
    }
}

impl Evaluator for IsolatedLaw {
    fn descriptor(&self) -> &LawDescriptor {
        match *self {}
    }

    fn evaluate(&self, _batch: &Batch<'_>, _outputs: &mut Outputs<'_>) -> Result<Evaluation, EvaluateError> {
        match *self {}
    }

    fn take_warnings(&self) -> Vec<String> {
        match *self {}
    }
}

/// Ends with the exit code of wrong input: there are no workers on this system.
pub fn worker_main(_arguments: &[String], _embedded: FindEmbedded<'_>) -> i32 {
    2
}
