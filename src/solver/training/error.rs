//! Errors of a training.

use crate::solver::full::SolveError;
use crate::solver::full::transient::TransientError;
use crate::solver::limits::Refused;
use crate::solver::reduced::ReducedError;

/// Error that ends a training without a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrainingError {
    /// The specification is refused.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// The specification is valid, but no model can be trained. Contains a sentence.
    #[error("{0}")]
    Specification(String),
    /// A full solution of the plan did not converge.
    #[error(
        "the full solver did not converge at M = {m:.4}, L = {l:.4}; leave that corner out of the range or refine the grid"
    )]
    NotConverged {
        /// M (Moes load parameter) of the point.
        m: f64,
        /// L (Moes lubricant parameter) of the point.
        l: f64,
    },
    /// A grid or a point is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A decomposition failed (non-finite snapshots).
    #[error("the snapshots of the window M {from}…{to} could not be decomposed")]
    Decomposition {
        /// Lower end of the interval of M.
        from: f64,
        /// Upper end of the interval of M.
        to: f64,
    },
    /// There are no suitable trajectories, or no bases or sampled equations can be computed from them.
    #[error("{0}")]
    Trajectories(&'static str),
    /// A training trajectory is refused.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// The reduced model refuses a trajectory.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The observer stopped the training.
    #[error("the training was cancelled")]
    Cancelled,
    /// The observer provides full solutions from elsewhere, and they are not available yet. The training can be
    /// continued with them.
    #[error("the training waits for full solutions")]
    Awaited,
}
