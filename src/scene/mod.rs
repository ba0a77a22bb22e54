//! Scene documents: one contact, one study of it, and the expected results.
//!
//! A [`Scene`] is plain data. The explorer builds, changes and saves it; the engine runs it. [`document`] reads and
//! writes it as RON and reports errors with line and column. [`check`] refuses invalid values and names the field. The
//! [`View`] stores what the explorer needs to open a scene as it was saved. Windows, themes and zoom are not part of a
//! scene.

#![warn(clippy::indexing_slicing)]

pub mod animation;
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
mod csv;
pub mod document;
pub mod drawing;
mod dynamics;
mod error;
pub mod examples;
mod expectation;
mod experiment;
mod extras;
mod field_tables;
mod grid;
mod kept_lubricant;
mod load_cases;
mod measured_data;
mod method;
pub mod named_lubricant;
pub mod names;
mod notice;
mod outcome;
mod parallel;
mod random_points;
pub mod regime;
pub mod regimes;
mod report;
pub(crate) mod ron_message;
mod run;
pub mod sampled;
mod scene_check;
mod statistics;
pub mod study;
mod subsurface;
pub mod table;
mod view;
mod written;

pub use answer::{Answer, Request};
pub use at::At;
pub use axis::{Axis, GradingError, Steps};
pub use bench::{Bench, answer_or_full};
pub use chart::{Area, Band, Chart, ChartAxis, ColorScale, Map, Marks, Note, Series};
pub use chart_page::{Page, drawn};
pub use contact_result::{ContactResult, Effort, HeatFacts, ReducedFacts, ResultJson, contact_columns, result_columns};
pub use contact_row::{ByMethods, ContactRow, RefusedContact, RowStatus};
pub use contact_spec::{
    ContactSpec, Domain, Facts, Field, Measure, MethodName, NotVaried, OilGrade, Refusal, ShearName, ValueError, Words,
};
pub use contact_sweep::{ContactSweep, Swept, SweptContact, Varied, VariedError};
pub use document::{Scene, TrainedModel};
pub use dynamics::ContactDynamics;
pub use error::{Reason, RunError, SceneError, SceneFileError, VERSION};
pub use expectation::{Expectation, Within};
pub use experiment::Experiment;
pub use extras::Extras;
pub use field_tables::{film_shear_table, profile_table};
pub use grid::Grid;
pub use kept_lubricant::KeptLubricant;
pub use load_cases::{CaseTable, CasesError, LineError, LoadCase};
pub use measured_data::{MeasuredError, MeasuredPoint, MeasuredTable, measured_points};
pub use method::{Method, ModelSource};
pub use notice::Notice;
pub use outcome::{Findings, NamedValue, SceneOutcome, Verdict};
pub use report::{Paper, Report, ReportFormat, Stated, profiles};
pub use run::run_scene;
pub use statistics::{median, percentile, rank_correlation};
pub use study::transient::{
    Drive, LinearisedTransient, PublishedMarch, ReducedTransient, SurfaceFeature, SurfaceShape, TransientStudy,
};
pub use study::{ComparedPlan, ComparedSampling, Contacts, OnlineScheme, Study, StudyObserver, StudyRow};
pub use subsurface::{Subsurface, stress_table};
pub use table::{Column, Table};
pub use view::{Held, LoadFollower, LubricantFollower, ShapeKeeps, View};
