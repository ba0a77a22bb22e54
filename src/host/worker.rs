//! Threads for work beside the caller.

use std::io;
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

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
