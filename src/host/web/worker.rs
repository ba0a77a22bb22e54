//! Thread functions of the web page, where WebAssembly has no threads: nothing can be spawned, nothing waits. Work is
//! done by the caller, or by another instance of the module in a web worker. Also tells whether memory is short.

use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

/// True if this process can run work in parallel with the caller.
pub const THREADS: bool = false;

/// Memory of this instance above which reduced models that can be read again are dropped \[bytes\].
const MEMORY_LIMIT: usize = 128 << 20;
/// Bytes of a page of WebAssembly's memory.
const PAGE: usize = 1 << 16;

/// Returns true if memory is short, so that reduced models that can be read again are dropped.
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

/// Returns the next value if it is available. A page must not wait.
///
/// # Errors
/// If no value is available, or the channel is closed.
pub fn receive<T>(values: &Receiver<T>, _timeout: Duration) -> Result<T, RecvTimeoutError> {
    values.try_recv().map_err(|none| match none {
        TryRecvError::Empty => RecvTimeoutError::Timeout,
        TryRecvError::Disconnected => RecvTimeoutError::Disconnected,
    })
}
