//! The experiment as a document: one contact, one question about it, and what is expected of the answer.
//!
//! A [`Scene`] is plain data. The explorer builds, changes and saves it; the engine runs it; [`document`] reads and
//! writes it as RON with line and column in every error; [`check`] refuses values that make no sense, naming the field.
//! What the explorer needs beyond the experiment to open a scene as it was saved stands in its [`View`]; windows,
//! themes and zoom are not part of it.

#![warn(clippy::indexing_slicing)]

mod answer;
pub mod at;
pub mod atomic_file;
mod axis;
pub mod bench;
pub mod chart;
mod chart_page;
pub mod check;
mod contact_result;
mod contact_row;
mod contact_spec;
mod contact_sweep;
pub mod document;
pub mod drawing;
mod error;
pub mod examples;
mod expectation;
mod experiment;
mod field_tables;
mod grid;
mod load_cases;
mod method;
pub mod named_lubricant;
pub mod names;
mod notice;
mod outcome;
mod parallel;
mod random_points;
pub mod regimes;
mod run;
pub mod sampled;
mod scene_check;
mod sheet;
mod statistics;
pub mod study;
pub mod table;
mod view;
mod written;

pub use answer::{Answer, Request};
pub use at::At;
pub use axis::{Axis, GradingError, Steps};
pub use bench::{Bench, answer_or_full};
pub use chart::{Band, Chart, ChartAxis, ColorScale, Map, Marks, Note, Series};
pub use chart_page::{Page, drawn};
pub use contact_result::{ContactResult, Effort, HeatFacts, ReducedFacts, ResultJson, contact_columns, result_columns};
pub use contact_row::{ByMethods, ContactRow, RefusedContact, RowStatus};
pub use contact_spec::{
    ContactSpec, Domain, Facts, Field, Measure, MethodName, NotVaried, OilGrade, Refusal, ShearName, ValueError, Words,
};
pub use contact_sweep::{ContactSweep, Swept, SweptContact, Varied, VariedError};
pub use document::{Scene, TrainedModel};
pub use error::{Reason, RunError, SceneError, SceneFileError, VERSION};
pub use expectation::{Expectation, Within};
pub use experiment::Experiment;
pub use field_tables::{film_shear_table, profile_table};
pub use grid::Grid;
pub use load_cases::{CaseTable, CasesError, LineError, LoadCase};
pub use method::{Method, ModelSource};
pub use notice::Notice;
pub use outcome::{Findings, NamedValue, SceneOutcome, Verdict};
pub use run::run_scene;
pub use sheet::Sheet;
pub use statistics::{median, percentile, rank_correlation};
pub use study::transient::{Drive, LinearisedTransient, PublishedMarch, ReducedTransient, TransientStudy};
pub use study::{ComparedPlan, ComparedSampling, Contacts, OnlineScheme, Study, StudyObserver, StudyRow};
pub use table::{Column, Table};
pub use view::{Held, LoadFollower, LubricantFollower, View};
