//! How the picture follows the document: by the reduced model, as a rule within the frame, else by the full solver in the
//! worker; and when the sliders rest, the truth about it.

use super::jobs::{FullSolve, GridChoice, JobKind};
use super::live::{Solved, Unanswered};
use super::picture::{Cuts, Origin, Picture};
use super::{Answers, Ask, Failure, PassedOver, REST_S};
use crate::app::document::{Document, Key};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::reduced::{ReducedModel, Trust};
use egui::Context;
use std::sync::Arc;

impl Answers {
    /// Answers a changed document by the reduced model, as a rule at once, else by the full solver in the worker. Called
    /// after the panels.
    pub fn refresh(&mut self, ctx: &Context, document: &Document) {
        if self.reading.is_none()
            && let Some(which) = self.models.late_for(&document.point, &document.lubricant)
        {
            self.read(ctx, which);
        }
        let ask = Ask::of(document, &self.models);
        if self.asked != Some(ask) {
            self.ask(ctx, document, ask);
        }
        self.receive_reduced(ctx, document);
    }

    fn ask(&mut self, ctx: &Context, document: &Document, ask: Ask) {
        let former = self.asked.replace(ask);
        let key = ask.key;
        let drawn = former.is_some_and(|former| self.picture.as_ref().is_some_and(|p| p.key == former.key));
        let same_means = former.is_some_and(|former| Ask { key, ..former } == ask);
        // What solves took belongs to a kind of contact and its means.
        if !same_means || former.is_some_and(|former| former.key.point.kind != key.point.kind) {
            self.reduced_times.clear();
            self.full_times.clear();
        }
        self.changed_at = ctx.input(|i| i.time);
        if former.is_none_or(|former| former.key != key) {
            self.failure = None;
            self.verify_failure = None;
            self.slide(key);
            // The same film by the same means is on the screen already, and what is known of it stays.
            if drawn && same_means && self.picture_is_current() && self.untried(document) == self.passed_over {
                self.compare();
                return;
            }
        }
        self.verify_due = false;
        self.passed_over = self.untried(document);
        match self.model(document) {
            Some(model) if self.passed_over.is_none() => {
                let model = Arc::clone(model);
                self.live.submit(ctx, ask, model);
            }
            _ => self.full_follows(ctx, document, ask),
        }
    }

    /// Takes in what the reduced model has answered.
    fn receive_reduced(&mut self, ctx: &Context, document: &Document) {
        for (ask, answer) in self.live.poll() {
            let present = self.asked == Some(ask);
            match answer {
                Ok(solved) => {
                    self.reduced_times.add(solved.wall_s);
                    if present || !self.picture_is_current() {
                        self.picture = Some(drawn_of(ask.key, *solved, self.cuts));
                        self.drop_full_of_another_grid(&ask.key);
                        self.compare();
                    }
                    if present {
                        self.verify_due = !self.full_is_current();
                        self.look_when_rested(ctx);
                    }
                }
                Err(Unanswered::Stopped) if present => {
                    let message = "The reduced solve was cancelled".to_owned();
                    self.failure = Some(Failure { key: ask.key, message, report: None, stopped: true });
                }
                Err(Unanswered::Failed(why)) if present => {
                    self.passed_over = Some(PassedOver::Failed(why));
                    self.full_follows(ctx, document, ask);
                }
                Err(_) => {}
            }
        }
    }

    fn drop_full_of_another_grid(&mut self, key: &Key) {
        if self.full.as_ref().is_some_and(|full| full.key == *key && self.is_of_another_grid(key, &full.solution)) {
            self.full = None;
        }
    }

    /// No reduced model draws the picture.
    fn full_follows(&mut self, ctx: &Context, document: &Document, ask: Ask) {
        let key = ask.key;
        self.comparison = None;
        let live = self.picture.as_ref().is_none_or(|p| p.key != key || p.origin != Origin::Full);
        if live {
            self.submit(ctx, document, JobKind::Live);
        }
        // A quick grid follows the hand; the chosen one answers when it rests.
        let finer = ask.plane.is_some_and(|plane| !live || plane != quick(plane));
        self.verify_due = finer && !self.is_settled(&key);
        self.look_when_rested(ctx);
    }

    fn look_when_rested(&self, ctx: &Context) {
        if self.verify_due {
            ctx.request_repaint_after_secs(REST_S as f32);
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

    /// Lays all curves where the point contact is cut. Called before the plots.
    pub fn follow_cuts(&mut self, cuts: Cuts) {
        self.cuts = cuts;
        let pinned = self.pins.iter_mut().map(|pin| &mut pin.picture);
        for picture in self.picture.iter_mut().chain(&mut self.full).chain(pinned) {
            picture.cut(cuts);
        }
        if self.comparison.as_ref().is_some_and(|c| c.cuts != cuts) {
            self.compare();
        }
    }

    /// Why the reduced model is not even tried; `None` where it is.
    fn untried(&self, document: &Document) -> Option<PassedOver> {
        let heat = document.lubricant.heat.is_some();
        let own = |model: &Arc<ReducedModel>| model.is_of(&document.point) && model.domain.heat.is_some() == heat;
        let shapes = self.model(document).is_some_and(own);
        match self.trust(document) {
            _ if self.reading.is_some() && !shapes => Some(PassedOver::Reading),
            None => Some(PassedOver::NoModel),
            Some(Trust::Outside(why)) => Some(PassedOver::Outside(why)),
            Some(Trust::Trained) => None,
        }
    }

    fn submit(&mut self, ctx: &Context, document: &Document, kind: JobKind) {
        let key = document.key();
        // A line contact is solved on the model's own grid wherever it lies, a point contact where the model serves it:
        // elsewhere on the grid that was chosen.
        let chosen = document.chosen_plane();
        let own = self.passed_over.is_none() || chosen.is_none();
        let plane = chosen.map(|plane| if kind == JobKind::Live { quick(plane) } else { plane });
        let model = self.model(document).filter(|_| own).map(Arc::as_ref);
        let grid = GridChoice::of(model, plane, &key.point);
        let start = match kind {
            // The truth must not depend on what it checks.
            JobKind::Verify => None,
            _ => self.picture.as_ref().map(|p| Arc::clone(&p.solution)),
        };
        self.jobs.submit(ctx, FullSolve { kind, key, grid, start });
    }

    /// Starts the verification when the sliders have rested. Called last in every frame.
    pub fn settle(&mut self, ctx: &Context, document: &Document) {
        if !self.verify_due {
            return;
        }
        let rest = self.rested_s(ctx.input(|i| i.time));
        if rest < REST_S {
            ctx.request_repaint_after_secs((REST_S - rest) as f32);
            return;
        }
        self.verify_due = false;
        let reduced = self.passed_over.is_none();
        if reduced && !self.full_is_current() {
            self.submit(ctx, document, JobKind::Verify);
        } else if !reduced && !self.is_settled(&document.key()) {
            self.submit(ctx, document, JobKind::Refine);
        }
    }

    /// Verifies now, even when a full solution is there.
    pub fn verify(&mut self, ctx: &Context, document: &Document) {
        self.verify_due = false;
        self.verify_failure = None;
        self.submit(ctx, document, JobKind::Verify);
    }
}

/// The picture of a reduced solution.
fn drawn_of(key: Key, solved: Solved, cuts: Cuts) -> Picture {
    let Solved { reduced, fields, .. } = solved;
    let origin = Origin::Reduced {
        residual_estimate: reduced.residual_estimate,
        error: reduced.error,
        iterations: reduced.iterations,
        window: reduced.window,
        stands_in: reduced.stands_in,
    };
    Picture::new(key, origin, Arc::new(fields), cuts, reduced.traction)
}

/// The grid of pictures that follow the hand: the quick one, unless the chosen one is as quick.
fn quick(chosen: PointGridSpec) -> PointGridSpec {
    let nodes = |spec: PointGridSpec| spec.nodes().map_or(usize::MAX, |(nx, ny)| nx * ny * ny);
    if nodes(chosen) <= nodes(PointGridSpec::QUICK) { chosen } else { PointGridSpec::QUICK }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::badge::verdict;
    use crate::app::display::Thresholds;
    use crate::app::model_source::Models;
    use crate::engine::{Embedded, Store};
    use std::time::{Duration, Instant};

    #[test]
    fn a_reduced_solve_that_is_stopped_says_so_and_no_full_one_follows() {
        let (ctx, document) = (Context::default(), Document::default());
        let mut answers = Answers::new(Models::only(Embedded::Line.model().ok()), Store::default());
        let ask = Ask::of(&document, &answers.models);
        answers.asked = Some(ask);
        answers.live.endless(ask);
        answers.refresh(&ctx, &document);
        assert!(answers.coming() && answers.failure.is_none());
        assert_eq!(answers.standing().map(|standing| standing.stage).as_deref(), Some("Reduced solve"));

        answers.cancel_all();
        let begin = Instant::now();
        while answers.coming() {
            assert!(begin.elapsed() < Duration::from_secs(60));
            answers.refresh(&ctx, &document);
        }
        let failure = answers.failure.as_ref().unwrap();
        assert_eq!((failure.key, failure.message.as_str()), (ask.key, "The reduced solve was cancelled"));
        assert_eq!(verdict(&answers, Thresholds::default()).title, "Cancelled");
        assert!(answers.standing().is_none() && answers.jobs.running().is_empty() && answers.passed_over.is_none());
    }
}
