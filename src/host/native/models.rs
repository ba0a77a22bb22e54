//! Files of the trained models that are part of the program.

/// The content of the file of a model; nothing where the program was built without it.
pub fn now(_name: &str) -> Option<Vec<u8>> {
    None
}

/// Calls `then` once the file of a model is there, from any thread.
pub fn then(name: &str, then: impl FnOnce() + Send + 'static) {
    // Without a thread nobody calls.
    let _handle = super::worker::spawn(name, then);
}
