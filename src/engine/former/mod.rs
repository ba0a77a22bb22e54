//! The reader of the former model files (versions 18 and 65540), for one conversion.
#![allow(dead_code, unused_imports, reason = "what wrote these files is gone")]

mod domain;
mod packed;
mod stored_heat;
mod stored_matrix;
mod stored_model;
mod stored_trajectories;

use super::checked_file::Format;
use super::rom::{ModelFileError, SavedModel};
use std::sync::Arc;

/// The model of a former file. That its parts belong together is not proved.
///
/// # Errors
/// When it is another file, or damaged.
pub fn read(bytes: &[u8]) -> Result<SavedModel, ModelFileError> {
    let format = |version| Format { magic: b"EHLROM\r\n", version, max_payload: 512 << 20 };
    if let Ok(payload) = format(65540).open(bytes) {
        let damaged = ModelFileError::Damaged { what: "its content cannot be inflated" };
        let content = packed::inflated(payload, 64).ok_or(damaged)?;
        return Ok(SavedModel::InTime(stored_trajectories::decode(&content)?));
    }
    Ok(SavedModel::Stationary(Arc::new(stored_model::decode(format(18).open(bytes)?, &())?)))
}

/// The model of a present file, likewise without a proof.
///
/// # Errors
/// When it is another file, or damaged.
pub fn read_present(bytes: &[u8]) -> Result<SavedModel, ModelFileError> {
    super::rom::from_own_bytes(bytes, &())
}
