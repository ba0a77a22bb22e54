//! Errors of commands.

use super::program::NoWindow;
use crate::engine::EngineError;
use crate::scene::atomic_file::WriteError;
use crate::scene::{Refusal, SceneFileError, Words};

/// Reason why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The request is invalid.
    #[error("{0}")]
    Request(String),
    /// The window cannot be opened.
    #[error(transparent)]
    Window(#[from] NoWindow),
    /// Error of the engine.
    #[error(transparent)]
    Harness(EngineError),
    /// The run was cancelled.
    #[error("the run was stopped before it was done")]
    Stopped,
    /// The reader of standard output has closed it. No message can be shown.
    #[error("standard output was closed by its reader")]
    ReaderLeft,
    /// Standard output cannot be written.
    #[error("cannot write to standard output: {0}")]
    Output(std::io::Error),
}

impl From<EngineError> for Failure {
    fn from(error: EngineError) -> Self {
        if error.cancelled() { Self::Stopped } else { Self::Harness(error) }
    }
}

impl From<SceneFileError> for Failure {
    fn from(error: SceneFileError) -> Self {
        Self::Harness(error.into())
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::Harness(error.into())
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        if error.kind() == std::io::ErrorKind::BrokenPipe { Self::ReaderLeft } else { Self::Output(error) }
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Request(refusal.in_words(Words::Flags))
    }
}

/// Returns the first paragraph of clap's message, on one line.
pub fn usage(error: &clap::Error) -> Failure {
    let text = error.render().to_string();
    let paragraph: Vec<&str> = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let sentence = paragraph.join(" ");
    let sentence = sentence.strip_prefix("error: ").unwrap_or(&sentence);
    Failure::Request(format!("{sentence}; --help lists what is accepted"))
}
