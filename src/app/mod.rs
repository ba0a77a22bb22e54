//! The explorer: a window in which a contact is dragged and answers at once.
//!
//! [`Explorer`] is the whole window as a function of an [`egui::Ui`]; [`run`] puts it into a native one.

mod color_map;
mod command;
mod controls;
mod document;
mod execute;
mod export;
mod figure;
mod files;
mod grid_error;
mod in_use;
mod jobs;
mod manual;
mod model_source;
mod numbers;
mod palette;
mod panels;
mod picture;
mod png;
mod presentation;
mod session;
mod state;
mod tabs;
mod theme;
mod traction;
mod training;
mod transient;

use crate::engine::Store;
use crate::solver::physics::contact::{ContactKind, Moes};
use crate::solver::reduced::ReducedModel;
use command::Command;
use document::Document;
use egui::{CentralPanel, Panel, ScrollArea, Ui};
use egui_tiles::Tree;
use jobs::JobKind;
use model_source::Models;
use palette::Palette;
use panels::help::Help;
use state::State;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;
use tabs::{Tab, Tabs};

/// By which the system knows the window, and the session its folder.
const APP_ID: &str = "ehl-explorer";

/// Opens the window, on a scene or on the last session, and returns when it is closed.
///
/// # Errors
/// One sentence when the scene cannot be read or there is no display.
pub fn run(scene: Option<PathBuf>) -> Result<(), String> {
    let mut explorer = Explorer::with_embedded_models();
    if let Some(folder) = eframe::storage_dir(APP_ID) {
        explorer = explorer.keeping_trainings_in(&folder);
    }
    if let Some(path) = &scene {
        explorer.open_scene(path)?;
    }
    let options = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_app_id(APP_ID)
            .with_title("EHL Explorer")
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([900.0, 560.0]),
        renderer: eframe::Renderer::Glow,
        ..eframe::NativeOptions::default()
    };
    let restore = scene.is_none();
    eframe::run_native(
        APP_ID,
        options,
        Box::new(move |creation| {
            if let Some(storage) = creation.storage {
                session::restore(&mut explorer, storage, restore);
            }
            // A session that ended in the midst of a presentation begins in a window.
            creation.egui_ctx.send_viewport_cmd(egui::ViewportCommand::Fullscreen(false));
            Ok(Box::new(explorer))
        }),
    )
    .map_err(|error| {
        let error = error.to_string();
        let reason = error.rsplit(": ").next().unwrap_or(&error).trim_end_matches('.');
        format!(
            "no window can be opened here ({reason}); without a display use the headless commands \
             `ehl-explorer solve`, `ehl-explorer run` or `ehl-explorer bench`"
        )
    })
}

/// The window.
pub struct Explorer {
    state: State,
    tree: Tree<Tab>,
    palette: Palette,
    help: Help,
    frame_s: f64,
    installed: bool,
}

impl Explorer {
    /// A window with one reduced model, or without any: the full solver then draws every other picture.
    pub fn new(model: Option<Arc<ReducedModel>>) -> Self {
        Self::with_models(Models::only(model), Store::default())
    }

    /// A window with all models that are part of the program.
    pub fn with_embedded_models() -> Self {
        let store = Store::default();
        Self::with_models(Models::embedded(&store), store)
    }

    fn with_models(models: Models, store: Store) -> Self {
        Self {
            state: State::new(Document::default(), models, store),
            tree: tabs::default_tree(),
            palette: Palette::default(),
            help: Help::default(),
            frame_s: 0.0,
            installed: false,
        }
    }

    /// Leaves the system's file dialogs alone; the path fields remain. For tests.
    pub fn without_system_dialogs(mut self) -> Self {
        self.state.files.native_dialogs = false;
        self
    }

    /// Keeps trainings in a folder while they run, and offers to go on with what is found there.
    pub fn keeping_trainings_in(mut self, folder: &Path) -> Self {
        self.state.training.keep_in(folder);
        self
    }

    /// One frame.
    pub fn ui(&mut self, ui: &mut Ui) {
        let begin = Instant::now();
        let ctx = ui.ctx().clone();
        if !self.installed {
            self.installed = true;
            theme::install(&ctx);
            ctx.set_theme(self.state.display.theme);
            self.state.training.look(&ctx);
        }
        self.scale(&ctx);
        self.palette.begin(&ctx);
        figure::begin(&ctx);
        self.state.receive();
        self.state.receive_training();
        let asked = self.state.files.asks() || self.state.asks_figure() || self.palette.is_open();
        let mut chosen = if asked { Vec::new() } else { Command::pressed(&ctx) };
        let presents = self.state.presentation.is_some();
        if presents {
            Panel::bottom("presentation").show(ui, |ui| panels::presentation::ui(ui, &mut self.state, &mut chosen));
        } else {
            self.panels(ui, &mut chosen);
        }
        // The picture follows within this frame: the panels that change the document are drawn before the plots.
        self.state.refresh(&ctx);
        self.state.follow_cuts();
        if !presents {
            Panel::bottom("readouts").show(ui, |ui| panels::readouts::ui(ui, &self.state));
        }
        CentralPanel::no_frame().show(ui, |ui| {
            self.tree.ui(&mut Tabs { state: &mut self.state }, ui);
        });
        self.state.files_ui(ui);
        self.state.figures_ui(&ctx);
        panels::help::ui(&ctx, &mut self.help);
        let action = self.palette.ui(&ctx, &self.state);
        self.state.settle(&ctx);
        for command in chosen {
            self.execute(&ctx, command);
        }
        if let Some(action) = action {
            self.act(&ctx, action);
        }
        // What a plot or a command changed shows in the next frame.
        if !self.state.is_answered() {
            ctx.request_repaint();
        }
        self.frame_s = begin.elapsed().as_secs_f64();
    }

    /// The panels around the tabs that are drawn before them.
    fn panels(&mut self, ui: &mut Ui, chosen: &mut Vec<Command>) {
        Panel::top("menu").show(ui, |ui| panels::menu::ui(ui, &mut self.state, chosen));
        Panel::bottom("jobs").show(ui, |ui| panels::strip::ui(ui, &self.state, self.frame_s, chosen));
        Panel::left("sliders").default_size(312.0).size_range(250.0..=520.0).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                panels::operating_point::ui(ui, &mut self.state);
                panels::lubricant::ui(ui, &mut self.state);
                panels::settings::ui(ui, &mut self.state);
                panels::plane::ui(ui, &mut self.state);
                ui.add_space(8.0);
            });
        });
    }

    /// M and L of the sliders.
    pub fn moes(&self) -> Moes {
        self.state.document.point.moes()
    }

    /// The load of the sliders: in N/m of a line contact, in N of a point contact.
    pub fn load(&self) -> f64 {
        self.state.document.point.load
    }

    /// H_c of the picture, when it belongs to the sliders.
    pub fn central_film(&self) -> Option<f64> {
        self.state.picture.as_ref().filter(|_| self.state.picture_is_current()).map(|p| p.solution.scalars.h_c)
    }

    /// Whether the contact of the sliders is a point contact.
    pub fn is_point(&self) -> bool {
        self.state.document.point.kind == ContactKind::Point
    }

    /// Nodes along X and across of the picture's grid.
    pub fn nodes(&self) -> Option<(usize, usize)> {
        self.state.picture.as_ref().map(|p| (p.solution.x.len(), p.solution.y.len()))
    }

    /// Where the profiles cut a point contact: X of the one across, Y of the one along.
    pub fn cuts(&self) -> (f64, f64) {
        (self.state.display.cuts.x, self.state.display.cuts.y)
    }

    /// Largest pressures of the drawn profiles: along X, and across where there is one.
    pub fn profile_peaks(&self) -> Option<(f64, Option<f64>)> {
        let peak = |curve: &[egui_plot::PlotPoint]| curve.iter().map(|p| p.y).reduce(f64::max);
        self.state.picture.as_ref().and_then(|p| Some((peak(&p.pressure)?, peak(&p.across.pressure))))
    }

    /// Estimated relative grid errors of H_c and H_min, when they belong to the sliders.
    pub fn grid_errors(&self) -> Option<(f64, f64)> {
        self.state.grid_error().map(|error| (error.accuracy.h_c_error, error.accuracy.h_min_error))
    }

    /// The first words of the trust badge.
    pub fn badge(&self) -> String {
        tabs::badge::verdict(&self.state).title
    }

    /// What the trust badge says after its first words; symbols stand in braces.
    pub fn badge_detail(&self) -> String {
        tabs::badge::verdict(&self.state).detail
    }

    /// Opens a scene, as File → Open does.
    ///
    /// # Errors
    /// A sentence when it cannot be read; what is on the screen stays.
    pub fn open_scene(&mut self, path: &Path) -> Result<(), String> {
        self.state.open_path(path)
    }

    /// Whether a computation runs or waits.
    pub fn busy(&self) -> bool {
        [JobKind::Live, JobKind::Refine, JobKind::Verify].into_iter().any(|kind| self.state.jobs.busy(kind))
    }

    /// Whether a training or a comparison runs.
    pub fn training(&self) -> bool {
        self.state.training.job().is_some()
    }

    /// Title of the reduced model in use.
    pub fn model_title(&self) -> Option<&str> {
        self.state.model().map(|model| model.title.as_str())
    }

    /// Whether a study of the Accuracy tab runs.
    pub fn studying(&self) -> bool {
        self.state.accuracy.standing().is_some()
    }

    /// Whether a contact is taken through time.
    pub fn marching(&self) -> bool {
        self.state.transient.work.standing().is_some()
    }

    /// Whether the number of operating points is studied.
    pub fn studying_points(&self) -> bool {
        self.state.transient.number.work.standing().is_some()
    }

    /// Operating points of the linearised model that is shown.
    pub fn operating_points(&self) -> Option<usize> {
        self.state.transient.linearised.as_ref().map(|linearised| linearised.model.points.len())
    }

    /// Contacts of the traction curve on the screen, when it is the one that was asked for last, and full solutions beside it.
    pub fn traction_contacts(&self) -> (Option<usize>, usize) {
        let view = &self.state.traction;
        let curve = view.curve.as_ref().filter(|_| view.curve_is_current());
        (curve.map(|curve| curve.samples.len()), view.markers.as_ref().map_or(0, |markers| markers.samples.len()))
    }

    /// Whether full solutions along the traction curve are being computed.
    pub fn solving_along(&self) -> bool {
        self.state.traction.full.standing().is_some()
    }

    /// SRR and NPR of the sliders.
    pub fn sliding(&self) -> (f64, f64) {
        (self.state.document.point.sliding.slide_to_roll_ratio, self.state.document.plateau_ratio())
    }

    /// Traction coefficient of the picture, when it belongs to the sliders.
    pub fn traction(&self) -> Option<f64> {
        self.state.picture.as_ref().filter(|_| self.state.picture_is_current()).map(|picture| picture.traction)
    }

    /// Moments that have been computed of contacts in time.
    pub fn transient_moments(&self) -> usize {
        self.state.transient.runs.iter().map(|run| run.trajectory.moments.len()).sum()
    }

    /// Seconds that the last frame took to build.
    pub fn frame_s(&self) -> f64 {
        self.frame_s
    }
}

impl eframe::App for Explorer {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        Self::ui(self, ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        session::save(self, storage);
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        std::time::Duration::from_secs(state::AUTO_SAVE_S)
    }
}
