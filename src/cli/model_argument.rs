//! Reduced model that an argument names: a file, or a model of the program.

use super::failure::Failure;
use crate::engine::{EngineError, SavedModel, bytes_of, named_by};
use std::path::Path;

/// Reads a model from a file, or an embedded model by its name. Also returns the content of its file.
pub fn model_of(path: &Path) -> Result<(SavedModel, Vec<u8>), Failure> {
    let read = match named_by(path).and_then(bytes_of) {
        Some(content) => SavedModel::from_bytes(&content).map(|model| (model, content.to_vec())),
        None => SavedModel::read_with_content(path),
    };
    Ok(read.map_err(|reason| EngineError::Model { path: path.to_owned(), reason: reason.into() })?)
}
