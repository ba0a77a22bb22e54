//! What a `.rom` file holds: a model of stationary contacts, or one in time.

use super::model_file::{self, ModelFileError};
use super::trajectory_file;
use crate::solver::reduced::ReducedModel;
use crate::solver::reduced::transient::TrajectoryModel;
use std::path::Path;
use std::sync::Arc;

/// A reduced model of either kind.
#[derive(Clone)]
pub enum SavedModel {
    /// Of stationary contacts.
    Stationary(Arc<ReducedModel>),
    /// In time.
    InTime(Arc<TrajectoryModel>),
}

impl SavedModel {
    /// Reads a file of either kind.
    ///
    /// # Errors
    /// When it cannot be read, is foreign, newer, cut off or damaged.
    pub fn read(path: &Path) -> Result<Self, ModelFileError> {
        Self::read_with_content(path).map(|(model, _)| model)
    }

    /// Reads a file of either kind, and gives its content besides, byte for byte: that of a former version would be kept
    /// a little differently now.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_with_content(path: &Path) -> Result<(Self, Vec<u8>), ModelFileError> {
        let content = match trajectory_file::content(path) {
            Err(ModelFileError::Stationary) => model_file::content(path)?,
            content => content?,
        };
        Ok((Self::from_bytes(&content)?, content))
    }

    /// A model from the content of a file.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ModelFileError> {
        match trajectory_file::from_bytes(bytes) {
            Err(ModelFileError::Stationary) => Ok(Self::Stationary(Arc::new(model_file::from_bytes(bytes)?))),
            model => Ok(Self::InTime(model?)),
        }
    }

    /// The content of its file.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ModelFileError> {
        match self {
            Self::Stationary(model) => model_file::to_bytes(model),
            Self::InTime(model) => trajectory_file::to_bytes(model),
        }
    }

    /// Its title.
    pub fn title(&self) -> &str {
        match self {
            Self::Stationary(model) => &model.title,
            Self::InTime(model) => &model.title,
        }
    }
}
