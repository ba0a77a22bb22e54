//! The last session: what is written as the program runs, so that a crash costs ten seconds at most.

use super::document::Document;
use super::state::Display;
use super::tabs::{self, Tab};
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
    if tabs::is_complete(&session.tree) {
        explorer.tree = session.tree;
    }
    if with_document && let Ok(document) = Document::from_ron(&session.document) {
        state.files.set_saved(Document::from_ron(&session.saved).unwrap_or_else(|_| document.clone()));
        state.files.path = session.path;
        state.replace_document(document);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::traction::Against;
    use crate::scene::named_lubricant::by_name;
    use crate::solver::physics::contact::Moes;
    use std::collections::HashMap;

    #[derive(Default)]
    struct Memory(HashMap<String, String>);

    impl Storage for Memory {
        fn get_string(&self, key: &str) -> Option<String> {
            self.0.get(key).cloned()
        }

        fn set_string(&mut self, key: &str, value: String) {
            self.0.insert(key.to_owned(), value);
        }

        fn remove_string(&mut self, key: &str) {
            self.0.remove(key);
        }

        fn flush(&mut self) {}
    }

    #[test]
    fn a_session_comes_back_with_its_unsaved_changes_and_its_truncation() {
        let mut explorer = Explorer::new(None);
        let document = &mut explorer.state.document;
        document.pick_lubricant(&by_name("squalane-pip").unwrap()).unwrap();
        document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        document.set_slide_to_roll_ratio(0.3).unwrap();
        document.set_plateau_ratio(Some(0.4)).unwrap();
        document.view.pressure_loss = Some(1e-6);
        let (point, view, lubricant) = (document.point, document.view, document.lubricant);
        explorer.state.display.traction.against = Against::Stribeck;
        let display = explorer.state.display.clone();
        let mut storage = Memory::default();
        save(&explorer, &mut storage);
        let mut again = Explorer::new(None);
        restore(&mut again, &storage, true);
        let document = &again.state.document;
        assert_eq!((document.point, document.view, document.lubricant), (point, view, lubricant));
        assert_eq!(again.state.display, display);
        assert!(again.state.dirty(), "what was not saved is still unsaved");
        explorer.state.files.set_saved(explorer.state.document.clone());
        save(&explorer, &mut storage);
        restore(&mut again, &storage, true);
        assert!(!again.state.dirty());
        storage.set_string(KEY, "(damaged".to_owned());
        let mut fresh = Explorer::new(None);
        restore(&mut fresh, &storage, true);
        assert_eq!(fresh.state.document, Document::default());
    }
}
