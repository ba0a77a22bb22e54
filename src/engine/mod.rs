//! Engine: the workbench with its shared resources, jobs, files, and runs without a window.
//!
//! * [`answer()`] solves a request. [`Workbench`] solves single contacts by any method, stores grids, work space and
//!   models between solves, and is the bench of studies.
//! * [`run_scene`] runs a scene.
//! * [`mod@bench`] is the speed table, [`SavedModel`] reads and writes `.rom` files, [`training_file`] stores
//!   unfinished trainings.
//! * [`campaign`] divides the work of a scene into shards for many processes and machines.

#![warn(clippy::indexing_slicing)]

mod answer;
mod archive;
pub mod arrays;
pub mod bench;
pub mod campaign;
mod checked_file;
pub mod coupled;
mod embedded;
mod grid_accuracy;
pub mod job;
pub mod model_arrays;
pub mod model_file;
pub mod model_snapshots;
pub mod model_text;
pub mod registry;
pub mod results;
mod rom;
pub mod speed;
mod store;
pub mod training_file;
pub mod validation;
mod workbench;

pub use answer::{Solver, answer};
pub use embedded::{Entry, bytes_of, catalogue, embedded, in_time, name_of, named_by};
pub use grid_accuracy::GridAccuracy;
pub use rom::{Catalogue, ModelKind, SavedModel};
pub use store::{Held, Store};
pub use workbench::Workbench;

pub use crate::scene::{
    Answer, ContactResult, Extras, NamedValue, ReducedFacts, Request, RunError as EngineError, SceneOutcome, Table,
    Verdict, contact_columns, film_shear_table, median, percentile, profile_table, rank_correlation, result_columns,
    run_scene, stress_table, table,
};
pub use crate::solver::warning::Warning;
