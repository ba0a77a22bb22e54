//! Work in another instance of the program. A native program has threads instead.

/// Sends a task to another instance. Returns `None`: there is none.
pub fn post(
    _lane: usize,
    _kind: &str,
    _task: &[u8],
    _receive: impl FnMut(Option<Vec<u8>>) -> bool + 'static,
) -> Option<Posted> {
    None
}

/// A task in another instance.
pub enum Posted {}

impl Posted {
    /// Tells it how often it was asked to stop.
    pub fn stop(&self, _times: u8) {
        match *self {}
    }
}
