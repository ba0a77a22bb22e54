//! There are no threads in a page: what would run on one is done at once by its caller, or by another instance.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

/// Whether work can run beside the caller in this process.
pub const THREADS: bool = false;

/// Memory of an instance from which on models that can be read again are given back \[bytes\].
const CROWDED: usize = 160 << 20;
/// Bytes of a page of WebAssembly's memory.
const PAGE: usize = 1 << 16;

/// Returns true if memory is short, so that models that can be read again are given back.
pub fn is_crowded() -> bool {
    core::arch::wasm32::memory_size::<0>() * PAGE > CROWDED
}

/// Would start a thread.
///
/// # Errors
/// Always.
pub fn spawn<T: Send + 'static>(
    _name: &str,
    _work: impl FnOnce() -> T + Send + 'static,
) -> io::Result<std::thread::JoinHandle<T>> {
    Err(io::Error::new(io::ErrorKind::Unsupported, "a page has no threads"))
}

/// Would let the calling thread sleep; a page must not.
pub fn pause(_duration: Duration) {}

/// The next value, if it is there: a page must not wait.
///
/// # Errors
/// When none is there, or none can come any more.
pub fn receive<T>(values: &Receiver<T>, _patience: Duration) -> Result<T, RecvTimeoutError> {
    values.try_recv().map_err(|none| match none {
        TryRecvError::Empty => RecvTimeoutError::Timeout,
        TryRecvError::Disconnected => RecvTimeoutError::Disconnected,
    })
}
