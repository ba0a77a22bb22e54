//! The explorer on the screen.

use std::path::PathBuf;

/// Opens the explorer, on a scene or on the last session.
///
/// # Errors
/// With one sentence when no window can be opened.
pub fn run(_scene: Option<PathBuf>) -> Result<(), String> {
    Err("this build has no window; use the commands solve, sweep, run, train, bench and info".to_owned())
}
