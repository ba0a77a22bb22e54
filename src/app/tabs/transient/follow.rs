//! Update of transient runs after a change of the document, while a tab shows them. Existing models replay at once.
//! When the sliders are idle, the full system checks the models and trains them again.

use super::linearised::NumberStudy;
use super::recorded::Recorded;
use super::runs::{TransientRuns, insert};
use crate::app::tabs::transient::{Run, Setup};
use crate::app::wake::wake;
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::study::transient::{Kind, MarchedBy, Model, Row};
use crate::scene::{Drive, ReducedTransient, Scene, StudyRow, TransientStudy};
use crate::solver::full::transient::{Ended, Frame, Inputs};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::ResponseTraining;
use egui::Context;
use std::sync::Arc;

/// Idle time before the full system starts \[s\].
const REST_S: f64 = 0.25;
/// Range of the reference load, relative to that of a model's training, in which the model is replayed.
const LOADS: (f64, f64) = (0.7, 1.4);

/// Models and the set-up they were trained with.
type LastModels = (Arc<Setup>, Vec<Model>);

/// Followed set-up, and the models that replay it.
#[derive(Default)]
pub struct Following {
    /// Last requested set-up.
    asked: Option<Arc<Setup>>,
    /// Time of that request on the window's clock \[s\].
    asked_at: f64,
    /// True if the full system still has to be run.
    due: bool,
    /// True if the user started the present runs. Only the user stops these.
    by_hand: bool,
    /// Models trained last, with their set-up.
    kept: Option<LastModels>,
    pub(super) replay: Background<StudyRow>,
    /// True if the running study would train the same models as those replayed.
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

    /// Records that the user started the present runs.
    pub(super) fn by_hand(&mut self, setup: &Arc<Setup>) {
        *self = Self { asked: Some(Arc::clone(setup)), by_hand: true, kept: self.kept.take(), ..Self::default() };
    }

    /// Cancels pending requests until the document changes.
    pub(super) fn rest(&mut self) {
        self.due = false;
        (self.replay, self.replaying) = (Background::default(), None);
    }

    /// Returns true if the running study would train the same models as those replayed.
    pub(super) fn models_are_last(&self) -> bool {
        self.last
    }

    /// Returns the model of a frame by which a run was computed.
    pub(super) fn model(&self, by: MarchedBy, frame: Frame) -> Option<&Model> {
        model(self.kept.as_ref(), by, frame)
    }

    /// Returns the models that can be replayed in addition to the built-in one. `None` if there is none at all.
    fn serving(&self, wanted: &Setup) -> Option<&[Model]> {
        let embedded = wanted.study.reduced.as_ref().is_some_and(ReducedTransient::is_embedded);
        self.made_for(wanted).or((embedded && wanted.sampled.is_none()).then_some(&[]))
    }

    /// Returns the models trained last if they can be replayed.
    fn made_for(&self, wanted: &Setup) -> Option<&[Model]> {
        let (setup, models) = self.kept.as_ref()?;
        let alike = |s: &Setup| (means(&s.study), s.grid, s.lubricant, OperatingPoint { load: 1.0, ..s.point });
        let share = wanted.point.load / setup.point.load;
        let near = (LOADS.0..=LOADS.1).contains(&share);
        (near && wanted.sampled.is_none() && alike(setup) == alike(wanted)).then_some(models.as_slice())
    }

    /// Returns true if training would give bitwise the same models as the present ones.
    fn final_for(&self, wanted: &Setup) -> bool {
        let kept = self.kept.as_ref().filter(|_| !wanted.study.trains_on_itself(wanted.point.kind));
        let expected = usize::from(wanted.study.reduced.is_some()) * wanted.study.frames.len()
            + usize::from(wanted.study.linearised.is_some());
        kept.is_some_and(|(setup, models)| setup.point == wanted.point && models.len() == expected)
            && self.made_for(wanted).is_some()
    }
}

/// Returns the settings of a study that determine its models, without the inputs.
fn means(study: &TransientStudy) -> TransientStudy {
    TransientStudy { inputs: Inputs::default(), duration: 1.0, window: None, ..study.clone() }
}

impl TransientRuns {
    /// Returns true if the runs on the screen are those that the tabs requested.
    pub fn is_current(&self) -> bool {
        self.following.asked.is_none() || self.setup == self.following.asked
    }

    /// Returns true if a set-up has already been requested.
    pub fn follows(&self, wanted: &Setup) -> bool {
        self.following.asked.as_deref() == Some(wanted)
    }

    /// Returns true if a run or a replay is about to start automatically.
    pub fn waits(&self) -> bool {
        self.following.due || self.following.replaying.is_some()
    }

    /// Returns true while runs are computed that the user started.
    pub fn runs_by_hand(&self) -> bool {
        self.following.by_hand && self.work.job().is_some()
    }

    /// Returns the training inputs of the models on the screen.
    pub fn trained_by(&self) -> Option<Vec<Drive>> {
        let (setup, models) = self.following.kept.as_ref()?;
        let study = &setup.study;
        if setup.point.kind.is_point() {
            let of_model = |model: &Model| match &model.kind {
                Kind::Reduced(reduced) => Some(ResponseTraining::of_model(reduced)),
                Kind::Linearised { .. } => None,
            };
            let training = study.responses().or_else(|| models.iter().find_map(of_model))?;
            let (inputs, duration) = training.sweep();
            return Some(vec![Drive { name: String::new(), inputs, duration }]);
        }
        let own = || vec![Drive { name: String::new(), inputs: study.inputs.clone(), duration: study.duration }];
        Some(if study.trainings.is_empty() { own() } else { study.trainings.clone() })
    }

    /// Follows the set-up that a tab shows.
    pub(super) fn follow(&mut self, ctx: &Context, store: &Store, wanted: Setup) {
        if self.follows(&wanted) || self.runs_by_hand() {
            return;
        }
        // Runs of another shape say nothing about this contact.
        let shape = |setup: &Setup| (setup.point.kind, setup.point.is_elliptic());
        if self.setup.as_ref().is_some_and(|setup| shape(setup) != shape(&wanted)) {
            self.forget();
        }
        let wanted = Arc::new(wanted);
        let cancelled = |run: &Run| matches!(run.trajectory.ended, Ended::Cancelled { .. });
        let whole = |run: &Run| run.ended && !run.replayed && !cancelled(run);
        let there = self.setup.as_ref() == Some(&wanted) && !self.runs.is_empty() && self.runs.iter().all(whole);
        let Following { asked, asked_at, due, by_hand, .. } = &mut self.following;
        (*asked, *asked_at) = (Some(Arc::clone(&wanted)), ctx.input(|i| i.time));
        (*due, *by_hand) = (!there && wanted.is_quick(), false);
        if self.work.job().is_some() {
            // The running computation belongs to another set-up.
            self.work = Background::default();
            self.recorded.iter_mut().for_each(Recorded::stopping);
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

    /// Replays the present models for the requested set-up. If a replay is running, the new one starts afterwards.
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
        // A replay without results does not replace the runs on the screen.
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

    /// Starts the full system when the sliders are idle. Call last in every frame.
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

    /// Returns the study of the requested set-up. It contains no models if it would train the same ones as those
    /// replayed.
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

/// Returns the model of a frame by which a run is computed.
fn model(kept: Option<&LastModels>, by: MarchedBy, frame: Frame) -> Option<&Model> {
    let kind = |kind: &Kind| match kind {
        Kind::Reduced(_) => by == MarchedBy::Reduced,
        Kind::Linearised { .. } => matches!(by, MarchedBy::Linearised(_)),
    };
    kept?.1.iter().find(|model| model.frame == frame && kind(&model.kind))
}
