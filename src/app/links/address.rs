//! Address of the page. It follows the present view, so that it can be sent, stored and loaded again.

use super::fragment::Fragment;
use crate::app::document::Document;
use crate::app::tab::Tab;
use crate::host::browser;
use crate::host::clock::Stopwatch;
use egui_tiles::Tree;

/// Minimum time between two changes of the address \[s\]. Browsers refuse frequent changes.
const PAUSE_S: f64 = 1.0;

/// View that the address was last made of.
#[derive(Default)]
pub struct Address {
    shown: Option<(Document, Tree<Tab>, Stopwatch)>,
}

impl Address {
    /// Updates the address to a document and its tabs. Returns the seconds until the next call if it has to wait.
    pub fn follow(&mut self, document: &Document, tree: &Tree<Tab>) -> Option<f64> {
        let (shown, last) = match &self.shown {
            Some((shown, arrangement, last)) => (shown == document && arrangement == tree, last.seconds()),
            None => (false, PAUSE_S),
        };
        if shown {
            return None;
        }
        if last < PAUSE_S {
            return Some(PAUSE_S - last);
        }
        if let Ok(link) = Fragment::link(document, tree) {
            browser::show(&link);
        }
        self.shown = Some((document.clone(), tree.clone(), Stopwatch::start()));
        None
    }
}
