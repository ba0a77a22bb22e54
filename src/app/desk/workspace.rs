//! Working state of the window: document, results, running jobs, files. Panels and tabs read it through a
//! [`Context`] and change it by commands.

use super::files::Files;
use super::opened::Opened;
use crate::app::animations::Animations;
use crate::app::answers::Answers;
use crate::app::answers::picture::Cuts;
use crate::app::caption;
use crate::app::context::Context;
use crate::app::controls::Entries;
use crate::app::display::Display;
use crate::app::document::{Document, Edit, History};
use crate::app::figure::Figures;
use crate::app::load_cases::LoadCasesWindow;
use crate::app::machines::MachineWindow;
use crate::app::measured::{MeasuredPoints, MeasuredWindow};
use crate::app::model_source::Models;
use crate::app::notice::Notice;
use crate::app::panels::headline::Headline;
use crate::app::presentation::Presentation;
use crate::app::reports::Reports;
use crate::app::tab::Tab;
use crate::app::tabs::all::Tabs;
use crate::app::tabs::transient::TransientRuns;
use crate::engine::job::{Standing, Wake};
use crate::engine::{Store, Workbench};
use crate::scene::Scene;
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::reduced::ReducedModel;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Working state of the window.
pub struct Desk {
    /// Document that is edited.
    pub document: Document,
    /// Undo and redo.
    pub history: History,
    /// Results for the document.
    pub answers: Answers,
    /// Opening, saving and exporting.
    pub files: Files,
    /// Theme, size, and position of the cuts through a point contact.
    pub display: Display,
    /// Text fields being edited and their messages.
    pub entries: Entries,
    /// True if the laws and constants of the lubricant are edited, even if it still has a name.
    pub own_lubricant: bool,
    /// Transient runs, which several tabs show.
    pub transient: TransientRuns,
    pub tabs: Tabs,
    /// Plots exported as figures.
    pub figures: Figures,
    /// Tables of load cases.
    pub load_cases: LoadCasesWindow,
    /// Measured data and fits.
    pub measured: MeasuredWindow,
    /// Points of the measured data of the document.
    pub measured_points: MeasuredPoints,
    /// Forms of bearings, gears and cams.
    pub machines: MachineWindow,
    /// Question of the example scene that was opened.
    pub headline: Option<Headline>,
    /// Titles of the lessons that were finished.
    pub finished: Vec<String>,
    /// Report that is being made.
    pub reports: Reports,
    /// Animation that is being drawn.
    pub animations: Animations,
    /// Running presentation, which shows only plots and sliders.
    pub presentation: Option<Presentation>,
    /// Item that was just opened and still has to be handled.
    pub opened: Option<Opened>,
    /// True if plots shall be fitted to their data in this frame.
    pub fit_plots: bool,
    /// Tabs whose axes are locked.
    pub locked: Vec<Tab>,
}

impl Desk {
    /// Creates the state with a document.
    pub fn new(document: Document, models: Models, store: Store) -> Self {
        let mut history = History::default();
        history.restart(&document);
        Self {
            files: Files::new(&document),
            document,
            history,
            answers: Answers::new(models, store),
            display: Display::default(),
            entries: Entries::default(),
            own_lubricant: false,
            transient: TransientRuns::default(),
            tabs: Tabs::default(),
            figures: Figures::default(),
            load_cases: LoadCasesWindow::default(),
            measured: MeasuredWindow::default(),
            measured_points: MeasuredPoints::default(),
            machines: MachineWindow::default(),
            headline: None,
            finished: Vec::new(),
            reports: Reports::default(),
            animations: Animations::default(),
            presentation: None,
            opened: None,
            fit_plots: true,
            locked: Vec::new(),
        }
    }

    /// Returns the read-only state for panels and tabs.
    pub fn context(&self) -> Context<'_> {
        Context {
            document: &self.document,
            answers: &self.answers,
            transient: &self.transient,
            file: self.files.path.as_deref(),
            entries: &self.entries,
            cuts: self.display.cuts,
            thresholds: self.display.thresholds,
            why: self.display.why,
            presenting: self.presentation.is_some(),
            fit: self.fit_plots,
            system: self.display.system,
            measured: self.measured_points.all(),
        }
    }

    /// Changes the document. A refusal is shown next to the field. After a successful change, pending entries in
    /// other fields are discarded.
    pub fn edit(&mut self, edit: Edit, field: &'static str) {
        let kind = self.document.point.kind;
        self.own_lubricant &= !matches!(edit, Edit::Named(_));
        let result = self.document.edit(edit);
        if result.is_ok() {
            self.entries.clear();
        }
        self.fit_plots |= self.document.point.kind != kind;
        self.entries.answer(field, result);
    }

    /// Draws the figure window and handles a completed report. Call after everything else is drawn.
    pub fn figures_ui(&mut self, ctx: &egui::Context) {
        let mut figures = std::mem::take(&mut self.figures);
        let made = figures.ui(ctx, self.display.theme, |tab| self.caption(tab));
        self.figures = figures;
        match made.map(Ok).or_else(|| self.reports.receive()) {
            Some(Ok(file)) => self.ask_path(ctx, file),
            Some(Err(why)) => self.files.notice = Some(Notice::Wrong(format!("No report: {why}"))),
            None => {}
        }
        match self.animations.receive() {
            Some(Ok(file)) => self.ask_path(ctx, file),
            Some(Err(why)) => self.files.notice = Some(Notice::Wrong(format!("No animation: {why}"))),
            None => {}
        }
    }

    /// Locks or unlocks the axes of a tab.
    pub fn lock(&mut self, tab: Tab, locked: bool) {
        self.locked.retain(|other| *other != tab);
        if locked {
            self.locked.push(tab);
        } else {
            self.fit_plots = true;
        }
    }

    /// Keeps the cuts of a point contact within its domain.
    pub fn follow_cuts(&mut self) {
        if let Some(PointGridSpec { domain: (from, to, edge), .. }) = self.document.chosen_plane() {
            let Cuts { x, y } = self.display.cuts;
            self.display.cuts = Cuts { x: x.clamp(from, to), y: y.clamp(edge, -edge) };
        }
        self.answers.follow_cuts(self.display.cuts);
    }

    /// Returns the reduced model for the contact on the screen.
    pub fn model(&self) -> Option<&Arc<ReducedModel>> {
        self.answers.model(&self.document)
    }

    /// Returns the progress of all jobs except the full solves for the picture.
    pub fn works(&self) -> Vec<Standing> {
        let context = self.context();
        let tabs = Tab::ALL.iter().flat_map(|tab| self.tabs.of(*tab).jobs(&context));
        let (tables, animated) = (self.measured.standing(), self.animations.standing());
        let made = [self.reports.standing(), self.figures.standing(), animated, tables];
        self.answers.standing().into_iter().chain(tabs).chain(made.into_iter().flatten()).collect()
    }

    /// Receives results since the last frame. Call first in every frame.
    pub fn receive(&mut self) {
        self.answers.receive();
        self.transient.receive(self.answers.store());
        self.tabs.receive();
        self.measured.receive();
        self.measured_points.follow(&self.document.view.measured);
    }

    /// Stops all jobs and keeps the results so far.
    pub fn stop_all(&mut self) {
        self.answers.cancel_all();
        self.transient.stop();
        self.tabs.stop();
        self.reports.stop();
        self.animations.stop();
        self.measured.stop();
        self.figures.stop();
    }

    /// Returns the parameters of the plots of a tab, for the caption of a figure.
    fn caption(&self, tab: Tab) -> String {
        let own = self.tabs.of(tab).caption(&self.context());
        own.unwrap_or_else(|| caption::contact(&self.document.point, &self.document.lubricant, self.display.system))
    }

    /// Runs the study of the scene on the screen.
    pub fn run_study(&mut self, wake: Wake) {
        let base = self.files.path.as_deref().and_then(Path::parent).unwrap_or(Path::new("")).to_owned();
        let bench = Workbench::on(self.answers.store(), base);
        self.tabs.results.start(self.document.to_scene(), bench, wake);
    }

    /// Solves a table of load cases in the Results tab.
    pub fn solve_cases(&mut self, scene: &Scene, wake: Wake) {
        let bench = Workbench::on(self.answers.store(), "");
        self.tabs.results.solve_cases(scene.clone(), bench, wake);
    }

    /// Watches a campaign of the scene on the screen.
    pub fn watch_campaign(&mut self, folder: PathBuf, wake: Wake) {
        self.tabs.results.watch(self.document.to_scene(), folder, wake);
    }

    /// Replaces the document, as New and Open do. Everything of the previous document is discarded, except pinned
    /// curves, which state their contacts, and data of reduced models.
    pub fn replace_document(&mut self, document: Document) {
        self.history.restart(&document);
        self.document = document;
        self.own_lubricant = false;
        self.headline = None;
        self.tabs.results.forget();
        self.tabs.regimes.forget();
        self.transient.forget();
        self.entries.clear();
    }
}
