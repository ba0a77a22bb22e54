//! Request to solve one contact, and the answer to it. Both can be sent between threads, processes and machines.

use super::contact_result::ContactResult;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::Extent;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Contact to solve, with grid and method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// The operating point.
    pub point: OperatingPoint,
    /// The lubricant's laws.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// Grid of a full solution.
    pub grid: Grid,
    /// Reduced model whose grid [`Grid::Model`] refers to.
    pub grid_model: ModelSource,
    /// Full solver, or which reduced model.
    pub method: Method,
    /// Length of a line contact and radii of the bodies, for forces and torques.
    #[serde(default, skip_serializing_if = "Extent::is_empty")]
    pub extent: Extent,
}

/// Answer to a [`Request`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The request that was solved.
    pub request: Request,
    /// Scalars, the method and grid they were computed with, and warnings about their accuracy.
    pub result: ContactResult,
    /// Fields of the solution. If a full solve did not converge, the last iterate; if a reduced solve did not converge,
    /// `None`.
    pub solution: Option<Solution>,
}

impl Answer {
    /// Returns the fields if the solve converged.
    pub fn fields(&self) -> Option<&Solution> {
        self.solution.as_ref().filter(|_| self.result.converged)
    }

    /// Returns the fields if the solve converged, and drops the rest of the answer.
    pub fn into_fields(self) -> Option<Solution> {
        self.solution.filter(|_| self.result.converged)
    }

    /// Marks this full solution as the replacement for a reduced solve that failed: adds the warnings of the failed
    /// answer and [`Warning::FullSolverTookOver`] in front of its own.
    pub fn in_place_of(mut self, failed: Self) -> Self {
        let why = failed.result.warnings.into_iter().chain([Warning::FullSolverTookOver]);
        self.result.warnings.splice(0..0, why);
        self
    }
}
