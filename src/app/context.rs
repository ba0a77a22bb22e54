//! Read access of tabs and panels to the window, and the list of their commands.

use super::answers::Answers;
use super::answers::picture::Cuts;
use super::command::Command;
use super::controls::Entries;
use super::display::Thresholds;
use super::document::{Document, Edit};
use crate::app::tabs::transient::TransientRuns;
use crate::scene::MeasuredPoint;
use crate::scene::regime::{Ratios, RegimeMap};
use crate::solver::physics::contact::FilmShape;
use crate::solver::physics::engineering::UnitSystem;
use std::path::Path;

/// Read-only state of the window.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// Document that is edited.
    pub document: &'a Document,
    /// Results for the document.
    pub answers: &'a Answers,
    /// Transient runs.
    pub transient: &'a TransientRuns,
    /// Refused entries by the name of their field.
    pub entries: &'a Entries,
    /// True if tabs show explanations for teaching.
    pub why: bool,
    /// File of the document, if it has one.
    pub file: Option<&'a Path>,
    /// Position of the cuts through a point contact.
    pub cuts: Cuts,
    /// Error limits of the badge.
    pub thresholds: Thresholds,
    /// True in presentation mode, which shows plots and little else.
    pub presenting: bool,
    /// True if plots shall be fitted to their data in this frame.
    pub fit: bool,
    /// System of units of the window.
    pub system: UnitSystem,
    /// Measured points of the document.
    pub measured: &'a [MeasuredPoint],
}

impl Context<'_> {
    /// Returns the ratios that define the regime: of the picture if it belongs to the sliders, otherwise estimated.
    pub fn regime_ratios(&self) -> Ratios {
        let point = &self.document.point;
        let estimate = || RegimeMap::new(FilmShape::of(point)).at(point.moes());
        self.answers.shown_picture().map_or_else(estimate, |picture| Ratios::of(&picture.solution))
    }
}

/// Commands of a frame, in their order.
#[derive(Default)]
pub struct Commands(Vec<Command>);

impl Commands {
    /// Adds a command.
    pub fn push(&mut self, command: Command) {
        self.0.push(command);
    }

    /// Adds a change of the document. A refusal is shown next to `field`.
    pub fn edit(&mut self, edit: Edit, field: &'static str) {
        self.push(Command::Edit(edit, field));
    }

    /// Adds several commands.
    pub fn extend(&mut self, commands: impl IntoIterator<Item = Command>) {
        self.0.extend(commands);
    }

    /// Returns all commands and empties the list.
    pub fn take(&mut self) -> Vec<Command> {
        std::mem::take(&mut self.0)
    }
}
