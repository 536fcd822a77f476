//! Readers of a record: the history, the fields and the plot of a run as files that appear whole.
//! Every writer takes plain data and a path; a file is written aside and renamed, so no reader ever
//! meets half of one, and a field goes to its file in pieces, never as a second array.
//! What the numbers mean, the report of a run and anything printed are not here.

pub mod checkpoint;
pub mod csv;
mod error;
mod fields;
mod fit;
mod html;
mod little_endian;
pub mod npz;
pub mod plot;
mod report;
mod study;
pub mod vtk;
pub mod whole;

pub use checkpoint::{CHECKPOINT, EarlierFields, EarlierFile, Keeper, Stored, read_checkpoint, write_checkpoint};
pub use csv::write_history;
pub use error::OutputError;
pub use fields::{FieldFormat, FieldSeries, write_fields};
pub use fit::{FIT_PICTURE, check_fit_folder, write_fit};
pub use html::{RunPage, write_run_page};
pub use plot::{Figure, write_plot};
pub use report::{LawReport, Report, StabilityReport};
pub use study::{STUDY_PICTURE, check_study_folder, write_study};
pub use whole::{WholeFolder, check_folder, earlier_scene, sweep_folder, write_file, write_file_synced};
