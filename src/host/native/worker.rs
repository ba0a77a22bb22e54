//! Threads for work in parallel to the caller.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

/// True if this process can run work in parallel to the caller.
pub const THREADS: bool = true;

/// Returns true if memory is short, so that models that can be read again are given back. Never on a desktop.
pub fn is_crowded() -> bool {
    false
}

/// Starts a thread with this name.
///
/// # Errors
/// If the system cannot start another thread.
pub fn spawn<T: Send + 'static>(name: &str, work: impl FnOnce() -> T + Send + 'static) -> io::Result<JoinHandle<T>> {
    Builder::new().name(name.replace('\0', " ")).spawn(work)
}

/// Suspends the calling thread.
pub fn pause(duration: Duration) {
    std::thread::sleep(duration);
}

/// Waits for the next value, at most for `patience`.
///
/// # Errors
/// If no value arrived in time, or the channel is closed.
pub fn receive<T>(values: &Receiver<T>, patience: Duration) -> Result<T, RecvTimeoutError> {
    values.recv_timeout(patience)
}
