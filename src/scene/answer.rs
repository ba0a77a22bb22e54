//! A contact to be solved, and what came of it: values that may travel between threads, processes and machines.

use super::contact_result::ContactResult;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// What is to be solved, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// The operating point.
    pub point: OperatingPoint,
    /// The lubricant's laws.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// Grid of a full solution.
    pub grid: Grid,
    /// The model that [`Grid::Model`] means.
    pub grid_model: ModelSource,
    /// In full, or by which reduced model.
    pub method: Method,
}

/// What came of a request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// What was solved.
    pub request: Request,
    /// Scalars, how they were obtained, and how far to trust them.
    pub result: ContactResult,
    /// Fields; of a full solve that did not converge the last state, of such a reduced solve `None`.
    pub solution: Option<Solution>,
}

impl Answer {
    /// The fields, if the solve converged.
    pub fn fields(&self) -> Option<&Solution> {
        self.solution.as_ref().filter(|_| self.result.converged)
    }

    /// The same, without the rest.
    pub fn into_fields(self) -> Option<Solution> {
        self.solution.filter(|_| self.result.converged)
    }

    /// Marks a full solution as the substitute of a reduced one that does not exist.
    pub fn in_place_of(mut self, failed: Self) -> Self {
        let why = failed.result.warnings.into_iter().chain([Warning::FullSolverTookOver]);
        self.result.warnings.splice(0..0, why);
        self
    }
}
