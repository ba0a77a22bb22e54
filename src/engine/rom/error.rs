//! Errors of model files.

use super::container::VERSION;
use crate::scene::atomic_file::{self, WriteError};
use crate::solver::discrete::grid::GridError;
use std::path::PathBuf;

/// Reason why a model file is refused.
#[derive(Debug, thiserror::Error)]
pub enum ModelFileError {
    /// Reading failed.
    #[error("cannot read {}: {}", path.display(), atomic_file::said(source))]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// Writing failed.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// Not a model file.
    #[error("this is not a reduced model file (.rom); train one with `ehl-explorer train SCENE.ron --out FILE.rom`")]
    Foreign,
    /// File of a model of the program that a web page could not fetch.
    #[error("the file of this reduced model could not be fetched; check the network connection and try again")]
    Missing,
    /// Written by a program with another version of the format.
    #[error("the model file has version {found}, but this program reads version {VERSION}; train it again")]
    OtherVersion {
        /// Version of the file.
        found: u32,
    },
    /// Transient model where a steady one is required.
    #[error(
        "this is a transient reduced model; use it in a scene with study: Transient(…, reduced: (model: File(\"FILE.rom\"))), \
         or export it with `ehl-explorer export fmu`"
    )]
    InTime,
    /// Steady model where a transient one is required.
    #[error(
        "this is a reduced model of steady contacts, but a transient one is required; `ehl-explorer train` creates one \
         from a scene whose study is Transient(…, reduced: (…))"
    )]
    Stationary,
    /// Truncated file.
    #[error("the model file is cut off: {found} of {wanted} bytes are there; copy it again or train it again")]
    Truncated {
        /// Size of the file \[bytes\].
        found: u64,
        /// Size announced in the header \[bytes\].
        wanted: u64,
    },
    /// Announced size larger than that of any model.
    #[error("the model file announces {bytes} bytes, more than any model has; it is damaged")]
    TooLarge {
        /// Announced size \[bytes\].
        bytes: u64,
    },
    /// The content does not match its hash, or is inconsistent.
    #[error("the model file is damaged ({what}); copy it again or train it again")]
    Damaged {
        /// Inconsistent part.
        what: &'static str,
    },
    /// A local model does not reproduce solutions that it was trained with.
    #[error("the local model M {}…{} does not reproduce its own training points; train the model again", m.0, m.1)]
    Unproven {
        /// Range of M of the local model.
        m: (f64, f64),
    },
    /// A transient model does not reproduce the steady contacts at the start of its trainings.
    #[error("the transient model does not reproduce the steady contacts at the start of its trainings; train it again")]
    UnprovenInTime,
    /// Reading was cancelled.
    #[error("cancelled")]
    Cancelled,
    /// The grid of the model is refused.
    #[error("the model file's grid is refused: {0}")]
    Grid(#[from] GridError),
}

pub(super) fn damaged(what: &'static str) -> ModelFileError {
    ModelFileError::Damaged { what }
}
