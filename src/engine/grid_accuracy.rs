//! Discretisation error of a point contact, estimated from a second solve on another grid.

use super::EngineError;
use super::workbench::Workbench;
use super::{Answer, Request};
use crate::scene::{Bench, Grid};
use crate::solver::full::Solution;
use crate::solver::full::point::{Accuracy, resolution_warning, second_grid};
use crate::solver::training::TrainingObserver;
use serde::Serialize;

/// Discretisation errors of H_c and H_min, by Richardson's extrapolation with second order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GridAccuracy {
    /// Number of nodes along X of the second grid.
    pub nx: usize,
    /// Number of nodes across of the second grid.
    pub ny: usize,
    /// Relative error of H_c on the first grid.
    pub h_c_error: f64,
    /// Relative error of H_min on the first grid.
    pub h_min_error: f64,
    /// Extrapolated value of H_c.
    #[serde(rename = "H_c_limit")]
    pub h_c_limit: f64,
    /// Extrapolated value of H_min.
    #[serde(rename = "H_min_limit")]
    pub h_min_limit: f64,
    /// True if both grids resolve the side lobes. Otherwise the error of H_min may be larger.
    pub resolved: bool,
}

impl GridAccuracy {
    /// Compares a solution with one on another grid; `None` if they cannot be compared.
    pub fn of(solution: &Solution, second: &Solution) -> Option<Self> {
        let accuracy = Accuracy::of_either(solution, second)?;
        let (h_c_error, h_min_error) = accuracy.errors_of(solution);
        Some(Self {
            nx: second.x.len(),
            ny: second.y.len(),
            h_c_error,
            h_min_error,
            h_c_limit: accuracy.h_c.limit,
            h_min_limit: accuracy.h_min.limit,
            resolved: [solution, second].into_iter().all(|solution| resolution_warning(solution).is_none()),
        })
    }
}

impl Workbench {
    /// Solves a point contact again on a second grid, and compares both solutions.
    ///
    /// # Errors
    /// If the answer is not a converged full solution of a point contact, or if the second solve fails.
    pub fn grid_accuracy(
        &mut self,
        answer: &Answer,
        observer: &dyn TrainingObserver,
    ) -> Result<GridAccuracy, EngineError> {
        let none = |why: &str| EngineError::Study(format!("the discretisation error cannot be estimated: {why}"));
        let solution = answer.fields().ok_or_else(|| none("the solve did not converge"))?;
        let spec = solution.mesh.plane();
        let spec = spec.ok_or_else(|| none("the answer is not a full solution of a point contact"))?;
        let request = Request { grid: Grid::Plane(second_grid(spec)), ..answer.request.clone() };
        let second = self.answer(&request, Some(solution), observer)?;
        let second = second.fields().ok_or_else(|| none("the solve on the second grid did not converge"))?;
        GridAccuracy::of(solution, second).ok_or_else(|| none("the two grids do not match"))
    }
}
