//! Functions of the browser around the page.

use super::{files, page};
use std::cell::RefCell;
use std::path::PathBuf;

/// True if the program runs as a web page.
pub const PAGE: bool = true;

thread_local! {
    static DROPPED: RefCell<Option<PathBuf>> = const { RefCell::new(None) };
    static ASKED: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Receives a file that was dropped on the page, as its name, a zero byte and its content. Called by the page.
pub fn take_dropped(file: &[u8]) {
    DROPPED.set(Some(files::arrived(file)));
}

/// Receives the fragment of an address that the user has opened. Called by the page.
pub fn ask(fragment: String) {
    ASKED.set(Some(fragment));
}

/// Returns a file that was dropped on the page since the last call.
pub fn dropped() -> Option<PathBuf> {
    DROPPED.take()
}

/// Returns the fragment of the page's address, if the user has opened or changed it since the last call.
pub fn asked() -> Option<String> {
    ASKED.take()
}

/// Sets the fragment of the page's address.
pub fn show(fragment: &str) {
    page::link(fragment);
}

/// Announces a message to users of screen readers.
pub fn say(news: &str) {
    page::news(news);
}
