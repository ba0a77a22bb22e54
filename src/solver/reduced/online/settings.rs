//! How the online phase is run, and why it may give no result.

use crate::solver::full::SolveError;
use crate::solver::parameters::CIRCLES;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;

/// Why a reduced solve gives no result.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReducedError {
    /// The problem itself is refused.
    #[error(transparent)]
    Problem(#[from] SolveError),
    /// The lubricant is none the reduced equations describe.
    #[error(
        "the reduced model was trained for a lubricant that does not thin under shear; use the full solver, or a model of this lubricant"
    )]
    ShearThinning,
    /// The contact is one with heat, of which the model knows nothing.
    #[error("the reduced model knows no heat; leave heat out, solve in full, or train a model with heat and name it")]
    Heat,
    /// The model is of the other kind of contact.
    #[error("the reduced model is of {} contacts, but the operating point is that of a {} contact", model.name(), given.name())]
    OtherContact {
        /// What the model is of.
        model: ContactKind,
        /// What it was given.
        given: ContactKind,
    },
    /// A model in time whose films rupture otherwise than was asked.
    #[error(
        "the reduced model in time was trained with films that rupture by {}, not by {}; train one with that law, or follow the full system",
        model.name(), given.name()
    )]
    OtherRupture {
        /// What the model knows.
        model: Cavitation,
        /// What was asked.
        given: Cavitation,
    },
    /// The model holds no window.
    #[error("the reduced model holds no bases")]
    Empty,
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
    /// It was asked to stop.
    #[error("the reduced solve was stopped")]
    Cancelled,
    /// The contact is an ellipse of which the model knows nothing.
    #[error("the reduced model knows {}; use the full solver for a ratio of radii of {given}", known_shapes(*known))]
    Ellipse {
        /// R_y/R of the contact.
        given: f64,
        /// R_y/R of the model.
        known: (f64, f64),
    },
    /// Newton's iteration ended where the model was not trained, in what no contact can be.
    #[error("the reduced solution is none, {0}; use the full solver here")]
    Implausible(String),
}

fn known_shapes(known: (f64, f64)) -> String {
    if known == CIRCLES {
        return "circular contacts only".to_owned();
    }
    format!("ellipses with a ratio of radii from {} to {} only", known.0, known.1)
}

impl ReducedError {
    /// The Newton steps of an iteration that was run and gave no solution; none where the request itself is refused.
    pub fn without_solution(&self) -> Option<usize> {
        match self {
            Self::NotConverged { iterations, .. } => Some(*iterations),
            Self::Implausible(_) | Self::Ellipse { .. } => Some(0),
            _ => None,
        }
    }
}

/// From where an online iteration is started.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Starts {
    /// The line through the last two solutions where the contact continues it, the last one where it is near, an
    /// interpolation between snapshots, the nearest snapshot, continuation from it.
    #[default]
    Explorer,
    /// The nearest snapshot by (3.20) as it is, and nothing else: the dissertation's.
    Nearest,
}

/// Settings of the online phase; changing them does not retrain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReducedOptions {
    /// Keep only this many pressure modes.
    pub pressure_modes: Option<usize>,
    /// Use the dissertation's V_δ V_δᵀ K V_p with this many deformation modes instead of the exact K V_p.
    pub deformation_modes: Option<usize>,
    /// Stop on ‖Δp̃‖/‖p̃‖ below this, where films are thin below a share of it. Newton converges quadratically: the error left
    /// is the square of it.
    pub tolerance: f64,
    /// Newton steps at most.
    pub max_newton: usize,
    /// Penalty factor γ̄ of (2.36) in place of the window's own.
    pub penalty: Option<f64>,
    /// From where it starts.
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
    /// The dissertation's scheme: the state holds δ̃ with all modes that were kept, and starts from the nearest
    /// snapshot only.
    pub fn dissertation() -> Self {
        Self { deformation_modes: Some(usize::MAX), starts: Starts::Nearest, ..Self::default() }
    }
}
