//! Solution of a reduced model.

use super::domain::Trust;
use super::error_estimate::ErrorEstimate;
use super::temperature_field::TemperatureField;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use serde::{Deserialize, Serialize};

/// Result of the online phase: few numbers only. Fields are reconstructed on request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedSolution {
    /// Operating point.
    pub point: OperatingPoint,
    /// Lubricant laws.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// Index of the local model used.
    pub window: usize,
    /// True if it is not the contact's own local model, which found no solution. Its errors were not measured there.
    pub by_neighbour: bool,
    /// Coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// With complementarity, the first cavitated column of each line along X, in node arrays; empty with a penalty.
    pub fronts: Vec<usize>,
    /// Solutions of other local models that are blended in near borders, with their shares. The scalars are then
    /// those of the blend.
    pub beside: Vec<(f64, ReducedSolution)>,
    /// Rigid-body separation H₀.
    pub h_0: f64,
    /// Central film thickness H_c.
    pub h_c: f64,
    /// Traction coefficient (3.41) by the traction quadrature; `None` if the model does not include sliding.
    pub traction: Option<f64>,
    /// Share by which the limiting stress reduces the traction of its own local model, 0…1; `None` with heat, or
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
