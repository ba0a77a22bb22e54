//! What was just opened.

use crate::app::tab::Tab;
use std::path::PathBuf;

/// What was just opened.
pub enum Opened {
    /// A scene, and the tab that answers its question.
    Scene(Tab),
    /// A campaign, by its folder.
    Campaign(PathBuf),
}
