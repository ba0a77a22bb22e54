//! The online phase: Newton's method in the reduced coordinates.

use super::model::{ReducedModel, Trust};
use crate::solver::contact::OperatingPoint;
use crate::solver::full::{Scalars, Solution, SolveError};
use crate::solver::lubricant::Lubricant;
use std::sync::Arc;

/// Why a reduced solve gives no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReducedError {
    /// The problem itself is refused.
    #[error(transparent)]
    Problem(#[from] SolveError),
    /// Newton's iteration did not converge.
    #[error(
        "the reduced model did not converge in {iterations} iterations (last step {step:.1e}); use the full solver here"
    )]
    NotConverged {
        /// Steps taken.
        iterations: usize,
        /// Last relative step.
        step: f64,
    },
}

/// Settings of the online phase; changing them does not retrain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedOptions {
    /// Keep only this many pressure modes.
    pub pressure_modes: Option<usize>,
    /// Use the dissertation's V_δ V_δᵀ K V_p with this many deformation modes instead of the exact K V_p.
    pub deformation_modes: Option<usize>,
    /// Stop on ‖Δp̃‖/‖p̃‖ below this.
    pub tolerance: f64,
    /// Newton steps at most.
    pub max_newton: usize,
}

impl Default for ReducedOptions {
    fn default() -> Self {
        Self { pressure_modes: None, deformation_modes: None, tolerance: 1e-6, max_newton: 40 }
    }
}

/// What the online phase returns: small numbers only; fields are reconstructed on request.
#[derive(Clone, Debug)]
pub struct ReducedSolution {
    /// The operating point it belongs to.
    pub point: OperatingPoint,
    /// The laws it belongs to.
    pub lubricant: Lubricant,
    /// The window that served it.
    pub window: usize,
    /// Coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// H₀.
    pub h_0: f64,
    /// Newton steps.
    pub iterations: usize,
    /// e_f^I, (3.15).
    pub residual_estimate: f64,
    /// Whether the model was trained for the point.
    pub trust: Trust,
}

/// A model with the operators of the chosen truncation and all work space.
pub struct Online {
    /// The model.
    pub model: Arc<ReducedModel>,
    options: ReducedOptions,
}

impl Online {
    /// Prepares the operators.
    pub fn new(model: Arc<ReducedModel>, options: ReducedOptions) -> Self {
        Self { model, options }
    }

    /// The settings in force.
    pub fn options(&self) -> &ReducedOptions {
        &self.options
    }

    /// Solves a contact: from the previous solution of this object where that is near, else from the nearest snapshot by (3.20).
    ///
    /// # Errors
    /// When the point is refused or Newton does not converge.
    pub fn solve(&mut self, _point: &OperatingPoint, _lubricant: Lubricant) -> Result<ReducedSolution, ReducedError> {
        Err(ReducedError::NotConverged { iterations: 0, step: f64::NAN })
    }

    /// Fields and scalars of a reduced solution, on the window's grid; `report.newton_iterations` holds the online iterations.
    ///
    /// # Errors
    /// When the solution's point is refused.
    pub fn reconstruct(&mut self, _solution: &ReducedSolution) -> Result<Solution, ReducedError> {
        Err(ReducedError::NotConverged { iterations: 0, step: f64::NAN })
    }

    /// Scalars only, without reconstructing the fields.
    ///
    /// # Errors
    /// When the solution's point is refused.
    pub fn scalars(&mut self, _solution: &ReducedSolution) -> Result<Scalars, ReducedError> {
        Err(ReducedError::NotConverged { iterations: 0, step: f64::NAN })
    }
}
