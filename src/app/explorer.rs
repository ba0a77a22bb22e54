//! Explorer: a window in which the user changes a contact and sees its solution at once.
//!
//! [`Explorer`] is the whole window as a function of an [`egui::Ui`]; `run` opens it as a native window.

use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::point_at;
use crate::app::desk::files::Pending;
use crate::app::desk::{Desk, Opened};
use crate::app::document::Document;
use crate::app::drawn::{self, Drawn};
use crate::app::examples::Examples;
use crate::app::layouts::{self, Layout};
use crate::app::lessons::{self, Lessons, OnScreen};
use crate::app::links::{Address, Embed, Fragment, LinkWindow};
use crate::app::model_source::Models;
use crate::app::notice::Notice;
use crate::app::palette::Palette;
use crate::app::panels::help::Help;
use crate::app::panels::settings::Settings;
use crate::app::refusal::Refusal;
use crate::app::session::{self, Keeper, Place};
use crate::app::tab::Tab;
use crate::app::tabs::frame::Frame;
use crate::app::units;
use crate::app::wake::wake;
use crate::app::{panels, theme};
use crate::engine::Store;
use crate::host::browser;
use crate::host::clock::Stopwatch;
use crate::solver::reduced::ReducedModel;
use egui::{CentralPanel, Panel, ScrollArea, Ui};
use egui_tiles::Tree;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Screen height up to which a presentation shows no read-outs \[points\].
const LOW: f32 = 480.0;
/// Width of all tabs below which their titles are closely spaced.
const NARROW: f32 = 900.0;
/// Height of a row of read-outs. With friction or a film ratio two rows are reserved, in windows that are narrower than
/// the one and at least as high as the other.
const READOUTS: f32 = 24.0;
const ONE_ROW: f32 = 1400.0;
const TWO_ROWS: f32 = 700.0;

/// Window of the program.
pub struct Explorer {
    pub(super) desk: Desk,
    pub(super) tree: Tree<Tab>,
    pub(super) palette: Palette,
    pub(super) help: Help,
    pub(super) settings: Settings,
    pub(super) lessons: Lessons,
    pub(super) examples: Examples,
    pub(super) drawn: Vec<Drawn>,
    pub(super) frame_s: f64,
    pub(super) installed: bool,
    pub(super) place: Place,
    pub(super) keeper: Option<Keeper>,
    pub(super) link_window: LinkWindow,
    /// Set if the window shows only one tab with chosen sliders.
    pub(super) embed: Option<Embed>,
    address: Address,
}

impl Explorer {
    /// Creates a window with one reduced model or none. Without a model the full solver draws every picture.
    pub fn new(model: Option<Arc<ReducedModel>>) -> Self {
        Self::with_models(Models::only(model), Store::default())
    }

    /// Creates a window with all built-in models.
    pub fn with_embedded_models() -> Self {
        let store = Store::default();
        Self::with_models(Models::embedded(&store), store)
    }

    pub(super) fn with_models(models: Models, store: Store) -> Self {
        Self {
            desk: Desk::new(Document::default(), models, store),
            tree: Layout::default().tree(Place::default().size.0),
            lessons: Lessons::default(),
            examples: Examples::default(),
            palette: Palette::default(),
            help: Help::default(),
            settings: Settings::default(),
            drawn: Vec::new(),
            frame_s: 0.0,
            installed: false,
            place: Place::default(),
            keeper: None,
            link_window: LinkWindow::default(),
            embed: None,
            address: Address::default(),
        }
    }

    /// Switches off the file dialogs of the system, so that only the path fields remain. For tests.
    pub fn without_system_dialogs(mut self) -> Self {
        self.desk.files.native_dialogs = false;
        self
    }

    /// Makes a frame wait for the reduced model up to `patience`, however busy the machine is. For tests.
    pub fn waiting_for_answers(mut self, patience: Duration) -> Self {
        self.desk.answers.be_patient(patience);
        self
    }

    /// Stores running trainings in a folder and offers to resume those found there.
    pub fn keeping_trainings_in(mut self, folder: &Path) -> Self {
        self.desk.tabs.training.work.keep_in(folder);
        self
    }

    /// Restores the last session of a folder and stores this session there. Restores the document only if
    /// `with_document` is true.
    pub fn keeping_session_in(mut self, folder: &Path, with_document: bool) -> Self {
        session::restore(&mut self, folder, with_document);
        match Keeper::new(folder) {
            Ok(keeper) => self.keeper = Some(keeper),
            Err(why) => self.desk.files.notice = Some(Notice::wrong(why)),
        }
        self
    }

    /// Draws one frame. Commands from the panels are executed before the tabs are drawn, so that the picture
    /// changes within the frame.
    pub fn ui(&mut self, ui: &mut Ui) {
        let begin = Stopwatch::start();
        let ctx = ui.ctx().clone();
        if !self.installed {
            self.installed = true;
            theme::install(&ctx);
            ctx.set_theme(self.desk.display.theme);
            self.desk.tabs.training.work.look(&ctx);
        }
        self.scale(&ctx);
        units::set_system(&ctx, self.desk.display.system);
        self.palette.begin(&ctx);
        self.desk.figures.begin(ui);
        drawn::begin(&ctx);
        self.desk.receive();
        let asked =
            self.desk.files.asks() || self.desk.figures.asks() || self.palette.is_open() || self.link_window.is_open();
        let mut commands = Commands::default();
        if !asked {
            commands.extend(Command::pressed(&ctx));
        }
        self.panels(ui, &mut commands);
        self.execute_all(&ctx, &mut commands);
        self.answer_opened(&ctx, &mut commands);
        let here = self.desk.document.point;
        self.desk.tabs.regimes.follow(here.kind, here.moes());
        self.desk.answers.refresh(&ctx, &self.desk.document);
        self.desk.follow_cuts();
        self.lessons_ui(ui, &mut commands);
        let in_time = self.shows_in_time();
        // On a very low screen a presentation leaves this space to the plots.
        let room = self.desk.presentation.is_none() || ctx.content_rect().height() > LOW;
        if room {
            self.readouts_ui(ui, in_time);
        }
        let asked_above = self.desk.presentation.is_none() && self.desk.document.lost_question().is_none();
        if let Some(headline) = self.desk.headline.as_ref().filter(|_| asked_above) {
            Panel::top("headline").show(ui, |ui| headline.ui(ui, &mut commands));
        }
        CentralPanel::no_frame().show(ui, |ui| {
            let narrow = ui.available_width() < NARROW;
            let mut frame = Frame { desk: &mut self.desk, commands: &mut commands, narrow };
            match &self.embed {
                Some(embed) => frame.tab_ui(ui, embed.tab),
                None => self.tree.ui(&mut frame, ui),
            }
        });
        self.drawn = drawn::all(&ctx);
        self.desk.files_ui(ui);
        self.desk.figures_ui(&ctx);
        panels::help::ui(&ctx, &mut self.help);
        self.link_window.ui(&ctx, &mut commands);
        self.settings.ui(&ctx, &self.desk, &mut commands);
        self.examples.ui(&ctx, &mut commands);
        self.desk.machines.ui(&ctx, &self.desk.document, &mut commands);
        self.desk.load_cases.ui(&ctx, &self.desk.document, &mut commands);
        let mut measured = std::mem::take(&mut self.desk.measured);
        measured.ui(&ctx, &self.desk.context(), &self.desk.entries, &mut commands);
        self.desk.measured = measured;
        commands.extend(self.palette.ui(&ctx, &self.desk));
        self.settle(&ctx);
        self.execute_all(&ctx, &mut commands);
        self.keep_session(&ctx);
        self.follow_address(&ctx);
        // Changes by a plot or a command appear in the next frame.
        if !self.desk.answers.is_answer_to(&self.desk.document) {
            ctx.request_repaint();
        }
        self.frame_s = begin.elapsed().as_secs_f64();
    }

    /// Draws the read-outs of the contact, or of the displayed time of a transient run.
    fn readouts_ui(&self, ui: &mut Ui, in_time: bool) {
        Panel::bottom("readouts").show(ui, |ui| {
            // The height is constant, so that nothing above moves.
            let screen = ui.ctx().content_rect();
            let document = &self.desk.document;
            let more = document.has_surfaces() || document.point.sliding.slide_to_roll_ratio != 0.0;
            let two =
                more && self.desk.presentation.is_none() && screen.width() < ONE_ROW && screen.height() >= TWO_ROWS;
            let rows = if two { 2.0 } else { 1.0 };
            ui.set_min_height(rows * READOUTS + (rows - 1.0) * ui.spacing().item_spacing.y);
            let context = self.desk.context();
            if !in_time || !panels::moment::ui(ui, &context) {
                panels::readouts::ui(ui, &context);
            }
        });
    }

    /// Draws the panel of lessons if it is open.
    fn lessons_ui(&mut self, ui: &mut Ui, commands: &mut Commands) {
        if !self.lessons.is_open() {
            // The ring of the palette disappears with the next click or key.
            let moves_on = |event: &egui::Event| {
                matches!(
                    event,
                    egui::Event::PointerButton { pressed: true, .. } | egui::Event::Key { pressed: true, .. }
                )
            };
            if ui.input(|input| input.events.iter().any(moves_on)) {
                point_at(ui.ctx(), None);
            }
            return;
        }
        let screen = OnScreen {
            point: self.desk.document.point,
            plateau_ratio: self.desk.document.plateau_ratio(),
            lubricant: self.desk.document.lubricant,
            composite_roughness_m: self.desk.document.composite_roughness_m(),
            tabs: layouts::seen(&self.tree),
            pins: self.desk.answers.pins().len(),
            checked: self.desk.answers.comparison().is_some() && self.desk.answers.picture_is_current(),
        };
        // On a small screen the panel is placed below, so that adjacent tabs keep their width.
        let below = ui.ctx().content_rect().width() < lessons::BESIDE && screen.tabs.len() > 1;
        let ((least, most), width) = (Place::LESSONS, self.place.lessons);
        let panel = match below {
            true => Panel::bottom("lessons below").default_size(lessons::HEIGHT).size_range(lessons::HEIGHT..=420.0),
            false => Panel::right("lessons").default_size(width).size_range(least..=most),
        };
        let (lessons, finished) = (&mut self.lessons, &self.desk.finished);
        let shown = panel.resizable(true).show(ui, |ui| lessons.ui(ui, &screen, finished, commands));
        if !below {
            self.place.lessons = shown.response.rect.width().clamp(least, most);
        }
    }

    /// Brings the tab of a newly opened scene to the front. Runs its study if it needs no confirmation.
    fn answer_opened(&mut self, ctx: &egui::Context, commands: &mut Commands) {
        match self.desk.opened.take() {
            None => {}
            Some(Opened::Scene(tab)) => {
                self.show(tab);
                if tab == Tab::Results {
                    self.desk.run_study(wake(ctx));
                }
            }
            Some(Opened::Link(link)) => {
                let Fragment { tree, embed, lesson, .. } = *link;
                self.tree = tree.unwrap_or_else(|| self.tree.clone());
                self.embed = embed;
                if let Some(lesson) = lesson {
                    commands.extend(self.lessons.open_lesson(lesson));
                }
            }
            Some(Opened::Campaign(folder)) => {
                self.show(Tab::Results);
                self.desk.watch_campaign(folder, wake(ctx));
            }
        }
    }

    /// Records finished gestures in the history, and starts computations that wait until the sliders are idle.
    fn settle(&mut self, ctx: &egui::Context) {
        let gesture = ctx.input(|i| i.pointer.any_down());
        let desk = &mut self.desk;
        if !gesture {
            desk.history.commit(&desk.document);
        }
        desk.answers.settle(ctx, &desk.document);
        desk.transient.settle(ctx, desk.answers.store());
        // Wait for a contact that is being solved.
        desk.fit_plots &= desk.answers.coming() && !desk.answers.picture_is_current();
    }

    /// Passes changes of this frame to the keeper of the session.
    fn keep_session(&mut self, ctx: &egui::Context) {
        let Some(mut keeper) = self.keeper.take() else { return };
        self.place.follow(ctx);
        if let Some(sentence) = keeper.follow(self) {
            self.desk.files.notice = Some(Notice::wrong(sentence));
        }
        self.keeper = Some(keeper);
    }

    /// Opens a link that the user has put into the address of the page, and updates the address to the present
    /// view.
    fn follow_address(&mut self, ctx: &egui::Context) {
        if !browser::PAGE {
            return;
        }
        if let Some(asked) = browser::asked().filter(|asked| asked.len() > 1) {
            self.desk.request(ctx, Pending::OpenLink(asked));
            ctx.request_repaint();
        } else if self.embed.is_none()
            && !ctx.input(|i| i.pointer.any_down())
            && let Some(seconds) = self.address.follow(&self.desk.document, &self.tree)
        {
            ctx.request_repaint_after_secs(seconds as f32);
        }
        if !ctx.input(|i| i.pointer.any_down())
            && let Some(news) = panels::readouts::spoken(&self.desk.context())
        {
            let wrong = match &self.desk.files.notice {
                Some(Notice::Wrong(why)) => format!("{why}. "),
                _ => String::new(),
            };
            browser::say(&format!("{wrong}{news}"));
        }
    }

    /// Draws the panels around the tabs that come before the tabs.
    fn panels(&mut self, ui: &mut Ui, commands: &mut Commands) {
        let (desk, frame_s) = (&mut self.desk, self.frame_s);
        // Move the entries out, so that the panels can change them while the context is borrowed.
        let (mut entries, mut own_laws) = (std::mem::take(&mut desk.entries), desk.own_lubricant);
        let context = desk.context();
        if let Some(embed) = &self.embed {
            let chosen = |quantity| embed.sliders.is_empty() || embed.sliders.contains(&quantity);
            let free = |quantity| !embed.locked.contains(&quantity);
            Panel::bottom("embed").show(ui, |ui| {
                panels::sliders::side_by_side(ui, &context, (&chosen, &free), &mut entries, commands);
            });
        } else if context.presenting {
            let bar = (!desk.locked.is_empty(), desk.display.sliders);
            Panel::bottom("presentation").show(ui, |ui| {
                panels::presentation::ui(ui, &context, bar, &mut entries, commands);
            });
        } else {
            Panel::top("menu").show(ui, |ui| panels::menu::ui(ui, desk, commands));
            Panel::bottom("jobs").show(ui, |ui| panels::strip::ui(ui, desk, frame_s, commands));
            let ((least, most), width) = (Place::SLIDERS, self.place.sliders);
            let sliders = Panel::left("sliders").default_size(width).size_range(least..=most).show(ui, |ui| {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    panels::operating_point::ui(ui, &context, &mut entries, commands);
                    panels::bodies::ui(ui, &context, &mut entries, commands);
                    panels::surfaces::ui(ui, &context, &mut entries, commands);
                    panels::lubricant::ui(ui, &context, &mut own_laws, &mut entries, commands);
                    panels::model::ui(ui, &context, commands);
                    panels::plane::ui(ui, &context, commands);
                    ui.add_space(8.0);
                });
            });
            self.place.sliders = sliders.response.rect.width().clamp(least, most);
        }
        (desk.entries, desk.own_lubricant) = (entries, own_laws);
    }

    /// Opens a scene, as File → Open does.
    ///
    /// # Errors
    /// A sentence if the scene cannot be read. The screen then keeps its content.
    pub fn open_scene(&mut self, path: &Path) -> Result<(), Refusal> {
        self.desk.open_path(path)
    }

    /// Opens the content of a link. Shows a notice if the link is refused.
    pub fn open_link(&mut self, link: &str) {
        if let Err(why) = self.desk.open_link(link) {
            self.desk.files.notice = Some(Notice::wrong(why));
        }
    }

    /// Returns the visible tabs.
    pub(super) fn tabs_in_front(&self) -> impl Iterator<Item = Tab> {
        layouts::seen(&self.tree).into_iter()
    }

    /// Returns true if only transient views are visible. The read-outs then show their displayed time.
    fn shows_in_time(&self) -> bool {
        // The map of a point contact shows the steady contact.
        let line = self.desk.document.point.kind.is_line();
        let in_time = |tab| matches!(tab, Tab::Transient | Tab::Tpwl) || line && tab == Tab::ContactMap;
        self.desk.document.no_transient().is_none() && self.tabs_in_front().all(in_time)
    }
}

impl eframe::App for Explorer {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        Self::ui(self, ui);
    }

    fn persist_egui_memory(&self) -> bool {
        false
    }
}
