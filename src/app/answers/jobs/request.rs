//! What is asked of the worker, and what comes back.

use crate::app::document::Key;
use crate::engine::{Answer, Store};
use crate::scene::Grid;
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec, PointGridSpec};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::ReducedModel;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a full solve is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum JobKind {
    /// The live picture where no reduced model serves.
    Live,
    /// The same contact on the grid that was chosen, after a live picture on a quick one.
    Refine,
    /// The check of a picture.
    Verify,
    /// The same contact on a second grid, to estimate what the first one costs.
    Estimate,
}

impl JobKind {
    /// How many kinds there are.
    pub const COUNT: usize = Self::Estimate as usize + 1;

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Live => "Full solve for the picture",
            Self::Refine => "Full solve on the chosen grid",
            Self::Verify => "Verification by a full solve",
            Self::Estimate => "Full solve on a second grid",
        }
    }
}

/// The grid of a solve: one that exists, or one to build.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "Stated", into = "Stated")]
pub enum GridChoice {
    /// A reduced model's own grid.
    Existing(ContactGrid),
    /// The same, to build.
    OfModel(GridSpec),
    Spec(GridSpec),
}

/// The same as another instance of the program gets it, which has grids of its own.
#[derive(Serialize, Deserialize)]
struct Stated {
    of_model: bool,
    spec: GridSpec,
}

impl From<GridChoice> for Stated {
    fn from(choice: GridChoice) -> Self {
        Self { of_model: !matches!(choice, GridChoice::Spec(_)), spec: choice.spec() }
    }
}

impl From<Stated> for GridChoice {
    fn from(Stated { of_model, spec }: Stated) -> Self {
        if of_model { Self::OfModel(spec) } else { Self::Spec(spec) }
    }
}

impl GridChoice {
    /// The grid of the window of a model that serves a contact; without a model the chosen one of a point contact, or
    /// the explorer's.
    pub fn of(model: Option<&ReducedModel>, plane: Option<PointGridSpec>, point: &OperatingPoint) -> Self {
        match (model.and_then(|model| model.windows.get(model.window_for(point))), plane) {
            (Some(window), _) => Self::Existing(window.grid.clone()),
            (None, None) => Self::Spec(GridSpec::explorer_for(point).unwrap_or(GridSpec::EXPLORER)),
            (None, Some(plane)) => Self::Spec(GridSpec::Plane(plane)),
        }
    }

    /// What the grid is built from.
    pub fn spec(&self) -> GridSpec {
        match self {
            Self::Existing(grid) => grid.spec(),
            Self::OfModel(spec) | Self::Spec(spec) => *spec,
        }
    }

    /// The grid as a request states it.
    pub fn stated(&self) -> Grid {
        match self {
            Self::Existing(_) | Self::OfModel(_) => Grid::Model,
            Self::Spec(spec) => Grid::from(*spec),
        }
    }

    /// The grid itself.
    ///
    /// # Errors
    /// When the specification is refused.
    pub fn with(&self, store: &Store) -> Result<ContactGrid, GridError> {
        match self {
            Self::Existing(grid) => Ok(grid.clone()),
            Self::OfModel(spec) | Self::Spec(spec) => store.grid(*spec),
        }
    }
}

/// A full solve that is wanted.
#[derive(Clone, Serialize, Deserialize)]
pub struct FullSolve {
    pub kind: JobKind,
    /// What to solve.
    pub key: Key,
    /// On which grid.
    pub grid: GridChoice,
    /// A solution to start from.
    pub start: Option<Arc<Solution>>,
}

/// What comes back.
pub enum Outcome {
    /// An answer, converged or not.
    Solved(Box<Answer>),
    /// A sentence why there is none.
    Failed(String),
}
