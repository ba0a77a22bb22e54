//! What the browser does around the page.

use super::{files, page};
use std::cell::RefCell;
use std::path::PathBuf;

/// Whether the program is a page.
pub const PAGE: bool = true;

thread_local! {
    static DROPPED: RefCell<Option<PathBuf>> = const { RefCell::new(None) };
    static ASKED: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Takes a file that was dropped on the page: its name, a zero, its content. Called by the page.
pub fn take_dropped(file: &[u8]) {
    DROPPED.set(Some(files::arrived(file)));
}

/// Takes the fragment of an address that the user has opened. Called by the page.
pub fn ask(fragment: String) {
    ASKED.set(Some(fragment));
}

/// A file that was dropped on the page since the last call.
pub fn dropped() -> Option<PathBuf> {
    DROPPED.take()
}

/// The fragment of the page's address, if it was opened or changed by the user since the last call.
pub fn asked() -> Option<String> {
    ASKED.take()
}

/// Puts a fragment into the page's address.
pub fn show(fragment: &str) {
    page::link(fragment);
}

/// Says something to people who cannot see the canvas.
pub fn say(news: &str) {
    page::news(news);
}
