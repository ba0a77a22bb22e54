//! State machine of the answers: the present request, its results, and the effect of events on them.

use super::ask::{Ask, quick};
use super::event::{Event, Wish};
use super::failure::{Failure, PassedOver};
use super::grid_error::GridError;
use super::jobs::{JobKind, Outcome};
use super::picture::{Comparison, Cuts, Origin, Picture};
use super::pins::{Pin, Pins};
use super::times::Times;
use super::work::Work;
use crate::app::document::Key;
use crate::app::model_source::Models;
use crate::engine::{Answer, Store};
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::full::{Report, Solution, Termination};
use std::sync::Arc;

/// Present request and its results.
pub struct Answers {
    pub(super) work: Work,
    asked: Option<Ask>,
    /// Time of the last change of the request \[s\].
    changed_at: f64,
    /// True if a full solution is due when the sliders are idle.
    full_due: bool,
    /// Time at which the picture last was that of the sliders \[s\].
    current_at: f64,
    /// True if the picture is late, but follows the sliders so closely that nobody sees the delay.
    late: bool,
    /// Grid of full solutions of the present line contact.
    line: Option<GridSpec>,
    cuts: Cuts,
    /// Last valid picture.
    picture: Option<Picture>,
    /// Last converged full solution.
    full: Option<Picture>,
    /// Difference between picture and full solution, if both belong to the same contact.
    comparison: Option<Comparison>,
    /// Report of the last full solve, converged or not, with its contact.
    last_report: Option<(Key, Report)>,
    failure: Option<Failure>,
    verify_failure: Option<Failure>,
    passed_over: Option<PassedOver>,
    grid_error: Option<GridError>,
    no_estimate: Option<String>,
    reduced_times: Times,
    full_times: Times,
    pins: Pins,
}

impl Answers {
    /// Creates the answers without a request.
    pub fn new(models: Models, store: Store) -> Self {
        Self {
            work: Work::new(models, store),
            asked: None,
            changed_at: 0.0,
            full_due: false,
            current_at: f64::NEG_INFINITY,
            late: false,
            line: None,
            cuts: Cuts::default(),
            picture: None,
            full: None,
            comparison: None,
            last_report: None,
            failure: None,
            verify_failure: None,
            passed_over: None,
            grid_error: None,
            no_estimate: None,
            reduced_times: Times::default(),
            full_times: Times::default(),
            pins: Pins::default(),
        }
    }

    /// Processes an event. Returns the computation that is needed next.
    pub(super) fn on(&mut self, event: Event) -> Option<Wish> {
        match event {
            Event::Asked(ask, passed_over, now) => return self.ask(ask, passed_over, now),
            Event::LineGrid(grid) => self.line = grid,
            Event::Reduced(ask, answer) => self.reduced(ask, *answer),
            Event::ReducedStopped(ask) if self.asked == Some(ask) => {
                let message = "The reduced solve was cancelled".to_owned();
                self.failure = Some(Failure { key: ask.key, message, report: None, stopped: true });
            }
            Event::ReducedFailed(ask, why) if self.asked == Some(ask) => {
                self.passed_over = Some(PassedOver::Failed(why));
                return self.full_follows(&ask);
            }
            Event::ReducedStopped(_) | Event::ReducedFailed(..) => {}
            Event::Full(kind, key, outcome) => {
                // A change of the sliding does not change the film thickness of a lubricant without shear-thinning.
                let key = self.key().filter(|present| key.has_film_of(present)).unwrap_or(key);
                match kind {
                    JobKind::Live => self.live(key, outcome),
                    JobKind::Verify | JobKind::Refine => self.verified(key, outcome),
                    JobKind::Estimate => self.estimated(key, outcome),
                }
            }
            Event::Cut(cuts) => self.cut(cuts),
            Event::Rested => return self.rested(),
            Event::VerificationAsked => {
                self.full_due = false;
                self.verify_failure = None;
                return Some(Wish::Full(JobKind::Verify));
            }
            Event::EstimateAsked => self.no_estimate = None,
            Event::ModelsChanged => (self.comparison, self.asked) = (None, None),
        }
        None
    }

    fn ask(&mut self, ask: Ask, passed_over: Option<PassedOver>, now: f64) -> Option<Wish> {
        let former = self.asked.replace(ask);
        let key = ask.key;
        let drawn = former.is_some_and(|former| self.picture.as_ref().is_some_and(|p| p.key == former.key));
        let same_means = former.is_some_and(|former| ask.has_means_of(&former));
        // The solve times are valid for one kind of contact and one method only.
        if !same_means || former.is_some_and(|former| former.key.point.kind != key.point.kind) {
            self.reduced_times.clear();
            self.full_times.clear();
        }
        self.changed_at = now;
        if former.is_none_or(|former| former.key != key) {
            self.failure = None;
            self.verify_failure = None;
            self.no_estimate = None;
            self.slide(key);
            // The screen already shows the same film thickness by the same method. Keep it and its checks.
            if drawn && same_means && self.picture_is_current() && passed_over == self.passed_over {
                self.compare();
                return None;
            }
        }
        self.full_due = false;
        self.passed_over = passed_over;
        if self.passed_over.is_none() { Some(Wish::Reduced) } else { self.full_follows(&ask) }
    }

    /// Assigns the pictures to a contact with the same film thickness, which needs no other solve.
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

    fn reduced(&mut self, ask: Ask, answer: Answer) {
        let present = self.asked == Some(ask);
        self.reduced_times.add(answer.result.wall_s);
        if present || !self.picture_is_current() {
            self.picture = Picture::of(ask.key, answer, self.cuts);
            let strange = |full: &Picture| full.key == ask.key && self.is_of_another_grid(&ask.key, &full.solution);
            if self.full.as_ref().is_some_and(strange) {
                self.full = None;
            }
            self.compare();
        }
        if present {
            self.full_due = !self.full_is_current();
        }
    }

    /// Requests a full solve, because no reduced model draws the picture.
    fn full_follows(&mut self, ask: &Ask) -> Option<Wish> {
        let key = ask.key;
        self.comparison = None;
        let elsewhere = |p: &Picture| self.line.is_some_and(|grid| p.solution.mesh.spec != grid);
        let live = self.picture.as_ref().is_none_or(|p| p.key != key || p.origin != Origin::Full || elsewhere(p));
        // While a slider moves, a quick grid is used. The chosen grid is used when the slider is idle.
        let finer = ask.plane.is_some_and(|plane| !live || plane != quick(plane));
        self.full_due = finer && !self.is_settled(&key);
        live.then_some(Wish::Full(JobKind::Live))
    }

    fn rested(&mut self) -> Option<Wish> {
        self.full_due = false;
        let key = self.key()?;
        let kind = match self.passed_over {
            None => (!self.full_is_current()).then_some(JobKind::Verify),
            Some(_) => (!self.is_settled(&key)).then_some(JobKind::Refine),
        };
        kind.map(Wish::Full)
    }

    /// Stores time and report of a converged full solution.
    fn solved(&mut self, key: Key, answer: &Answer) {
        self.full_times.add(answer.result.wall_s);
        self.last_report = report_of(key, answer);
    }

    /// Stores the report of a full solve that has ended without a solution, and returns the failure.
    fn failed(&mut self, key: Key, outcome: Outcome) -> Failure {
        match outcome {
            Outcome::Failed(message) => Failure { key, message, report: None, stopped: false },
            Outcome::Solved(answer) => {
                self.last_report = report_of(key, &answer);
                let report = self.last_report.as_ref().map(|(_, report)| report.clone());
                let termination = report.as_ref().map_or(Termination::Diverged, |report| report.termination);
                let message = format!("The full solve {}", termination.describe());
                Failure { key, message, report, stopped: termination == Termination::Cancelled }
            }
        }
    }

    fn live(&mut self, key: Key, outcome: Outcome) {
        let (present, drawn) = (Some(key) == self.key(), self.is_reduced(&key));
        let answer = match outcome {
            Outcome::Solved(answer) if answer.result.converged => answer,
            other if present && !drawn => return self.failure = Some(self.failed(key, other)),
            _ => return,
        };
        self.solved(key, &answer);
        if present {
            self.failure = None;
        }
        // Not needed if the sliders have moved back to a contact that the reduced model has solved.
        let late = !present && self.picture_is_current();
        // Also not needed if the model has been read in the meantime, or if the chosen grid has finished before the
        // quick one.
        if late || drawn || self.is_settled(&key) {
            return;
        }
        self.full = Picture::of(key, *answer, self.cuts);
        self.picture.clone_from(&self.full);
        self.comparison = None;
    }

    fn verified(&mut self, key: Key, outcome: Outcome) {
        let present = Some(key) == self.key();
        let answer = match outcome {
            Outcome::Solved(answer) if answer.result.converged => answer,
            // A change of the request cancels the solve, which is not a failure.
            other if present => return self.verify_failure = Some(self.failed(key, other)),
            _ => return,
        };
        self.solved(key, &answer);
        let reduced = self.is_reduced(&key);
        let Some(full) = Picture::of(key, *answer, self.cuts) else { return };
        // Ignore it if the model has been read in the meantime (its own check follows), or if the grid is no longer
        // the chosen one.
        let another = self.is_of_another_grid(&key, &full.solution);
        if another || !reduced && self.plane().is_some_and(|plane| full.solution.mesh.plane() != Some(plane)) {
            return;
        }
        if present && self.plane().is_some() && !reduced {
            self.failure = None;
            self.picture = Some(full.clone());
        }
        self.full = Some(full);
        self.verify_failure = None;
        self.compare();
    }

    fn estimated(&mut self, key: Key, outcome: Outcome) {
        if Some(key) != self.key() {
            return;
        }
        match outcome {
            Outcome::Solved(second) if second.result.converged => {
                match self.full.as_ref().and_then(|full| GridError::of(full, second.fields()?)) {
                    Some(error) => self.grid_error = Some(error),
                    None => self.no_estimate = Some("the contact or its grid has changed meanwhile".to_owned()),
                }
            }
            other => self.no_estimate = Some(self.failed(key, other).message),
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

    fn cut(&mut self, cuts: Cuts) {
        self.cuts = cuts;
        self.picture.iter_mut().chain(&mut self.full).for_each(|picture| picture.cut(cuts));
        self.pins.cut(cuts);
        if self.comparison.as_ref().is_some_and(|c| c.cuts != cuts) {
            self.compare();
        }
    }

    /// Keeps the live curve for comparison.
    pub fn pin(&mut self) {
        if let Some(picture) = &self.picture {
            self.pins.add(picture);
        }
    }

    /// Pins the live curve in place of the last pinned one, whose contact it returns. `None` if one of them is missing.
    pub fn swap_pin(&mut self) -> Option<Key> {
        self.pins.swap(self.picture.as_ref()?)
    }

    /// Removes a pinned curve by its index.
    pub fn unpin(&mut self, place: usize) {
        self.pins.remove(place);
    }

    /// Removes all pinned curves.
    pub fn unpin_all(&mut self) {
        self.pins.clear();
    }

    /// Returns the pinned curves, the oldest first.
    pub fn pins(&self) -> &[Pin] {
        self.pins.all()
    }

    /// Returns the last request.
    pub fn asked(&self) -> Option<Ask> {
        self.asked
    }

    /// Returns the contact of the last request.
    pub fn key(&self) -> Option<Key> {
        self.asked.map(|ask| ask.key)
    }

    fn plane(&self) -> Option<PointGridSpec> {
        self.asked.and_then(|ask| ask.plane)
    }

    /// Returns the seconds since the request last changed, as of `now`.
    pub fn rested_s(&self, now: f64) -> f64 {
        now - self.changed_at
    }

    /// Returns true if a full solution is due when the sliders are idle.
    pub(super) fn full_is_due(&self) -> bool {
        self.full_due
    }

    /// Returns the last valid picture, whatever the present request.
    pub fn picture(&self) -> Option<&Picture> {
        self.picture.as_ref()
    }

    /// Returns the picture if it belongs to the sliders.
    pub fn current_picture(&self) -> Option<&Picture> {
        self.picture.as_ref().filter(|_| self.picture_is_current())
    }

    /// Determines whether the picture is drawn as that of the sliders. It may be late by `delay` while a reduced solve
    /// runs. `asked_at` is the time of the request of a picture that has just arrived. Returns the rest of the delay \[s\]
    /// if the picture is late.
    pub(super) fn lag(&mut self, asked_at: Option<f64>, now: f64, delay: f64) -> Option<f64> {
        let current = self.picture_is_current();
        self.current_at = if current { now } else { asked_at.unwrap_or(self.current_at) };
        let kind = |key: &Key| key.point.kind;
        let alike = self.picture.as_ref().map(|picture| kind(&picture.key)) == self.key().as_ref().map(kind);
        let left = self.current_at + delay - now;
        self.late = !current && alike && self.passed_over.is_none() && self.failure.is_none() && left > 0.0;
        self.late.then_some(left)
    }

    /// Returns true if the picture is drawn as that of the sliders: it is, or it follows them so closely that nobody
    /// sees the delay.
    pub fn picture_follows(&self) -> bool {
        self.late || self.picture_is_current()
    }

    /// Returns the picture if it is drawn as that of the sliders.
    pub fn shown_picture(&self) -> Option<&Picture> {
        self.picture.as_ref().filter(|_| self.picture_follows())
    }

    /// Returns true if a contact is that of a picture that is drawn as that of the sliders.
    pub fn shows(&self, key: &Key) -> bool {
        self.shown_picture().is_some_and(|picture| picture.key == *key)
    }

    /// Returns the last converged full solution, whatever the present request.
    pub fn full(&self) -> Option<&Picture> {
        self.full.as_ref()
    }

    /// Returns the difference between the picture and the full solution of its contact, if there is one.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_ref()
    }

    /// Returns the reason why there is no picture for the sliders.
    pub fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// Returns the reason why the verification has no result.
    pub fn verify_failure(&self) -> Option<&Failure> {
        self.verify_failure.as_ref()
    }

    /// Returns the reason why the reduced model does not draw the picture.
    pub fn passed_over(&self) -> Option<&PassedOver> {
        self.passed_over.as_ref()
    }

    /// Returns the report of the last full solve, converged or not, and its contact.
    pub fn last_report(&self) -> Option<&(Key, Report)> {
        self.last_report.as_ref()
    }

    /// Returns the times of the last reduced solves.
    pub fn reduced_times(&self) -> &Times {
        &self.reduced_times
    }

    /// Returns the times of the last full solves.
    pub fn full_times(&self) -> &Times {
        &self.full_times
    }

    /// Returns the discretisation error if it was estimated for the sliders and the chosen grid.
    pub fn grid_error(&self) -> Option<&GridError> {
        let (mesh, key) = (self.full.as_ref().map(|full| full.solution.mesh), self.key()?);
        self.grid_error.as_ref().filter(|error| error.key.has_film_of(&key) && Some(error.mesh) == mesh)
    }

    /// Returns the reason why a requested estimate of the discretisation error is missing.
    pub fn no_estimate(&self) -> Option<&str> {
        self.no_estimate.as_deref()
    }

    /// Returns true if a discretisation error can be estimated. This needs a full solution on the chosen grid.
    pub fn can_estimate(&self) -> bool {
        self.full_is_current() && !self.is_quick()
    }

    /// Returns true if the picture is a full solution on a quick grid that the chosen grid will replace.
    pub fn is_quick(&self) -> bool {
        let on = |picture: &Picture, plane: PointGridSpec| picture.solution.mesh.plane() == Some(plane);
        matches!((&self.picture, self.plane()), (Some(picture), Some(plane))
            if picture.origin == Origin::Full && !on(picture, plane))
    }

    /// Returns a description of the method for the heads of tables.
    pub fn means(&self) -> String {
        let sketch = if self.is_quick() { "sketch on a quick grid; " } else { "" };
        self.picture.as_ref().map_or_else(String::new, |picture| format!("{sketch}{}", picture.means()))
    }

    /// Returns true if the picture belongs to the sliders.
    pub fn picture_is_current(&self) -> bool {
        self.picture.as_ref().is_some_and(|picture| Some(picture.key) == self.key())
    }

    /// Returns true if the full solution belongs to the sliders.
    pub fn full_is_current(&self) -> bool {
        self.full.as_ref().is_some_and(|full| Some(full.key) == self.key())
    }

    /// Returns true if the reduced model draws the picture of a contact.
    fn is_reduced(&self, key: &Key) -> bool {
        let of_it = |picture: &Picture| picture.key == *key && picture.origin != Origin::Full;
        self.passed_over.is_none() && self.picture.as_ref().is_some_and(of_it)
    }

    /// Returns true if a full solution uses another grid than the reduced picture of its contact. Such a solution
    /// arrived while the model was being read and does not check the picture.
    fn is_of_another_grid(&self, key: &Key, full: &Solution) -> bool {
        self.is_reduced(key) && self.picture.as_ref().is_some_and(|picture| !picture.shares_grid(full))
    }

    /// Returns true if there is a full solution of a contact on the chosen grid.
    fn is_settled(&self, key: &Key) -> bool {
        let on_plane = |full: &Picture| self.plane().is_none_or(|plane| full.solution.mesh.plane() == Some(plane));
        self.plane().is_some() && self.full.as_ref().is_some_and(|full| full.key == *key && on_plane(full))
    }
}

/// Returns the report of a full solve with its contact.
fn report_of(key: Key, answer: &Answer) -> Option<(Key, Report)> {
    Some((key, answer.solution.as_ref()?.report.clone()))
}
