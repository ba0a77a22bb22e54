//! Everything the window knows.

mod answers;
mod display;
mod following;

pub use display::Display;

use super::controls::Entries;
use super::document::{Document, History};
use super::figure::Figures;
use super::files::Files;
use super::grid_error::GridError;
use super::in_use::InUse;
use super::jobs::{Jobs, Key};
use super::model_source::Models;
use super::picture::{Comparison, Origin, Picture};
use super::presentation::Presentation;
use super::tabs::contact_map::ContactMap;
use super::tabs::film_shear::FilmShearImage;
use super::tabs::{accuracy::AccuracyView, basis::BasisView, regimes::RegimeChart, tpwl::TpwlView};
use super::traction::TractionView;
use super::training::Training;
use super::transient::TransientView;
use crate::engine::Store;
use crate::engine::job::Standing;
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::{Mesh, Problem, Report};
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use std::sync::Arc;

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
    /// Grids, solvers and models, shared by everything that computes.
    pub store: Store,
    /// Full solves for the picture.
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
    pub fn new(document: Document, models: Models, store: Store) -> Self {
        let mut history = History::default();
        history.restart(&document);
        Self {
            files: Files::new(&document),
            document,
            history,
            display: Display::default(),
            jobs: Jobs::new(&store),
            store,
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

    /// How far the study is that runs beside the picture; the first where there are several.
    pub fn study(&self) -> Option<Standing> {
        let transient = &self.transient;
        let studied = self.accuracy.standing().or(transient.work.standing()).or(transient.number.work.standing());
        studied.or(self.traction.full.standing())
    }

    /// Stops everything that runs; what has been found stays.
    pub fn stop_all(&mut self) {
        self.jobs.cancel_all();
        self.training.stop();
        self.accuracy.stop();
        self.transient.stop();
        self.traction.full.stop();
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
