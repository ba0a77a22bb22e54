//! Everything the window knows, and how a change of the document becomes a picture and its verification.

mod answers;
mod display;

pub use display::Display;

use super::controls::Entries;
use super::document::{Document, History};
use super::figure::Figures;
use super::files::Files;
use super::grid_error::GridError;
use super::in_use::InUse;
use super::jobs::{GridChoice, JobKind, Jobs, Key, Request};
use super::model_source::Models;
use super::picture::{Comparison, Cuts, Origin, Picture};
use super::plots::contact_map::ContactMap;
use super::plots::film_shear::FilmShearImage;
use super::plots::{accuracy::AccuracyView, basis::BasisView, regimes::RegimeChart, tpwl::TpwlView};
use super::presentation::Presentation;
use super::task::Standing;
use super::traction::TractionView;
use super::training::Training;
use super::transient::TransientView;
use crate::solver::contact::ContactKind;
use crate::solver::full::{Mesh, Problem, Report};
use crate::solver::grid::PointGridSpec;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use egui::Context;
use std::sync::Arc;
use std::time::Instant;

/// Seconds of rest after which a verification starts by itself.
pub const REST_S: f64 = 0.25;
/// Seconds between two writes of the session.
pub const AUTO_SAVE_S: u64 = 10;
/// Curves that can be pinned at once.
pub const MOST_PINS: usize = 8;

/// A curve that stays for comparison.
pub struct Pin {
    /// Number shown to people.
    pub number: usize,
    /// The curve and its parameters.
    pub picture: Picture,
}

/// Why the picture is not what the sliders say.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The parameters that failed.
    pub key: Key,
    /// A sentence.
    pub message: String,
    /// How far the solve got.
    pub report: Option<Report>,
}

/// Why the full solver draws the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PassedOver {
    /// There is no reduced model.
    NoModel,
    /// It was not trained for this contact; a sentence says why.
    Outside(String),
    /// It did not converge; a sentence says how.
    Failed(String),
}

/// The state of the window.
pub struct State {
    /// What is edited.
    pub document: Document,
    /// Undo and redo.
    pub history: History,
    /// Opening, saving, exporting.
    pub files: Files,
    /// How things are shown.
    pub display: Display,
    /// The worker.
    pub jobs: Jobs,
    /// Text fields being edited and their messages.
    pub entries: Entries,
    /// Whether laws and constants of the lubricant are edited, though it may still have a name.
    pub own_lubricant: bool,
    /// The reduced models.
    pub models: Models,
    online: Option<Online>,
    /// The last valid picture.
    pub picture: Option<Picture>,
    /// The last converged full solution.
    pub full: Option<Picture>,
    /// The report of the last full solve, converged or not, and what it was for.
    pub last_report: Option<(Key, Report)>,
    /// The picture against the full solution, when both belong together.
    pub comparison: Option<Comparison>,
    /// Why there is no picture for the sliders.
    pub failure: Option<Failure>,
    /// Why the verification gave nothing.
    pub verify_failure: Option<Failure>,
    /// Why the reduced model was passed over.
    pub passed_over: Option<PassedOver>,
    /// Pinned curves.
    pub pins: Vec<Pin>,
    /// Seconds of the last reduced and full solves.
    pub reduced_wall_s: Option<f64>,
    /// Seconds of the last full solve.
    pub full_wall_s: Option<f64>,
    /// What the grid costs, estimated on request.
    pub grid_error: Option<GridError>,
    /// Images of the Contact map tab.
    pub map: ContactMap,
    /// Image of the shear across the film.
    pub film_shear: FilmShearImage,
    /// State of the Reduced basis tab.
    pub basis: BasisView,
    /// The studies of the Accuracy tab.
    pub accuracy: AccuracyView,
    /// Trainings.
    pub training: Training,
    /// Contacts in time.
    pub transient: TransientView,
    /// What the TPWL tab shows.
    pub tpwl: TpwlView,
    /// Plots that leave as pictures.
    pub figures: Figures,
    /// Traction and film along one quantity.
    pub traction: TractionView,
    /// What the Regimes tab keeps between frames.
    pub regimes: RegimeChart,
    /// A presentation under way: plots and sliders only.
    pub presentation: Option<Presentation>,
    /// Plots are to be fitted to their data in this frame.
    pub fit_plots: bool,
    wanted: Option<Key>,
    wanted_plane: Option<PointGridSpec>,
    wanted_options: Option<ReducedOptions>,
    changed_at: f64,
    verify_due: bool,
    next_pin: usize,
}

impl State {
    /// A window on a document.
    pub fn new(document: Document, models: Models) -> Self {
        let mut history = History::default();
        history.restart(&document);
        Self {
            files: Files::new(&document),
            document,
            history,
            display: Display::default(),
            jobs: Jobs::default(),
            entries: Entries::default(),
            own_lubricant: false,
            models,
            online: None,
            picture: None,
            full: None,
            last_report: None,
            comparison: None,
            failure: None,
            verify_failure: None,
            passed_over: None,
            pins: Vec::new(),
            reduced_wall_s: None,
            full_wall_s: None,
            grid_error: None,
            map: ContactMap::default(),
            film_shear: FilmShearImage::default(),
            basis: BasisView::default(),
            accuracy: AccuracyView::default(),
            training: Training::default(),
            transient: TransientView::default(),
            tpwl: TpwlView::default(),
            figures: Figures::default(),
            traction: TractionView::default(),
            regimes: RegimeChart::default(),
            presentation: None,
            fit_plots: true,
            wanted: None,
            wanted_plane: None,
            wanted_options: None,
            changed_at: 0.0,
            verify_due: false,
            next_pin: 1,
        }
    }

    /// What the sliders ask for.
    pub fn key(&self) -> Key {
        Key { point: self.document.point, lubricant: self.document.lubricant }
    }

    /// Whether the present document has been answered by [`Self::refresh`].
    pub fn is_answered(&self) -> bool {
        self.wanted == Some(self.key())
            && self.wanted_plane == self.plane()
            && self.wanted_options == Some(self.reduced_options())
    }

    /// The grid that was chosen for a point contact; none for a line contact.
    pub fn plane(&self) -> Option<PointGridSpec> {
        (self.document.point.kind == ContactKind::Point).then(|| self.document.plane())
    }

    /// The reduced model that serves the contact on the screen.
    pub fn model(&self) -> Option<&Arc<ReducedModel>> {
        self.models.of(self.document.point.kind, &self.document.lubricant)
    }

    /// Whether the picture is a full solution on another grid than the one that was chosen, and will be replaced by one on that.
    pub fn is_quick(&self) -> bool {
        let on = |picture: &Picture, plane: PointGridSpec| picture.solution.mesh == Mesh::Point(plane);
        matches!((&self.picture, self.plane()), (Some(picture), Some(plane))
            if picture.origin == Origin::Full && !on(picture, plane))
    }

    /// Whether the picture belongs to the sliders.
    pub fn picture_is_current(&self) -> bool {
        self.picture.as_ref().is_some_and(|p| p.key == self.key())
    }

    /// Whether the picture should be drawn grey: not the sliders', and not about to be replaced.
    pub fn picture_is_stale(&self, now: f64) -> bool {
        !self.picture_is_current() && (self.failure.is_some() || now - self.changed_at > REST_S)
    }

    /// What the grid costs, where that was estimated for the sliders and the chosen grid.
    pub fn grid_error(&self) -> Option<&GridError> {
        let mesh = self.full.as_ref().map(|full| full.solution.mesh);
        self.grid_error.as_ref().filter(|error| error.key.has_film_of(&self.key()) && Some(error.mesh) == mesh)
    }

    /// Whether the full solution belongs to the sliders.
    pub fn full_is_current(&self) -> bool {
        self.full.as_ref().is_some_and(|p| p.key == self.key())
    }

    /// Puts a reduced model in use and returns the one it replaces: the picture and everything drawn of the model follow.
    pub fn use_model(&mut self, model: Arc<ReducedModel>) -> Option<Arc<ReducedModel>> {
        let former = self.models.put(model);
        self.models_have_changed();
        former
    }

    /// Does without a reduced model.
    pub fn drop_model(&mut self, model: &Arc<ReducedModel>) {
        self.models.remove(model);
        self.models_have_changed();
    }

    fn models_have_changed(&mut self) {
        self.online = None;
        self.regimes = RegimeChart::default();
        self.comparison = None;
        self.wanted = None;
    }

    /// Whether the model was trained for the sliders.
    pub fn trust(&self) -> Option<Trust> {
        let problem = Problem::new(&self.document.point, self.document.lubricant).ok()?;
        self.model().map(|m| m.trust(&problem))
    }

    /// The truncation the document asks for, in the window that serves it.
    pub fn reduced_options(&self) -> ReducedOptions {
        let moes = self.document.point.moes();
        self.in_use().map_or_else(ReducedOptions::default, |model| model.options_at(moes))
    }

    /// The reduced model with the document's truncation.
    pub fn in_use(&self) -> Option<InUse> {
        self.model().map(|model| InUse::new(model, &self.document.view))
    }

    /// Seconds since the document last changed, as of `now`.
    pub fn rested_s(&self, now: f64) -> f64 {
        now - self.changed_at
    }

    /// Answers a changed document: at once by the reduced model, else by the full solver in the worker. Called after the panels.
    pub fn refresh(&mut self, ctx: &Context) {
        let (key, options) = (self.key(), self.reduced_options());
        if self.is_answered() {
            return;
        }
        let moved = self.wanted != Some(key);
        let drawn = self.picture.as_ref().is_some_and(|picture| self.wanted == Some(picture.key));
        let same_means = self.wanted_plane == self.plane() && self.wanted_options == Some(options);
        self.wanted = Some(key);
        self.wanted_plane = self.plane();
        self.wanted_options = Some(options);
        self.changed_at = ctx.input(|i| i.time);
        if moved {
            self.failure = None;
            self.verify_failure = None;
            self.slide(key);
            // The same film by the same means is on the screen already, and what is known of it stays.
            if drawn && same_means && self.picture_is_current() && self.untried() == self.passed_over {
                self.compare();
                return;
            }
        }
        if self.refresh_reduced(key, options) {
            self.compare();
            self.verify_due = !self.full_is_current();
            if self.verify_due {
                ctx.request_repaint_after_secs(REST_S as f32);
            }
        } else {
            self.comparison = None;
            let live = self.picture.as_ref().is_none_or(|p| p.key != key || p.origin != Origin::Full);
            if live {
                self.submit(ctx, JobKind::Live);
            }
            // A quick grid follows the hand; the chosen one answers when it rests.
            let finer = self.plane().is_some_and(|plane| !live || plane != quick(plane));
            self.verify_due = finer && !self.is_settled(&key);
            if self.verify_due {
                ctx.request_repaint_after_secs(REST_S as f32);
            }
        }
    }

    /// Takes the pictures along to a contact with the same film: they need no other solve.
    fn slide(&mut self, key: Key) {
        let along = |picture: &&mut Picture| picture.key != key && picture.key.has_film_of(&key);
        let shared = matches!((&self.picture, &self.full), (Some(a), Some(b)) if Arc::ptr_eq(&a.solution, &b.solution));
        if let Some(picture) = self.picture.as_mut().filter(along) {
            picture.slide(key);
        }
        if shared {
            self.full.clone_from(&self.picture);
        } else if let Some(full) = self.full.as_mut().filter(along) {
            full.slide(key);
        }
    }

    /// Lays all curves where the point contact is cut, within its domain. Called before the plots.
    pub fn follow_cuts(&mut self) {
        if let Some(PointGridSpec { domain: (from, to, edge), .. }) = self.plane() {
            let Cuts { x, y } = self.display.cuts;
            self.display.cuts = Cuts { x: x.clamp(from, to), y: y.clamp(edge, -edge) };
        }
        let cuts = self.display.cuts;
        let pinned = self.pins.iter_mut().map(|pin| &mut pin.picture);
        for picture in self.picture.iter_mut().chain(&mut self.full).chain(pinned) {
            picture.cut(cuts);
        }
        if self.comparison.as_ref().is_some_and(|c| c.cuts != cuts) {
            self.compare();
        }
    }

    /// Why the reduced model is not even tried; `None` where it is.
    fn untried(&self) -> Option<PassedOver> {
        match self.trust() {
            None => Some(PassedOver::NoModel),
            Some(Trust::Outside(why)) => Some(PassedOver::Outside(why)),
            Some(Trust::Trained) => None,
        }
    }

    /// Tries the reduced model; `false` when the full solver has to take over.
    fn refresh_reduced(&mut self, key: Key, options: ReducedOptions) -> bool {
        self.passed_over = self.untried();
        let (None, Some(model)) = (&self.passed_over, self.model().cloned()) else { return false };
        if self.online.as_ref().is_none_or(|o| *o.options() != options || !Arc::ptr_eq(&o.model, &model)) {
            let first = self.online.is_none();
            let mut online = Online::new(model, options);
            if first {
                // The very first solve pays for cold caches and code; the time shown should be that of every later one.
                let _ = online.solve(&key.point, key.lubricant);
                online.forget();
            }
            self.online = Some(online);
        }
        let Some(online) = &mut self.online else { return false };
        // Operators belong to the model and its truncation: the time shown is the solve's alone.
        online.prepare(key.point.moes());
        let begin = Instant::now();
        let solved = online.solve(&key.point, key.lubricant);
        let wall_s = begin.elapsed().as_secs_f64();
        let result = solved.and_then(|reduced| online.reconstruct(&reduced).map(|fields| (reduced, fields)));
        match result {
            Ok((reduced, fields)) => {
                self.reduced_wall_s = Some(wall_s);
                let origin = Origin::Reduced {
                    residual_estimate: reduced.residual_estimate,
                    error: reduced.error,
                    iterations: reduced.iterations,
                    window: reduced.window,
                };
                let (cuts, traction) = (self.display.cuts, reduced.traction);
                self.picture = Some(Picture::new(key, origin, Arc::new(fields), cuts, traction));
                true
            }
            Err(error) => {
                self.passed_over = Some(PassedOver::Failed(error.to_string()));
                false
            }
        }
    }

    fn submit(&mut self, ctx: &Context, kind: JobKind) {
        let key = self.key();
        // A line contact is solved on the model's own grid wherever it lies, a point contact where the model serves it: elsewhere on the
        // grid that was chosen.
        let own = self.passed_over.is_none() || self.plane().is_none();
        let plane = self.plane().map(|plane| if kind == JobKind::Live { quick(plane) } else { plane });
        let model = self.model().filter(|_| own).map(Arc::as_ref);
        let grid = GridChoice::of(model, plane, key.point.moes());
        let start = match kind {
            // The truth must not depend on what it checks.
            JobKind::Verify => None,
            _ => self.picture.as_ref().map(|p| Arc::clone(&p.solution)),
        };
        self.jobs.submit(ctx, Request { kind, key, grid, start });
    }

    /// Starts the verification when the sliders have rested, and records finished gestures. Called last in every frame.
    pub fn settle(&mut self, ctx: &Context) {
        let gesture = ctx.input(|i| i.pointer.any_down());
        if !gesture && self.history.commit(&self.document) {
            // The session is written with the next frame after its interval: see to it that there is one.
            ctx.request_repaint_after_secs(AUTO_SAVE_S as f32 + 1.0);
        }
        if self.verify_due {
            let rest = ctx.input(|i| i.time) - self.changed_at;
            if rest >= REST_S {
                self.verify_due = false;
                let reduced = self.passed_over.is_none();
                if reduced && !self.full_is_current() {
                    self.submit(ctx, JobKind::Verify);
                } else if !reduced && !self.is_settled(&self.key()) {
                    self.submit(ctx, JobKind::Refine);
                }
            } else {
                ctx.request_repaint_after_secs((REST_S - rest) as f32);
            }
        }
        self.fit_plots = false;
    }

    /// Verifies now, even when a full solution is there.
    pub fn verify(&mut self, ctx: &Context) {
        self.verify_due = false;
        self.verify_failure = None;
        self.submit(ctx, JobKind::Verify);
    }

    /// How far the study is that runs beside the picture; the first where there are several.
    pub fn study(&self) -> Option<Standing> {
        let studied = self.accuracy.standing().or(self.transient.standing()).or(self.transient.number.standing());
        studied.or(self.traction.standing())
    }

    /// Stops everything that runs; what has been found stays.
    pub fn stop_all(&mut self) {
        self.jobs.cancel_all();
        self.training.stop();
        self.accuracy.stop();
        self.transient.stop();
        self.traction.stop();
    }

    /// Keeps the live curve for comparison.
    pub fn pin(&mut self) {
        if let Some(picture) = &self.picture
            && self.pins.len() < MOST_PINS
        {
            self.pins.push(Pin { number: self.next_pin, picture: picture.clone() });
            self.next_pin += 1;
        }
    }

    /// Replaces the document, as New and Open do.
    pub fn replace_document(&mut self, document: Document) {
        self.history.restart(&document);
        self.document = document;
        self.own_lubricant = false;
        self.forget_entries();
    }

    /// Forgets what was typed and refused: the document is another one now.
    pub fn forget_entries(&mut self) {
        self.entries.clear();
        self.training.refused = None;
        self.transient.refused = None;
    }
}

/// The grid of pictures that follow the hand: the quick one, unless the chosen one is as quick.
fn quick(chosen: PointGridSpec) -> PointGridSpec {
    let nodes = |spec: PointGridSpec| spec.nodes().map_or(usize::MAX, |(nx, ny)| nx * ny * ny);
    if nodes(chosen) <= nodes(PointGridSpec::QUICK) { chosen } else { PointGridSpec::QUICK }
}
