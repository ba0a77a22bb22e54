//! The questions a scene can ask.

use super::{Axis, Method, ModelSource, QuantityBox, TransientStudy};
use crate::solver::physics::contact::FilmFormula;
use crate::solver::reduced::{Norm, ReducedOptions, Sampling};
use crate::solver::training::{Range, TrainingSpec};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What is asked of a scene's contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Study {
    /// The contact itself.
    Point {
        /// How it is solved.
        methods: Vec<Method>,
    },
    /// The contact along one to three varied quantities, the last one fastest; each solve starts from its neighbour.
    Sweep {
        /// What is varied.
        over: Vec<Axis>,
        /// How each point is solved.
        methods: Vec<Method>,
        /// Whether full solves start cold instead.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        cold: bool,
        /// Whether reduced methods are compared with full solutions on the model's own grid: then what the grids differ by is no part of the error.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        compare_on_model_grid: bool,
    },
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory {
        /// The box.
        range: QuantityBox,
        /// Equidistant values of c, both ends counted.
        points: usize,
        /// How each point is solved.
        methods: Vec<Method>,
    },
    /// Random points (3.17): how often a method fails, how fast it is, and how far a reduced model lies from full solutions.
    RandomTest {
        /// Where the points are drawn.
        range: Range,
        /// How many.
        tests: usize,
        /// Seed of the random numbers: the same seed gives the same points.
        seed: u64,
        /// What is tested; a full method starts cold.
        method: Method,
        /// Full solutions on the model's own grid are compared at this many of the points.
        #[serde(default)]
        compare: usize,
    },
    /// Where a reduced model's error comes from: its basis, Galerkin's projection, the sampling of rows, or the grid.
    ErrorSplit {
        /// Where it is split.
        contacts: Contacts,
        /// The reduced model.
        method: Method,
    },
    /// The contact on ever finer uniform grids over the scene's domain: observed order and extrapolated value. A point contact keeps ΔY.
    GridStudy {
        /// Spacings ΔX, falling by one constant factor; at least three.
        dx: Vec<f64>,
    },
    /// How many modes the full solutions at all combinations of one to three varied quantities need at losses of information: Table 3.7.
    Dimensions {
        /// What is varied.
        over: Vec<Axis>,
        /// Losses of information, (2.92) and (2.93).
        losses: Vec<f64>,
    },
    /// Training of a reduced model.
    Training(TrainingSpec),
    /// Error measures (3.10), (3.14), (3.15) of a reduced model at random points (3.17), ordered by the true error: Fig. 3.1.
    ErrorMeasures {
        /// Where the points are drawn.
        range: Range,
        /// How many.
        points: usize,
        /// Seed of the random numbers.
        seed: u64,
        /// The measured model.
        model: ModelSource,
        /// Its online scheme.
        #[serde(default)]
        online: OnlineScheme,
        /// The norm of states and residuals.
        #[serde(default)]
        norm: Norm,
    },
    /// Weights of the distance measure by (3.9) from full solutions at random points (3.17): (3.20).
    DistanceMeasure {
        /// Where the points are drawn.
        range: Range,
        /// How many.
        points: usize,
        /// Seed of the random numbers.
        seed: u64,
    },
    /// Plans of snapshot selection side by side: Tables 3.2 and 3.3, Figs. 3.3 to 3.5 and 3.7.
    PlanComparison {
        /// The plans.
        plans: Vec<ComparedPlan>,
        /// The box of random tests (3.17) and of the trajectory (3.21).
        range: QuantityBox,
        /// Random tests of each.
        tests: usize,
        /// Seed of the random tests.
        seed: u64,
        /// Full solutions are compared at this many of them.
        compare: usize,
        /// Points along the trajectory.
        trajectory: usize,
        /// Online scheme of all of them.
        #[serde(default)]
        online: OnlineScheme,
    },
    /// An adaptive training cut at each tolerance of its ladder: Fig. 3.6.
    ToleranceStudy {
        /// The scene of the training; relative paths refer to this scene's folder.
        training: PathBuf,
        /// The box of random tests (3.17) and of the trajectory (3.21).
        range: QuantityBox,
        /// Points along the trajectory, each with a full solution.
        points: usize,
        /// Random tests of each cut.
        tests: usize,
        /// Seed of the random tests.
        seed: u64,
        /// Online scheme.
        #[serde(default)]
        online: OnlineScheme,
    },
    /// Ways of sampling rows, on the same full solutions and basis.
    SamplingComparison {
        /// The scene of the training; relative paths refer to this scene's folder.
        training: PathBuf,
        /// The ways.
        samplings: Vec<ComparedSampling>,
        /// The box of random tests (3.17).
        range: QuantityBox,
        /// Random tests of each.
        tests: usize,
        /// Seed of the random tests.
        seed: u64,
        /// Full solutions are compared at this many of them.
        compare: usize,
    },
    /// The contact in time, under inputs that vary, in full and by models: Figs. 2.6 (right), 4.4, 4.10 to 4.18.
    Transient(TransientStudy),
    /// Full solutions against a published film formula at all pairs of M and L in the default realisation.
    FormulaComparison {
        /// The formula.
        formula: Formula,
        /// Load numbers.
        m: Vec<f64>,
        /// Lubricant numbers.
        l: Vec<f64>,
    },
}

/// Which contacts a study looks at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Contacts {
    /// The scene's own operating point.
    Here,
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory {
        /// The box.
        range: QuantityBox,
        /// Equidistant values of c, both ends counted.
        points: usize,
    },
}

/// One of the compared plans.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedPlan {
    /// Its name in results.
    pub name: String,
    /// The scene of its training; relative paths refer to this scene's folder.
    pub training: PathBuf,
    /// Failure rate as published \[%\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub published_failure_percent: Option<f64>,
}

/// One of the compared ways of sampling rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedSampling {
    /// Its name in results.
    pub name: String,
    /// How rows are sampled.
    pub sampling: Sampling,
    /// Sampled rows per pressure mode.
    pub rows_per_mode: f64,
    /// Penalty factor γ̄ of the reduced equations.
    pub penalty: f64,
}

/// How a reduced model is solved online.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum OnlineScheme {
    /// The explorer's: exact deformation operator, several starts, continuation.
    #[default]
    Explorer,
    /// The dissertation's: δ̃ in the state, the nearest snapshot by (3.20) as the only start.
    Dissertation,
}

/// A published film formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Formula {
    /// Moes, central film.
    Moes,
    /// Dowson & Higginson, minimum film.
    DowsonHigginson,
    /// Dowson & Toyoda, central film.
    DowsonToyoda,
    /// Hamrock & Dowson, point contact, central film.
    HamrockDowsonCentral,
    /// Hamrock & Dowson, point contact, minimum film.
    HamrockDowsonMinimum,
    /// Nijenbanning, Venner & Moes, point contact, central film.
    NijenbanningVennerMoes,
}

impl Study {
    /// The methods it uses, in order.
    pub fn methods(&self) -> &[Method] {
        match self {
            Self::Point { methods } | Self::Sweep { methods, .. } | Self::Trajectory { methods, .. } => methods,
            Self::RandomTest { method, .. } | Self::ErrorSplit { method, .. } => std::slice::from_ref(method),
            Self::GridStudy { .. }
            | Self::Dimensions { .. }
            | Self::Training(_)
            | Self::FormulaComparison { .. }
            | Self::ErrorMeasures { .. }
            | Self::DistanceMeasure { .. }
            | Self::PlanComparison { .. }
            | Self::ToleranceStudy { .. }
            | Self::SamplingComparison { .. }
            | Self::Transient(_) => &[],
        }
    }

    /// The reduced model whose grid [`Grid::Model`](super::Grid::Model) means: the first one used, else the embedded one.
    pub fn grid_model(&self) -> ModelSource {
        self.methods().iter().find_map(Method::model).cloned().unwrap_or_default()
    }
}

impl OnlineScheme {
    /// The solver's options for it.
    pub fn options(self) -> ReducedOptions {
        match self {
            Self::Explorer => ReducedOptions::default(),
            Self::Dissertation => ReducedOptions::dissertation(),
        }
    }
}

impl Formula {
    /// The solver's name for it.
    pub fn film_formula(self) -> FilmFormula {
        match self {
            Self::Moes => FilmFormula::MoesLine,
            Self::DowsonHigginson => FilmFormula::DowsonHigginson,
            Self::DowsonToyoda => FilmFormula::DowsonToyoda,
            Self::HamrockDowsonCentral => FilmFormula::HamrockDowsonCentral,
            Self::HamrockDowsonMinimum => FilmFormula::HamrockDowsonMinimum,
            Self::NijenbanningVennerMoes => FilmFormula::NijenbanningVennerMoes,
        }
    }
}
