//! Report of the contact on the screen. It is solved in the background by the full solver and, inside the
//! trained range, by the reduced model.

use super::answers::Answers;
use super::document::Document;
use super::lessons::Lesson;
use super::purpose::{Purpose, Written};
use super::wake::wake;
use crate::app::refusal::Refusal;
use crate::engine::job::{Background, Ending, Given, Job, Reporter, Standing, Task};
use crate::engine::{Store, Workbench};
use crate::scene::{Answer, Method, Paper, Report, ReportFormat, Request, Stated, answer_or_full};
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::reduced::Trust;
use egui::Context;
use serde::{Deserialize, Serialize};

/// Author, company and paper of reports. They are stored with the session.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ReportSettings {
    /// Name of the author; may be empty.
    pub author: String,
    /// Company; may be empty.
    pub company: String,
    pub paper: Paper,
}

impl ReportSettings {
    /// Largest number of letters of a name.
    pub const LONGEST: usize = 120;

    /// Returns true if the names fit into the heading of a report.
    pub fn is_sound(&self) -> bool {
        [&self.author, &self.company].iter().all(|name| name.chars().count() <= Self::LONGEST)
    }
}

/// Report that is being made.
#[derive(Default)]
pub struct Reports {
    pub settings: ReportSettings,
    of: Option<Of>,
    work: Background<Progress>,
}

/// Content of a report, with the answers that have been solved so far.
struct Of {
    format: ReportFormat,
    stated: Stated,
    answers: Vec<Answer>,
    /// Lesson of a worksheet, and the answers of its start and its steps.
    lesson: Option<(Lesson, Vec<usize>)>,
}

/// Solves of a report.
#[derive(Serialize, Deserialize)]
pub struct Solves {
    requests: Vec<Request>,
    model: Option<Given>,
}

/// Messages of the solves of a report.
#[derive(Serialize, Deserialize)]
pub enum Progress {
    Answer(Box<Answer>),
    Complete,
}

impl Task for Solves {
    const KIND: &'static str = "report";
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

impl Reports {
    /// Starts the report of a document's contact.
    pub fn begin(
        &mut self,
        ctx: &Context,
        (document, answers): (&Document, &Answers),
        format: ReportFormat,
        system: UnitSystem,
    ) {
        let (key, grid) = (document.key(), document.grid);
        let (mut methods, mut model) = (vec![Method::Full], None);
        if let Some(in_use) = answers.in_use(document).filter(|_| answers.trust(document) == Some(Trust::Trained)) {
            methods.push(in_use.method());
            model = Some(Given::of(&in_use.model));
        }
        let requests = methods
            .into_iter()
            .map(|method| Request { extent: document.extent(), ..key.request(grid, method) })
            .collect();
        let ReportSettings { author, company, .. } = self.settings.clone();
        self.of = Some(Of {
            format,
            stated: Stated { title: document.title.clone(), author, company, system, ..Stated::default() }
                .with(document.bodies_in_force(), document.view.oil.filter(|_| document.oil_counts()))
                .with_lubricant(&document.point, &document.lubricant),
            answers: Vec::new(),
            lesson: None,
        });
        self.work.run(Job::of("Report", wake(ctx), answers.store(), Solves { requests, model }));
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
        let stated = Stated { title: lesson.title.clone(), ..Stated::default() };
        let lesson = Some((lesson, indices));
        self.of = Some(Of { format: ReportFormat::Html, stated, answers: Vec::new(), lesson });
        self.work.run(Job::of("Worksheet", wake(ctx), answers.store(), Solves { requests, model: None }));
        Ok(())
    }

    /// Returns the report once it is complete, or the reason why there is none.
    pub fn receive(&mut self) -> Option<Result<Purpose, Refusal>> {
        let (mut complete, answers) = (false, self.of.as_mut().map(|of| &mut of.answers));
        let mut unread = Vec::new();
        let answers = answers.unwrap_or(&mut unread);
        self.work.receive(|told| match told {
            Progress::Answer(answer) => answers.push(*answer),
            Progress::Complete => complete = true,
        });
        if let Some(Of { format, stated, answers, lesson }) = self.of.take_if(|_| complete) {
            if let Some((lesson, indices)) = lesson {
                let page = lesson.worksheet(&answers, &indices);
                return Some(Ok(Purpose::Write(Written::Html, page.into_bytes().into())));
            }
            let file = Report::new(&stated, &answers, self.settings.paper).file(format);
            let written = match format {
                ReportFormat::Html => Written::Html,
                ReportFormat::Pdf => Written::Pdf,
            };
            return Some(Ok(Purpose::Write(written, file.into())));
        }
        self.work.message.take().map(|why| Err(Refusal::new(why)))
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops the report.
    pub fn stop(&self) {
        self.work.stop();
    }
}
