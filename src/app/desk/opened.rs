//! Item that was just opened.

use crate::app::links::Fragment;
use crate::app::tab::Tab;
use std::path::PathBuf;

/// Item that was just opened.
pub enum Opened {
    /// A scene, with the tab that shows its result.
    Scene(Tab),
    /// Content of a link apart from the document.
    Link(Box<Fragment>),
    /// A campaign, by its folder.
    Campaign(PathBuf),
}
