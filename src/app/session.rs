//! The last session: what is written as the program runs, so that a crash costs ten seconds at most.

use super::Explorer;
use super::display::Display;
use super::document::Document;
use super::tab::Tab;
use super::tabs::contact_map::MapView;
use super::tabs::{self, profiles};
use super::traction;
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
    display: Shown,
    tree: Tree<Tab>,
}

/// How everything is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
struct Shown {
    #[serde(flatten)]
    display: Display,
    #[serde(flatten)]
    profiles: profiles::Choices,
    traction: traction::Choices,
    map: MapView,
}

impl Shown {
    fn of(Explorer { desk, .. }: &Explorer) -> Self {
        let views = &desk.views;
        Self {
            display: desk.display,
            profiles: views.profiles.choices,
            traction: views.traction.choices,
            map: views.map.view,
        }
    }

    fn restore(self, Explorer { desk, .. }: &mut Explorer) {
        desk.display = self.display;
        let views = &mut desk.views;
        (views.profiles.choices, views.traction.choices, views.map.view) = (self.profiles, self.traction, self.map);
    }
}

/// Writes the session.
pub fn save(explorer: &Explorer, storage: &mut dyn Storage) {
    let desk = &explorer.desk;
    if let (Ok(document), Ok(saved)) = (desk.document.to_ron(), desk.files.saved().to_ron()) {
        let session = Session {
            document,
            saved,
            path: desk.files.path.clone(),
            recent: desk.files.recent.clone(),
            display: Shown::of(explorer),
            tree: explorer.tree.clone(),
        };
        eframe::set_value(storage, KEY, &session);
    }
}

/// Restores how things are shown, and the document too when `with_document`. What cannot be read is left at its default.
pub fn restore(explorer: &mut Explorer, storage: &dyn Storage, with_document: bool) {
    let Some(session) = eframe::get_value::<Session>(storage, KEY) else { return };
    session.display.restore(explorer);
    let desk = &mut explorer.desk;
    desk.files.recent = session.recent;
    if let Some(tree) = tabs::completed(session.tree) {
        explorer.tree = tree;
    }
    if with_document && let Ok(document) = Document::from_ron(&session.document) {
        desk.files.set_saved(Document::from_ron(&session.saved).unwrap_or_else(|_| document.clone()));
        desk.files.path = session.path;
        desk.replace_document(document);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::traction::Against;
    use crate::scene::named_lubricant::by_name;
    use crate::solver::physics::contact::{Moes, Quantity};
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
    fn a_layout_from_before_a_tab_was_added_keeps_its_order_and_gets_the_tab() {
        let old: Vec<Tab> = Tab::ALL.into_iter().filter(|tab| *tab != Tab::Results).rev().collect();
        let tree = tabs::completed(Tree::new_tabs(egui::Id::unique("tabs"), old.clone())).unwrap();
        let panes: Vec<Tab> = match tree.root().and_then(|root| tree.tiles.get(root)) {
            Some(egui_tiles::Tile::Container(container)) => {
                container.children().filter_map(|id| tree.tiles.get_pane(id).copied()).collect()
            }
            _ => Vec::new(),
        };
        assert_eq!(panes, [&old[..], &[Tab::Results]].concat());
        assert!(tabs::completed(Tree::new_tabs(egui::Id::unique("tabs"), vec![Tab::Profiles; 2])).is_none());
        assert!(tabs::completed(Tree::empty(egui::Id::unique("tabs"))).is_none());
    }

    #[test]
    fn a_session_comes_back_with_its_unsaved_changes_and_its_truncation() {
        let mut explorer = Explorer::new(None);
        let document = &mut explorer.desk.document;
        document.pick_lubricant(&by_name("squalane-pip").unwrap()).unwrap();
        document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        document.set_quantity(Quantity::SlideToRollRatio, 0.3).unwrap();
        document.set_quantity(Quantity::NewtonianPlateauRatio, 0.4).unwrap();
        document.view.pressure_loss = Some(1e-6);
        let (point, view, lubricant) = (document.point, document.view, document.lubricant);
        explorer.desk.views.traction.choices.against = Against::Stribeck;
        let display = Shown::of(&explorer);
        let mut storage = Memory::default();
        save(&explorer, &mut storage);
        let mut again = Explorer::new(None);
        restore(&mut again, &storage, true);
        let document = &again.desk.document;
        assert_eq!((document.point, document.view, document.lubricant), (point, view, lubricant));
        assert_eq!(Shown::of(&again), display);
        assert!(again.desk.dirty(), "what was not saved is still unsaved");
        explorer.desk.files.set_saved(explorer.desk.document.clone());
        save(&explorer, &mut storage);
        restore(&mut again, &storage, true);
        assert!(!again.desk.dirty());
        storage.set_string(KEY, "(damaged".to_owned());
        let mut fresh = Explorer::new(None);
        restore(&mut fresh, &storage, true);
        assert_eq!(fresh.desk.document, Document::default());
    }
}
