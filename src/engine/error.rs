//! What can be wrong with a request.

use super::model_file::ModelFileError;
use super::training_file::TrainingFileError;
use crate::scene::sampled::SampledError;
use crate::scene::{SceneError, SceneFileError, atomic_file::WriteError};
use crate::solver::full::SolveError;
use crate::solver::full::transient::TransientError;
use crate::solver::physics::contact::ContactError;
use crate::solver::reduced::ReducedError;
use crate::solver::reduced::tpwl::TpwlError;
use crate::solver::training::TrainingError;
use std::path::PathBuf;

/// Why a request gives no result. A solve that does not converge is a result, not an error.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    /// The problem itself is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The reduced model refuses the problem.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The embedded model cannot be used.
    #[error("the embedded reduced model cannot be used: {0}")]
    Embedded(#[source] ModelFileError),
    /// A model file cannot be used.
    #[error("the reduced model {} cannot be used: {reason}", path.display())]
    Model {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: ModelFileError,
    },
    /// A scene file is refused.
    #[error(transparent)]
    SceneFile(#[from] SceneFileError),
    /// A scene is refused.
    #[error("the scene is refused: {0}")]
    Scene(#[from] SceneError),
    /// A scene that should describe a training asks something else.
    #[error("the scene {} describes no training; its study must be Training(…)", path.display())]
    NoTraining {
        /// The file.
        path: PathBuf,
    },
    /// A scene's study and its operating point do not fit.
    #[error("{0}")]
    Study(String),
    /// A contact in time is refused.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// A trajectory-piecewise-linear model is refused.
    #[error(transparent)]
    Tpwl(#[from] TpwlError),
    /// Sampled inputs are refused.
    #[error(transparent)]
    Sampled(#[from] SampledError),
    /// The training gives no model.
    #[error(transparent)]
    Training(#[from] TrainingError),
    /// An unfinished training cannot be gone on with or kept.
    #[error(transparent)]
    TrainingFile(#[from] TrainingFileError),
    /// An output cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The caller asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl From<ContactError> for EngineError {
    fn from(error: ContactError) -> Self {
        Self::Solve(error.into())
    }
}

impl EngineError {
    /// Whether the caller stopped it; everything else means that the request was wrong.
    pub fn cancelled(&self) -> bool {
        matches!(self, Self::Cancelled | Self::Training(TrainingError::Cancelled))
    }
}
