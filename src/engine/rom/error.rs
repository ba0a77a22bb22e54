//! Why a model file is refused.

use super::container::VERSION;
use crate::scene::atomic_file::{self, WriteError};
use crate::solver::discrete::grid::GridError;
use std::path::PathBuf;

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
    /// Written by a program with another format.
    #[error("the model file has version {found}, but this program reads version {VERSION}; train it again")]
    OtherVersion {
        /// Its version.
        found: u32,
    },
    /// A transient model, where a steady one is wanted.
    #[error(
        "this is a transient reduced model; a scene takes contacts through time with it (study: Transient(…, reduced: \
         (model: File(\"FILE.rom\")))), and `ehl-explorer export fmu` makes a unit of it"
    )]
    InTime,
    /// A steady model, where a transient one is wanted.
    #[error(
        "this is a reduced model of steady contacts, but a transient one is wanted; `ehl-explorer train` makes one of a \
         scene whose study is Transient(…, reduced: (…))"
    )]
    Stationary,
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
    /// The parts of a steady model do not give what it was trained from.
    #[error("the window M {}…{} of the model does not solve its own training points; train it again", m.0, m.1)]
    Unproven {
        /// Range of M of the window.
        m: (f64, f64),
    },
    /// A transient model does not find the steady contacts where its trainings began.
    #[error("the transient model does not find the contacts that its trainings began with; train it again")]
    UnprovenInTime,
    /// It is no longer wanted.
    #[error("cancelled")]
    Cancelled,
    /// Its grid is refused.
    #[error("the model file's grid is refused: {0}")]
    Grid(#[from] GridError),
}

pub(super) fn damaged(what: &'static str) -> ModelFileError {
    ModelFileError::Damaged { what }
}
