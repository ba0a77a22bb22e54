//! Work in another instance of the program. A native program uses threads instead.

/// Sends a task to another instance. Always returns `None`, because there is no other instance.
pub fn post(
    _lane: usize,
    _kind: &str,
    _task: &[u8],
    _receive: impl FnMut(Option<Vec<u8>>) -> bool + 'static,
) -> Option<Posted> {
    None
}

/// Task in another instance.
pub enum Posted {}

impl Posted {
    /// Reports to the instance how often the task was requested to stop.
    pub fn stop(&self, _times: u8) {
        match *self {}
    }
}
