//! State of files in the window.

use super::path_window::PathWindow;
use crate::app::document::Document;
use crate::app::notice::Notice;
use crate::scene::Scene;
use std::path::PathBuf;
use std::sync::Arc;

/// Action that waits for a confirmation.
#[derive(Clone, Debug, PartialEq)]
pub enum Pending {
    /// Start a new document.
    New,
    /// Open the dialog for a scene.
    OpenDialog,
    /// Open the scene at a path.
    Open(PathBuf),
    /// Open a scene that has no file.
    OpenScene(Arc<Scene>),
    /// Open the content of a link.
    OpenLink(String),
    /// Close the program.
    Quit,
    /// Start another training.
    Train,
    /// Discard a stopped training.
    DiscardTraining,
    /// Discard a trained model.
    ThrowModelAway,
}

/// State of files in the window.
pub struct Files {
    /// File that the document was opened from or saved to.
    pub path: Option<PathBuf>,
    /// Recently used scenes, newest first.
    pub recent: Vec<PathBuf>,
    /// Notice about the last file action.
    pub notice: Option<Notice>,
    /// True if the file dialog of the system is used.
    pub native_dialogs: bool,
    pub(super) saved: Document,
    pub(super) window: Option<PathWindow>,
    pub(super) pending: Option<Pending>,
    pub(super) after_save: Option<Pending>,
    pub(super) quit: bool,
}

impl Files {
    /// Creates the state without files and without unsaved changes.
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

    /// Sets the saved state of the document, for a restored session.
    pub fn set_saved(&mut self, saved: Document) {
        self.saved = saved;
    }

    /// Returns the saved state of the document.
    pub fn saved(&self) -> &Document {
        &self.saved
    }

    /// Returns true if a window of this module is open.
    pub fn asks(&self) -> bool {
        self.window.is_some() || self.pending.is_some()
    }
}
