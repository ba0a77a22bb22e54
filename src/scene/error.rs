//! Errors of scenes: why a scene is refused or gives no result.

use super::atomic_file::WriteError;
use super::load_cases::CasesError;
use super::sampled::SampledError;
use crate::solver::full::SolveError;
use crate::solver::full::transient::TransientError;
use crate::solver::limits::Refused;
use crate::solver::physics::contact::ContactError;
use crate::solver::reduced::ReducedError;
use crate::solver::reduced::tpwl::TpwlError;
use crate::solver::training::TrainingError;
use std::path::PathBuf;

/// Version of the scene format: written by this program, and the newest that it reads.
pub const VERSION: u32 = 1;

/// Reason why a scene is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// The text is not a valid scene.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Description of the error.
        message: String,
    },
    /// It was written by a newer program.
    #[error("it has format version {version}, but this program reads versions up to {VERSION}; use a newer program")]
    Newer {
        /// The scene's version.
        version: u32,
    },
    /// Version 0 never existed.
    #[error("it has format version 0, which does not exist; write `version: {VERSION}`")]
    NoVersion,
    /// A field has an invalid value.
    #[error(transparent)]
    Field(#[from] Refused),
    /// The operating point is invalid.
    #[error("`at`: {0}")]
    At(#[from] ContactError),
    /// The scene cannot be written as text.
    #[error("it cannot be written as text: {0}")]
    Unwritable(String),
}

/// Reason why a scene file is refused.
#[derive(Debug, thiserror::Error)]
pub enum SceneFileError {
    /// The file cannot be read.
    #[error("cannot read the scene {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Reason given by the system.
        reason: String,
    },
    /// The file is not a valid scene.
    #[error("the scene {} is refused: {reason}", path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// Reason.
        reason: SceneError,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Error of a file or service that the bench provides, of any format.
pub type Reason = Box<dyn std::error::Error + Send + Sync>;

/// Reason why a request gives no result. A solve that does not converge is a result, not an error.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The problem itself is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The reduced model refuses the problem.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The embedded model cannot be used.
    #[error("the embedded reduced model cannot be used: {0}")]
    Embedded(#[source] Reason),
    /// A model file cannot be used.
    #[error("the reduced model {} cannot be used: {reason}", path.display())]
    Model {
        /// The file.
        path: PathBuf,
        /// Reason.
        reason: Reason,
    },
    /// A scene file is refused.
    #[error(transparent)]
    SceneFile(#[from] SceneFileError),
    /// A scene is refused.
    #[error("the scene is refused: {0}")]
    Scene(#[from] SceneError),
    /// The scene has another study than a training.
    #[error("the scene {} describes no training; its study must be Training(…), or Transient(…) with its own reduced model", path.display())]
    NoTraining {
        /// The file.
        path: PathBuf,
    },
    /// The study and the operating point are inconsistent.
    #[error("{0}")]
    Study(String),
    /// A transient contact is refused.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// A trajectory-piecewise-linear model is refused.
    #[error(transparent)]
    Tpwl(#[from] TpwlError),
    /// Sampled inputs are refused.
    #[error(transparent)]
    Sampled(#[from] SampledError),
    /// A table of load cases is refused.
    #[error(transparent)]
    Cases(#[from] CasesError),
    /// The training failed.
    #[error(transparent)]
    Training(#[from] TrainingError),
    /// An unfinished training cannot be continued or saved.
    #[error("{0}")]
    TrainingFile(#[source] Reason),
    /// An output cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The caller asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl From<ContactError> for RunError {
    fn from(error: ContactError) -> Self {
        Self::Solve(error.into())
    }
}

impl RunError {
    /// Returns true if the caller stopped the run. All other errors mean that the request was invalid.
    pub fn cancelled(&self) -> bool {
        matches!(self, Self::Cancelled | Self::Training(TrainingError::Cancelled))
    }

    /// Returns true if the error affects the solves of all contacts, not only the requested one.
    pub fn concerns_all_contacts(&self) -> bool {
        self.cancelled() || matches!(self, Self::Model { .. } | Self::Embedded(_))
    }
}
