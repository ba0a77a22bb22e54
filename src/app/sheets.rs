//! Results sheet of the contact on the screen. It is solved in the background by the full solver and, inside the
//! trained range, by the reduced model.

use super::answers::Answers;
use super::document::Document;
use super::lessons::Lesson;
use super::purpose::{Purpose, Written};
use super::wake::wake;
use crate::app::refusal::Refusal;
use crate::engine::job::{Background, Ending, Given, Job, Reporter, Standing, Task};
use crate::engine::{Store, Workbench};
use crate::scene::{Answer, Method, Request, Sheet, answer_or_full};
use crate::solver::physics::bodies::Bodies;
use crate::solver::reduced::Trust;
use egui::Context;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Format of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// For reading and for notes, with figures next to it.
    Markdown,
    /// With embedded figures.
    Html,
    /// For other programs.
    Csv,
}

/// Sheet that is being made.
#[derive(Default)]
pub struct Sheets {
    of: Option<Of>,
    work: Background<Progress>,
}

/// Content of a sheet, with the answers that have been solved so far.
struct Of {
    form: Form,
    title: String,
    bodies: Option<Bodies>,
    answers: Vec<Answer>,
    /// Lesson of a worksheet, and the answers of its start and its steps.
    lesson: Option<(Lesson, Vec<usize>)>,
}

/// Solves of a sheet.
#[derive(Serialize, Deserialize)]
pub struct Solves {
    requests: Vec<Request>,
    model: Option<Given>,
}

/// Messages of the solves of a sheet.
#[derive(Serialize, Deserialize)]
pub enum Progress {
    Answer(Box<Answer>),
    Complete,
}

impl Task for Solves {
    const KIND: &'static str = "sheet";
    const LANE: usize = 1;
    type Message = Progress;

    fn run(self, store: &Store, reporter: &Reporter<Progress>) -> Ending {
        let mut bench = Workbench::on(store, "");
        if let Some(model) = &self.model {
            bench = bench.using(&model.model(store)?);
        }
        for (k, request) in self.requests.iter().enumerate() {
            reporter.stage(&format!("solving, {}", request.method.name()), k, self.requests.len());
            match answer_or_full(&mut bench, request, reporter) {
                Ok(answer) => reporter.send(Progress::Answer(Box::new(answer))),
                Err(error) if error.cancelled() || reporter.cancelled() => return Ok(()),
                Err(error) => return Err(error.to_string().into()),
            }
        }
        reporter.send(Progress::Complete);
        Ok(())
    }
}

impl Form {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Markdown, Self::Html, Self::Csv];

    /// Returns the name in the menu.
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
    /// Starts the sheet of a document's contact.
    pub fn begin(&mut self, ctx: &Context, (document, answers): (&Document, &Answers), form: Form) {
        let (key, grid) = (document.key(), document.grid);
        let (mut methods, mut model) = (vec![Method::Full], None);
        if let Some(in_use) = answers.in_use(document).filter(|_| answers.trust(document) == Some(Trust::Trained)) {
            methods.push(in_use.method());
            model = Some(Given::of(&in_use.model));
        }
        let requests = methods.into_iter().map(|method| key.request(grid, method)).collect();
        self.of = Some(Of {
            form,
            title: document.title.clone(),
            bodies: document.bodies_in_force(),
            answers: Vec::new(),
            lesson: None,
        });
        self.work.run(Job::of("Results sheet", wake(ctx), answers.store(), Solves { requests, model }));
    }

    /// Starts the worksheet of a lesson. Its contacts are solved by the full solver.
    ///
    /// # Errors
    /// A sentence if a contact of the lesson is refused.
    pub fn begin_worksheet(
        &mut self,
        ctx: &Context,
        (document, answers): (&Document, &Answers),
        lesson: Lesson,
    ) -> Result<(), Refusal> {
        let (keys, indices) = lesson.pictures()?;
        let requests = keys.iter().map(|key| key.request(document.grid, Method::Full)).collect();
        let (title, lesson) = (lesson.title.clone(), Some((lesson, indices)));
        self.of = Some(Of { form: Form::Html, title, bodies: None, answers: Vec::new(), lesson });
        self.work.run(Job::of("Worksheet", wake(ctx), answers.store(), Solves { requests, model: None }));
        Ok(())
    }

    /// Returns the sheet once it is complete, or the reason why there is none.
    pub fn receive(&mut self) -> Option<Result<Purpose, Refusal>> {
        let (mut complete, answers) = (false, self.of.as_mut().map(|of| &mut of.answers));
        let mut unread = Vec::new();
        let answers = answers.unwrap_or(&mut unread);
        self.work.receive(|told| match told {
            Progress::Answer(answer) => answers.push(*answer),
            Progress::Complete => complete = true,
        });
        if let Some(Of { form, title, bodies, answers, lesson }) = self.of.take_if(|_| complete) {
            if let Some((lesson, indices)) = lesson {
                let page = lesson.worksheet(&answers, &indices);
                return Some(Ok(Purpose::Write(Written::Html, page.into_bytes().into())));
            }
            return Some(Ok(form.write(Sheet::new(&title, &answers, bodies.as_ref()))));
        }
        self.work.message.take().map(|why| Err(Refusal::new(why)))
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops the sheet.
    pub fn stop(&self) {
        self.work.stop();
    }
}
