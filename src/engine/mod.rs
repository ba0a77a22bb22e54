//! Headless experiments: runs scenes, compares with their expectations, writes tables, CSV and JSON, measures speed.
//!
//! * [`Workbench`] solves single contacts by any method and keeps grids, work space and models between solves.
//! * [`PointReport`] is one result as the command line prints it; its flattened names are what expectations refer to.
//! * [`run_scene`] answers a scene's question; each study has a module of its own.
//! * [`mod@bench`] is the speed table, [`model_file`] the `.rom` format, [`training_file`] keeps unfinished trainings, [`table`] tables and
//!   CSV; [`compare_models`] holds models side by side.
//!
//! Wall time is measured here and nowhere below.

mod answer;
pub mod bench;
mod checked_file;
mod dimension_study;
mod distance_study;
mod error;
mod error_measure_study;
mod formula_comparison;
mod grid_accuracy;
mod grid_study;
pub mod job;
mod model_comparison;
pub mod model_file;
mod outcome;
mod parallel;
mod plan_comparison;
mod random_test;
mod report;
pub mod results;
mod run;
mod sampling_study;
mod series;
mod split_study;
mod statistics;
mod store;
mod stored_matrix;
mod stored_model;
pub mod table;
mod timed_march;
mod tolerance_study;
pub mod training_file;
mod training_study;
mod transient_study;
mod workbench;

pub use answer::{Answer, ReducedFacts, Request};
pub use error::EngineError;
pub use grid_accuracy::GridAccuracy;
pub use model_comparison::{ModelComparison, ModelScore, Spread, compare_models};
pub use outcome::{NamedValue, SceneOutcome, Verdict};
pub use report::{
    GridReport, HertzReport, MoesReport, PointReport, RESULT_COLUMNS, ReducedReport, SiReport, film_shear_table,
    profile_table,
};
pub use run::run_scene;
pub use statistics::{median, percentile, rank_correlation};
pub use store::Store;
pub use table::Table;
pub(crate) use transient_study::{TOO_STEEP, train_linearised};
pub use workbench::Workbench;
