//! What the window knows about files.

use super::path_window::PathWindow;
use crate::app::document::Document;
use crate::app::notice::Notice;
use crate::scene::Scene;
use std::path::PathBuf;
use std::sync::Arc;

/// What waits for the answer about unsaved changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Pending {
    /// A fresh document.
    New,
    /// The dialog to open a scene.
    OpenDialog,
    /// A certain scene.
    Open(PathBuf),
    /// A scene that lies nowhere yet.
    OpenScene(Arc<Scene>),
    /// What a link holds.
    OpenLink(String),
    /// The end.
    Quit,
    /// Another training.
    Train,
    /// The end of a training that was stopped.
    DiscardTraining,
    /// The end of a model that was trained.
    ThrowModelAway,
}

/// What the window knows about files.
pub struct Files {
    /// Where the document was opened from or saved to.
    pub path: Option<PathBuf>,
    /// Recently used scenes, newest first.
    pub recent: Vec<PathBuf>,
    /// A sentence about the last file action: what was done, or what went wrong.
    pub notice: Option<Notice>,
    /// Whether the system's file dialog is tried.
    pub native_dialogs: bool,
    pub(super) saved: Document,
    pub(super) window: Option<PathWindow>,
    pub(super) pending: Option<Pending>,
    pub(super) after_save: Option<Pending>,
    pub(super) quit: bool,
}

impl Files {
    /// Nothing opened, nothing to lose.
    pub fn new(document: &Document) -> Self {
        Self {
            path: None,
            recent: Vec::new(),
            notice: None,
            native_dialogs: true,
            saved: document.clone(),
            window: None,
            pending: None,
            after_save: None,
            quit: false,
        }
    }

    /// Declares what is on disk, as a restored session does.
    pub fn set_saved(&mut self, saved: Document) {
        self.saved = saved;
    }

    /// What is on disk.
    pub fn saved(&self) -> &Document {
        &self.saved
    }

    /// Whether a window of this module is open.
    pub fn asks(&self) -> bool {
        self.window.is_some() || self.pending.is_some()
    }
}
