//! How transient runs follow the document while a tab shows them. Existing models replay at once. When the sliders are
//! idle, the full system checks the models and trains them again.

use super::linearised::NumberStudy;
use super::runs::{TransientRuns, insert};
use crate::app::tabs::transient::{Run, Setup};
use crate::app::wake::wake;
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::study::transient::{Kind, MarchedBy, Model, Row};
use crate::scene::{Drive, ReducedTransient, Scene, StudyRow, TransientStudy};
use crate::solver::full::transient::{Ended, Frame, Inputs};
use crate::solver::physics::contact::OperatingPoint;
use egui::Context;
use std::sync::Arc;

/// Idle seconds before the full system starts.
const REST_S: f64 = 0.25;
/// Reference loads, over that of a model's training, at which it is still replayed.
const LOADS: (f64, f64) = (0.7, 1.4);

/// Models and the set-up they were trained with.
type Kept = (Arc<Setup>, Vec<Model>);

/// Set-up that is followed, and the models that replay it.
#[derive(Default)]
pub struct Following {
    /// Set-up that was asked for last.
    asked: Option<Arc<Setup>>,
    /// Time of that request on the window's clock \[s\].
    asked_at: f64,
    /// True if the full system is still to be run.
    due: bool,
    /// True if the present runs were started by hand. Only the user stops these.
    by_hand: bool,
    /// Models that were trained last, with their set-up.
    kept: Option<Kept>,
    pub(super) replay: Background<StudyRow>,
    /// Whether the models that were replayed are those that the question under way would make.
    last: bool,
    replaying: Option<Arc<Setup>>,
    runs: Vec<Run>,
}

impl Following {
    /// Stores a model.
    pub(super) fn keep(&mut self, setup: Option<&Arc<Setup>>, model: Model) {
        let Some(setup) = setup else { return };
        match &mut self.kept {
            Some((of, models)) if of == setup && !models.iter().any(|own| own.name == model.name) => models.push(model),
            kept => *kept = Some((Arc::clone(setup), vec![model])),
        }
    }

    /// Notes that the present runs were started by hand.
    pub(super) fn by_hand(&mut self, setup: &Arc<Setup>) {
        *self = Self { asked: Some(Arc::clone(setup)), by_hand: true, kept: self.kept.take(), ..Self::default() };
    }

    /// Cancels pending requests until the document changes.
    pub(super) fn rest(&mut self) {
        self.due = false;
        (self.replay, self.replaying) = (Background::default(), None);
    }

    /// Whether the models that were replayed are those that the question under way would make.
    pub(super) fn models_are_last(&self) -> bool {
        self.last
    }

    /// Returns the model of a frame by which a run was computed.
    pub(super) fn model(&self, by: MarchedBy, frame: Frame) -> Option<&Model> {
        model(self.kept.as_ref(), by, frame)
    }

    /// The models that can be replayed, beside that of the program.
    fn serving(&self, wanted: &Setup) -> Option<&[Model]> {
        let embedded = wanted.study.reduced.as_ref().is_some_and(ReducedTransient::is_embedded);
        self.made_for(wanted).or((embedded && wanted.sampled.is_none()).then_some(&[]))
    }

    /// The models that were made last, where they can be replayed.
    fn made_for(&self, wanted: &Setup) -> Option<&[Model]> {
        let (setup, models) = self.kept.as_ref()?;
        let alike = |s: &Setup| (means(&s.study), s.grid, s.lubricant, OperatingPoint { load: 1.0, ..s.point });
        let share = wanted.point.load / setup.point.load;
        let near = (LOADS.0..=LOADS.1).contains(&share);
        (near && wanted.sampled.is_none() && alike(setup) == alike(wanted)).then_some(models.as_slice())
    }

    /// Whether the models there are would be made again, to the last bit.
    fn final_for(&self, wanted: &Setup) -> bool {
        let kept = self.kept.as_ref().filter(|_| !wanted.study.trains_on_itself());
        let expected = usize::from(wanted.study.reduced.is_some()) * wanted.study.frames.len()
            + usize::from(wanted.study.linearised.is_some());
        kept.is_some_and(|(setup, models)| setup.point == wanted.point && models.len() == expected)
            && self.made_for(wanted).is_some()
    }
}

/// What models of a study are made by, whatever inputs they follow.
fn means(study: &TransientStudy) -> TransientStudy {
    TransientStudy { inputs: Inputs::default(), duration: 1.0, window: None, ..study.clone() }
}

impl TransientRuns {
    /// Returns true if the runs on the screen are those that the tabs asked for.
    pub fn is_current(&self) -> bool {
        self.following.asked.is_none() || self.setup == self.following.asked
    }

    /// Returns true if a set-up has already been asked for.
    pub fn follows(&self, wanted: &Setup) -> bool {
        self.following.asked.as_deref() == Some(wanted)
    }

    /// Returns true if a run or a replay is about to start by itself.
    pub fn waits(&self) -> bool {
        self.following.due || self.following.replaying.is_some()
    }

    /// Returns true while runs are computed that were started by hand.
    pub fn runs_by_hand(&self) -> bool {
        self.following.by_hand && self.work.job().is_some()
    }

    /// Returns the training inputs of the models on the screen.
    pub fn trained_by(&self) -> Option<Vec<Drive>> {
        let (setup, _) = self.following.kept.as_ref()?;
        let study = &setup.study;
        let own = || vec![Drive { name: String::new(), inputs: study.inputs.clone(), duration: study.duration }];
        Some(if study.trainings.is_empty() { own() } else { study.trainings.clone() })
    }

    /// Follows the set-up that a tab shows.
    pub(super) fn follow(&mut self, ctx: &Context, store: &Store, wanted: Setup) {
        if self.follows(&wanted) || self.runs_by_hand() {
            return;
        }
        let wanted = Arc::new(wanted);
        let cancelled = |run: &Run| matches!(run.trajectory.ended, Ended::Cancelled { .. });
        let whole = |run: &Run| run.ended && !run.replayed && !cancelled(run);
        let there = self.setup.as_ref() == Some(&wanted) && !self.runs.is_empty() && self.runs.iter().all(whole);
        let Following { asked, asked_at, due, by_hand, .. } = &mut self.following;
        (*asked, *asked_at) = (Some(Arc::clone(&wanted)), ctx.input(|i| i.time));
        (*due, *by_hand) = (!there && wanted.is_quick(), false);
        if self.work.job().is_some() {
            // What was being computed is wanted no more.
            self.work = Background::default();
            self.end();
            self.next = None;
        }
        if !there {
            self.replay(ctx, store);
        }
        if self.runs.is_empty() {
            self.following.asked_at -= REST_S;
        }
        self.settle(ctx, store);
    }

    /// Replays the models that are there along what is wanted, unless they are at it: what is wanted then comes next.
    fn replay(&mut self, ctx: &Context, store: &Store) {
        self.ctx = Some(ctx.clone());
        let following = &mut self.following;
        let Some(wanted) = following.asked.clone().filter(|_| following.replaying.is_none()) else { return };
        if let Some(models) = following.serving(&wanted).map(<[Model]>::to_vec) {
            let job = wanted.question().replay(models, store, wake(ctx));
            following.runs.clear();
            following.replay.run(job);
            following.replaying = Some(wanted);
        }
    }

    /// Receives replayed runs and shows them when they are complete.
    pub(super) fn receive_replayed(&mut self, store: &Store) {
        let Following { replay, replaying, runs, kept, asked, .. } = &mut self.following;
        replay.receive(|row| {
            let StudyRow::Transient(row) = row else { return };
            match (row, runs.last_mut()) {
                (Row::Begun { by, trajectory, .. }, _) => {
                    let model = model(kept.as_ref(), by, trajectory.transient.frame);
                    runs.push(Run { replayed: true, ..Run::begun(by, *trajectory, model) });
                }
                (Row::Marched(march), Some(run)) => run.end(&march),
                (row, Some(run)) => run.take(row),
                (_, None) => {}
            }
        });
        if replay.job().is_some() {
            return;
        }
        let Some(setup) = replaying.take() else { return };
        let again = asked.as_ref() != Some(&setup);
        let new: Vec<Run> = std::mem::take(runs).into_iter().filter(|run| run.ended).collect();
        // What gives no answer takes nobody's place.
        if self.setup.as_ref() != Some(&setup) && !new.is_empty() {
            self.setup = Some(setup);
            self.runs.clear();
            self.number = NumberStudy::default();
        }
        for run in new {
            let own = self.runs.iter().position(|own| own.by == run.by && own.frame() == run.frame());
            match own {
                Some(place) if self.runs[place].replayed => self.runs[place] = run,
                Some(_) => {}
                None => _ = insert(&mut self.runs, run),
            }
        }
        if let (true, Some(ctx)) = (again, self.ctx.clone()) {
            self.replay(&ctx, store);
        }
    }

    /// Starts the full system when the sliders are idle. Called last in every frame.
    pub fn settle(&mut self, ctx: &Context, store: &Store) {
        if !self.following.due {
            return;
        }
        let left = self.following.asked_at + REST_S - ctx.input(|i| i.time);
        if left > 0.0 {
            ctx.request_repaint_after_secs(left as f32);
            return;
        }
        if self.following.replaying.is_some() {
            return;
        }
        self.following.due = false;
        if let Some(wanted) = self.following.asked.clone() {
            let question = self.checking(&wanted);
            self.begin(ctx, store, &wanted, question);
        }
    }

    /// The question about what is wanted; without models where those that were replayed are the ones it would make.
    fn checking(&mut self, wanted: &Arc<Setup>) -> Scene {
        let replayed = self.setup.as_ref() == Some(wanted) && self.runs.iter().any(|run| run.replayed);
        self.following.last = replayed && self.following.final_for(wanted);
        if !self.following.last {
            return wanted.question();
        }
        let study = TransientStudy { reduced: None, linearised: None, ..wanted.study.clone() };
        Setup { study, ..Setup::clone(wanted) }.question()
    }
}

/// The model of a frame that a run is by.
fn model(kept: Option<&Kept>, by: MarchedBy, frame: Frame) -> Option<&Model> {
    let kind = |kind: &Kind| match kind {
        Kind::Reduced(_) => by == MarchedBy::Reduced,
        Kind::Linearised { .. } => matches!(by, MarchedBy::Linearised(_)),
    };
    kept?.1.iter().find(|model| model.frame == frame && kind(&model.kind))
}
