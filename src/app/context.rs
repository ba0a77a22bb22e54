//! What a tab or panel sees of the window, and how it says what is wanted.

use super::answers::Answers;
use super::answers::picture::Cuts;
use super::command::Command;
use super::controls::Entries;
use super::display::Thresholds;
use super::document::{Document, Edit};
use crate::app::tabs::transient::TransientRuns;
use std::path::Path;

/// What is shown: to be looked at, not to be changed.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// What is edited.
    pub document: &'a Document,
    /// What came of it.
    pub answers: &'a Answers,
    /// Transient runs.
    pub transient: &'a TransientRuns,
    /// What was refused, by the names of fields.
    pub entries: &'a Entries,
    /// Whether tabs say why, for teaching.
    pub why: bool,
    /// Where the document lies on disk, if it does.
    pub file: Option<&'a Path>,
    /// Where a point contact is cut.
    pub cuts: Cuts,
    /// From where on the badge uses another word.
    pub thresholds: Thresholds,
    /// Whether an audience looks: plots and little else.
    pub presenting: bool,
    /// Whether plots are to be fitted to their data in this frame.
    pub fit: bool,
}

/// What was asked for in a frame, in its order.
#[derive(Default)]
pub struct Commands(Vec<Command>);

impl Commands {
    /// Asks for something.
    pub fn push(&mut self, command: Command) {
        self.0.push(command);
    }

    /// Asks for a change of the document; a refusal stands beside `field`.
    pub fn edit(&mut self, edit: Edit, field: &'static str) {
        self.push(Command::Edit(edit, field));
    }

    /// Asks for whatever there is.
    pub fn extend(&mut self, commands: impl IntoIterator<Item = Command>) {
        self.0.extend(commands);
    }

    /// Everything that was asked for; nothing stays.
    pub fn take(&mut self) -> Vec<Command> {
        std::mem::take(&mut self.0)
    }
}
