//! Reasons why a background job ends early, and a function that turns a panic into such a reason.

use serde::{Deserialize, Serialize};
use std::any::Any;
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Reason why a job ended early.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
pub enum JobError {
    /// No thread could be started.
    #[error("no thread could be started for this computation")]
    NoThread,
    /// The worker ended before the job. It is another instance of the program.
    #[error("the worker of this computation has ended; try again")]
    Lost,
    /// The work panicked.
    #[error(transparent)]
    Panicked(#[from] Panicked),
    /// The work is refused or has no result.
    #[error("{0}")]
    Failed(String),
}

impl JobError {
    /// Returns [`Self::Failed`] with this reason.
    pub fn failed(reason: impl Display) -> Self {
        Self::Failed(reason.to_string())
    }
}

impl From<String> for JobError {
    fn from(sentence: String) -> Self {
        Self::Failed(sentence)
    }
}

/// Panic of the work, with its message.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[error("the solver stopped unexpectedly ({0}); the window and your work are not affected")]
pub struct Panicked(String);

/// Runs a function and catches panics.
///
/// # Errors
/// If the function panics.
pub fn guarded<T>(run: impl FnOnce() -> T) -> Result<T, Panicked> {
    catch_unwind(AssertUnwindSafe(run)).map_err(|payload| Panicked(panic_text(&*payload).to_owned()))
}

/// Returns the message of a panic.
fn panic_text(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason given")
}
