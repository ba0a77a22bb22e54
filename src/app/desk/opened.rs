//! What was just opened.

use crate::app::links::Fragment;
use crate::app::tab::Tab;
use std::path::PathBuf;

/// What was just opened.
pub enum Opened {
    /// A scene, and the tab that answers its question.
    Scene(Tab),
    /// What a link holds beside a document.
    Link(Box<Fragment>),
    /// A campaign, by its folder.
    Campaign(PathBuf),
}
