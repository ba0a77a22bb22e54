//! Thread functions of the web page, with the names of the native ones. WebAssembly has no threads here, so the
//! functions neither start threads nor wait. Work is done by the caller, or by another instance of the program in a web
//! worker.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

/// True if this process can run work in parallel with the caller.
pub const THREADS: bool = false;

/// Memory of this instance above which it counts as short \[bytes\].
const MEMORY_LIMIT: usize = 128 << 20;
/// Size of a page of WebAssembly memory \[bytes\].
const PAGE: usize = 1 << 16;

/// Returns true if memory is short. The caller then frees reduced models that it can read again.
pub fn is_crowded() -> bool {
    core::arch::wasm32::memory_size::<0>() * PAGE > MEMORY_LIMIT
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

/// Returns the next value if it is available. Does not wait, because that would block the page.
///
/// # Errors
/// If no value is available, or the channel is closed.
pub fn receive<T>(values: &Receiver<T>, _timeout: Duration) -> Result<T, RecvTimeoutError> {
    values.try_recv().map_err(|error| match error {
        TryRecvError::Empty => RecvTimeoutError::Timeout,
        TryRecvError::Disconnected => RecvTimeoutError::Disconnected,
    })
}
