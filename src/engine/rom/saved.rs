//! Reads and writes `.rom` files of steady and transient models.

use super::container::{Contents, FORMAT, ModelKind};
use super::error::{ModelFileError, damaged};
use super::{steady, transient};
use crate::engine::checked_file::Unreadable;
use crate::host::pool::on_all_cores;
use crate::scene::atomic_file;
use crate::solver::observer::Observer;
use crate::solver::reduced::ReducedModel;
use crate::solver::reduced::transient::TrajectoryModel;
use std::path::Path;
use std::sync::Arc;

/// Reduced model, steady or transient.
#[derive(Clone)]
pub enum SavedModel {
    /// Model of steady contacts.
    Stationary(Arc<ReducedModel>),
    /// Model of transient contacts.
    InTime(Arc<TrajectoryModel>),
}

impl SavedModel {
    /// Reads a file of either kind.
    ///
    /// # Errors
    /// If it cannot be read, has another format or version, is truncated or damaged.
    pub fn read(path: &Path) -> Result<Self, ModelFileError> {
        Self::read_with_content(path).map(|(model, _)| model)
    }

    /// Reads a file of either kind and also returns its bytes.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_with_content(path: &Path) -> Result<(Self, Vec<u8>), ModelFileError> {
        let content = content(path)?;
        Ok((Self::from_bytes(&content)?, content))
    }

    /// Reads a model from the content of a file.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ModelFileError> {
        let model = from_own_bytes(bytes, &())?;
        model.prove(&())?;
        Ok(model)
    }

    /// Returns the content of the model's file.
    ///
    /// # Errors
    /// If it cannot be encoded.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ModelFileError> {
        match self {
            Self::Stationary(model) => to_bytes(model),
            Self::InTime(model) => in_time_to_bytes(model),
        }
    }

    /// Writes the model's file as a whole or not at all.
    ///
    /// # Errors
    /// If the file cannot be written, or would be refused by [`Self::read`].
    pub fn write(&self, path: &Path) -> Result<(), ModelFileError> {
        write_proven(&self.to_bytes()?, path)
    }

    /// Returns the steady model.
    ///
    /// # Errors
    /// If it is a transient model.
    pub fn stationary(self) -> Result<Arc<ReducedModel>, ModelFileError> {
        match self {
            Self::Stationary(model) => Ok(model),
            Self::InTime(_) => Err(ModelFileError::InTime),
        }
    }

    /// Returns the transient model.
    ///
    /// # Errors
    /// If it is a steady model.
    pub fn in_time(self) -> Result<Arc<TrajectoryModel>, ModelFileError> {
        match self {
            Self::Stationary(_) => Err(ModelFileError::Stationary),
            Self::InTime(model) => Ok(model),
        }
    }

    /// Returns the title.
    pub fn title(&self) -> &str {
        match self {
            Self::Stationary(model) => &model.title,
            Self::InTime(model) => &model.title,
        }
    }

    /// Checks the model by solving contacts that it was trained with.
    pub(super) fn prove(&self, observer: &dyn Observer) -> Result<(), ModelFileError> {
        match self {
            Self::Stationary(model) => on_all_cores(|| steady::prove(model, observer)),
            Self::InTime(model) => transient::prove(model),
        }
    }
}

/// Writes the content of a model file as a whole or not at all, after checking that it can be read.
///
/// # Errors
/// As [`SavedModel::write`].
pub(in crate::engine) fn write_proven(bytes: &[u8], path: &Path) -> Result<(), ModelFileError> {
    // The file has fewer digits than the model, so that the decoded content must be checked.
    SavedModel::from_bytes(bytes)?;
    Ok(atomic_file::replace(path, bytes)?)
}

/// Reads the bytes of a model file. Checks the announced size before memory is allocated.
fn content(path: &Path) -> Result<Vec<u8>, ModelFileError> {
    FORMAT.read(path).map_err(|reason| match reason {
        Unreadable::Io(source) => ModelFileError::Io { path: path.to_owned(), source },
        Unreadable::Flaw(flaw) => flaw.into(),
    })
}

/// Reads a file of either kind with an observer, as [`SavedModel::read`].
///
/// # Errors
/// As [`SavedModel::read`], and if the observer cancels.
pub(in crate::engine) fn read_watched(path: &Path, observer: &dyn Observer) -> Result<SavedModel, ModelFileError> {
    let model = from_own_bytes(&content(path)?, observer)?;
    model.prove(observer)?;
    Ok(model)
}

/// Reads a model from trusted bytes, without solving training contacts.
///
/// # Errors
/// As [`SavedModel::from_bytes`], and if the observer cancels.
pub(in crate::engine) fn from_own_bytes(bytes: &[u8], observer: &dyn Observer) -> Result<SavedModel, ModelFileError> {
    let contents = Contents::open(bytes)?;
    Ok(match contents.kind() {
        ModelKind::Steady => SavedModel::Stationary(Arc::new(on_all_cores(|| steady::decode(&contents, observer))?)),
        ModelKind::Transient => SavedModel::InTime(Arc::new(on_all_cores(|| transient::decode(&contents))?)),
    })
}

/// Reads a steady model without its bases, calibrations and kernels from trusted bytes. It has everything that the screen
/// shows of a model, except the modes; it cannot solve.
///
/// # Errors
/// If the file is damaged or of a transient model.
pub(in crate::engine) fn outline_from_own_bytes(bytes: &[u8]) -> Result<ReducedModel, ModelFileError> {
    let contents = Contents::outline(bytes)?;
    match contents.kind() {
        ModelKind::Steady => on_all_cores(|| steady::decode(&contents, &())),
        ModelKind::Transient => Err(ModelFileError::InTime),
    }
}

/// Returns the content of the file of a steady model.
///
/// # Errors
/// If it cannot be encoded.
pub(in crate::engine) fn to_bytes(model: &ReducedModel) -> Result<Vec<u8>, ModelFileError> {
    on_all_cores(|| steady::encode(model)).ok_or(damaged("encoding"))
}

/// Returns the content of the file of a transient model.
///
/// # Errors
/// If it cannot be encoded.
pub(super) fn in_time_to_bytes(model: &TrajectoryModel) -> Result<Vec<u8>, ModelFileError> {
    on_all_cores(|| transient::encode(model)).ok_or(damaged("encoding"))
}
