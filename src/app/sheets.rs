//! The results sheet of the contact on the screen: solved in full, and by the reduced model where that was trained for
//! it, beside the window.

use super::answers::Answers;
use super::document::Document;
use super::purpose::{Purpose, Written};
use super::wake::wake;
use crate::app::refusal::Refusal;
use crate::engine::job::{Background, Job, Standing};
use crate::engine::{EngineError, Workbench};
use crate::scene::{Method, Sheet, answer_or_full};
use crate::solver::reduced::Trust;
use egui::Context;
use std::sync::Arc;

/// How a sheet is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// For people and for notes, with figures beside it.
    Markdown,
    /// With its figures in it.
    Html,
    /// For other programs.
    Csv,
}

/// The sheet that is being made.
#[derive(Default)]
pub struct Sheets {
    work: Background<Purpose>,
}

impl Form {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Markdown, Self::Html, Self::Csv];

    /// As the menu calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Markdown => "Results sheet as Markdown…",
            Self::Html => "Results sheet as HTML…",
            Self::Csv => "Results sheet as CSV…",
        }
    }

    fn write(self, sheet: Sheet) -> Purpose {
        let (written, text) = match self {
            Self::Markdown => return Purpose::Notes(Arc::new(sheet)),
            Self::Html => (Written::Html, sheet.to_html()),
            Self::Csv => (Written::Table, sheet.to_csv()),
        };
        Purpose::Write(written, text.into_bytes().into())
    }
}

impl Sheets {
    /// Begins the sheet of the contact of a document.
    pub fn begin(&mut self, ctx: &Context, (document, answers): (&Document, &Answers), form: Form) {
        let (key, grid) = (document.key(), document.grid);
        let mut bench = Workbench::on(answers.store(), "");
        let mut methods = vec![Method::Full];
        if let Some(in_use) = answers.in_use(document).filter(|_| answers.trust(document) == Some(Trust::Trained)) {
            methods.push(in_use.method());
            bench = bench.using(&in_use.model);
        }
        let (title, bodies) = (document.title.clone(), document.bodies_in_force());
        self.work.run(Job::start("Results sheet", wake(ctx), move |reporter| {
            let mut solve = || -> Result<Purpose, EngineError> {
                let mut answers = Vec::new();
                for (k, method) in methods.iter().enumerate() {
                    reporter.stage(&format!("solving, {}", method.name()), k, methods.len());
                    answers.push(answer_or_full(&mut bench, &key.request(grid, method.clone()), reporter)?);
                }
                Ok(form.write(Sheet::new(&title, &answers, bodies.as_ref())))
            };
            match solve() {
                Ok(purpose) => reporter.send(purpose),
                Err(error) if error.cancelled() || reporter.cancelled() => {}
                Err(error) => return Err(error.to_string().into()),
            }
            Ok(())
        }));
    }

    /// The sheet once it is made, or why there is none.
    pub fn receive(&mut self) -> Option<Result<Purpose, Refusal>> {
        let mut made = None;
        self.work.receive(|purpose| made = Some(Ok(purpose)));
        made.or_else(|| self.work.message.take().map(|why| Err(Refusal::new(why))))
    }

    /// How far it is.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Makes it no more.
    pub fn stop(&self) {
        self.work.stop();
    }
}
