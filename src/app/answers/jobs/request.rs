//! Requests to the worker and their results.

use crate::app::document::Key;
use crate::engine::{Answer, Store};
use crate::scene::Grid;
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec, PointGridSpec};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::ReducedModel;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Purpose of a full solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum JobKind {
    /// The live picture where no reduced model covers the contact.
    Live,
    /// The same contact on the chosen grid, after a live picture on a quick grid.
    Refine,
    /// The check of a reduced picture.
    Verify,
    /// The same contact on a second grid, to estimate the discretisation error of the first.
    Estimate,
}

impl JobKind {
    /// Number of kinds.
    pub const COUNT: usize = Self::Estimate as usize + 1;

    /// Returns the name that the screen shows.
    pub fn name(self) -> &'static str {
        match self {
            Self::Live => "Full solve for the picture",
            Self::Refine => "Full solve on the chosen grid",
            Self::Verify => "Verification by a full solve",
            Self::Estimate => "Full solve on a second grid",
        }
    }
}

/// Grid of a solve: an existing grid, or the specification of one to build.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "Stated", into = "Stated")]
pub enum GridChoice {
    /// Grid of a reduced model.
    Existing(ContactGrid),
    /// Grid of a reduced model, to be built from its specification.
    OfModel(GridSpec),
    Spec(GridSpec),
}

/// Serialised form, for another instance of the program, which builds its own grids.
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
    /// Returns the grid of the local model that covers the contact. Without a model, returns the chosen grid of a
    /// point contact or the default grid of a line contact.
    pub fn of(model: Option<&ReducedModel>, plane: Option<PointGridSpec>, point: &OperatingPoint) -> Self {
        match (model.and_then(|model| model.windows.get(model.window_for(point))), plane) {
            (Some(window), _) => Self::Existing(window.grid.clone()),
            (None, None) => Self::Spec(GridSpec::explorer_for(point).unwrap_or(GridSpec::EXPLORER)),
            (None, Some(plane)) => Self::Spec(GridSpec::Plane(plane)),
        }
    }

    /// Returns the specification of the grid.
    pub fn spec(&self) -> GridSpec {
        match self {
            Self::Existing(grid) => grid.spec(),
            Self::OfModel(spec) | Self::Spec(spec) => *spec,
        }
    }

    /// Returns the grid in the form that a request uses.
    pub fn stated(&self) -> Grid {
        match self {
            Self::Existing(_) | Self::OfModel(_) => Grid::Model,
            Self::Spec(spec) => Grid::from(*spec),
        }
    }

    /// Returns the grid, and builds it if necessary.
    ///
    /// # Errors
    /// If the specification is refused.
    pub fn with(&self, store: &Store) -> Result<ContactGrid, GridError> {
        match self {
            Self::Existing(grid) => Ok(grid.clone()),
            Self::OfModel(spec) | Self::Spec(spec) => store.grid(*spec),
        }
    }
}

/// Request for a full solve.
#[derive(Clone, Serialize, Deserialize)]
pub struct FullSolve {
    pub kind: JobKind,
    /// Contact to solve.
    pub key: Key,
    /// Grid to solve it on.
    pub grid: GridChoice,
    /// Solution that serves as initial guess.
    pub start: Option<Arc<Solution>>,
}

/// Result of a full solve.
pub enum Outcome {
    /// Answer, converged or not.
    Solved(Box<Answer>),
    /// Reason why there is no answer, as a sentence.
    Failed(String),
}
