//! The last session: what is written as the program runs, so that a crash costs ten seconds at most.

use super::document::Document;
use super::plots::{self, Tab};
use super::state::Display;
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
    display: Display,
    tree: Tree<Tab>,
}

/// Writes the session.
pub fn save(explorer: &Explorer, storage: &mut dyn Storage) {
    let state = &explorer.state;
    if let (Ok(document), Ok(saved)) = (state.document.to_ron(), state.files.saved().to_ron()) {
        let session = Session {
            document,
            saved,
            path: state.files.path.clone(),
            recent: state.files.recent.clone(),
            display: state.display.clone(),
            tree: explorer.tree.clone(),
        };
        eframe::set_value(storage, KEY, &session);
    }
}

/// Restores how things are shown, and the document too when `with_document`. What cannot be read is left at its default.
pub fn restore(explorer: &mut Explorer, storage: &dyn Storage, with_document: bool) {
    let Some(session) = eframe::get_value::<Session>(storage, KEY) else { return };
    let state: &mut State = &mut explorer.state;
    state.display = session.display;
    state.files.recent = session.recent;
    if plots::is_complete(&session.tree) {
        explorer.tree = session.tree;
    }
    if with_document && let Ok(document) = Document::from_ron(&session.document) {
        state.files.set_saved(Document::from_ron(&session.saved).unwrap_or_else(|_| document.clone()));
        state.files.path = session.path;
        state.replace_document(document);
    }
}
