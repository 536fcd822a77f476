//! Many cases of one scene: which keys take which values, which cases belong to a shard, and the table of what came out.
//!
//! A case is a number and overrides of the scene, so every case is a scene that can be run alone with `--set`. Running
//! cases, and anything printed, is not here.

mod cases;
mod error;
mod shard;
mod table;
mod vary;

pub use cases::{Case, Sweep};
pub use error::SweepError;
pub use shard::Shard;
pub use table::{Found, RESULTS, Row, read_row, write_row, write_table};
pub use vary::Vary;
