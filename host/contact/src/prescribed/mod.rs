//! Prescribed contact: pressure, motion and whatever else a law reads come from a history file.
//! Here are the two readers (CSV and NPZ), the checks on what they read and the columns they hand out.
//! Not here: deciding which columns are needed (plan) and quadrature in time over them (integrator).

mod assemble;
mod column;
mod csv_file;
mod error;
mod growing;
mod header;
mod history;
mod npz_file;
mod npz_shape;
mod samples;
#[cfg(test)]
mod tests;

pub use column::{Column, Needs};
pub use error::HistoryError;
pub use header::{Header, Layout, Motion};
pub use history::{History, Interval, PointIds};
pub use samples::{ColumnData, ColumnView, RowView, Samples};
