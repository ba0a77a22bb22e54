//! Contacts in time from the window: what was asked, what has come of it so far, and the moment that is looked at.

use super::player::Player;
use super::run::Run;
use super::setup::Setup;

use super::follow::Following;
use super::linearised::{Linearised, NumberStudy, OtherRule};
use super::projection::FieldErrors;
use crate::app::wake::wake;
use crate::engine::job::{Background, Job, Standing};
use crate::engine::{Store, Workbench};
use crate::scene::study::transient::{By, Kind, MarchedBy, Model, Row};
use crate::scene::{Scene, StudyRow};
use crate::solver::full::transient::{Ended, Frame, Moment, Quantity};
use crate::solver::reduced::tpwl::Weighting;
use egui::Context;
use std::sync::Arc;

/// What can be asked of contacts in time.
#[derive(Clone, Debug, PartialEq)]
pub enum InTimeCommand {
    /// Run this one.
    Run(Box<Setup>),
    /// Show this one: at once by models that are there, in full when the hands rest.
    Follow(Box<Setup>),
    /// Stop the runs, and the study of their linearised model.
    Stop,
    /// Look at the moment T, and stay there.
    GoTo(f64),
    /// Play from the present moment on, or pause.
    TogglePlay,
    /// Play on for seconds of the clock.
    PlayOn(f64),
    /// Study how many operating points it takes.
    StudyNumber,
    /// Stop that study.
    StopNumber,
}

/// What the window knows of contacts in time.
#[derive(Default)]
pub struct TransientView {
    /// What the runs belong to.
    pub setup: Option<Arc<Setup>>,
    /// The runs, in their order; the first is what the others are compared with.
    pub runs: Vec<Run>,
    /// The linearised model of the runs, with what is shown of it.
    pub linearised: Option<Linearised>,
    /// How many operating points it takes.
    pub number: NumberStudy,
    /// What runs, and why there is nothing or no more.
    pub work: Background<StudyRow>,
    /// Seconds and moments of the marches that the models of the last frame are trained by, where they are others.
    trained: Option<(f64, Vec<Vec<Moment>>)>,
    /// The run that rows go to.
    filled: Filled,
    /// What the job under way runs, until its first row.
    pub(super) next: Option<Arc<Setup>>,
    pub(super) following: Following,
    looking: Background<OtherRule>,
    /// Why a model could not be had of a run.
    pub notes: Vec<String>,
    /// The moment that is looked at.
    pub player: Player,
    pub(super) ctx: Option<Context>,
    /// Counts the starts: plots of new results forget how the former ones were zoomed.
    pub generation: u64,
}

/// The run that rows go to.
#[derive(Default)]
enum Filled {
    /// None yet.
    #[default]
    None,
    /// The one of this place.
    Shown(usize),
    /// One that takes the place of a replayed one once it has ended.
    Behind(Box<Run>),
}

impl TransientView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self, store: &Store) {
        self.number.receive();
        let (mut rows, works) = (Vec::new(), self.work.job().is_some());
        self.work.receive(|row| rows.push(row));
        for row in rows {
            if let StudyRow::Transient(row) = row {
                self.take(row);
            }
        }
        if works && self.work.job().is_none() {
            self.end();
        }
        self.receive_replayed(store);
        let linearised = &mut self.linearised;
        self.looking.receive(|found| linearised.iter_mut().for_each(|own| own.other = Some(found.clone())));
        for k in 0..self.runs.len() {
            if self.runs[k].difference.is_none() && self.runs[k].ended {
                self.runs[k].difference = self.difference(k);
                self.runs[k].field_errors = self.field_errors(k);
            }
        }
        let reached = self.runs.iter().map(Run::reached).fold(0.0, f64::max);
        self.player.reached(reached);
    }

    /// The work has ended: what it had begun stays as it is.
    pub(super) fn end(&mut self) {
        let stopped = self.work.message.is_none();
        if let Some(run) = self.filled().filter(|run| stopped && !run.ended) {
            (run.ended, run.trajectory.ended) = (true, Ended::Cancelled { time: run.reached() });
        }
        self.filled = Filled::None;
    }

    fn filled(&mut self) -> Option<&mut Run> {
        match &mut self.filled {
            Filled::None => None,
            Filled::Shown(place) => self.runs.get_mut(*place),
            Filled::Behind(run) => Some(run),
        }
    }

    fn take(&mut self, row: Row) {
        if let Some(setup) = self.next.take() {
            self.replace(setup);
        }
        match row {
            Row::Begun { by, trajectory, .. } => {
                let trained_s = self.trained.as_ref().map_or(0.0, |trained| trained.0);
                let model = self.following.model(by, trajectory.transient.frame);
                let mut run = Run::begun(by, *trajectory, model);
                run.model.iter_mut().for_each(|model| model.training_s += trained_s);
                let replayed = |own: &Run| own.replayed && own.by == run.by && own.frame() == run.frame();
                self.filled = if self.runs.iter().any(replayed) {
                    Filled::Behind(Box::new(run))
                } else {
                    Filled::Shown(insert(&mut self.runs, run))
                };
            }
            Row::Marched(march) => {
                if matches!(march.by, By::Full { .. }) {
                    self.trained = None;
                }
                if let Some(run) = self.filled() {
                    run.end(&march);
                }
                if let Filled::Behind(run) = std::mem::take(&mut self.filled) {
                    let replayed = |own: &Run| own.replayed && own.by == run.by && own.frame() == run.frame();
                    if let Some(place) = self.runs.iter().position(replayed) {
                        self.runs[place] = *run;
                    }
                }
            }
            Row::Trained { wall_s, moments, cut_short, .. } => {
                self.trained = Some((wall_s, moments));
                self.notes.extend(cut_short);
            }
            Row::Model(model) => {
                self.take_model(&model);
                self.following.keep(self.setup.as_ref(), model);
            }
            row @ (Row::Moment { .. } | Row::State { .. }) => {
                if let Some(run) = self.filled() {
                    run.take(row);
                }
            }
        }
    }

    /// Lets runs of another set-up take the place of those on the screen. Replayed ones of the same stay until their
    /// betters come.
    fn replace(&mut self, setup: Arc<Setup>) {
        let (same, last) = (self.setup.as_ref() == Some(&setup), self.following.models_are_last());
        let follows =
            |former: &Arc<Setup>| former.point == setup.point && former.study.duration == setup.study.duration;
        if !self.setup.as_ref().is_some_and(follows) {
            self.generation += 1;
        }
        self.runs.retain(|run| same && run.replayed);
        self.runs.iter_mut().for_each(|run| run.replayed = !last);
        if setup.study.linearised.is_none() {
            self.linearised = None;
        }
        self.number = NumberStudy::default();
        self.notes.clear();
        self.trained = None;
        self.setup = Some(setup);
    }

    fn take_model(&mut self, made: &Model) {
        let (Kind::Linearised { model, .. }, Some(ctx)) = (&made.kind, &self.ctx) else { return };
        let own = self.runs.iter().rev().find(|run| run.by == MarchedBy::Full && run.frame() == Frame::Fixed);
        let own = || own.map(|run| run.trajectory.moments.clone()).into_iter().collect();
        let (trainings, own) = match &self.trained {
            Some((_, trainings)) => (trainings.clone(), false),
            None => (own(), true),
        };
        self.linearised = Some(Linearised { model: Arc::clone(model), trainings, own, other: None });
        let model = Arc::clone(model);
        // What the other rule would choose takes longer than a frame.
        self.looking.run(Job::start("Looking into the linearised model", wake(ctx), move |reporter| {
            reporter.send(OtherRule::of(&model));
            Ok(())
        }));
    }

    /// How far the runs are.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing().or_else(|| self.looking.standing())
    }

    /// How far models are that are replayed.
    pub fn replaying(&self) -> Option<Standing> {
        self.following.replay.standing()
    }

    /// What a run is compared with: a model with the full system in its frame, a full one with the first; `None` for the first itself.
    pub fn reference_of(&self, k: usize) -> Option<&Run> {
        let (run, earlier) = (self.runs.get(k)?, self.runs.get(..k)?);
        match run.by {
            MarchedBy::Full => earlier.first(),
            MarchedBy::Reduced | MarchedBy::Linearised(_) => {
                earlier.iter().find(|other| other.by == MarchedBy::Full && other.frame() == run.frame())
            }
        }
    }

    fn field_errors(&self, k: usize) -> Option<FieldErrors> {
        let (run, reference) = (self.runs.get(k)?, self.reference_of(k).filter(|reference| reference.ended)?);
        Some(FieldErrors::of(run, reference, run.reduced.as_ref()?))
    }

    fn difference(&self, k: usize) -> Option<f64> {
        let (run, reference) = (self.runs.get(k)?, self.reference_of(k).filter(|reference| reference.ended)?);
        let whole = (0.0, run.reached());
        Some(run.trajectory.difference(&reference.trajectory, Quantity::CentralFilm, whole)?.0)
    }

    /// The runs of linearised models, by their weightings.
    pub fn linearised_runs(&self) -> impl Iterator<Item = (Weighting, &Run)> {
        self.runs.iter().filter_map(|run| match run.by {
            MarchedBy::Linearised(weighting) => Some((weighting, run)),
            MarchedBy::Full | MarchedBy::Reduced => None,
        })
    }

    /// Those of the linearised model that is looked into.
    pub fn runs_of<'a>(&'a self, linearised: &'a Linearised) -> impl Iterator<Item = (Weighting, &'a Run)> {
        let own = |run: &Run| run.linearised.as_ref().is_some_and(|model| Arc::ptr_eq(model, &linearised.model));
        self.linearised_runs().filter(move |(_, run)| own(run))
    }

    /// The full run that the linearised ones are compared with.
    pub fn reference_of_linearised(&self) -> Option<&Run> {
        let first = self.runs.iter().position(|run| matches!(run.by, MarchedBy::Linearised(_)))?;
        self.reference_of(first)
    }

    /// Does what was asked for.
    pub fn execute(&mut self, ctx: &Context, store: &Store, command: InTimeCommand) {
        match command {
            InTimeCommand::Run(setup) => self.start(ctx, store, *setup),
            InTimeCommand::Follow(setup) => self.follow(ctx, store, *setup),
            InTimeCommand::Stop => self.stop(),
            InTimeCommand::GoTo(time) => self.player.go_to(time),
            InTimeCommand::TogglePlay => self.player.toggle(),
            InTimeCommand::PlayOn(seconds) => {
                let duration = self.setup.as_ref().map_or(0.0, |setup| setup.study.duration);
                self.player.advance(seconds, duration);
            }
            InTimeCommand::StudyNumber => {
                if let (Some(linearised), Some(full)) = (&self.linearised, self.reference_of_linearised()) {
                    let (model, full) = (Arc::clone(&linearised.model), full.without_fields());
                    self.number.start(ctx, model, full);
                }
            }
            InTimeCommand::StopNumber => self.number.work.stop(),
        }
    }

    /// Stops the runs, and the study of their linearised model; what they have found stays.
    pub fn stop(&mut self) {
        self.following.rest();
        self.work.stop();
        self.number.work.stop();
    }

    /// Runs a contact in time from the beginning, unless it is refused.
    pub fn start(&mut self, ctx: &Context, store: &Store, setup: Setup) {
        let setup = Arc::new(setup);
        if self.begin(ctx, store, &setup, setup.question()) {
            self.following.by_hand(&setup);
            self.next = None;
            self.runs.clear();
            self.linearised = None;
            self.looking = Background::default();
            self.replace(setup);
            self.generation += 1;
            self.player = Player::default();
        }
    }

    /// Begins a question about a set-up; whether it is not refused.
    pub(super) fn begin(&mut self, ctx: &Context, store: &Store, setup: &Arc<Setup>, question: Scene) -> bool {
        self.ctx = Some(ctx.clone());
        if let Err(error) = setup.study.own_march(setup.point, setup.lubricant, Frame::Fixed).problem() {
            self.work = Background::default();
            self.work.message = Some(error.to_string());
            return false;
        }
        self.filled = Filled::None;
        self.next = Some(Arc::clone(setup));
        self.work.run(question.ask(Workbench::on(store, ""), wake(ctx)));
        true
    }
}

/// Lays a run behind those of its frame that are told before it; where it lies then.
pub fn insert(runs: &mut Vec<Run>, run: Run) -> usize {
    let rank = |by: MarchedBy| match by {
        MarchedBy::Full => 0,
        MarchedBy::Reduced => 1,
        MarchedBy::Linearised(_) => 2,
    };
    let before = |own: &Run| own.frame() == run.frame() && rank(own.by) <= rank(run.by);
    let first_of_frame = runs.iter().position(|own| own.frame() == run.frame());
    let place = runs.iter().rposition(before).map(|k| k + 1).or(first_of_frame).unwrap_or(runs.len());
    runs.insert(place, run);
    place
}
