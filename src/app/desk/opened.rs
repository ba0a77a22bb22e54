//! What was just opened.

use crate::app::links::Embed;
use crate::app::tab::Tab;
use egui_tiles::Tree;
use std::path::PathBuf;

/// What was just opened.
pub enum Opened {
    /// A scene, and the tab that answers its question.
    Scene(Tab),
    /// What a link holds beside a document.
    Link {
        /// The arrangement of the tabs.
        tree: Option<Tree<Tab>>,
        /// One tab with chosen sliders.
        embed: Option<Embed>,
        /// Number of a lesson, from 1.
        lesson: Option<usize>,
    },
    /// A campaign, by its folder.
    Campaign(PathBuf),
}
