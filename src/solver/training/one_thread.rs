//! Work that nothing can interrupt (a decomposition, a kernel, a plan of many points), done so that a cancel need not
//! wait for it.

use super::TrainingError;
use crate::solver::observer::Observer;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Longest time between two looks at the observer.
const PATIENCE: Duration = Duration::from_millis(10);

/// Does `work` on a thread of its own while the observer is asked; after a cancel the thread finishes unheard.
///
/// Linear algebra splits its sums by the threads it finds: on one thread a model is the same to the last bit on every
/// machine size.
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
