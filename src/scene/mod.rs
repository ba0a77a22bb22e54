//! The experiment as a document: one contact, one question about it, and what is expected of the answer.
//!
//! A [`Scene`] is plain data. The explorer builds, changes and saves it; the engine runs it; [`document`] reads and
//! writes it as RON with line and column in every error; [`check`] refuses values that make no sense, naming the field.
//! What the explorer needs beyond the experiment to open a scene as it was saved stands in its [`View`]; windows,
//! themes and zoom are not part of it.

#![warn(clippy::indexing_slicing)]

pub mod at;
pub mod atomic_file;
mod axis;
pub mod bench;
pub mod chart;
mod chart_page;
pub mod check;
mod contact_result;
pub mod document;
pub mod drawing;
mod error;
pub mod examples;
mod expectation;
mod experiment;
mod grid;
mod load_cases;
mod method;
pub mod named_lubricant;
mod outcome;
mod parallel;
mod random_points;
pub mod regimes;
mod run;
pub mod sampled;
mod scene_check;
mod sheet;
mod statistics;
mod stored_result;
pub mod study;
pub mod table;
mod view;

pub use at::At;
pub use axis::{Axis, Steps};
pub use bench::{Answer, Bench, ReducedFacts, Request, answer_or_full};
pub use chart::{Band, Chart, ChartAxis, ColorScale, Map, Marks, Note, Series};
pub use chart_page::{Page, drawn};
pub use contact_result::{
    CONTACT_COLUMNS, ContactResult, HeatFacts, RESULT_COLUMNS, film_shear_table, profile_table, result_columns,
};
pub use error::{Reason, RunError, SceneError, SceneFileError, VERSION};
pub use expectation::{Expectation, Within};
pub use experiment::Experiment;
pub use grid::Grid;
pub use load_cases::{CaseTable, CasesError, LoadCase};
pub use method::{Method, ModelSource};
pub use outcome::{Findings, NamedValue, SceneOutcome, Verdict};
pub use run::run_scene;
pub use sheet::{Sheet, Solved};
pub use statistics::{median, percentile, rank_correlation};
pub use study::transient::{Drive, LinearisedTransient, PublishedMarch, ReducedTransient, TransientStudy};
pub use study::{ComparedPlan, ComparedSampling, Contacts, OnlineScheme, Study, StudyObserver, StudyRow};
pub use table::{Column, Table};
pub use view::{Held, LoadFollower, LubricantFollower, View};

pub use crate::solver::training::QuantityBox;

use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant, Sliding};
use crate::solver::training::TrainingSpec;
use serde::{Deserialize, Serialize};

/// How far the α of a scene may lie from the one that a viscosity law determines and still count as the same, rounded.
const ROUNDED_ALPHA: f64 = 1e-3;

/// Whether a field may be left out of the text of a scene.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Use of the model that a scene trains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum TrainedModel {
    /// A file of its own.
    #[default]
    Separate,
    /// Part of the program.
    Embedded,
}

/// An experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of the format, [`VERSION`].
    pub version: u32,
    /// Title for people.
    pub title: String,
    /// Where the experiment comes from: a table, a figure, a paper.
    #[serde(default, skip_serializing_if = "is_default")]
    pub source: String,
    /// Line or point contact.
    #[serde(default)]
    pub contact: ContactKind,
    /// Laws of the lubricant; its constants are part of [`Scene::at`].
    #[serde(default)]
    pub lubricant: Lubricant,
    /// How the film ruptures in full solutions, and in models that are trained from them.
    #[serde(default, skip_serializing_if = "is_default")]
    pub cavitation: Cavitation,
    /// Heat: thermal constants of the oil and of both bodies; without it everything has the inlet's temperature.
    #[serde(default, skip_serializing_if = "is_default")]
    pub heat: Option<Heat>,
    /// The operating point. Studies that bring their own points (trajectory, random test, training) do not use it.
    #[serde(default)]
    pub at: At,
    /// Slide-to-roll ratio SRR.
    #[serde(default, skip_serializing_if = "is_default")]
    pub srr: f64,
    /// Newtonian plateau ratio NPR of a shear-thinning lubricant, in place of its own.
    #[serde(default, skip_serializing_if = "is_default")]
    pub npr: Option<f64>,
    /// Grid of full solutions; a reduced model always uses its own.
    #[serde(default)]
    pub grid: Grid,
    /// The question.
    pub study: Study,
    /// What the answer should be.
    #[serde(default, skip_serializing_if = "is_default")]
    pub expect: Vec<Expectation>,
    /// Whether it takes less than ten seconds of one processor: `run --all --quick` and the tests run those.
    #[serde(default, skip_serializing_if = "is_default")]
    pub quick: bool,
    /// Whether some of its solves are meant to fail. Without this, or an expectation that admits failures, a solve that
    /// fails lets the scene fall short.
    #[serde(default, skip_serializing_if = "is_default")]
    pub failures_expected: bool,
    /// Use of the model that the scene trains. `run --all` runs a scene that trains an embedded model only if it is named.
    #[serde(default, skip_serializing_if = "is_default")]
    pub training: TrainedModel,
    /// What the explorer keeps with it; results do not depend on it.
    #[serde(default, skip_serializing_if = "is_default")]
    pub view: Option<View>,
}

impl Scene {
    /// A scene that solves one contact in its default realisation, in full and by the embedded model.
    pub fn at_moes(m: f64, l: f64) -> Self {
        Self {
            version: VERSION,
            title: format!("Line contact at M = {m}, L = {l}"),
            source: String::new(),
            contact: ContactKind::Line,
            lubricant: Lubricant::default(),
            cavitation: Cavitation::default(),
            heat: None,
            at: At::moes(m, l),
            srr: 0.0,
            npr: None,
            grid: Grid::Graded,
            study: Study::Point(study::point::Point { methods: vec![Method::Full, Method::EMBEDDED] }),
            expect: Vec::new(),
            quick: false,
            failures_expected: false,
            training: TrainedModel::Separate,
            view: None,
        }
    }

    /// The operating point in SI units.
    ///
    /// # Errors
    /// When it is outside any sense, or more is fixed than M and L leave free.
    pub fn point(&self) -> Result<OperatingPoint, ContactError> {
        self.at.with_alpha_of(&self.lubricant).point(self.contact)
    }

    /// A sentence where the scene's own α has no effect: the viscosity law determines another one.
    pub fn unused_alpha(&self) -> Option<String> {
        let own = self.lubricant.own_coefficient()?;
        let given = match self.at {
            At::Si { alpha, .. } => alpha,
            At::Moes { alpha, .. } => alpha?,
        };
        let contradicts = (given / own - 1.0).abs() > ROUNDED_ALPHA;
        contradicts.then(|| {
            format!(
                "the alpha of `at`, {given:.4e} 1/Pa, has no effect: the lubricant's viscosity law has {own:.4e} 1/Pa"
            )
        })
    }

    /// What its study is about.
    pub fn experiment(&self) -> Experiment {
        Experiment {
            contact: self.contact,
            lubricant: self.laws(),
            at: self.at,
            sliding: self.sliding(),
            grid: self.grid,
            grid_model: self.study.grid_model(),
            expected: self.expect.iter().map(|expectation| expectation.name.clone()).collect(),
        }
    }

    /// The training that it describes, of films that rupture as the scene says; none where it asks something else.
    pub fn training(&self) -> Option<TrainingSpec> {
        match &self.study {
            Study::Training(spec) => Some(spec.clone().under(self.cavitation).heated(self.heat)),
            _ => None,
        }
    }

    /// The laws of the lubricant, with the way its film ruptures and heat.
    pub fn laws(&self) -> Lubricant {
        Lubricant { cavitation: self.cavitation, heat: self.heat, ..self.lubricant }
    }

    /// Takes over laws, with the way the film ruptures and heat.
    pub fn set_laws(&mut self, laws: Lubricant) {
        (self.cavitation, self.heat) = (laws.cavitation, laws.heat);
        self.lubricant = Lubricant { cavitation: Cavitation::default(), heat: None, ..laws };
    }

    /// The sliding and the plateau ratio.
    pub fn sliding(&self) -> Sliding {
        Sliding { slide_to_roll_ratio: self.srr, newtonian_plateau_ratio: self.npr }
    }
}
