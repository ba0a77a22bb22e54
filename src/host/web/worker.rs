//! Substitutes for threads, which a page does not have. The caller does the work itself, or another instance does
//! it.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

/// True if this process can run work in parallel to the caller.
pub const THREADS: bool = false;

/// Memory of an instance from which on models that can be read again are given back \[bytes\].
const CROWDED: usize = 160 << 20;
/// Bytes of a page of WebAssembly's memory.
const PAGE: usize = 1 << 16;

/// Returns true if memory is short, so that models that can be read again are given back.
pub fn is_crowded() -> bool {
    core::arch::wasm32::memory_size::<0>() * PAGE > CROWDED
}

/// Refuses to start a thread.
///
/// # Errors
/// Always.
pub fn spawn<T: Send + 'static>(
    _name: &str,
    _work: impl FnOnce() -> T + Send + 'static,
) -> io::Result<std::thread::JoinHandle<T>> {
    Err(io::Error::new(io::ErrorKind::Unsupported, "a page has no threads"))
}

/// Does nothing, because a page must not sleep.
pub fn pause(_duration: Duration) {}

/// Returns the next value if it is available. A page must not wait.
///
/// # Errors
/// If no value is available, or the channel is closed.
pub fn receive<T>(values: &Receiver<T>, _patience: Duration) -> Result<T, RecvTimeoutError> {
    values.try_recv().map_err(|none| match none {
        TryRecvError::Empty => RecvTimeoutError::Timeout,
        TryRecvError::Disconnected => RecvTimeoutError::Disconnected,
    })
}
