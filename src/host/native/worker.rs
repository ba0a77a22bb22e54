//! Threads for work beside the caller.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

/// Whether work can run beside the caller in this process.
pub const THREADS: bool = true;

/// Returns true if memory is short, so that models that can be read again are given back. Never on a desktop.
pub fn is_crowded() -> bool {
    false
}

/// Starts a thread of this name.
///
/// # Errors
/// When the system has no thread left.
pub fn spawn<T: Send + 'static>(name: &str, work: impl FnOnce() -> T + Send + 'static) -> io::Result<JoinHandle<T>> {
    Builder::new().name(name.replace('\0', " ")).spawn(work)
}

/// Lets the calling thread sleep.
pub fn pause(duration: Duration) {
    std::thread::sleep(duration);
}

/// Waits for the next value for at most a while.
///
/// # Errors
/// When none came, or none can come any more.
pub fn receive<T>(values: &Receiver<T>, patience: Duration) -> Result<T, RecvTimeoutError> {
    values.recv_timeout(patience)
}
