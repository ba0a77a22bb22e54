//! Studies of a contact. Each has its own file with its data as written in a scene, its check, its run, its rows, and
//! the conversion of rows into values, tables and charts.
//!
//! A study does not depend on its observer. [`Study::run`] receives an [`Experiment`] (contact and solver settings of
//! the scene), a [`Bench`] (services that it may use) and a [`StudyObserver`]. The observer receives each [`StudyRow`]
//! as soon as it is computed, receives the progress, and may cancel. Everything else is computed from the rows, also
//! while the study is running: [`Study::findings`] returns the values that expectations refer to, [`Study::tables`] the
//! numbers, [`Study::charts`] the charts. A viewer therefore does not depend on the kind of study:
//!
//! ```text
//! struct Window(Mutex<Vec<StudyRow>>);
//! impl StudyObserver for Window { fn row(&self, row: StudyRow) { … push … } }
//! scene.study.run(&scene.experiment(), &mut bench, &window)?;      // on a separate thread
//! scene.study.charts(&rows);  scene.study.tables(&rows);           // meanwhile, with the rows so far
//! scene.outcome(&rows, seconds)                                    // values, verdicts, tables
//! ```
//!
//! [`run_scene`](super::run_scene) does all of this and returns the outcome. To add a study, write a file with a
//! [`Question`] and add a line to the list of studies below.
#![allow(clippy::indexing_slicing, reason = "rows, methods and models of one run: places in lists that it made itself")]

/// Selects the rows of one kind, in order.
macro_rules! only {
    ($rows:expr, $kind:path) => {
        $rows.iter().filter_map(|row| if let $kind(row) = row { Some(row) } else { None }).collect::<Vec<_>>()
    };
}

pub mod amplitude;
pub mod dimensions;
pub mod distance_measure;
pub mod error_measures;
pub mod error_split;
pub mod fit;
pub mod flow_curve;
pub mod formula_comparison;
pub mod grid_study;
pub mod information_loss;
pub mod load_cases;
pub mod measured_film;
pub mod model_sizes;
mod path;
mod pieces;
pub mod plan_comparison;
pub mod point;
mod question;
pub mod random_test;
pub mod sampling_comparison;
pub mod schemes_in_time;
pub mod starvation;
pub mod stationary_profile;
pub mod sweep;
pub mod tolerance_study;
pub mod training;
pub mod trajectory;
pub mod transient;
pub mod transition;
pub mod vibration;

pub use error_measures::OnlineScheme;
pub use error_split::Contacts;
pub use path::{OnModelGrid, PathRow};
pub use plan_comparison::ComparedPlan;
pub use question::{Divisible, Question, Setting, Tell};
pub use sampling_comparison::ComparedSampling;

use super::bench::Bench;
use super::chart::Chart;
use super::check::{Checked, refuse};
use super::error::RunError;
use super::experiment::Experiment;
use super::method::{Method, ModelSource};
use super::outcome::Findings;
use super::table::Table;
use crate::solver::training::{TrainingObserver, TrainingSpec};
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

/// Generates [`Study`] and [`StudyRow`] from a list of studies, and forwards calls to the file of each study.
macro_rules! studies {
    ($($(#[$about:meta])* $name:ident($question:ty),)*) => {
        /// Study of a scene's contact.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub enum Study {
            $($(#[$about])* $name($question),)*
        }

        /// Row of any study. A model in a row is serialised as its file.
        #[derive(Clone, Debug, Serialize, Deserialize)]
        #[expect(clippy::large_enum_variant, reason = "a study has rows of one kind")]
        pub enum StudyRow {
            $(
                #[doc = concat!("Row of [`Study::", stringify!($name), "`].")]
                $name(<$question as Question>::Row),
            )*
        }

        impl Study {
            /// Refuses invalid values, and names the field.
            pub(super) fn check(&self, experiment: &Experiment) -> Checked {
                match self {
                    $(Self::$name(question) => Question::check(question, experiment),)*
                }
            }

            /// Returns the methods that the study uses, in order.
            pub fn methods(&self) -> &[Method] {
                match self {
                    $(Self::$name(question) => question.methods(),)*
                }
            }

            /// Runs the study. The observer receives each row as soon as it is computed. Rows remain valid if the study
            /// ends early.
            ///
            /// # Errors
            /// If something is refused, a model is not available, or the observer cancels. Solves that do not converge
            /// are rows.
            pub fn run(
                &self,
                experiment: &Experiment,
                bench: &mut dyn Bench,
                observer: &dyn StudyObserver,
            ) -> Result<(), RunError> {
                let mut setting = Setting { experiment, bench, observer, wants_states: observer.wants_states() };
                match self {
                    $(Self::$name(question) => question.run(&mut setting, &|row| observer.row(StudyRow::$name(row))),)*
                }
            }

            /// Evaluates rows: values by the names used in expectations, and warnings.
            pub fn findings(&self, experiment: &Experiment, rows: &[StudyRow]) -> Findings {
                let mut found = Findings::default();
                match self {
                    $(Self::$name(question) => question.findings(experiment, &only!(rows, StudyRow::$name), &mut found),)*
                }
                found
            }

            /// Returns the rows so far as tables.
            pub fn tables(&self, rows: &[StudyRow]) -> Vec<Table> {
                match self {
                    $(Self::$name(question) => question.tables(&only!(rows, StudyRow::$name)),)*
                }
            }

            /// Returns charts of the rows so far.
            pub fn charts(&self, rows: &[StudyRow]) -> Vec<Chart> {
                match self {
                    $(Self::$name(question) => question.charts(&only!(rows, StudyRow::$name)),)*
                }
            }
        }
    };
}

studies! {
    /// The contact, solved by one or more methods.
    Point(point::Point),
    /// The contact along one to three varied quantities; the last one varies fastest. Each solve starts from its
    /// neighbour.
    Sweep(sweep::Sweep),
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory(trajectory::Trajectory),
    /// Random validation at points (3.17): failure rate and speed of a method, and errors of a reduced model against
    /// full solutions.
    RandomTest(random_test::RandomTest),
    /// The contact on a sequence of finer uniform grids over the scene's domain: observed order and extrapolated value.
    /// For a point contact, ΔY is constant.
    GridStudy(grid_study::GridStudy),
    /// Number of modes needed by the full solutions at all combinations of one to three varied quantities, for given
    /// losses of information (Table 3.7).
    Dimensions(dimensions::Dimensions),
    /// Error measures (3.10), (3.14), (3.15) of a reduced model at random points (3.17), ordered by the true error
    /// (Fig. 3.1).
    ErrorMeasures(error_measures::ErrorMeasureStudy),
    /// Weights of the distance measure (3.20), determined by (3.9) from full solutions at random points (3.17).
    DistanceMeasure(distance_measure::DistanceMeasure),
    /// Adaptive training evaluated at each tolerance of its ladder (Fig. 3.6).
    ToleranceStudy(tolerance_study::ToleranceStudy),
    /// Methods of sampling equations, with the same full solutions and basis.
    SamplingComparison(sampling_comparison::SamplingComparison),
    /// Table of load cases, one contact per line.
    LoadCases(load_cases::LoadCases),
    /// Full solutions compared with a published film-thickness formula at all pairs of M and L in the default
    /// realisation.
    FormulaComparison(formula_comparison::FormulaComparison),
    /// Film thickness along Y = 0 compared with published measurements or computations.
    MeasuredFilm(measured_film::MeasuredFilm),
    /// Constants of the lubricant fitted to measured film thicknesses and friction coefficients.
    Fit(fit::Fit),
    /// The contact with several inlet film thicknesses (starvation).
    Starvation(starvation::Starvation),
    /// Rough surface z(x) at rest in a line contact.
    StationaryProfile(stationary_profile::StationaryProfile),
    /// Pressure and film thickness for increasing load number, from rigid bodies to the dry contact (Fig. 2.2).
    Transition(transition::Transition),
    /// Amplitude of the film thickness under a wavy surface, over its wavelength.
    Amplitude(amplitude::Amplitude),
    /// Stiffness and damping of the film over frequency and speed.
    Vibration(vibration::Vibration),
    /// Viscosity of the lubricant over shear stress (Fig. 3.10).
    FlowCurve(flow_curve::FlowCurve),
    /// Loss of information over the number of modes for a transient contact, in each frame (Fig. 4.5).
    InformationLoss(information_loss::InformationLoss),
    /// Galerkin scheme, residual minimisation and methods of sampling equations for a transient contact.
    SchemesInTime(schemes_in_time::SchemesInTime),
    /// Error of a reduced model split by source: basis, Galerkin projection, sampled equations, grid.
    ErrorSplit(error_split::ErrorSplitStudy),
    /// Error and time of a reduced model over the numbers of modes and of sampled equations.
    ModelSizes(model_sizes::ModelSizes),
    /// Training of a reduced model.
    Training(TrainingSpec),
    /// Comparison of plans of snapshot selection (Tables 3.2 and 3.3, Figs. 3.3 to 3.5 and 3.7).
    PlanComparison(plan_comparison::PlanComparison),
    /// Transient contact with time-dependent inputs, by the full solver and by models (Figs. 2.6 (right), 4.4, 4.10 to
    /// 4.18).
    Transient(transient::TransientStudy),
}

impl Study {
    /// Refuses heat in a study that does not support it.
    ///
    /// # Errors
    /// Names the field `heat`.
    pub fn check_heat(&self) -> Checked {
        match self {
            Self::Point(_)
            | Self::Sweep(_)
            | Self::RandomTest(_)
            | Self::LoadCases(_)
            | Self::Fit(_)
            | Self::Training(_) => Ok(()),
            // Its own check refuses heat, together with other unsupported settings.
            Self::Transient(_) => Ok(()),
            _ => Err(refuse(
                "heat",
                "is computed by the studies Point, Sweep, RandomTest, LoadCases, Fit and Training only; leave it out, or \
                 use one of them",
            )),
        }
    }

    /// Returns the reduced model whose grid [`Grid::Model`](super::Grid::Model) refers to: the first model of the
    /// study, or the embedded one.
    pub fn grid_model(&self) -> ModelSource {
        self.methods().iter().find_map(Method::model).cloned().unwrap_or_default()
    }
}

/// Observer of a study.
pub trait StudyObserver: TrainingObserver {
    /// Receives each row as soon as it is computed, on any thread.
    fn row(&self, _row: StudyRow) {}

    /// Returns true to receive fields of transient contacts as rows.
    fn wants_states(&self) -> bool {
        false
    }
}

impl StudyObserver for () {}

/// Stops a study from another thread.
impl StudyObserver for AtomicBool {}
