//! Why a training gives no model.

use crate::solver::full::SolveError;
use crate::solver::full::transient::TransientError;
use crate::solver::limits::Refused;
use crate::solver::reduced::ReducedError;

/// Why a training gives no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TrainingError {
    /// The specification is refused.
    #[error(transparent)]
    Refused(#[from] Refused),
    /// The specification makes sense, but no model.
    #[error("{0}")]
    Specification(String),
    /// A full solution the plan asks for could not be had.
    #[error(
        "the full solver did not converge at M = {m:.4}, L = {l:.4}; leave that corner out of the range or refine the grid"
    )]
    NotConverged {
        /// Load number of the point.
        m: f64,
        /// Lubricant number of the point.
        l: f64,
    },
    /// A grid or a point is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// Linear algebra gave up (non-finite snapshots).
    #[error("the snapshots of the window M {from}…{to} could not be decomposed")]
    Decomposition {
        /// Lower end of the window.
        from: f64,
        /// Upper end of the window.
        to: f64,
    },
    /// There are no trajectories to learn from, or no bases or rule for their rows could be had.
    #[error("{0}")]
    Trajectories(&'static str),
    /// A training trajectory is refused.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// The reduced model refuses a trajectory.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The observer asked to stop.
    #[error("the training was cancelled")]
    Cancelled,
    /// Full solutions that somebody else computes are not there yet; the training goes on with them.
    #[error("the training waits for full solutions")]
    Awaited,
}
