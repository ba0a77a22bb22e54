//! What finished jobs bring: a picture, the truth about it, what its grid costs, or why there is none.

use super::grid_error::GridError;
use super::jobs::{FullSolve, GridChoice, JobKind, Outcome, Running, wake};
use super::picture::{Comparison, Origin, Picture};
use super::{Answers, Failure};
use crate::app::document::Key;
use crate::engine::Answer;
use crate::engine::job::Job;
use crate::host::pool::on_spare_cores;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::point::second_grid;
use crate::solver::full::{Report, Termination};
use egui::Context;
use std::sync::Arc;

impl Answers {
    /// Begins to read a model of the program. Until it is there the full solver draws the pictures.
    pub(super) fn read(&mut self, ctx: &Context, name: &'static str) {
        let store = self.store.clone();
        self.reading = Some(Job::start("Reading a reduced model", wake(ctx), move |reporter| {
            reporter.send(on_spare_cores(|| store.embedded(name)).map_err(|error| error.to_string())?);
            Ok(())
        }));
    }

    /// Puts the model in use that has been read.
    fn receive_model(&mut self) {
        let Some(job) = &mut self.reading else { return };
        // The model may come a while before the word that this was all.
        let mut read = None;
        let ended = job.poll(|model| read = Some(model)).is_some();
        if read.is_none() && !ended {
            return;
        }
        // Who has put one of his own in use meanwhile keeps it; where the build is damaged there is none.
        self.reading = None;
        match read {
            Some(model) if !self.models.serves(&model) => {
                self.use_model(model);
            }
            _ => self.models_have_changed(),
        }
    }

    /// Answers finished jobs. Called first in every frame.
    pub fn receive(&mut self) {
        self.receive_model();
        for (mut job, outcome) in self.jobs.poll() {
            // Another sliding does not make another film where it does not thin.
            if let Some(key) = self.key().filter(|key| job.key.has_film_of(key)) {
                job.key = key;
            }
            match job.kind {
                JobKind::Live => self.receive_live(&job, outcome),
                JobKind::Verify | JobKind::Refine => self.receive_verification(&job, outcome),
                JobKind::Estimate => self.receive_second_grid(&job, outcome),
            }
        }
    }

    fn receive_live(&mut self, job: &Running, outcome: Outcome) {
        match outcome {
            Outcome::Solved(answer) if answer.result.converged => {
                self.full_times.add(answer.result.wall_s);
                self.last_report = report_of(job.key, &answer);
                if Some(job.key) == self.key() {
                    self.failure = None;
                } else if self.picture_is_current() {
                    // The sliders have moved back to where the reduced model answers at once: this solution comes too
                    // late.
                    return;
                }
                if self.is_reduced(&job.key) {
                    // The model has been read meanwhile.
                    return;
                }
                if self.is_settled(&job.key) {
                    // The chosen grid has answered before the quick one.
                    return;
                }
                self.full = Picture::of(job.key, *answer, self.cuts);
                self.picture.clone_from(&self.full);
                self.comparison = None;
            }
            other => {
                if Some(job.key) == self.key() && !self.is_reduced(&job.key) {
                    self.failure = Some(failure_of(job.key, other, &mut self.last_report));
                }
            }
        }
    }

    fn receive_verification(&mut self, job: &Running, outcome: Outcome) {
        match outcome {
            Outcome::Solved(answer) if answer.result.converged => {
                self.full_times.add(answer.result.wall_s);
                self.last_report = report_of(job.key, &answer);
                let reduced = self.is_reduced(&job.key);
                let Some(full) = Picture::of(job.key, *answer, self.cuts) else { return };
                if self.is_of_another_grid(&job.key, &full.solution) {
                    // The model has been read meanwhile; its truth follows.
                    return;
                }
                if !reduced && self.plane().is_some_and(|plane| full.solution.mesh.plane() != Some(plane)) {
                    // Another grid has been chosen meanwhile, and answers later.
                    return;
                }
                if Some(job.key) == self.key() && self.plane().is_some() && !reduced {
                    self.failure = None;
                    self.picture = Some(full.clone());
                }
                self.full = Some(full);
                self.verify_failure = None;
                self.compare();
            }
            other => {
                let cancelled_by_change = Some(job.key) != self.key();
                if !cancelled_by_change {
                    self.verify_failure = Some(failure_of(job.key, other, &mut self.last_report));
                }
            }
        }
    }

    fn receive_second_grid(&mut self, job: &Running, outcome: Outcome) {
        if Some(job.key) != self.key() {
            return;
        }
        let result = match outcome {
            Outcome::Solved(answer) if answer.result.converged => self
                .full
                .as_ref()
                .and_then(|full| GridError::of(full, answer.fields()?))
                .ok_or_else(|| "the contact or its grid has changed meanwhile".to_owned()),
            other => Err(failure_of(job.key, other, &mut self.last_report).message),
        };
        match result {
            Ok(error) => self.grid_error = Some(error),
            Err(message) => self.no_estimate = Some(message),
        }
    }

    /// Whether a full solution on the chosen grid is there for a contact.
    pub(super) fn is_settled(&self, key: &Key) -> bool {
        let on_plane = |full: &Picture| self.plane().is_none_or(|plane| full.solution.mesh.plane() == Some(plane));
        self.plane().is_some() && self.full.as_ref().is_some_and(|full| full.key == *key && on_plane(full))
    }

    pub(super) fn compare(&mut self) {
        self.comparison = match (&self.picture, &self.full) {
            (Some(picture), Some(full)) if picture.key == full.key && picture.origin != Origin::Full => {
                Some(Comparison::new(picture, full))
            }
            _ => None,
        };
    }

    /// Estimates what the chosen grid costs, by a solve on a second one.
    pub fn estimate_grid_error(&mut self, ctx: &Context) {
        self.no_estimate = None;
        let Some(full) = self.full.as_ref().filter(|_| self.full_is_current()) else { return };
        let Some(spec) = full.solution.mesh.plane() else { return };
        let (key, start) = (full.key, Some(Arc::clone(&full.solution)));
        let grid = GridChoice::Spec(GridSpec::Plane(second_grid(spec)));
        self.jobs.submit(ctx, FullSolve { kind: JobKind::Estimate, key, grid, start });
    }
}

fn failure_of(key: Key, outcome: Outcome, last_report: &mut Option<(Key, Report)>) -> Failure {
    match outcome {
        Outcome::Failed(message) => Failure { key, message, report: None, stopped: false },
        Outcome::Solved(answer) => {
            *last_report = report_of(key, &answer);
            let report = last_report.as_ref().map(|(_, report)| report.clone());
            let termination = report.as_ref().map_or(Termination::Diverged, |report| report.termination);
            let message = format!("The full solve {}", termination.describe());
            Failure { key, message, report, stopped: termination == Termination::Cancelled }
        }
    }
}

/// How a full solve went, with the contact that it was for.
fn report_of(key: Key, answer: &Answer) -> Option<(Key, Report)> {
    Some((key, answer.solution.as_ref()?.report.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::model_source::Models;
    use crate::engine::Store;
    use crate::engine::job::Wake;
    use std::sync::mpsc::channel;

    #[test]
    fn a_model_is_in_use_as_soon_as_it_is_there_however_long_its_reader_takes_to_end() {
        let mut answers = Answers::new(Models::only(None), Store::default());
        let model = crate::engine::embedded("line").unwrap();
        let (own, (sent, arrived), (end, ended)) = (Arc::clone(&model), channel(), channel::<()>());
        answers.reading = Some(Job::start("Reading", Wake::default(), move |reporter| {
            reporter.send(own);
            let _ = (sent.send(()), ended.recv());
            Ok(())
        }));
        arrived.recv().unwrap();
        answers.receive();
        assert!(answers.models.contains(&model));
        drop(end);
        answers.receive();
        assert!(answers.models.contains(&model));
    }
}
