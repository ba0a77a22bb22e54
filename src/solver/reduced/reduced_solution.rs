//! Result of solving a reduced model.

use super::domain::Trust;
use super::error_estimate::ErrorEstimate;
use super::temperature_field::TemperatureField;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use serde::{Deserialize, Serialize};

/// Result of solving a reduced model: coefficients and scalars. Fields are reconstructed on request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedSolution {
    /// Operating point.
    pub point: OperatingPoint,
    /// Lubricant laws.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// Index of the local model used.
    pub window: usize,
    /// True if the local model of this range found no solution and a neighbour was used, whose errors were not measured
    /// here.
    pub by_neighbour: bool,
    /// Coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// With complementarity, the first cavitated column of each line along X, in node arrays; empty with a penalty.
    pub fronts: Vec<usize>,
    /// Solutions of neighbouring local models, and their weights, which are blended in near the limits of a range. The scalars are then
    /// those of the blend.
    pub beside: Vec<(f64, ReducedSolution)>,
    /// Rigid-body separation H₀.
    pub h_0: f64,
    /// Central film thickness H_c.
    pub h_c: f64,
    /// Traction coefficient (3.41) by the traction quadrature; `None` if the model does not include sliding.
    pub traction: Option<f64>,
    /// Relative reduction of the traction by the limiting stress, 0…1, before blending; `None` with heat, or
    /// without a traction quadrature.
    pub cut: Option<f64>,
    /// Temperatures; `None` if isothermal.
    pub heat: Option<TemperatureField>,
    /// Number of Newton steps.
    pub iterations: usize,
    /// Residual e_f^I, (3.15), in the L2 norm over X restricted to the sampled equations.
    pub residual_estimate: f64,
    /// Calibrated estimate of its errors. `None` if the model has no calibration or was used differently from it:
    /// outside the trained range, with another local model, fewer modes or other settings. Also `None` for a film
    /// hotter than lubricants endure.
    pub error: Option<ErrorEstimate>,
    /// Whether the model was trained for the point.
    pub trust: Trust,
}
