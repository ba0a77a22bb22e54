//! Updates of the answers after a change of the document. The reduced model usually returns the picture within the
//! frame; otherwise the full solver computes it in a worker. When the sliders are idle, a full solution checks the
//! picture.

use super::ask::{Ask, REST_S, quick};
use super::event::{Event, Wish};
use super::failure::PassedOver;
use super::jobs::{FullSolve, GridChoice, JobKind, Running};
use super::live::{AT_ONCE, Unanswered};
use super::picture::Cuts;
use super::state::Answers;
use crate::app::document::Document;
use crate::app::in_use::InUse;
use crate::app::model_source::Models;
use crate::app::wake::wake;
use crate::engine::Store;
use crate::engine::job::Standing;
use crate::host::worker;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::Problem;
use crate::solver::full::point::second_grid;
use crate::solver::reduced::{Domain, ReducedModel, ReducedOptions, Trust};
use egui::Context;
use std::sync::Arc;
use std::time::Duration;

impl Answers {
    /// Receives models that have been read and solves that have ended. Call first in every frame.
    pub fn receive(&mut self) {
        self.receive_model();
        for (job, outcome) in self.work.jobs.poll() {
            self.on(Event::Full(job.kind, job.key, outcome));
        }
    }

    /// Recomputes the picture after a change of the document. Uses the reduced model within the frame; if none
    /// covers the contact, starts a full solve in the worker. Call once per frame, after the panels.
    pub fn refresh(&mut self, ctx: &Context, document: &Document) {
        if self.work.reading.is_none()
            && let Some(name) = self.work.models.late_for(&document.point, &document.lubricant)
        {
            self.read(ctx, name);
        }
        let ask = Ask::of(document, &self.work.models);
        if self.asked() != Some(ask) {
            let line = document.chosen_plane().is_none();
            let grid = line.then(|| {
                GridChoice::of(
                    self.model(document).map(Arc::as_ref),
                    None,
                    &document.lubricant.grid_contact(&document.point),
                )
                .spec()
            });
            self.on(Event::LineGrid(grid));
            self.follow(ctx, document, Event::Asked(ask, self.untried(document), ctx.input(|i| i.time)));
        }
        let (now, mut came) = (ctx.input(|i| i.time), false);
        for (ask, answer) in self.work.live.poll() {
            came |= answer.is_ok();
            let event = match answer {
                Ok(answer) => Event::Reduced(ask, answer),
                Err(Unanswered::Stopped) => Event::ReducedStopped(ask),
                Err(Unanswered::Failed(why)) => Event::ReducedFailed(ask, why),
            };
            self.follow(ctx, document, event);
        }
        let asked_at = came.then(|| now - self.work.live.waited_s());
        // With threads, the frame itself has waited.
        let delay = if worker::THREADS { 0.0 } else { AT_ONCE.as_secs_f64() };
        if let Some(left) = self.lag(asked_at, now, delay) {
            ctx.request_repaint_after_secs(left as f32);
        }
    }

    /// Starts the full solution when the sliders are idle. Call last in every frame.
    pub fn settle(&mut self, ctx: &Context, document: &Document) {
        if !self.full_is_due() {
            return;
        }
        let rest = self.rested_s(ctx.input(|i| i.time));
        if rest < REST_S {
            ctx.request_repaint_after_secs((REST_S - rest) as f32);
        } else {
            self.follow(ctx, document, Event::Rested);
        }
    }

    /// Starts a full solve now, even if there is a full solution already.
    pub fn verify(&mut self, ctx: &Context, document: &Document) {
        self.follow(ctx, document, Event::VerificationAsked);
    }

    /// Estimates the discretisation error by a full solve on a second grid.
    pub fn estimate_grid_error(&mut self, ctx: &Context) {
        self.on(Event::EstimateAsked);
        let Some(full) = self.full().filter(|_| self.full_is_current()) else { return };
        let Some(spec) = full.solution.mesh.plane() else { return };
        let (key, start) = (full.key, Some(Arc::clone(&full.solution)));
        let grid = GridChoice::Spec(GridSpec::Plane(second_grid(spec)));
        self.work.jobs.submit(ctx, FullSolve { kind: JobKind::Estimate, key, grid, start });
    }

    /// Moves the cuts of all point contacts. Call before the plots.
    pub fn follow_cuts(&mut self, cuts: Cuts) {
        self.on(Event::Cut(cuts));
    }

    /// Processes an event and starts the computation that it requires.
    fn follow(&mut self, ctx: &Context, document: &Document, event: Event) {
        match self.on(event) {
            None => {}
            Some(Wish::Full(kind)) => self.submit(ctx, document, kind),
            Some(Wish::Reduced) => {
                if let (Some(ask), Some(model)) = (self.asked(), self.model(document).cloned()) {
                    self.work.live.submit(ctx, ask, model);
                }
            }
        }
    }

    fn submit(&mut self, ctx: &Context, document: &Document, kind: JobKind) {
        let key = document.key();
        // A line contact is always solved on the model's grid. A point contact uses the model's grid inside the
        // trained range, and the chosen grid elsewhere.
        let chosen = document.chosen_plane();
        let own = self.passed_over().is_none() || chosen.is_none();
        let plane = chosen.map(|plane| if kind == JobKind::Live { quick(plane) } else { plane });
        let model = self.model(document).filter(|_| own).map(Arc::as_ref);
        let grid = GridChoice::of(model, plane, &key.lubricant.grid_contact(&key.point));
        // A final solution must depend on its request alone. A sketch is soon replaced and may therefore start from
        // the picture.
        let sketch = kind == JobKind::Live && plane != chosen;
        let start = self.picture().filter(|_| sketch).map(|picture| Arc::clone(&picture.solution));
        self.work.jobs.submit(ctx, FullSolve { kind, key, grid, start });
    }

    /// Returns the reason why the reduced model is not even tried. `None` if it is tried.
    fn untried(&self, document: &Document) -> Option<PassedOver> {
        let kind = |domain: &Domain| (domain.heats(), domain.is_rough());
        let asked = (document.lubricant.heat.is_some(), document.lubricant.is_rough());
        let own = |model: &Arc<ReducedModel>| model.is_of(&document.point) && kind(&model.domain) == asked;
        let shapes = self.model(document).is_some_and(own);
        match self.trust(document) {
            _ if self.work.reading.is_some() && !shapes => Some(PassedOver::Reading),
            None => Some(PassedOver::NoModel),
            Some(Trust::Outside(why)) => Some(PassedOver::Outside(why.to_string())),
            Some(Trust::Trained) => None,
        }
    }

    /// Starts to read a built-in model. The full solver draws the pictures until the model is available.
    fn read(&mut self, ctx: &Context, name: &'static str) {
        self.work.reading = Some(self.work.store.read(name, wake(ctx)));
    }

    /// Puts the model in use that has been read.
    fn receive_model(&mut self) {
        let Some(job) = &mut self.work.reading else { return };
        // The model may arrive before the message that the job has ended.
        let mut read = None;
        let ended = job.poll(|model| read = Some(model)).is_some();
        if read.is_none() && !ended {
            return;
        }
        // A model that the user has put in use in the meantime stays. If the built-in file is damaged, there is no
        // model.
        self.work.reading = None;
        match read {
            Some(model) if !self.work.models.serves(&model) => _ = self.use_model(model),
            _ => self.models_have_changed(),
        }
    }

    /// Puts a reduced model in use and returns the one that it replaces. The picture and all views of the model are
    /// updated.
    pub fn use_model(&mut self, model: Arc<ReducedModel>) -> Option<Arc<ReducedModel>> {
        let former = self.work.models.put(model);
        self.models_have_changed();
        former
    }

    /// Removes a reduced model from use.
    pub fn drop_model(&mut self, model: &Arc<ReducedModel>) {
        self.work.models.remove(model);
        self.models_have_changed();
    }

    fn models_have_changed(&mut self) {
        self.work.live.forget();
        self.on(Event::ModelsChanged);
    }

    /// Returns true if [`Self::refresh`] has requested the picture of the document.
    pub fn is_answer_to(&self, document: &Document) -> bool {
        self.asked() == Some(Ask::of(document, &self.work.models))
    }

    /// Returns the store of grids, solvers, models and operators.
    pub fn store(&self) -> &Store {
        &self.work.store
    }

    /// Returns the reduced models in use.
    pub fn models(&self) -> &Models {
        &self.work.models
    }

    /// Returns the reduced model for a document's contact.
    pub fn model(&self, document: &Document) -> Option<&Arc<ReducedModel>> {
        self.work.models.of(&document.point, &document.lubricant)
    }

    /// Returns the reduced model for a document's contact together with the document's truncation.
    pub fn in_use(&self, document: &Document) -> Option<InUse> {
        InUse::of(document, &self.work.models)
    }

    /// Returns the truncation that a document chooses for the local model of its contact.
    pub fn options(&self, document: &Document) -> ReducedOptions {
        Ask::of(document, &self.work.models).options
    }

    /// Returns whether the document's contact is inside the trained range of the model.
    pub fn trust(&self, document: &Document) -> Option<Trust> {
        let problem = Problem::new(&document.point, document.lubricant).ok()?;
        self.model(document).map(|model| model.trust(&problem))
    }

    /// Returns the full solves that wait or run.
    pub fn running(&self) -> &[Running] {
        self.work.jobs.running()
    }

    /// Returns true if a full solve of a kind waits or runs.
    pub fn runs(&self, kind: JobKind) -> bool {
        self.work.jobs.busy(kind)
    }

    /// Returns true while the contact of the sliders is being solved, for its picture or to check it.
    pub fn busy(&self) -> bool {
        self.coming() || self.runs(JobKind::Refine) || self.runs(JobKind::Verify)
    }

    /// Returns true while a picture is being computed.
    pub fn coming(&self) -> bool {
        self.work.live.busy() || self.runs(JobKind::Live)
    }

    /// Returns true if a model is being read.
    #[cfg(test)]
    pub fn reads(&self) -> bool {
        self.work.reading.is_some()
    }

    /// Returns the progress of the reduced solve for the picture.
    pub fn standing(&self) -> Option<Standing> {
        self.work.live.standing()
    }

    /// Stops all solves.
    pub fn cancel_all(&self) {
        self.work.live.stop();
        self.work.jobs.cancel_all();
    }

    /// Sets how long a frame waits for the reduced model. The default is 0.1 s.
    pub fn be_patient(&mut self, patience: Duration) {
        self.work.live.be_patient(patience);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::badge::verdict;
    use crate::app::display::Thresholds;
    use crate::engine::embedded;
    use crate::engine::job::{Job, Wake};
    use crate::host::clock::Stopwatch;
    use std::sync::mpsc::channel;

    #[test]
    fn stopped_reduced_solve_starts_no_full_one() {
        let (ctx, document) = (Context::default(), Document::default());
        let mut answers = Answers::new(Models::only(embedded("line").ok()), Store::default());
        let ask = Ask::of(&document, answers.models());
        assert_eq!(answers.on(Event::Asked(ask, None, 0.0)), Some(Wish::Reduced));
        answers.work.live.endless(ask);
        answers.refresh(&ctx, &document);
        assert!(answers.coming() && answers.failure().is_none());
        assert_eq!(answers.standing().map(|standing| standing.stage).as_deref(), Some("Reduced solve"));

        answers.cancel_all();
        let begin = Stopwatch::start();
        while answers.coming() {
            assert!(begin.elapsed() < Duration::from_secs(60));
            answers.refresh(&ctx, &document);
        }
        let failure = answers.failure().unwrap();
        assert_eq!((failure.key, failure.message.as_str()), (ask.key, "The reduced solve was cancelled"));
        assert_eq!(verdict(&answers, Thresholds::default()).title, "Cancelled");
        assert!(answers.standing().is_none() && answers.running().is_empty() && answers.passed_over().is_none());
    }

    #[test]
    fn model_is_used_as_soon_as_it_is_read() {
        let mut answers = Answers::new(Models::only(None), Store::default());
        let model = embedded("line").unwrap();
        let (own, (sent, arrived), (end, ended)) = (Arc::clone(&model), channel(), channel::<()>());
        answers.work.reading = Some(Job::start("Reading", Wake::default(), move |reporter| {
            reporter.send(own);
            let _ = (sent.send(()), ended.recv());
            Ok(())
        }));
        arrived.recv().unwrap();
        answers.receive();
        assert!(answers.models().contains(&model));
        drop(end);
        answers.receive();
        assert!(answers.models().contains(&model));
    }
}
