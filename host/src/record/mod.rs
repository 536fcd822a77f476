//! What happened in a run, as plain data: a row of quantities per accepted step, fields at chosen
//! times, where their points lie, and the profiles a plot shows.
//! Nothing here computes physics, and nothing here knows a file format: `solve` fills these types
//! and `output` reads them.
//! Large arrays are borrowed or owned alike, so a field reaches a file without a copy of its own.

mod checkpoint;
mod event;
mod field;
mod fit;
mod geometry;
mod history;
mod identity;
mod profile;
mod run;
mod study;
mod units;

pub use checkpoint::{Checkpoint, CheckpointError};
pub use event::{Event, Nobody, Observer, Wish};
pub use field::{Field, FieldData, Snapshot};
pub use fit::{FitParameter, FitPoint, FitRecord};
pub use geometry::{Geometry, Grid, PointIds, Points};
pub use history::{History, HistoryRow};
pub use identity::{Difference, Identity, LawIdentity};
pub use profile::{Line, Profile};
pub use run::{Cost, ESTIMATED, End, Estimated, MemoryLine, Record, Stability};
pub use study::{
    Case, Cheapest, Clock, Errors, GridError, Kind, Limit, Order, Rung, Status, StudyRecord, Timing, Work, Yardstick,
    YardstickKind,
};
pub use units::Units;
