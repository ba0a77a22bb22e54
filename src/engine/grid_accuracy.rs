//! What the grid costs the film of a point contact, from a second solve on another grid.

use super::EngineError;
use super::workbench::Workbench;
use super::{Answer, Request};
use crate::scene::{Bench, Grid};
use crate::solver::full::Solution;
use crate::solver::full::point::{Accuracy, resolution_warning, second_grid};
use crate::solver::training::TrainingObserver;
use serde::Serialize;

/// Discretisation errors of H_c and H_min, by Richardson's extrapolation with the scheme's second order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GridAccuracy {
    /// Nodes along X of the second grid.
    pub nx: usize,
    /// Its nodes across.
    pub ny: usize,
    /// Relative error of H_c on the first grid.
    pub h_c_error: f64,
    /// Relative error of H_min on the first grid.
    pub h_min_error: f64,
    /// H_c in the limit of fine grids.
    #[serde(rename = "H_c_limit")]
    pub h_c_limit: f64,
    /// H_min in the limit of fine grids.
    #[serde(rename = "H_min_limit")]
    pub h_min_limit: f64,
    /// Whether both grids resolve the side lobes; else the error of H_min may be larger.
    pub resolved: bool,
}

impl GridAccuracy {
    /// Compares a solution with one on another grid; `None` where they do not belong together.
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
    /// Solves a point contact that has been answered on a second grid, and compares.
    ///
    /// # Errors
    /// When the answer is no converged full solution of a point contact, or the second solve has none.
    pub fn grid_accuracy(
        &mut self,
        answer: &Answer,
        observer: &dyn TrainingObserver,
    ) -> Result<GridAccuracy, EngineError> {
        let none = |why: &str| EngineError::Study(format!("the grid's error cannot be estimated: {why}"));
        let solution = answer.fields().ok_or_else(|| none("the solve did not converge"))?;
        let spec = solution.mesh.plane();
        let spec = spec.ok_or_else(|| none("only full solutions of point contacts have one"))?;
        let request = Request { grid: Grid::Plane(second_grid(spec)), ..answer.request.clone() };
        let second = self.answer(&request, Some(solution), observer)?;
        let second = second.fields().ok_or_else(|| none("the solve on the second grid did not converge"))?;
        GridAccuracy::of(solution, second).ok_or_else(|| none("both grids do not belong together"))
    }
}
