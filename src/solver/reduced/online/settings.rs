//! Settings of the online phase of a reduced model, and errors of its solves.

use crate::solver::full::SolveError;
use crate::solver::parameters::CIRCLES;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;
use serde::{Deserialize, Serialize};

/// Error of a reduced solve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReducedError {
    /// The problem is refused.
    #[error(transparent)]
    Problem(#[from] SolveError),
    /// The lubricant is shear-thinning, and the model is Newtonian.
    #[error(
        "the reduced model was trained for a Newtonian lubricant; use the full solver, or a model of this lubricant"
    )]
    ShearThinning,
    /// The contact is thermal, and the model is isothermal.
    #[error(
        "the reduced model is isothermal; leave heat out, use the full solver, or name a model trained for thermal contacts"
    )]
    Heat,
    /// The surfaces are rough, and the model was trained for smooth ones, or the reverse.
    #[error(
        "the reduced model was trained for {} surfaces, not for {} ones; use the full solver or another model",
        if *rough { "smooth" } else { "rough" }, if *rough { "rough" } else { "smooth" }
    )]
    Roughness {
        /// True if the surfaces of the contact are rough.
        rough: bool,
    },
    /// The model is of another kind of contact, line or point.
    #[error("the reduced model is of {} contacts, but the operating point is that of a {} contact", model.name(), given.name())]
    OtherContact {
        /// Kind of the model.
        model: ContactKind,
        /// Kind of the given contact.
        given: ContactKind,
    },
    /// The cavitation model of a transient model differs from the requested one.
    #[error(
        "the transient reduced model was trained with the cavitation model {}, not {}; train one with that cavitation model, or use the full system",
        model.name(), given.name()
    )]
    OtherCavitation {
        /// Cavitation model of the model.
        model: Cavitation,
        /// Requested cavitation model.
        given: Cavitation,
    },
    /// The model has no local model.
    #[error("the reduced model contains no local model")]
    Empty,
    /// Newton's method did not converge.
    #[error(
        "the reduced model did not converge in {iterations} iterations (last step {step:.1e}); use the full solver here"
    )]
    NotConverged {
        /// Number of steps.
        iterations: usize,
        /// Relative size of the last step.
        step: f64,
    },
    /// The solve was cancelled.
    #[error("the reduced solve was stopped")]
    Cancelled,
    /// The radius ratio of the contact is outside the interval of the model.
    #[error("the reduced model supports {}; use the full solver for a ratio of radii of {given}", known_shapes(*known))]
    Ellipse {
        /// R_y/R of the contact.
        given: f64,
        /// Interval of R_y/R of the model.
        known: (f64, f64),
    },
    /// Outside the trained range the iteration ended in a state that is not a solution of a contact.
    #[error("the reduced solution is not valid, {0}; use the full solver here")]
    Implausible(String),
}

/// Returns the supported contacts as text, for an interval of R_y/R.
fn known_shapes(known: (f64, f64)) -> String {
    if known == CIRCLES {
        return "circular contacts only".to_owned();
    }
    format!("elliptical contacts with a ratio of radii from {} to {} only", known.0, known.1)
}

impl ReducedError {
    /// Returns the number of Newton steps if the error belongs to this contact only: the model has no solution of it.
    /// Zero if the contact was not tried or its solution is not plausible. `None` for all other errors.
    pub fn without_solution(&self) -> Option<usize> {
        match self {
            Self::NotConverged { iterations, .. } => Some(*iterations),
            Self::Implausible(_) | Self::Ellipse { .. } | Self::Roughness { .. } => Some(0),
            _ => None,
        }
    }
}

/// Selection of initial guesses for an online iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Starts {
    /// All initial guesses of [`Online::solve`](super::Online::solve), one after the other.
    #[default]
    Explorer,
    /// Only the nearest snapshot by (3.20), unchanged, as in the dissertation.
    Nearest,
}

/// Settings of the online phase. They can be changed without another training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedOptions {
    /// Number of pressure modes; `None` for all.
    pub pressure_modes: Option<usize>,
    /// Number of deformation modes V_δ, with which the deformation of the pressure modes V_p is V_δ V_δᵀ K V_p as in
    /// the dissertation; `None` for the exact K V_p.
    pub deformation_modes: Option<usize>,
    /// Stopping tolerance for ‖Δp̃‖/‖p̃‖, with the pressure coefficients p̃. It is reduced for thin films. Newton's
    /// method converges quadratically, so that the remaining relative error is about its square.
    pub tolerance: f64,
    /// Maximum number of Newton steps.
    pub max_newton: usize,
    /// Penalty factor γ̄ of (2.36); `None` for the local model's own.
    pub penalty: Option<f64>,
    /// Selection of initial guesses.
    pub starts: Starts,
}

impl Default for ReducedOptions {
    fn default() -> Self {
        Self {
            pressure_modes: None,
            deformation_modes: None,
            tolerance: 1e-5,
            max_newton: 40,
            penalty: None,
            starts: Starts::Explorer,
        }
    }
}

impl ReducedOptions {
    /// Returns the dissertation's scheme: the state contains δ̃ with all stored modes, and the iteration starts from
    /// the nearest snapshot only.
    pub fn dissertation() -> Self {
        Self { deformation_modes: Some(usize::MAX), starts: Starts::Nearest, ..Self::default() }
    }
}
