//! Files of steady reduced models (`.rom`). [`SavedModel`] also reads and writes those of transient models.

pub use super::rom::ModelFileError;

use super::rom::{self, SavedModel};
use crate::solver::observer::Observer;
use crate::solver::reduced::ReducedModel;
use std::path::Path;
use std::sync::Arc;

/// Reads a model file. The announced size is checked before memory is allocated.
///
/// # Errors
/// If the file cannot be read, has another format or version, is truncated or damaged, or contains a transient model.
pub fn read(path: &Path) -> Result<ReducedModel, ModelFileError> {
    SavedModel::read(path)?.stationary().map(Arc::unwrap_or_clone)
}

/// Reads a model file with an observer.
///
/// # Errors
/// As [`read`], and if the observer cancels.
pub(super) fn read_watched(path: &Path, observer: &dyn Observer) -> Result<Arc<ReducedModel>, ModelFileError> {
    rom::read_watched(path, observer)?.stationary()
}

/// Writes a model file as a whole or not at all.
///
/// # Errors
/// If the file cannot be written, or would be refused by [`read`].
pub fn write(model: &ReducedModel, path: &Path) -> Result<(), ModelFileError> {
    rom::write_proven(&to_bytes(model)?, path)
}

/// Returns the content of a model file.
///
/// # Errors
/// If the model cannot be encoded.
pub fn to_bytes(model: &ReducedModel) -> Result<Vec<u8>, ModelFileError> {
    rom::to_bytes(model)
}

/// Reads a model from the content of a file.
///
/// # Errors
/// As [`read`].
pub fn from_bytes(bytes: &[u8]) -> Result<ReducedModel, ModelFileError> {
    SavedModel::from_bytes(bytes)?.stationary().map(Arc::unwrap_or_clone)
}
