//! Runs parts of a training so that they can be cancelled. Uninterruptible work (a decomposition, a kernel, a plan of
//! many points) runs on a separate thread, and a cancellation does not wait for it. Work of many items runs on all
//! threads.

use super::error::TrainingError;
use crate::host::pool;
use crate::solver::observer::{Observer, Progress};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs `work` on a separate thread and checks the observer meanwhile; see [`pool::on_one_thread`].
///
/// # Errors
/// [`TrainingError::Cancelled`] if the observer cancels.
pub fn on_one_thread<T: Send + 'static>(
    observer: &dyn Observer,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, TrainingError> {
    pool::on_one_thread(|| !observer.cancelled(), work).ok_or(TrainingError::Cancelled)
}

/// Runs `work` for every item on all threads, with the work space of the thread, the index of the item, and the item.
/// `tool` creates a work space. `stage` names the work in reports of progress. Returns the results in the order of the
/// items.
///
/// # Errors
/// [`TrainingError::Cancelled`] if the observer cancels.
pub(super) fn in_parallel<T: Sync, W, R: Send>(
    observer: &dyn Observer,
    stage: &str,
    items: &[T],
    tool: impl Fn() -> W + Sync + Send,
    work: impl Fn(&mut W, usize, &T) -> R + Sync + Send,
) -> Result<Vec<R>, TrainingError> {
    let done = AtomicUsize::new(0);
    let one = |tool: &mut W, index: usize, item: &T| {
        if observer.cancelled() {
            return Err(TrainingError::Cancelled);
        }
        let result = work(tool, index, item);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        observer.progress(Progress { stage: stage.to_owned(), done, total: items.len() });
        Ok(result)
    };
    pool::map_with(items, tool, one)
}
