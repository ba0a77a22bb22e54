//! Files of the built-in trained models.

/// Returns the content of a model's file. Always `None`, because a native program has no files to fetch.
pub fn now(_name: &str) -> Option<Vec<u8>> {
    None
}

/// Calls `then` from another thread.
pub fn then(name: &str, then: impl FnOnce() + Send + 'static) {
    // If no thread can be started, `then` is not called.
    let _handle = super::worker::spawn(name, then);
}
