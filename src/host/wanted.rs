//! What a file dialog asks for, natively and in a page.

use std::path::PathBuf;

/// What a dialog asks for.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Whether a file is to be read.
    pub reads: bool,
    /// What such files are called.
    pub files: &'static str,
    /// How their names end.
    pub endings: &'static [&'static str],
    /// Path to begin with.
    pub suggestion: PathBuf,
}
