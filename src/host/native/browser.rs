//! Functions of a browser around a page. A native program has no browser.

use std::path::PathBuf;

/// True if the program runs as a web page.
pub const PAGE: bool = false;

/// Returns a file that was dropped on the page since the last call. Files dropped on a native window arrive with
/// its events.
pub fn dropped() -> Option<PathBuf> {
    None
}

/// Returns the fragment of the page's address, if the user has opened or changed it since the last call.
pub fn asked() -> Option<String> {
    None
}

/// Sets the fragment of the page's address.
pub fn show(_fragment: &str) {}

/// Announces a message to users of screen readers.
pub fn say(_news: &str) {}
