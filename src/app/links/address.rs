//! Updates the address of the web page to the present document and tabs, so that a link to them can be sent, stored
//! and loaded again.

use super::fragment::Fragment;
use crate::app::document::Document;
use crate::app::tab::Tab;
use crate::host::browser;
use crate::host::clock::Stopwatch;
use egui_tiles::Tree;

/// Minimum time between two changes of the address \[s\]. Browsers refuse frequent changes.
const PAUSE_S: f64 = 1.0;

/// State of the address: document and tabs of the last change, and the time since then.
#[derive(Default)]
pub struct Address {
    shown: Option<(Document, Tree<Tab>, Stopwatch)>,
}

impl Address {
    /// Updates the address to a document and its tabs. Returns the seconds until the next call if it has to wait.
    pub fn follow(&mut self, document: &Document, tree: &Tree<Tab>) -> Option<f64> {
        let (shown, elapsed_s) = match &self.shown {
            Some((shown, arrangement, last)) => (shown == document && arrangement == tree, last.seconds()),
            None => (false, PAUSE_S),
        };
        if shown {
            return None;
        }
        if elapsed_s < PAUSE_S {
            return Some(PAUSE_S - elapsed_s);
        }
        if let Ok(link) = Fragment::link(document, tree) {
            browser::show(&link);
        }
        self.shown = Some((document.clone(), tree.clone(), Stopwatch::start()));
        None
    }
}
