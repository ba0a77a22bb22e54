//! One training or comparison at a time, on threads of its own, so that the live picture keeps answering.

use crate::app::refusal::Refusal;
use crate::app::tabs::training::chart::Chart;
use crate::app::wake::wake;
use crate::engine::job::{Ending, Job, Reporter, guarded};
use crate::engine::model_file;
use crate::engine::training_file::{self, TrainingKeeper};
use crate::host::clock::Stopwatch;
use crate::host::pool::on_spare_cores;
use crate::scene::atomic_file;
use crate::solver::reduced::ReducedModel;
use crate::solver::training::{
    Observer, Plan, Progress, TrainingError, TrainingObserver, TrainingSpec, TrainingState, Windows, train_resumable,
};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Checkpoints by which the pace is judged.
const PACE: usize = 12;

/// How a training ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// By its plan.
    Complete,
    /// By the user.
    Stopped,
    /// By what the sentence says.
    Failed(String),
}

/// What a training leaves.
pub struct Trained {
    /// Everything that was solved.
    pub state: TrainingState,
    /// How it ended.
    pub ended: Ended,
    /// The model, also of a training that was stopped or failed; or a sentence why there is none.
    pub made: Result<Made, Refusal>,
    /// Why it could not be kept on disk.
    pub unkept: Option<String>,
}

/// A model with the content of its file.
#[derive(Clone)]
pub struct Made {
    pub model: Arc<ReducedModel>,
    /// What is written when it is saved.
    pub bytes: Arc<Vec<u8>>,
    /// Whether the session's folder keeps it until it is saved or thrown away.
    pub kept: bool,
    /// Whether it was saved.
    pub saved: bool,
}

/// Where a session keeps what trainings leave.
#[derive(Clone, Debug)]
pub struct Files {
    /// A training that is not at its end.
    pub training: PathBuf,
    /// The last model, until it is saved or thrown away.
    pub model: PathBuf,
}

/// What a former session left.
pub enum Found {
    /// A training that is not at its end.
    Training(Box<TrainingState>),
    /// A model that was not saved.
    Model(Made),
}

/// What a training has found so far; only the last state of it is of interest.
#[derive(Default)]
struct Live {
    /// Full solutions so far.
    chart: Arc<Chart>,
    /// The last checkpoints with their numbers of full solutions, of the slowest part: the search, where there is one.
    pace: VecDeque<(Stopwatch, usize)>,
    /// Why it is not kept on disk, until that is told.
    unkept: Option<String>,
}

/// Most full solutions a plan takes.
fn most_solutions(spec: &TrainingSpec) -> usize {
    let per_window = match &spec.plan {
        Plan::FarthestPoint { snapshots } => *snapshots,
        Plan::Adaptive { limit, .. } | Plan::WorstOfPool { limit, .. } => *limit,
        Plan::Grid { nodes } => return nodes.iter().product(),
    };
    match &spec.windows {
        Windows::Given(windows) => per_window * windows.len(),
        Windows::Anchored { count, .. } => per_window * count,
        // How many it will be is not known before; one is the least.
        Windows::Automatic { .. } => per_window,
    }
}

/// A training that runs.
pub struct Running {
    /// Most full solutions there will be.
    pub most: usize,
    /// Whether there may be fewer.
    pub fewer: bool,
    live: Arc<Mutex<Live>>,
    trained: Option<Trained>,
    /// How far it is.
    pub job: Job<Trained>,
}

impl Running {
    /// Trains on from a state; it is kept in the file meanwhile.
    pub fn start(ctx: &egui::Context, state: TrainingState, files: Option<Files>) -> Self {
        let (most, fewer) = (most_solutions(&state.spec), state.spec.plan.searches());
        let live = Arc::new(Mutex::new(Live { chart: Arc::new(Chart::of(&state)), ..Live::default() }));
        let theirs = Arc::clone(&live);
        let job = Job::start("Training", wake(ctx), move |reporter| {
            let watched = Watched { reporter, live: theirs, searches: fewer, keeper: None };
            reporter.send(on_spare_cores(|| train(state, files, watched)));
            Ok(())
        });
        Self { most, fewer, live, trained: None, job }
    }

    /// How it ended and what came of it, once it has ended.
    pub fn receive(&mut self) -> Option<(Ending, Option<Trained>)> {
        let trained = &mut self.trained;
        let ending = self.job.poll(|came| *trained = Some(came))?;
        Some((ending, self.trained.take()))
    }

    /// Why the training is not kept on disk, once.
    pub fn unkept(&self) -> Option<String> {
        lock(&self.live).unkept.take()
    }

    /// Full solutions so far.
    pub fn chart(&self) -> Arc<Chart> {
        Arc::clone(&lock(&self.live).chart)
    }

    /// Seconds left at the present pace, when all full solutions are taken that the plan allows.
    pub fn time_left(&self) -> Option<f64> {
        let live = lock(&self.live);
        let ((begin, from), (end, to)) = (live.pace.front()?, live.pace.back()?);
        let done = to.checked_sub(*from).filter(|done| *done > 0)?;
        let per_solution = (begin.seconds() - end.seconds()) / done as f64;
        let left = per_solution * self.most.saturating_sub(*to) as f64 - end.seconds();
        Some(left.max(0.0))
    }
}

fn lock(live: &Mutex<Live>) -> MutexGuard<'_, Live> {
    // Whoever panicked while writing left a picture that is only to look at.
    live.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shows the work in the window and keeps it on disk.
struct Watched<'a> {
    reporter: &'a Reporter<Trained>,
    live: Arc<Mutex<Live>>,
    searches: bool,
    keeper: Option<TrainingKeeper>,
}

impl Observer for Watched<'_> {
    fn progress(&self, progress: Progress) {
        self.reporter.progress(progress);
    }

    fn cancelled(&self) -> bool {
        self.reporter.cancelled()
    }
}

impl TrainingObserver for Watched<'_> {
    fn checkpoint(&self, state: &TrainingState) {
        if let Some(Err(reason)) = self.keeper.as_ref().map(|keeper| keeper.checkpoint(state)) {
            lock(&self.live).unkept = Some(reason.to_string());
        }
        let chart = Arc::new(Chart::of(state));
        let mut live = lock(&self.live);
        // A search retrains for every solution: how fast the first ones came says nothing about it.
        if self.searches == chart.solved.last().is_some_and(|dot| dot.searched) {
            if live.pace.len() == PACE {
                live.pace.pop_front();
            }
            live.pace.push_back((Stopwatch::start(), chart.solved.len()));
        }
        live.chart = chart;
    }
}

/// Begins to look for what a former session left behind; nothing comes where there is nothing.
pub fn look(ctx: &egui::Context, files: Files) -> Job<Found> {
    Job::start("Looking for what was left", wake(ctx), move |reporter| {
        // A model comes first: one that cannot be read is no reason to leave a training alone.
        let model = files.model.exists().then(|| found_model(&files.model));
        if let Some(Ok(made)) = model {
            reporter.send(Found::Model(made));
        }
        if files.training.exists() {
            let state = training_file::read(&files.training).map_err(|error| error.to_string())?;
            reporter.send(Found::Training(Box::new(state)));
        }
        Ok(())
    })
}

fn found_model(path: &Path) -> Result<Made, Refusal> {
    let model = model_file::read(path)?;
    let bytes = std::fs::read(path)?;
    Ok(Made { model: Arc::new(model), bytes: Arc::new(bytes), kept: true, saved: false })
}

fn train(mut state: TrainingState, files: Option<Files>, mut watch: Watched<'_>) -> Trained {
    let model_path = files.as_ref().map(|files| files.model.clone());
    match files.map(|files| TrainingKeeper::new(files.training)).transpose() {
        Ok(keeper) => watch.keeper = keeper,
        Err(reason) => lock(&watch.live).unkept = Some(format!("{reason}. This training is not kept on disk")),
    }
    let result = guarded(|| train_resumable(&mut state, &watch));
    let keeper = watch.keeper.take();
    let (ended, made) = match result {
        Ok(Ok(model)) => (Ended::Complete, file_of(model)),
        Ok(Err(TrainingError::Cancelled)) => (Ended::Stopped, rest(&state, watch.reporter)),
        Ok(Err(error)) => (Ended::Failed(error.to_string()), rest(&state, watch.reporter)),
        // Whatever broke there would break here too.
        Err(broken) => (Ended::Failed(broken.to_string()), Err(broken.into())),
    };
    let kept = match (keeper, &ended) {
        (Some(keeper), Ended::Complete) => keeper.discard(),
        (Some(keeper), _) if state.solutions() > 0 => keeper.keep(&state),
        _ => Ok(()),
    };
    let mut unkept = kept.err().map(|error| error.to_string());
    let made = made.map(|made| match model_path.map(|path| atomic_file::replace(&path, &made.bytes)) {
        Some(Ok(())) => Made { kept: true, ..made },
        Some(Err(error)) => {
            unkept.get_or_insert(format!("{error}. The model is kept only while this window is open"));
            made
        }
        None => made,
    });
    Trained { state, ended, made, unkept }
}

/// The model of what there is, unless that is not wanted either.
fn rest(state: &TrainingState, reporter: &Reporter<Trained>) -> Result<Made, Refusal> {
    match guarded(|| state.model(&reporter.abandoned()))? {
        Ok(model) => file_of(model),
        Err(TrainingError::Cancelled) => Err(Refusal::new("no model was made of them")),
        Err(error) => Err(error.into()),
    }
}

fn file_of(model: ReducedModel) -> Result<Made, Refusal> {
    let bytes = model_file::to_bytes(&model)?;
    Ok(Made { model: Arc::new(model), bytes: Arc::new(bytes), kept: false, saved: false })
}
