//! Work in a worker of the page, which is another instance of the program.

use super::page;

/// Sends a task to another instance. `receive` gets its messages, and `None` if it ended without a last message; it
/// returns true while it expects more. Returns `None` if there is no other instance.
pub fn post(
    lane: usize,
    kind: &str,
    task: &[u8],
    receive: impl FnMut(Option<Vec<u8>>) -> bool + 'static,
) -> Option<Posted> {
    let ticket = page::ticket(receive);
    if page::post(lane as u32, ticket, kind, task) {
        return Some(Posted(ticket));
    }
    page::forget(ticket);
    None
}

/// Task in another instance.
pub struct Posted(u32);

impl Posted {
    /// Reports to the instance how often the task was requested to stop.
    pub fn stop(&self, times: u8) {
        page::stop(self.0, times);
    }
}
