//! Reading and writing a `.rom` file of either kind.

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

/// A reduced model of either kind.
#[derive(Clone)]
pub enum SavedModel {
    /// Of steady contacts.
    Stationary(Arc<ReducedModel>),
    /// Of transient contacts.
    InTime(Arc<TrajectoryModel>),
}

impl SavedModel {
    /// Reads a file of either kind.
    ///
    /// # Errors
    /// When it cannot be read, is foreign, of another version, cut off or damaged.
    pub fn read(path: &Path) -> Result<Self, ModelFileError> {
        Self::read_with_content(path).map(|(model, _)| model)
    }

    /// Reads a file of either kind and returns its bytes as well.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_with_content(path: &Path) -> Result<(Self, Vec<u8>), ModelFileError> {
        let content = content(path)?;
        Ok((Self::from_bytes(&content)?, content))
    }

    /// A model from the content of a file.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ModelFileError> {
        let model = from_own_bytes(bytes, &())?;
        model.prove(&())?;
        Ok(model)
    }

    /// The content of its file.
    ///
    /// # Errors
    /// When it cannot be encoded.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ModelFileError> {
        match self {
            Self::Stationary(model) => to_bytes(model),
            Self::InTime(model) => in_time_to_bytes(model),
        }
    }

    /// Writes its file as a whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written, or would be refused by [`Self::read`].
    pub fn write(&self, path: &Path) -> Result<(), ModelFileError> {
        write_proven(&self.to_bytes()?, path)
    }

    /// The steady model.
    ///
    /// # Errors
    /// When it is a transient one.
    pub fn stationary(self) -> Result<Arc<ReducedModel>, ModelFileError> {
        match self {
            Self::Stationary(model) => Ok(model),
            Self::InTime(_) => Err(ModelFileError::InTime),
        }
    }

    /// The transient model.
    ///
    /// # Errors
    /// When it is a steady one.
    pub fn in_time(self) -> Result<Arc<TrajectoryModel>, ModelFileError> {
        match self {
            Self::Stationary(_) => Err(ModelFileError::Stationary),
            Self::InTime(model) => Ok(model),
        }
    }

    /// Its title.
    pub fn title(&self) -> &str {
        match self {
            Self::Stationary(model) => &model.title,
            Self::InTime(model) => &model.title,
        }
    }

    /// Solves contacts that it was trained with, and compares.
    pub(super) fn prove(&self, observer: &dyn Observer) -> Result<(), ModelFileError> {
        match self {
            Self::Stationary(model) => on_all_cores(|| steady::prove(model, observer)),
            Self::InTime(model) => transient::prove(model),
        }
    }
}

/// Writes the content of a model file as a whole or not at all.
///
/// # Errors
/// As [`SavedModel::write`].
pub(in crate::engine) fn write_proven(bytes: &[u8], path: &Path) -> Result<(), ModelFileError> {
    // A file has fewer digits than a model that was just trained.
    SavedModel::from_bytes(bytes)?;
    Ok(atomic_file::replace(path, bytes)?)
}

/// Reads the bytes of a model file. Checks the announced size before it allocates memory.
fn content(path: &Path) -> Result<Vec<u8>, ModelFileError> {
    FORMAT.read(path).map_err(|reason| match reason {
        Unreadable::Io(source) => ModelFileError::Io { path: path.to_owned(), source },
        Unreadable::Flaw(flaw) => flaw.into(),
    })
}

/// [`SavedModel::read`] while an observer watches.
///
/// # Errors
/// As there, and when the observer cancels.
pub(in crate::engine) fn read_watched(path: &Path, observer: &dyn Observer) -> Result<SavedModel, ModelFileError> {
    let model = from_own_bytes(&content(path)?, observer)?;
    model.prove(observer)?;
    Ok(model)
}

/// Reads a model from bytes that belong to the program, without solving training contacts.
///
/// # Errors
/// As [`SavedModel::from_bytes`], and when the observer cancels.
pub(in crate::engine) fn from_own_bytes(bytes: &[u8], observer: &dyn Observer) -> Result<SavedModel, ModelFileError> {
    let contents = Contents::open(bytes)?;
    Ok(match contents.kind() {
        ModelKind::Steady => SavedModel::Stationary(Arc::new(on_all_cores(|| steady::decode(&contents, observer))?)),
        ModelKind::Transient => SavedModel::InTime(Arc::new(on_all_cores(|| transient::decode(&contents))?)),
    })
}

/// The content of the file of a steady model.
///
/// # Errors
/// When it cannot be encoded.
pub(in crate::engine) fn to_bytes(model: &ReducedModel) -> Result<Vec<u8>, ModelFileError> {
    on_all_cores(|| steady::encode(model)).ok_or(damaged("encoding"))
}

/// The content of the file of a transient model.
///
/// # Errors
/// When it cannot be encoded.
pub(super) fn in_time_to_bytes(model: &TrajectoryModel) -> Result<Vec<u8>, ModelFileError> {
    on_all_cores(|| transient::encode(model)).ok_or(damaged("encoding"))
}
