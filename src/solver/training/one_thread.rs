//! Work that nothing can interrupt (a decomposition, a kernel, a plan of many points), done so that a cancel need not
//! wait for it; and work of many parts, done on all threads.

use super::error::TrainingError;
use crate::host::pool;
use crate::solver::observer::{Observer, Progress};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Does `work` on a separate thread while the observer is asked; see [`pool::on_one_thread`].
///
/// # Errors
/// When the observer cancels.
pub fn on_one_thread<T: Send + 'static>(
    observer: &dyn Observer,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, TrainingError> {
    pool::on_one_thread(|| !observer.cancelled(), work).ok_or(TrainingError::Cancelled)
}

/// Does `work` for every item, on all threads with a tool of `tool` each; what came of the items is in their order.
///
/// # Errors
/// When the observer cancels.
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
