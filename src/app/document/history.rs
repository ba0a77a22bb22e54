//! Undo and redo by snapshots of the document.

use super::experiment::Document;

/// Undo and redo by snapshots. An edit is a whole gesture, recorded when the pointer is released.
#[derive(Debug, Default)]
pub struct History {
    undo: Vec<Document>,
    redo: Vec<Document>,
    committed: Option<Document>,
}

/// Number of stored snapshots.
const HISTORY_LIMIT: usize = 200;

impl History {
    /// Clears the history and starts from a document.
    pub fn restart(&mut self, document: &Document) {
        *self = Self { committed: Some(document.clone()), ..Self::default() };
    }

    /// Records the document if it differs from the last recorded one. Returns true if it was recorded.
    pub fn commit(&mut self, document: &Document) -> bool {
        match &self.committed {
            Some(last) if last == document => return false,
            Some(last) => {
                self.undo.push(last.clone());
                if self.undo.len() > HISTORY_LIMIT {
                    self.undo.remove(0);
                }
                self.redo.clear();
                self.committed = Some(document.clone());
            }
            None => self.committed = Some(document.clone()),
        }
        true
    }

    /// Restores the document before the last edit.
    pub fn undo(&mut self, document: &mut Document) {
        self.commit(document);
        if let Some(former) = self.undo.pop() {
            self.redo.push(std::mem::replace(document, former));
            self.committed = Some(document.clone());
        }
    }

    /// Restores the document before the last undo.
    pub fn redo(&mut self, document: &mut Document) {
        if let Some(next) = self.redo.pop() {
            self.undo.push(std::mem::replace(document, next));
            self.committed = Some(document.clone());
        }
    }

    /// Returns true if there is an edit to undo.
    pub fn can_undo(&self, document: &Document) -> bool {
        !self.undo.is_empty() || self.committed.as_ref().is_some_and(|c| c != document)
    }

    /// Returns true if there is an edit to redo.
    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }
}
