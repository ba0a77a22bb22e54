//! Files of steady reduced models (`.rom`); [`SavedModel`] reads and writes those of transient ones as well.

pub use super::rom::ModelFileError;

use super::rom::{self, SavedModel};
use crate::solver::observer::Observer;
use crate::solver::reduced::ReducedModel;
use std::path::Path;
use std::sync::Arc;

/// Reads a model file. Its announced size is checked before anything is allocated.
///
/// # Errors
/// When the file cannot be read, is foreign, of another version, cut off or damaged, or a transient model.
pub fn read(path: &Path) -> Result<ReducedModel, ModelFileError> {
    SavedModel::read(path)?.stationary().map(Arc::unwrap_or_clone)
}

/// The same while an observer watches.
///
/// # Errors
/// As [`read`], and when the observer cancels.
pub(super) fn read_watched(path: &Path, observer: &dyn Observer) -> Result<Arc<ReducedModel>, ModelFileError> {
    rom::read_watched(path, observer)?.stationary()
}

/// Writes a model file as a whole or not at all.
///
/// # Errors
/// When the file cannot be written, or would be refused by [`read`].
pub fn write(model: &ReducedModel, path: &Path) -> Result<(), ModelFileError> {
    rom::write_proven(&to_bytes(model)?, path)
}

/// The content of a model file.
///
/// # Errors
/// When the model cannot be encoded.
pub fn to_bytes(model: &ReducedModel) -> Result<Vec<u8>, ModelFileError> {
    rom::to_bytes(model)
}

/// A model from the content of a file.
///
/// # Errors
/// As [`read`].
pub fn from_bytes(bytes: &[u8]) -> Result<ReducedModel, ModelFileError> {
    SavedModel::from_bytes(bytes)?.stationary().map(Arc::unwrap_or_clone)
}
