//! Everything about loading and calling a wear law.
//!
//! Here are the facts of a library file, the entries a law comes from, its description, the batches it is called with
//! and the checks on what it answers, in this process or in a worker of its own. What a law's inputs are computed
//! from is not here: a caller hands over columns of numbers.

pub mod batch;
pub mod build;
mod checks;
pub mod constants;
pub mod describe;
pub mod descriptor;
pub mod embedded;
pub mod entry;
pub mod evaluation;
pub mod fields;
pub mod file_facts;
pub mod float_env;
pub mod handle;
pub mod isolate;
#[cfg(feature = "layout-check")]
pub mod layout_check;
pub mod loader;
pub mod lookup;
pub mod memory;
mod number_text;
mod streaming;
pub mod table;
pub mod values;

pub use batch::{Batch, BatchBuilder, BatchError, Outputs};
pub use constants::{ConstantsError, GivenConstants};
pub use descriptor::{Degree, LawDescriptor, Quantity};
pub use entry::{Embedded, Entry, LibraryFile};
pub use evaluation::{EvaluateError, Evaluation, Evaluator, NamedValues, PointInputs};
pub use fields::{Claim, Claims, Field, Fields, Flag, Flags, OutputItem, OutputItems};
pub use handle::LawInstance;
pub use isolate::{IsolateError, IsolateOptions, IsolatedLaw, Source};
pub use loader::{Law, LoadError, LoadOptions, Plugin};
pub use values::{CallNumbers, Indices, UnitSizes, Values};

#[cfg(test)]
mod test_laws;
#[cfg(test)]
mod tests;
