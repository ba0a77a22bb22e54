//! Fit of constants of the lubricant to the measured tables of the document, in the background.

use crate::app::context::Context;
use crate::app::document::{Document, Key};
use crate::app::in_use::question;
use crate::app::refusal::Refusal;
use crate::app::wake::wake;
use crate::engine::Workbench;
use crate::engine::job::{Background, Standing};
use crate::scene::study::fit::{Fit, FitParameter, Row};
use crate::scene::{CaseTable, Grid, MeasuredTable, Method, Study, StudyRow};

/// Contact and tables of a fit.
#[derive(Clone, PartialEq)]
struct Asked {
    key: Key,
    tables: Vec<MeasuredTable>,
}

impl Asked {
    fn of(document: &Document) -> Self {
        Self { key: document.key(), tables: document.view.measured.clone() }
    }
}

/// Running or finished fit.
#[derive(Default)]
pub struct FitRun {
    work: Background<StudyRow>,
    asked: Option<Asked>,
    row: Option<Row>,
}

impl FitRun {
    /// Starts the fit of constants of the document's lubricant. The reduced model in use computes the contacts, or the
    /// full solver without one.
    pub fn start(&mut self, ctx: &egui::Context, context: &Context<'_>, parameters: Vec<FitParameter>) {
        let document = context.document;
        let asked = Asked::of(document);
        let measured = asked.tables.iter().map(|table| CaseTable::Text(table.text.clone())).collect();
        let in_use = context.answers.in_use(document);
        let method = in_use.as_ref().map_or(Method::Full, |by| by.method());
        let study = Study::Fit(Fit { measured, parameters, method });
        let scene = question("Fit", &asked.key, Grid::Graded, study);
        let store = context.answers.store();
        self.work.run(match in_use {
            Some(by) => by.ask(ctx, store, scene),
            None => scene.ask(Workbench::on(store, ""), wake(ctx)),
        });
        (self.asked, self.row) = (Some(asked), None);
    }

    /// Receives the result.
    pub fn receive(&mut self) {
        let row = &mut self.row;
        self.work.receive(|found| {
            if let StudyRow::Fit(found) = found {
                *row = Some(found);
            }
        });
    }

    /// Returns the result, and true if contact or tables have changed since then. A used result does not change the
    /// contact that it belongs to.
    pub fn result(&self, document: &Document) -> Option<(&Row, bool)> {
        let row = self.row.as_ref()?;
        let now = Asked::of(document);
        let used = now.key.point == row.point && now.key.lubricant == row.lubricant;
        Some((row, self.asked.as_ref() != Some(&now) && !used))
    }

    /// Returns the reason why the last fit has no result.
    pub fn message(&self) -> Option<Refusal> {
        self.work.message.as_ref().map(|why| Refusal::new(why.clone()))
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops the fit.
    pub fn stop(&self) {
        self.work.stop();
    }
}
