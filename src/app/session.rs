//! The last session: what is written as the program runs, so that a crash costs ten seconds at most.

use super::document::{document_from_text, document_to_text};
use super::plots::{self, Tab};
use super::state::View;
use super::{Explorer, state::State};
use eframe::Storage;
use egui_tiles::Tree;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

const KEY: &str = "session";

#[derive(Serialize, Deserialize)]
struct Session {
    document: String,
    saved: String,
    path: Option<PathBuf>,
    recent: Vec<PathBuf>,
    view: View,
    tree: Tree<Tab>,
}

/// Writes the session.
pub fn save(explorer: &Explorer, storage: &mut dyn Storage) {
    let state = &explorer.state;
    if let (Ok(document), Ok(saved)) = (document_to_text(&state.document), document_to_text(state.files.saved())) {
        let session = Session {
            document,
            saved,
            path: state.files.path.clone(),
            recent: state.files.recent.clone(),
            view: state.view.clone(),
            tree: explorer.tree.clone(),
        };
        eframe::set_value(storage, KEY, &session);
    }
}

/// Restores the view, and the document too when `with_document`. What cannot be read is left at its default.
pub fn restore(explorer: &mut Explorer, storage: &dyn Storage, with_document: bool) {
    let Some(session) = eframe::get_value::<Session>(storage, KEY) else { return };
    let state: &mut State = &mut explorer.state;
    state.view = session.view;
    state.files.recent = session.recent;
    if plots::is_complete(&session.tree) {
        explorer.tree = session.tree;
    }
    if with_document && let Ok(document) = document_from_text(&session.document) {
        state.files.set_saved(document_from_text(&session.saved).unwrap_or_else(|_| document.clone()));
        state.files.path = session.path;
        state.replace_document(document);
    }
}
