//! The questions a scene can ask. There is one file for each: its data as a scene writes them, its check, its run, its
//! rows, and what the rows look like as values, tables and charts.
//!
//! A study does not know who watches it. [`Study::run`] is given an [`Experiment`] (the facts of the scene's contact),
//! a [`Bench`] (what it may use) and a [`StudyObserver`], which is told each [`StudyRow`] as soon as it is known, how
//! far the work is, and whether it is still wanted. Everything else is read off the rows, of a study that has ended or
//! of one that still runs: [`Study::findings`] are the values that expectations name, [`Study::tables`] the numbers,
//! [`Study::charts`] how they are best looked at. So whoever shows a study need not know which one it is:
//!
//! ```text
//! struct Window(Mutex<Vec<StudyRow>>);
//! impl StudyObserver for Window { fn row(&self, row: StudyRow) { … push … } }
//! scene.study.run(&scene.experiment(), &mut bench, &window)?;      // on a thread of its own
//! scene.study.charts(&rows);  scene.study.tables(&rows);           // meanwhile, as often as rows have come
//! scene.outcome(&rows, seconds)                                    // values, verdicts, tables
//! ```
//!
//! [`run_scene`](super::run_scene) does all of it for who only wants the outcome. A new study is a file with a
//! [`Question`], and a line in the list of studies below.
#![allow(clippy::indexing_slicing, reason = "rows, methods and models of one run: places in lists that it made itself")]

/// Of rows of several kinds those of one, in their order.
macro_rules! only {
    ($rows:expr, $kind:path) => {
        $rows.iter().filter_map(|row| if let $kind(row) = row { Some(row) } else { None }).collect::<Vec<_>>()
    };
}

pub mod dimensions;
pub mod distance_measure;
pub mod error_measures;
pub mod error_split;
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
pub mod sweep;
pub mod tolerance_study;
pub mod training;
pub mod trajectory;
pub mod transient;
pub mod transition;

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

/// What is asked of a scene's contact, what comes of it, and how each is handed to the file of its study.
macro_rules! studies {
    ($($(#[$about:meta])* $name:ident($question:ty),)*) => {
        /// What is asked of a scene's contact.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub enum Study {
            $($(#[$about])* $name($question),)*
        }

        /// A row of any study. A model in it is serialised as its file.
        #[derive(Clone, Debug, Serialize, Deserialize)]
        #[expect(clippy::large_enum_variant, reason = "a study has rows of one kind")]
        pub enum StudyRow {
            $(
                #[doc = concat!("What comes of [`Study::", stringify!($name), "`].")]
                $name(<$question as Question>::Row),
            )*
        }

        impl Study {
            /// Refuses a question that makes no sense, naming the field.
            pub(super) fn check(&self, experiment: &Experiment) -> Checked {
                match self {
                    $(Self::$name(question) => Question::check(question, experiment),)*
                }
            }

            /// The methods it uses, in order.
            pub fn methods(&self) -> &[Method] {
                match self {
                    $(Self::$name(question) => question.methods(),)*
                }
            }

            /// Answers the question; the observer is told each row as soon as it is known. What was told is worth
            /// keeping also where it ends early.
            ///
            /// # Errors
            /// When something is refused, a model cannot be had, or the observer cancels. Solves that do not converge
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

            /// What rows say: values by the names that expectations use, and warnings.
            pub fn findings(&self, experiment: &Experiment, rows: &[StudyRow]) -> Findings {
                let mut found = Findings::default();
                match self {
                    $(Self::$name(question) => question.findings(experiment, &only!(rows, StudyRow::$name), &mut found),)*
                }
                found
            }

            /// Rows in numbers, of as many as there are.
            pub fn tables(&self, rows: &[StudyRow]) -> Vec<Table> {
                match self {
                    $(Self::$name(question) => question.tables(&only!(rows, StudyRow::$name)),)*
                }
            }

            /// How rows are best looked at, as many as there are.
            pub fn charts(&self, rows: &[StudyRow]) -> Vec<Chart> {
                match self {
                    $(Self::$name(question) => question.charts(&only!(rows, StudyRow::$name)),)*
                }
            }
        }
    };
}

studies! {
    /// The contact itself.
    Point(point::Point),
    /// The contact along one to three varied quantities, the last one fastest; each solve starts from its neighbour.
    Sweep(sweep::Sweep),
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory(trajectory::Trajectory),
    /// Random points (3.17): how often a method fails, how fast it is, and how far a reduced model lies from full
    /// solutions.
    RandomTest(random_test::RandomTest),
    /// The contact on ever finer uniform grids over the scene's domain: observed order and extrapolated value. A point
    /// contact keeps ΔY.
    GridStudy(grid_study::GridStudy),
    /// How many modes the full solutions at all combinations of one to three varied quantities need at losses of
    /// information: Table 3.7.
    Dimensions(dimensions::Dimensions),
    /// Error measures (3.10), (3.14), (3.15) of a reduced model at random points (3.17), ordered by the true error:
    /// Fig. 3.1.
    ErrorMeasures(error_measures::ErrorMeasureStudy),
    /// Weights of the distance measure by (3.9) from full solutions at random points (3.17): (3.20).
    DistanceMeasure(distance_measure::DistanceMeasure),
    /// An adaptive training cut at each tolerance of its ladder: Fig. 3.6.
    ToleranceStudy(tolerance_study::ToleranceStudy),
    /// Ways of sampling rows, on the same full solutions and basis.
    SamplingComparison(sampling_comparison::SamplingComparison),
    /// A table of load cases, each line a contact of its own.
    LoadCases(load_cases::LoadCases),
    /// Full solutions against a published film formula at all pairs of M and L in the default realisation.
    FormulaComparison(formula_comparison::FormulaComparison),
    /// The contact's film along Y = 0 against films that others measured or computed.
    MeasuredFilm(measured_film::MeasuredFilm),
    /// The contact under supplied films of several thicknesses.
    Starvation(starvation::Starvation),
    /// Pressure and film as the load number grows, from rigid bodies to the dry contact: Fig. 2.2.
    Transition(transition::Transition),
    /// The lubricant's viscosity against shear stress: Fig. 3.10.
    FlowCurve(flow_curve::FlowCurve),
    /// Loss of information against modes of a contact in time, in each frame: Fig. 4.5.
    InformationLoss(information_loss::InformationLoss),
    /// Galerkin's scheme, residual minimisation and ways of sampling rows for a contact in time.
    SchemesInTime(schemes_in_time::SchemesInTime),
    /// Where a reduced model's error comes from: its basis, Galerkin's projection, the sampling of rows, or the grid.
    ErrorSplit(error_split::ErrorSplitStudy),
    /// Error and time of a reduced model against its numbers of modes and of sampled rows.
    ModelSizes(model_sizes::ModelSizes),
    /// Training of a reduced model.
    Training(TrainingSpec),
    /// Plans of snapshot selection side by side: Tables 3.2 and 3.3, Figs. 3.3 to 3.5 and 3.7.
    PlanComparison(plan_comparison::PlanComparison),
    /// The contact in time, under inputs that vary, in full and by models: Figs. 2.6 (right), 4.4, 4.10 to 4.18.
    Transient(transient::TransientStudy),
}

impl Study {
    /// Refuses heat where a study knows none.
    ///
    /// # Errors
    /// Naming the field `heat`.
    pub fn check_heat(&self) -> Checked {
        match self {
            Self::Point(_) | Self::Sweep(_) | Self::RandomTest(_) | Self::LoadCases(_) | Self::Training(_) => Ok(()),
            // Its own check refuses it with what it does not cover besides.
            Self::Transient(_) => Ok(()),
            _ => Err(refuse(
                "heat",
                "is computed by the studies Point, Sweep, RandomTest, LoadCases and Training only; leave it out, or ask \
                 one of them",
            )),
        }
    }

    /// The reduced model whose grid [`Grid::Model`](super::Grid::Model) means: the first one used, else the embedded
    /// one.
    pub fn grid_model(&self) -> ModelSource {
        self.methods().iter().find_map(Method::model).cloned().unwrap_or_default()
    }
}

/// Watches a study.
pub trait StudyObserver: TrainingObserver {
    /// Told of each row as soon as it is known, from whichever thread.
    fn row(&self, _row: StudyRow) {}

    /// Whether rows with fields are wanted of contacts in time.
    fn wants_states(&self) -> bool {
        false
    }
}

impl StudyObserver for () {}

/// Stops a study from another thread.
impl StudyObserver for AtomicBool {}
