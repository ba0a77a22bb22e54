//! Everything the window knows, and how a change of the document becomes a picture and its verification.

use super::controls::Entries;
use super::document::{Document, History};
use super::files::Files;
use super::in_use::InUse;
use super::jobs::{GridChoice, JobKind, Jobs, Key, Outcome, Request, Running};
use super::picture::{Comparison, Origin, Picture};
use super::plots::{accuracy::AccuracyView, basis::BasisView, regimes::RegimeChart};
use super::training::Training;
use crate::solver::full::{Problem, Report};
use crate::solver::grid::GridSpec;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, Trust};
use egui::Context;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use std::time::Instant;

/// Seconds of rest after which a verification starts by itself.
pub const REST_S: f64 = 0.25;
/// Seconds between two writes of the session.
pub const AUTO_SAVE_S: u64 = 10;
/// Curves that can be pinned at once.
pub const MOST_PINS: usize = 8;

/// How things are shown; not part of the document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Display {
    /// Draw the full solution over the reduced one.
    pub overlay: bool,
    /// Draw the difference below.
    pub difference: bool,
    /// Theme wanted.
    pub theme: egui::ThemePreference,
    /// Size of everything.
    pub zoom: f32,
}

impl Default for Display {
    fn default() -> Self {
        Self { overlay: false, difference: false, theme: egui::ThemePreference::System, zoom: 1.0 }
    }
}

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
    /// The reduced model.
    pub model: Option<Arc<ReducedModel>>,
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
    /// State of the Reduced basis tab.
    pub basis: BasisView,
    /// The studies of the Accuracy tab.
    pub accuracy: AccuracyView,
    /// Trainings.
    pub training: Training,
    /// What the Regimes tab keeps between frames.
    pub regimes: RegimeChart,
    /// Plots are to be fitted to their data in this frame.
    pub fit_plots: bool,
    wanted: Option<Key>,
    wanted_options: Option<ReducedOptions>,
    changed_at: f64,
    verify_due: bool,
    next_pin: usize,
}

impl State {
    /// A window on a document.
    pub fn new(document: Document, model: Option<Arc<ReducedModel>>) -> Self {
        let mut history = History::default();
        history.restart(&document);
        Self {
            files: Files::new(&document),
            document,
            history,
            display: Display::default(),
            jobs: Jobs::default(),
            entries: Entries::default(),
            model,
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
            basis: BasisView::default(),
            accuracy: AccuracyView::default(),
            training: Training::default(),
            regimes: RegimeChart::default(),
            fit_plots: true,
            wanted: None,
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
        self.wanted == Some(self.key()) && self.wanted_options == Some(self.reduced_options())
    }

    /// Whether the picture belongs to the sliders.
    pub fn picture_is_current(&self) -> bool {
        self.picture.as_ref().is_some_and(|p| p.key == self.key())
    }

    /// Whether the picture should be drawn grey: not the sliders', and not about to be replaced.
    pub fn picture_is_stale(&self, now: f64) -> bool {
        !self.picture_is_current() && (self.failure.is_some() || now - self.changed_at > REST_S)
    }

    /// Whether the full solution belongs to the sliders.
    pub fn full_is_current(&self) -> bool {
        self.full.as_ref().is_some_and(|p| p.key == self.key())
    }

    /// Puts a reduced model in use, or none: the picture and everything drawn of the model follow.
    pub fn use_model(&mut self, model: Option<Arc<ReducedModel>>) {
        self.model = model;
        self.online = None;
        self.regimes = RegimeChart::default();
        self.comparison = None;
        self.wanted = None;
    }

    /// Whether the model was trained for the sliders.
    pub fn trust(&self) -> Option<Trust> {
        let problem = Problem::new(&self.document.point, self.document.lubricant).ok()?;
        self.model.as_ref().map(|m| m.trust(&problem))
    }

    /// The truncation the document asks for, in the window that serves it.
    pub fn reduced_options(&self) -> ReducedOptions {
        let moes = self.document.point.moes();
        self.in_use().map_or_else(ReducedOptions::default, |model| model.options_at(moes))
    }

    /// The reduced model with the document's truncation.
    pub fn in_use(&self) -> Option<InUse> {
        self.model.as_ref().map(|model| InUse::new(model, &self.document.view))
    }

    /// Seconds since the document last changed, as of `now`.
    pub fn rested_s(&self, now: f64) -> f64 {
        now - self.changed_at
    }

    /// Answers finished jobs. Called first in every frame.
    pub fn receive(&mut self) {
        self.accuracy.receive();
        for (job, outcome) in self.jobs.poll() {
            match job.kind {
                JobKind::Live => self.receive_live(&job, outcome),
                JobKind::Verify => self.receive_verification(&job, outcome),
            }
        }
    }

    fn receive_live(&mut self, job: &Running, outcome: Outcome) {
        match outcome {
            Outcome::Solved(solution, wall_s) if solution.converged() => {
                self.full_wall_s = Some(wall_s);
                self.last_report = Some((job.key, solution.report.clone()));
                if job.key == self.key() {
                    self.failure = None;
                } else if self.picture_is_current() {
                    // The sliders have moved back to where the reduced model answers at once: this solution comes too late.
                    return;
                }
                let picture = Picture::new(job.key, Origin::Full, Arc::from(solution));
                self.full = Some(picture.clone());
                self.picture = Some(picture);
                self.comparison = None;
            }
            other => {
                if job.key == self.key() {
                    self.failure = Some(failure_of(job.key, other, &mut self.last_report));
                }
            }
        }
    }

    fn receive_verification(&mut self, job: &Running, outcome: Outcome) {
        match outcome {
            Outcome::Solved(solution, wall_s) if solution.converged() => {
                self.full_wall_s = Some(wall_s);
                self.last_report = Some((job.key, solution.report.clone()));
                self.full = Some(Picture::new(job.key, Origin::Full, Arc::from(solution)));
                self.verify_failure = None;
                self.compare();
            }
            other => {
                let cancelled_by_change = job.key != self.key();
                if !cancelled_by_change {
                    self.verify_failure = Some(failure_of(job.key, other, &mut self.last_report));
                }
            }
        }
    }

    fn compare(&mut self) {
        self.comparison = match (&self.picture, &self.full) {
            (Some(picture), Some(full)) if picture.key == full.key && picture.origin != Origin::Full => {
                Some(Comparison::new(picture, full))
            }
            _ => None,
        };
    }

    /// Answers a changed document: at once by the reduced model, else by the full solver in the worker. Called after the panels.
    pub fn refresh(&mut self, ctx: &Context) {
        let (key, options) = (self.key(), self.reduced_options());
        if self.wanted == Some(key) && self.wanted_options == Some(options) {
            return;
        }
        let moved = self.wanted != Some(key);
        self.wanted = Some(key);
        self.wanted_options = Some(options);
        self.changed_at = ctx.input(|i| i.time);
        if moved {
            self.failure = None;
            self.verify_failure = None;
        }
        if self.refresh_reduced(key, options) {
            self.compare();
            self.verify_due = !self.full_is_current();
            if self.verify_due {
                ctx.request_repaint_after_secs(REST_S as f32);
            }
        } else {
            self.verify_due = false;
            self.comparison = None;
            if self.picture.as_ref().is_none_or(|p| p.key != key || p.origin != Origin::Full) {
                self.submit(ctx, JobKind::Live);
            }
        }
    }

    /// Tries the reduced model; `false` when the full solver has to take over.
    fn refresh_reduced(&mut self, key: Key, options: ReducedOptions) -> bool {
        self.passed_over = match self.trust() {
            None => Some(PassedOver::NoModel),
            Some(Trust::Outside(why)) => Some(PassedOver::Outside(why)),
            Some(Trust::Trained) => None,
        };
        let (None, Some(model)) = (&self.passed_over, &self.model) else { return false };
        if self.online.as_ref().is_none_or(|o| *o.options() != options || !Arc::ptr_eq(&o.model, model)) {
            let first = self.online.is_none();
            let mut online = Online::new(Arc::clone(model), options);
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
                self.picture = Some(Picture::new(key, origin, Arc::new(fields)));
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
        let moes = key.point.moes();
        let window = self.model.as_ref().and_then(|m| m.windows.get(m.window_for(moes)));
        let grid = match window.and_then(|window| window.grid.line()) {
            Some(grid) => GridChoice::Existing(Arc::clone(grid)),
            None => GridChoice::Spec(GridSpec::EXPLORER),
        };
        let start = match kind {
            JobKind::Live => self.picture.as_ref().map(|p| Arc::clone(&p.solution)),
            // The truth must not depend on what it checks.
            JobKind::Verify => None,
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
                if !self.full_is_current() {
                    self.submit(ctx, JobKind::Verify);
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
        self.entries = Entries::default();
        self.training.refused = None;
    }
}

fn failure_of(key: Key, outcome: Outcome, last_report: &mut Option<(Key, Report)>) -> Failure {
    match outcome {
        Outcome::Failed(message) => Failure { key, message, report: None },
        Outcome::Solved(solution, _) => {
            let report = solution.report.clone();
            *last_report = Some((key, report.clone()));
            let message = format!("The full solve {}", report.termination.describe());
            Failure { key, message, report: Some(report) }
        }
    }
}
