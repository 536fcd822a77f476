//! What will be done: a scene and a law resolved into one immutable plan, with what is left out and why.
//!
//! The plan is made before anything is allocated or evaluated: from the scene, from what the law declares, and from
//! the names (not the values) in a history. Carrying it out is [`crate::solve`]'s business.

mod advance;
mod build;
mod constants;
mod error;
mod loading;
mod machine_memory;
mod material;
mod needs;
mod output;
mod solved;
mod solved_needs;

pub use advance::{Advance, Sample};
pub use build::{Plan, Skipped};
pub use constants::{ConstantTable, Row};
pub use error::{PlanError, PlanProblem};
pub use loading::{Block, Linear, LoadStep};
pub use material::{Material, ScalingPlan};
pub use output::{FieldKind, OutputPlan, ReferencePlan};
pub use solved::{Elastic, Scheme, Slope, SolvedPlan};
