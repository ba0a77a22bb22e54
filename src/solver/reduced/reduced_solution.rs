//! The solution of a reduced model.

use super::domain::Trust;
use super::error_estimate::ErrorEstimate;
use super::warmth::Warmth;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use serde::{Deserialize, Serialize};

/// What the online phase returns: small numbers only; fields are reconstructed on request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedSolution {
    /// The operating point it belongs to.
    pub point: OperatingPoint,
    /// The laws it belongs to.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// The window that served it.
    pub window: usize,
    /// Whether that is not the contact's own, which found no solution: errors were not measured there.
    pub stands_in: bool,
    /// Coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// Under complementarity the first ruptured column of each line along X, in node arrays; empty under a penalty.
    pub fronts: Vec<usize>,
    /// Solutions of further windows around anchors, near whose borders it is blended with them, and the share of each;
    /// the films and what follows from them are then those of the blend.
    pub beside: Vec<(f64, ReducedSolution)>,
    /// H₀.
    pub h_0: f64,
    /// Central film H_c.
    pub h_c: f64,
    /// Traction coefficient (3.41) by the window's rule on few nodes; none of a model that does not know sliding.
    pub traction: Option<f64>,
    /// The share that the limiting stress takes of what its own window's traction were without one, 0…1; none with heat, or
    /// where no rule says it.
    pub cut: Option<f64>,
    /// Its temperatures; none without heat.
    pub heat: Option<Warmth>,
    /// Newton steps.
    pub iterations: usize,
    /// e_f^I, (3.15), in the L2 norm over X restricted to the sampled rows.
    pub residual_estimate: f64,
    /// Calibrated estimate of its errors. None where the model has no calibration, or solved otherwise than it was
    /// calibrated: outside its domain, by another window, with fewer modes or other settings; nor of a film hotter than
    /// lubricants endure.
    pub error: Option<ErrorEstimate>,
    /// Whether the model was trained for the point.
    pub trust: Trust,
}
