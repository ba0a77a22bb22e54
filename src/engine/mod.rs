//! The bench: what is expensive and shared, jobs, files, and headless experiments.
//!
//! * [`Workbench`] solves single contacts by any method and keeps grids, work space and models between solves: it is the bench of studies.
//! * [`run_scene`] answers a scene's question.
//! * [`mod@bench`] is the speed table, [`model_file`] the `.rom` format, [`training_file`] keeps unfinished trainings.

#![warn(clippy::indexing_slicing)]

pub mod arrays;
pub mod bench;
mod checked_file;
mod grid_accuracy;
pub mod job;
pub mod model_arrays;
pub mod model_file;
pub mod results;
mod store;
mod stored_matrix;
mod stored_model;
pub mod training_file;
mod workbench;

pub use grid_accuracy::GridAccuracy;
pub use store::Store;
pub use workbench::Workbench;

pub use crate::scene::study::transient::TOO_STEEP;
pub use crate::scene::{
    Answer, CONTACT_COLUMNS, ContactResult, NamedValue, RESULT_COLUMNS, ReducedFacts, Request, RunError as EngineError,
    SceneOutcome, Table, Verdict, film_shear_table, median, percentile, profile_table, rank_correlation, run_scene,
    table,
};
