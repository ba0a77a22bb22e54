//! Files of the trained models, which the page fetches when they are needed.

use super::page;

/// Returns the content of a model's file if it has been fetched. In a worker this call fetches it.
pub fn now(name: &str) -> Option<Vec<u8>> {
    page::model(name)
}

/// Calls `then` once the file of a model is available, or cannot be fetched.
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
