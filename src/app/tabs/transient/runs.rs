//! Transient runs: the requested set-up, the results so far, and the displayed time.

use super::player::Player;
use super::recorded::Recorded;
use super::run::Run;
use super::setup::Setup;

use super::follow::Following;
use super::linearised::{Linearised, NumberStudy, OtherRule, OtherRuleTask};
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

/// Changes of transient runs.
#[derive(Clone, Debug, PartialEq)]
pub enum TransientCommand {
    /// Run a set-up from the beginning.
    Run(Box<Setup>),
    /// Show a set-up: at once by existing models, in full when the sliders are idle.
    Follow(Box<Setup>),
    /// Stop the runs, and the study of their linearised model.
    Stop,
    /// Show the time T and stop playing.
    GoTo(f64),
    /// Play from the displayed time on, or pause.
    TogglePlay,
    /// Advance the displayed time by seconds of the clock.
    PlayOn(f64),
    /// Study the number of operating points.
    StudyNumber,
    /// Stop that study.
    StopNumber,
}

/// Transient runs and the displayed time. Several tabs read them.
#[derive(Default)]
pub struct TransientRuns {
    /// Set-up of the runs.
    pub setup: Option<Arc<Setup>>,
    /// Runs in their order. The others are compared with the first.
    pub runs: Vec<Run>,
    /// Linearised model of the runs.
    pub linearised: Option<Linearised>,
    /// Study of the number of operating points.
    pub number: NumberStudy,
    /// Running job, and why the last one ended early.
    pub work: Background<StudyRow>,
    /// Seconds and time steps of the training runs of the last frame, if these are not the runs themselves.
    trained: Option<(f64, Vec<Vec<Moment>>)>,
    /// Run that receives the rows.
    filled: Filled,
    /// Rows of the last study.
    pub recorded: Option<Recorded>,
    /// Set-up of the running job until its first row arrives.
    pub(super) next: Option<Arc<Setup>>,
    pub(super) following: Following,
    looking: Background<OtherRule>,
    /// Reasons why a model could not be made from a run.
    pub notes: Vec<String>,
    /// Displayed time.
    pub player: Player,
    pub(super) ctx: Option<Context>,
    /// Number of starts. Plots of new results do not keep the zoom of the previous ones.
    pub generation: u64,
}

/// Run that receives the rows.
#[derive(Default)]
enum Filled {
    /// None yet.
    #[default]
    None,
    /// Run at this index of the list.
    Shown(usize),
    /// Run that replaces a replayed one when it has ended.
    Behind(Box<Run>),
}

impl TransientRuns {
    /// Receives the results since the last frame.
    pub fn receive(&mut self, store: &Store) {
        self.number.receive();
        let (mut rows, works) = (Vec::new(), self.work.job().is_some());
        if self.work.job().is_some_and(Job::stopping) {
            self.recorded.iter_mut().for_each(Recorded::stopping);
        }
        self.work.receive(|row| rows.push(row));
        for row in rows {
            if let StudyRow::Transient(row) = row {
                self.recorded.iter_mut().for_each(|recorded| recorded.push(&row));
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

    /// Ends the job. The run in progress keeps its results.
    pub(super) fn end(&mut self) {
        let stopped = self.work.message.is_none();
        if let Some(run) = self.filled().filter(|run| stopped && !run.ended) {
            (run.ended, run.trajectory.ended) = (true, Ended::Cancelled { time: run.reached() });
        }
        let failed = self.work.message.is_some();
        self.recorded.iter_mut().for_each(|recorded| recorded.end(failed));
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
                self.notes.extend(cut_short.iter().map(ToString::to_string));
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

    /// Replaces the runs by those of another set-up. Replayed runs of the same set-up stay until full results
    /// arrive.
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
        let name = "Analysing the linearised model";
        self.looking.run(Job::of(name, wake(ctx), &Store::default(), OtherRuleTask(model)));
    }

    /// Returns the progress of the runs.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing().or_else(|| self.looking.standing())
    }

    /// Returns the progress of replayed models.
    pub fn replaying(&self) -> Option<Standing> {
        self.following.replay.standing()
    }

    /// Returns the reference of a run: for a model the full run in its frame, for a full run the first one. `None`
    /// for the first run.
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

    /// Returns the runs of linearised models with their weightings.
    pub fn linearised_runs(&self) -> impl Iterator<Item = (Weighting, &Run)> {
        self.runs.iter().filter_map(|run| match run.by {
            MarchedBy::Linearised(weighting) => Some((weighting, run)),
            MarchedBy::Full | MarchedBy::Reduced => None,
        })
    }

    /// Returns the runs of one linearised model with their weightings.
    pub fn runs_of<'a>(&'a self, linearised: &'a Linearised) -> impl Iterator<Item = (Weighting, &'a Run)> {
        let own = |run: &Run| run.linearised.as_ref().is_some_and(|model| Arc::ptr_eq(model, &linearised.model));
        self.linearised_runs().filter(move |(_, run)| own(run))
    }

    /// Returns the full run that the linearised runs are compared with.
    pub fn reference_of_linearised(&self) -> Option<&Run> {
        let first = self.runs.iter().position(|run| matches!(run.by, MarchedBy::Linearised(_)))?;
        self.reference_of(first)
    }

    /// Executes a command.
    pub fn execute(&mut self, ctx: &Context, store: &Store, command: TransientCommand) {
        match command {
            TransientCommand::Run(setup) => self.start(ctx, store, *setup),
            TransientCommand::Follow(setup) => self.follow(ctx, store, *setup),
            TransientCommand::Stop => self.stop(),
            TransientCommand::GoTo(time) => self.player.go_to(time),
            TransientCommand::TogglePlay => self.player.toggle(),
            TransientCommand::PlayOn(seconds) => {
                let duration = self.setup.as_ref().map_or(0.0, |setup| setup.study.duration);
                self.player.advance(seconds, duration);
            }
            TransientCommand::StudyNumber => {
                if let (Some(linearised), Some(full)) = (&self.linearised, self.reference_of_linearised()) {
                    let (model, full) = (Arc::clone(&linearised.model), full.without_fields());
                    self.number.start(ctx, model, full);
                }
            }
            TransientCommand::StopNumber => self.number.work.stop(),
        }
    }

    /// Returns the run of an animation: the first full one with fields.
    pub fn animated(&self) -> Option<&Run> {
        self.runs.iter().find(|run| run.by == MarchedBy::Full && run.trajectory.states.len() > 1)
    }

    /// Stops the runs and the study of their linearised model, and keeps their results.
    pub fn stop(&mut self) {
        self.following.rest();
        self.work.stop();
        self.number.work.stop();
    }

    /// Discards all runs and models, because another document is on the screen.
    pub fn forget(&mut self) {
        *self = Self { generation: self.generation + 1, ..Self::default() };
    }

    /// Runs a set-up from the beginning, unless it is refused.
    pub fn start(&mut self, ctx: &Context, store: &Store, setup: Setup) {
        let setup = Arc::new(setup);
        if self.begin(ctx, store, &setup, setup.question()) {
            self.following.by_hand(&setup);
            self.recorded.iter_mut().for_each(|recorded| recorded.by_hand = true);
            self.next = None;
            self.runs.clear();
            self.linearised = None;
            self.looking = Background::default();
            self.replace(setup);
            self.generation += 1;
            self.player = Player::default();
        }
    }

    /// Starts a study of a set-up. Returns false if the set-up is refused.
    pub(super) fn begin(&mut self, ctx: &Context, store: &Store, setup: &Arc<Setup>, question: Scene) -> bool {
        self.ctx = Some(ctx.clone());
        if let Err(error) = setup.study.own_march(setup.point, setup.lubricant, Frame::Fixed).problem() {
            self.work = Background::default();
            self.work.message = Some(error.to_string());
            self.recorded.iter_mut().for_each(|recorded| recorded.end(true));
            return false;
        }
        self.filled = Filled::None;
        self.next = Some(Arc::clone(setup));
        self.recorded = Some(Recorded::begin(setup, self.recorded.as_ref()));
        self.work.run(question.ask(Workbench::on(store, ""), wake(ctx)));
        true
    }
}

/// Inserts a run after the runs of its frame that precede it. Returns its index.
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
