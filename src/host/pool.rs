//! Parallel work on the cores of the machine. All parallel work starts here and never in the global pool of rayon:
//! after a `fork` that pool has no threads in the child process, which would wait forever.

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::OnceLock;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Longest time between two calls of `go_on` by [`on_one_thread`].
const PATIENCE: Duration = Duration::from_millis(10);

/// Thread pool of a process, followed by the pools of the processes that were forked from it.
struct Pool {
    process: u32,
    /// `None` if the system has no threads.
    threads: Option<ThreadPool>,
    next: OnceLock<Box<Pool>>,
}

static FIRST: OnceLock<Box<Pool>> = OnceLock::new();

/// Returns the pool of this process, and creates it at the first call.
fn of_this_process() -> Option<&'static ThreadPool> {
    // Only these systems fork. Others need not have process numbers.
    let process = if cfg!(unix) { std::process::id() } else { 0 };
    let mut place = &FIRST;
    loop {
        match place.get() {
            Some(pool) if pool.process == process => return pool.threads.as_ref(),
            Some(pool) => place = &pool.next,
            None => {
                #[cfg(test)]
                tests::forbid_the_global_pool();
                let threads = ThreadPoolBuilder::new().build().ok();
                // If another thread was faster, the next pass of the loop finds its pool.
                let _ = place.set(Box::new(Pool { process, threads, next: OnceLock::new() }));
            }
        }
    }
}

/// Runs `work`, whose parallel parts use all cores. Inside other parallel work it stays in the present pool.
pub fn on_all_cores<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    if rayon::current_thread_index().is_some() {
        return work();
    }
    match of_this_process() {
        Some(pool) => pool.install(work),
        None => {
            // The calling thread becomes the only thread of a pool.
            let _alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
            work()
        }
    }
}

/// Returns the value of a cell, and computes it first by parallel work if the cell is empty. `get_or_init` would block
/// for ever: a thread that waits for parallel work takes up other work, which may ask for the same value. Several threads
/// that ask at the same time all compute it.
pub fn computed<T>(cell: &OnceLock<T>, compute: impl FnOnce() -> T) -> &T {
    match cell.get() {
        Some(value) => value,
        None => {
            let value = compute();
            cell.get_or_init(|| value)
        }
    }
}

/// Returns the number of threads that parallel work uses here.
pub fn threads() -> usize {
    on_all_cores(rayon::current_num_threads)
}

/// Returns the number of cores of the machine.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Runs `work` in a new pool of `threads` threads.
pub fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    match ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        Err(_) => on_all_cores(work),
    }
}

/// Runs `work` on all cores but one, which stays free for the window and its live picture.
pub fn on_spare_cores<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    on_threads(cores().saturating_sub(1).max(1), work)
}

/// Runs `work` on a new thread while the calling thread polls `go_on`. If `go_on` returns false, returns `None`;
/// the thread then finishes, and its result is dropped.
///
/// The thread is the only one of its pool. Sums are otherwise split by the number of threads, so this makes
/// results, such as a trained model, bitwise equal on every machine.
pub fn on_one_thread<T: Send + 'static>(
    go_on: impl Fn() -> bool,
    work: impl FnOnce() -> T + Send + 'static,
) -> Option<T> {
    if !go_on() {
        return None;
    }
    // Without another thread the work runs here, with results equal up to rounding.
    let Ok(pool) = ThreadPoolBuilder::new().num_threads(1).build() else { return Some(on_all_cores(work)) };
    let (sender, receiver) = channel();
    pool.spawn(move || {
        // Pass a panic on to the receiver. After `go_on` has returned false there is no receiver.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(work)));
    });
    loop {
        match receiver.recv_timeout(PATIENCE) {
            Ok(Ok(done)) => return Some(done),
            Ok(Err(panic)) => resume_unwind(panic),
            Err(RecvTimeoutError::Timeout) if go_on() => {}
            Err(_) => return None,
        }
    }
}

/// Runs both closures in parallel.
pub fn both<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    on_all_cores(|| rayon::join(a, b))
}

/// Calls `work` for every item with its index. Uses several threads if each of them gets at least `least` items.
pub fn each<T: Send>(items: &mut [T], least: usize, work: impl Fn(usize, &mut T) + Sync + Send) {
    if items.len() / 2 < least {
        return items.iter_mut().enumerate().for_each(|(k, item)| work(k, item));
    }
    on_all_cores(|| items.par_iter_mut().enumerate().with_min_len(least).for_each(|(k, item)| work(k, item)));
}

/// Calls `work` for every chunk of `size` items with its index. Uses several threads if each gets at least `least`
/// chunks.
pub fn each_chunk<T: Send>(items: &mut [T], size: usize, least: usize, work: impl Fn(usize, &mut [T]) + Sync + Send) {
    if items.len().div_ceil(size) / 2 < least {
        return items.chunks_mut(size).enumerate().for_each(|(k, chunk)| work(k, chunk));
    }
    on_all_cores(|| items.par_chunks_mut(size).enumerate().with_min_len(least).for_each(|(k, chunk)| work(k, chunk)));
}

/// Returns the results of `work` for every item with its index, in the order of the items. Uses all threads; each
/// thread works with its own tools from `tool`.
///
/// # Errors
/// The first error of `work`. The remaining items are skipped.
pub fn map_with<T: Sync, W, R: Send, E: Send>(
    items: &[T],
    tool: impl Fn() -> W + Sync + Send,
    work: impl Fn(&mut W, usize, &T) -> Result<R, E> + Sync + Send,
) -> Result<Vec<R>, E> {
    let one = |tool: &mut W, (index, item): (usize, &T)| work(tool, index, item);
    on_all_cores(|| items.par_iter().enumerate().map_init(tool, one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// Makes parallel work outside [`on_all_cores`] panic in all unit tests.
    pub(super) fn forbid_the_global_pool() {
        let no_thread = |_| Err(io::Error::other("the global pool is not used"));
        let refused = ThreadPoolBuilder::new().spawn_handler(no_thread).build_global();
        assert!(refused.is_err());
    }

    #[test]
    fn parallel_work_runs_in_the_pool_of_this_process_alone() {
        let count = AtomicUsize::new(0);
        let mut items = vec![0; 1000];
        each(&mut items, 10, |k, item| {
            assert!(rayon::current_thread_index().is_some());
            count.fetch_add(1, Ordering::Relaxed);
            *item = k;
        });
        assert!(count.into_inner() == 1000 && items.iter().enumerate().all(|(k, item)| k == *item));
        each_chunk(&mut items, 3, usize::MAX, |k, chunk| {
            assert!(rayon::current_thread_index().is_none() && chunk[0] == 3 * k);
        });
        assert_eq!(
            map_with(&items, || (), |(), k, item| if k < 2000 { Ok(k + item) } else { Err(()) }).unwrap()[7],
            14
        );
        assert_eq!(both(|| 1, || 2), (1, 2));
        assert!(std::panic::catch_unwind(|| items.par_iter().for_each(|_| ())).is_err(), "not in the global pool");
        assert_eq!(on_threads(3, threads), 3);
    }

    #[test]
    fn work_on_one_thread_is_left_when_nobody_wants_it() {
        assert_eq!(on_one_thread(|| true, threads), Some(1));
        assert_eq!(on_one_thread(|| false, || 1), None);
        let asked = AtomicUsize::new(0);
        let wait = || std::thread::sleep(50 * PATIENCE);
        assert_eq!(on_one_thread(|| asked.fetch_add(1, Ordering::Relaxed) < 2, wait), None);
        assert!(std::panic::catch_unwind(|| on_one_thread(|| true, || panic!("broken"))).is_err());
    }
}
