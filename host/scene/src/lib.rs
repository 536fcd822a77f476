//! What was asked: a scene file as typed, validated, plain data, and every error it can hold, with its place.
//! A section of the file is a file here, and it holds both its types and how they are read.
//! What a scene means (which law, which points, which substeps) is the plan's; nothing here opens a file but the scene.

mod bound;
mod constants;
mod contact;
mod document;
pub mod documented;
mod drive;
mod error;
mod geometry;
mod law;
mod loading;
mod method;
mod output;
mod overrides;
mod phrase;
mod place;
mod reader;
mod tree;
mod units;

#[cfg(test)]
mod tests;

pub use bound::Bound;
pub use constants::{Constants, RowShape, TableRow};
pub use contact::{Body, Boundary, Contact, Elasticity, Foundation, HalfSpace, Model, ModelKind, Prescribed};
pub use document::Scene;
pub use drive::{Drive, Field, Sliding};
pub use error::{Problem, SceneError};
pub use geometry::{Grid, Shape, Surface};
pub use law::{Basis, Law, Mode};
pub use loading::{Cycle, Quantity, Step};
pub use method::{Accuracy, BeyondLimit, Integrator, Method, Scaling, ScalingKind, Stop};
pub use output::{Every, Format, Output, Reference, Target};
pub use overrides::Override;
pub use place::{Located, Location};
pub use units::{Sizes, Unit, Units};
