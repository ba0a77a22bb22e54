//! What has been asked of the engine and what came of it: the picture, the truth about it, or why there is none.
//!
//! An [`Ask`] is read off the document in every frame. It is answered by the reduced model, as a rule within the frame,
//! else by the full solver in the worker; when the sliders rest, a full solution checks the reduced one. Everything here
//! belongs to an ask, and nobody but this module changes it.

mod follow;
pub mod grid_error;
pub mod jobs;
mod live;
pub mod picture;
mod receive;
mod times;

use crate::app::document::{Document, Key};
use crate::app::in_use::InUse;
use crate::app::model_source::Models;
use crate::engine::Store;
use crate::engine::job::{Job, Standing};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::{Problem, Report, Solution};
use crate::solver::reduced::{ReducedModel, ReducedOptions, Trust};
use grid_error::GridError;
use jobs::{JobKind, Jobs};
use live::Live;
use picture::{Comparison, Cuts, Origin, Picture};
use std::sync::Arc;
use std::time::Duration;
use times::Times;

/// Seconds of rest after which a verification starts by itself.
pub const REST_S: f64 = 0.25;
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
    /// Whether it was to stop: then it says nothing of the contact.
    pub stopped: bool,
}

/// Why the full solver draws the picture.
#[derive(Clone, Debug, PartialEq)]
pub enum PassedOver {
    /// There is no reduced model.
    NoModel,
    /// It is being read.
    Reading,
    /// It was not trained for this contact; a sentence says why.
    Outside(String),
    /// It did not converge; a sentence says how.
    Failed(String),
}

/// What the picture is to show, and by what means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ask {
    /// The contact.
    pub key: Key,
    /// The grid of full solutions of a point contact.
    pub plane: Option<PointGridSpec>,
    /// The truncation of the reduced model.
    pub options: ReducedOptions,
}

/// What was asked and what came of it.
pub struct Answers {
    /// Grids, solvers, models and operators.
    pub store: Store,
    /// The reduced models.
    pub models: Models,
    /// The solves that wait or run.
    pub jobs: Jobs,
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
    /// Seconds of the last reduced solves.
    pub reduced_times: Times,
    /// Seconds of the last full solves.
    pub full_times: Times,
    /// Why there is no estimate of what the grid costs, where one was asked for.
    pub no_estimate: Option<String>,
    grid_error: Option<GridError>,
    /// A model of the program on its way.
    reading: Option<Job<Arc<ReducedModel>>>,
    live: Live,
    asked: Option<Ask>,
    cuts: Cuts,
    changed_at: f64,
    verify_due: bool,
    next_pin: usize,
}

impl Ask {
    /// What a document asks for of the models there are.
    pub fn of(document: &Document, models: &Models) -> Self {
        let in_use = in_use(document, models);
        Self {
            key: document.key(),
            plane: document.chosen_plane(),
            options: in_use.map_or_else(ReducedOptions::default, |model| model.options_at(&document.point)),
        }
    }
}

fn in_use(document: &Document, models: &Models) -> Option<InUse> {
    let model = models.of(&document.point, &document.lubricant)?;
    Some(InUse::new(model, &document.view))
}

impl Answers {
    /// Nothing asked yet.
    pub fn new(models: Models, store: Store) -> Self {
        Self {
            jobs: Jobs::new(&store),
            live: Live::new(&store),
            store,
            models,
            picture: None,
            full: None,
            last_report: None,
            comparison: None,
            failure: None,
            verify_failure: None,
            passed_over: None,
            pins: Vec::new(),
            reduced_times: Times::default(),
            full_times: Times::default(),
            no_estimate: None,
            grid_error: None,
            reading: None,
            asked: None,
            cuts: Cuts::default(),
            changed_at: 0.0,
            verify_due: false,
            next_pin: 1,
        }
    }

    /// Whether the present document has been answered by [`Self::refresh`].
    pub fn is_answer_to(&self, document: &Document) -> bool {
        self.asked == Some(Ask::of(document, &self.models))
    }

    /// The contact that was asked for last.
    pub fn key(&self) -> Option<Key> {
        self.asked.map(|ask| ask.key)
    }

    fn plane(&self) -> Option<PointGridSpec> {
        self.asked.and_then(|ask| ask.plane)
    }

    /// The reduced model that serves a document's contact.
    pub fn model(&self, document: &Document) -> Option<&Arc<ReducedModel>> {
        self.models.of(&document.point, &document.lubricant)
    }

    /// The same with the document's truncation.
    pub fn in_use(&self, document: &Document) -> Option<InUse> {
        in_use(document, &self.models)
    }

    /// The truncation a document asks for, in the window that serves it.
    pub fn options(&self, document: &Document) -> ReducedOptions {
        Ask::of(document, &self.models).options
    }

    /// Whether the model was trained for a document's contact.
    pub fn trust(&self, document: &Document) -> Option<Trust> {
        let problem = Problem::new(&document.point, document.lubricant).ok()?;
        self.model(document).map(|model| model.trust(&problem))
    }

    /// Whether the picture is a full solution on another grid than the one that was chosen, and will be replaced by one
    /// on that.
    pub fn is_quick(&self) -> bool {
        let on = |picture: &Picture, plane: PointGridSpec| picture.solution.mesh.plane() == Some(plane);
        matches!((&self.picture, self.plane()), (Some(picture), Some(plane))
            if picture.origin == Origin::Full && !on(picture, plane))
    }

    fn is_of_the_ask(&self, picture: Option<&Picture>) -> bool {
        picture.is_some_and(|picture| Some(picture.key) == self.key())
    }

    /// Whether the picture belongs to the sliders.
    pub fn picture_is_current(&self) -> bool {
        self.is_of_the_ask(self.picture.as_ref())
    }

    /// The picture, where it belongs to the sliders.
    pub fn current_picture(&self) -> Option<&Picture> {
        self.picture.as_ref().filter(|_| self.picture_is_current())
    }

    /// Whether the contact of the sliders is being solved, for its picture or for the truth about it.
    pub fn busy(&self) -> bool {
        self.coming() || [JobKind::Refine, JobKind::Verify].into_iter().any(|kind| self.jobs.busy(kind))
    }

    /// Whether a picture is on its way.
    pub fn coming(&self) -> bool {
        self.live.busy() || self.jobs.busy(JobKind::Live)
    }

    /// How far the reduced solve for the picture is.
    pub fn standing(&self) -> Option<Standing> {
        self.live.standing()
    }

    /// Stops all solves.
    pub fn cancel_all(&self) {
        self.live.stop();
        self.jobs.cancel_all();
    }

    /// Lets a frame wait for the reduced model for so long, instead of a tenth of a second.
    pub fn be_patient(&mut self, patience: Duration) {
        self.live.be_patient(patience);
    }

    /// Whether the full solution belongs to the sliders.
    pub fn full_is_current(&self) -> bool {
        self.is_of_the_ask(self.full.as_ref())
    }

    /// Whether the reduced model draws the picture of a contact.
    fn is_reduced(&self, key: &Key) -> bool {
        let of_it = |picture: &Picture| picture.key == *key && picture.origin != Origin::Full;
        self.passed_over.is_none() && self.picture.as_ref().is_some_and(of_it)
    }

    /// Whether the full solution of a contact lies on another grid than its reduced picture. It came while the model was
    /// being read, and is not the truth about it.
    fn is_of_another_grid(&self, key: &Key, full: &Solution) -> bool {
        self.is_reduced(key) && self.picture.as_ref().is_some_and(|picture| !picture.shares_grid(full))
    }

    /// What the grid costs, where that was estimated for the sliders and the chosen grid.
    pub fn grid_error(&self) -> Option<&GridError> {
        let (mesh, key) = (self.full.as_ref().map(|full| full.solution.mesh), self.key()?);
        self.grid_error.as_ref().filter(|error| error.key.has_film_of(&key) && Some(error.mesh) == mesh)
    }

    /// Whether a grid error can be estimated: of a full solution on the chosen grid of a point contact.
    pub fn can_estimate(&self) -> bool {
        self.full_is_current() && !self.is_quick()
    }

    /// Seconds since the ask last changed, as of `now`.
    pub fn rested_s(&self, now: f64) -> f64 {
        now - self.changed_at
    }

    /// Puts a reduced model in use and returns the one it replaces: the picture and everything drawn of the model
    /// follow.
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
        self.live.forget();
        self.comparison = None;
        self.asked = None;
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
}
