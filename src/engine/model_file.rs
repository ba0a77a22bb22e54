//! Reduced model files (`.rom`): the header of `checked_file`, then what `stored_model` makes of a model. Models in time,
//! whose versions count on from another number, are those of [`super::trajectory_file`].

use super::checked_file::{Flaw, Format, Unreadable};
use super::stored_model;
use super::trajectory_file::in_time;
use crate::scene::atomic_file::{self, WriteError};
use crate::solver::discrete::grid::GridError;
use crate::solver::observer::Observer;
use crate::solver::reduced::ReducedModel;
use std::path::{Path, PathBuf};

const VERSION: u32 = 18;
/// From it on the parts of a model have names.
const OLDEST: u32 = 14;
/// What every reduced model file begins with.
pub(super) const MAGIC: &[u8; 8] = b"EHLROM\r\n";
/// Real models have a few MB.
pub(super) const MAX_PAYLOAD: u64 = 512 << 20;
const FORMAT: Format =
    Format { magic: MAGIC, version: VERSION, oldest: OLDEST, whole_hash: 7, max_payload: MAX_PAYLOAD };

/// Why a model file is refused. Nothing is lost by it.
#[derive(Debug, thiserror::Error)]
pub enum ModelFileError {
    /// Reading failed.
    #[error("cannot read {}: {}", path.display(), atomic_file::said(source))]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Writing failed.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Not a model file at all.
    #[error("this is not a reduced model file (.rom); train one with `ehl-explorer train SCENE.ron --out FILE.rom`")]
    Foreign,
    /// Written by a newer program.
    #[error(
        "the model file has version {found}, but this program reads version {VERSION}; use a newer program or train it again"
    )]
    Newer {
        /// Its version.
        found: u32,
    },
    /// A model in time, where one of stationary contacts is wanted.
    #[error(
        "this is a reduced model in time; a scene takes contacts through time with it (study: Transient(…, reduced: \
         (model: File(\"FILE.rom\")))), and `ehl-explorer export fmu` makes a unit of it"
    )]
    InTime,
    /// A model of stationary contacts, where one in time is wanted.
    #[error(
        "this is a reduced model of stationary contacts, but one in time is wanted; `ehl-explorer train` makes one of a \
         scene whose study is Transient(…, reduced: (…))"
    )]
    Stationary,
    /// A model in time that was written by a newer program.
    #[error(
        "the file of a reduced model in time has version {found}, but this program reads version {read}; use a newer \
         program or train it again"
    )]
    NewerInTime {
        /// Its version.
        found: u32,
        /// The newest that is read.
        read: u32,
    },
    /// Written by an older program.
    #[error("the model file has version {found}, but this program reads version {VERSION}; train it again")]
    Older {
        /// Its version.
        found: u32,
    },
    /// Cut off.
    #[error("the model file is cut off: {found} of {wanted} bytes are there; copy it again or train it again")]
    Truncated {
        /// Bytes that are there.
        found: u64,
        /// Bytes that the header announces.
        wanted: u64,
    },
    /// Larger than any model.
    #[error("the model file announces {bytes} bytes, more than any model has; it is damaged")]
    TooLarge {
        /// Bytes announced.
        bytes: u64,
    },
    /// The content does not fit its hash or itself.
    #[error("the model file is damaged ({what}); copy it again or train it again")]
    Damaged {
        /// What does not fit.
        what: &'static str,
    },
    /// Its parts do not give what it was trained from.
    #[error("the window M {}…{} of the model does not solve its own training points; train it again", m.0, m.1)]
    Unproven {
        /// Range of M of the window.
        m: (f64, f64),
    },
    /// A model in time does not rest where its trainings began.
    #[error("the model in time does not find the contacts that its trainings began with; train it again")]
    UnprovenInTime,
    /// It is no longer wanted.
    #[error("cancelled")]
    Cancelled,
    /// Its grid is refused.
    #[error("the model file's grid is refused: {0}")]
    Grid(#[from] GridError),
}

impl From<Flaw> for ModelFileError {
    fn from(flaw: Flaw) -> Self {
        match flaw {
            Flaw::Foreign => Self::Foreign,
            Flaw::Newer { found } if in_time(found) => Self::InTime,
            Flaw::Newer { found } => Self::Newer { found },
            Flaw::Older { found } => Self::Older { found },
            Flaw::Truncated { found, wanted } => Self::Truncated { found, wanted },
            Flaw::TooLarge { bytes } => Self::TooLarge { bytes },
            Flaw::Changed => Self::Damaged { what: "its content does not match its hash" },
        }
    }
}

/// Reads a model file. Its announced size is checked before anything is allocated.
///
/// # Errors
/// When the file cannot be read, is foreign, newer, cut off or damaged.
pub fn read(path: &Path) -> Result<ReducedModel, ModelFileError> {
    read_watched(path, &())
}

/// The same while an observer watches.
///
/// # Errors
/// As [`read`], and when the observer cancels.
pub(super) fn read_watched(path: &Path, observer: &dyn Observer) -> Result<ReducedModel, ModelFileError> {
    proven(&content(path)?, observer)
}

/// The content of a model file, of no more than its announced size.
pub(super) fn content(path: &Path) -> Result<Vec<u8>, ModelFileError> {
    FORMAT.read(path).map_err(|reason| match reason {
        Unreadable::Io(source) => ModelFileError::Io { path: path.to_owned(), source },
        Unreadable::Flaw(flaw) => flaw.into(),
    })
}

/// Writes a model file as a whole or not at all.
///
/// # Errors
/// When the file cannot be written, or would be refused by [`read`].
pub fn write(model: &ReducedModel, path: &Path) -> Result<(), ModelFileError> {
    let bytes = to_bytes(model)?;
    // What is written has fewer digits than what was trained.
    proven(&bytes, &())?;
    Ok(atomic_file::replace(path, &bytes)?)
}

/// The content of a model file.
///
/// # Errors
/// When the model cannot be encoded.
pub fn to_bytes(model: &ReducedModel) -> Result<Vec<u8>, ModelFileError> {
    let payload = stored_model::encode(model).ok_or(ModelFileError::Damaged { what: "encoding" })?;
    Ok(FORMAT.seal(&payload))
}

/// A model from the content of a file.
///
/// # Errors
/// As [`read`].
pub fn from_bytes(bytes: &[u8]) -> Result<ReducedModel, ModelFileError> {
    proven(bytes, &())
}

fn proven(bytes: &[u8], observer: &dyn Observer) -> Result<ReducedModel, ModelFileError> {
    let model = from_own_bytes(bytes, observer)?;
    stored_model::prove(&model, observer)?;
    Ok(model)
}

/// The same of bytes that belong to the program, whose parts are known to belong together.
pub(super) fn from_own_bytes(bytes: &[u8], observer: &dyn Observer) -> Result<ReducedModel, ModelFileError> {
    stored_model::decode(FORMAT.open(bytes)?, observer)
}

#[cfg(test)]
mod tests;
