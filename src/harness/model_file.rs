//! Reduced-model files (`.rom`).

use crate::solver::reduced::ReducedModel;
use std::path::Path;
use std::sync::Arc;

/// Why a reduced-model file cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelFileError {
    /// Not in this build.
    #[error("reduced-model files are not available in this build; use --method full")]
    Unavailable,
}

/// The model in the program.
///
/// # Errors
/// When there is none.
pub fn embedded() -> Result<Arc<ReducedModel>, ModelFileError> {
    Err(ModelFileError::Unavailable)
}

/// Reads a model.
///
/// # Errors
/// When the file cannot be read or is no model.
pub fn read(_path: &Path) -> Result<ReducedModel, ModelFileError> {
    Err(ModelFileError::Unavailable)
}

/// Writes a model, as a whole or not at all.
///
/// # Errors
/// When the file cannot be written.
pub fn write(_model: &ReducedModel, _path: &Path) -> Result<(), ModelFileError> {
    Err(ModelFileError::Unavailable)
}
