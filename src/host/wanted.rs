//! Request to a file dialog. The native program and the web page have separate dialogs that take the same request.

use std::path::PathBuf;

/// Request to a file dialog.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// True to choose an existing file that is read, false to choose a file that is written.
    pub reads: bool,
    /// Name of the type of file, shown in the dialog.
    pub files: &'static str,
    /// Accepted file extensions.
    pub endings: &'static [&'static str],
    /// Suggested path of the file.
    pub suggestion: PathBuf,
}
