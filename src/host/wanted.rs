//! Request to a file dialog, for native programs and web pages.

use std::path::PathBuf;

/// Request to a file dialog.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// True if a file is to be read.
    pub reads: bool,
    /// Name of this type of file.
    pub files: &'static str,
    /// Accepted file extensions.
    pub endings: &'static [&'static str],
    /// Suggested path.
    pub suggestion: PathBuf,
}
