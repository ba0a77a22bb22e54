//! What a browser does around a page. A native program has none.

use std::path::PathBuf;

/// Whether the program is a page.
pub const PAGE: bool = false;

/// A file that was dropped on the page since the last call. Those dropped on a native window come with its events.
pub fn dropped() -> Option<PathBuf> {
    None
}

/// The fragment of the page's address, if it was opened or changed by the user since the last call.
pub fn asked() -> Option<String> {
    None
}

/// Puts a fragment into the page's address.
pub fn show(_fragment: &str) {}

/// Says something to people who cannot see the canvas.
pub fn say(_news: &str) {}
