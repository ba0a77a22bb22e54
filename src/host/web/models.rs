//! Files of the trained models, which the page fetches when they are needed.

use super::page;

/// The content of the file of a model, if it has been fetched; a worker fetches it.
pub fn now(name: &str) -> Option<Vec<u8>> {
    page::model(name)
}

/// Calls `then` once the file of a model is there, or cannot be had.
pub fn then(name: &str, then: impl FnOnce() + Send + 'static) {
    let mut then = Some(then);
    let ticket = page::ticket(move |_| {
        if let Some(then) = then.take() {
            then();
        }
        false
    });
    page::fetch_model(name, ticket);
}
