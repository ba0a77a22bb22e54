//! Work that nothing can interrupt (a decomposition, a kernel, a plan of many points), done so that a cancel need not
//! wait for it; and work of many parts, done on all threads.

use super::{Progress, TrainingError};
use crate::solver::observer::Observer;
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Longest time between two looks at the observer.
const PATIENCE: Duration = Duration::from_millis(10);

/// Does `work` on a thread of its own while the observer is asked; after a cancel the thread finishes unheard.
///
/// The thread is alone in its pool: sums that are split by the threads there are, and with them a model, are the same
/// to the last bit on every machine size.
///
/// # Errors
/// When the observer cancels.
pub fn on_one_thread<T: Send + 'static>(
    observer: &dyn Observer,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, TrainingError> {
    if observer.cancelled() {
        return Err(TrainingError::Cancelled);
    }
    // Without another thread the work is done here, equal to rounding.
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return Ok(work()) };
    let (sender, receiver) = channel();
    pool.spawn(move || {
        // A panic is passed on to whoever waits; after a cancel nobody does.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(work)));
    });
    loop {
        match receiver.recv_timeout(PATIENCE) {
            Ok(Ok(done)) => return Ok(done),
            Ok(Err(panic)) => resume_unwind(panic),
            Err(RecvTimeoutError::Timeout) if !observer.cancelled() => {}
            Err(_) => return Err(TrainingError::Cancelled),
        }
    }
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
    let one = |tool: &mut W, (index, item): (usize, &T)| {
        if observer.cancelled() {
            return Err(TrainingError::Cancelled);
        }
        let result = work(tool, index, item);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        observer.progress(Progress { stage: stage.to_owned(), done, total: items.len() });
        Ok(result)
    };
    items.par_iter().enumerate().map_init(tool, one).collect()
}
