//! Where the explorer's reduced models come from: one for each kind of contact, or none.

use crate::harness::model_file;
use crate::solver::contact::ContactKind;
use crate::solver::reduced::ReducedModel;
use std::sync::Arc;

/// The reduced models in use. Where there is none for a kind of contact, the full solver draws its pictures.
#[derive(Clone, Default)]
pub struct Models {
    line: Option<Arc<ReducedModel>>,
    point: Option<Arc<ReducedModel>>,
}

impl Models {
    /// The models embedded in the program. Without them (a damaged build) the full solver draws the pictures.
    pub fn embedded() -> Self {
        let of = |kind| model_file::embedded_of(kind).ok();
        Self { line: of(ContactKind::Line), point: of(ContactKind::Point) }
    }

    /// A model of line contacts, or none.
    pub fn of_lines(line: Option<Arc<ReducedModel>>) -> Self {
        Self { line, point: None }
    }

    /// The model that serves a kind of contact.
    pub fn of(&self, kind: ContactKind) -> Option<&Arc<ReducedModel>> {
        match kind {
            ContactKind::Line => self.line.as_ref(),
            ContactKind::Point => self.point.as_ref(),
        }
    }

    /// Puts a model, or none, in place of the one that serves a kind of contact.
    pub fn put(&mut self, kind: ContactKind, model: Option<Arc<ReducedModel>>) {
        match kind {
            ContactKind::Line => self.line = model,
            ContactKind::Point => self.point = model,
        }
    }
}
