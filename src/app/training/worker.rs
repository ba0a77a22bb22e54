//! One training or comparison at a time, on threads of its own, so that the live picture keeps answering.

use super::chart::Chart;
use crate::app::jobs::guarded;
use crate::engine::training_file::{self, TrainingKeeper};
use crate::engine::{ModelComparison, compare_models, model_file};
use crate::solver::reduced::ReducedModel;
use crate::solver::training::{
    Observer, Plan, Progress, TrainingError, TrainingObserver, TrainingSpec, TrainingState, Windows, train_resumable,
};
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Random points at which two models are compared.
const COMPARED_POINTS: usize = 200;
/// Seed of those points: the same ones for every pair.
const COMPARED_SEED: u64 = 31;
/// Shortest time between two repaints.
const REPAINT: Duration = Duration::from_millis(100);
/// Checkpoints by which the pace is judged.
const PACE: usize = 12;

/// What is to be done.
pub enum Task {
    /// Look for a training that a former session left behind.
    Look(PathBuf),
    /// Train on from a state; it is kept in the file meanwhile.
    Train(Box<TrainingState>, Option<PathBuf>),
    /// Compare two models over the range of the second's training.
    Compare(Arc<ReducedModel>, Arc<ReducedModel>, Box<TrainingSpec>),
}

/// What came of it.
pub enum Outcome {
    /// What a former session left behind, or a sentence why it is of no use.
    Found(Result<Option<Box<TrainingState>>, String>),
    /// The end of a training.
    Trained(Box<Trained>),
    /// The comparison, or why there is none.
    Compared(Result<ModelComparison, String>),
}

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
    pub made: Result<Made, String>,
    /// Why it could not be kept on disk.
    pub unkept: Option<String>,
}

/// A model with the content of its file.
#[derive(Clone)]
pub struct Made {
    /// The model.
    pub model: Arc<ReducedModel>,
    /// What is written when it is saved.
    pub bytes: Arc<Vec<u8>>,
}

/// How far the work is.
#[derive(Default)]
pub struct Live {
    /// Present step.
    pub progress: Option<Progress>,
    /// Full solutions so far.
    pub chart: Arc<Chart>,
    /// Most full solutions there will be.
    pub most: usize,
    /// Whether there may be fewer.
    pub fewer: bool,
    /// The last checkpoints with their numbers of full solutions, of the slowest part: the search, where there is one.
    pace: VecDeque<(Instant, usize)>,
}

impl Live {
    /// Seconds left at the present pace, when all full solutions are taken that the plan allows.
    pub fn time_left(&self) -> Option<f64> {
        let ((begin, from), (end, to)) = (self.pace.front()?, self.pace.back()?);
        let done = to.checked_sub(*from).filter(|done| *done > 0)?;
        let per_solution = end.duration_since(*begin).as_secs_f64() / done as f64;
        let left = per_solution * self.most.saturating_sub(*to) as f64 - end.elapsed().as_secs_f64();
        Some(left.max(0.0))
    }
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
        // How many it will be is not known before; one is the least.
        Windows::Automatic { .. } => per_window,
    }
}

/// Work that runs.
pub struct Job {
    /// What it is, for people.
    pub name: &'static str,
    /// Whether it is a training.
    pub trains: bool,
    /// When it began.
    pub since: Instant,
    live: Arc<Mutex<Live>>,
    stop: Arc<AtomicBool>,
    abandon: Arc<AtomicBool>,
    outcome: Receiver<Outcome>,
}

impl Job {
    /// Begins.
    pub fn start(ctx: &egui::Context, task: Task) -> Self {
        let mut live = Live::default();
        let name = match &task {
            Task::Look(_) => "Looking for an unfinished training",
            Task::Train(state, _) => {
                live.chart = Arc::new(Chart::of(state));
                live.most = most_solutions(&state.spec);
                live.fewer = state.spec.plan.searches();
                "Training"
            }
            Task::Compare(..) => "Comparing two models",
        };
        let trains = matches!(task, Task::Train(..));
        let live = Arc::new(Mutex::new(live));
        let (stop, abandon) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let (sender, outcome) = channel();
        let watch = Watch {
            live: Arc::clone(&live),
            cancel: Arc::clone(&stop),
            keeper: None,
            ctx: ctx.clone(),
            painted: None.into(),
        };
        let last = Arc::clone(&abandon);
        // Where no thread can be had the channel closes at once, which ends the job with a sentence.
        let _handle = std::thread::Builder::new().name("training".to_owned()).spawn(move || {
            let ctx = watch.ctx.clone();
            let outcome = match rayon::ThreadPoolBuilder::new().num_threads(threads()).build() {
                Ok(pool) => pool.install(|| work(task, watch, last)),
                Err(_) => work(task, watch, last),
            };
            // The window may be gone: then nobody waits.
            let _ = sender.send(outcome);
            ctx.request_repaint();
        });
        Self { name, trains, since: Instant::now(), live, stop, abandon, outcome }
    }

    /// What came of it, once it has ended.
    pub fn poll(&self) -> Option<Result<Outcome, String>> {
        use std::sync::mpsc::TryRecvError;
        match self.outcome.try_recv() {
            Ok(outcome) => Some(Ok(outcome)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("the work ended without a result".to_owned())),
        }
    }

    /// Stops it and keeps what there is; asked again, does not even make a model of that.
    pub fn stop(&self) {
        if self.stop.swap(true, Ordering::Relaxed) {
            self.abandon.store(true, Ordering::Relaxed);
        }
    }

    /// Whether it was asked to stop.
    pub fn stopping(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// How far it is.
    pub fn live(&self) -> MutexGuard<'_, Live> {
        // Whoever panicked while writing left a picture that is only to look at.
        self.live.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        self.abandon.store(true, Ordering::Relaxed);
    }
}

/// All cores but one, which is the window's and the live picture's.
fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, |cores| cores.get().saturating_sub(1).max(1))
}

/// Shows the work in the window and keeps it on disk.
struct Watch {
    live: Arc<Mutex<Live>>,
    cancel: Arc<AtomicBool>,
    keeper: Option<TrainingKeeper>,
    ctx: egui::Context,
    painted: Mutex<Option<Instant>>,
}

impl Watch {
    fn change(&self, change: impl FnOnce(&mut Live)) {
        change(&mut self.live.lock().unwrap_or_else(PoisonError::into_inner));
        let mut painted = self.painted.lock().unwrap_or_else(PoisonError::into_inner);
        if painted.is_none_or(|at| at.elapsed() > REPAINT) {
            *painted = Some(Instant::now());
            self.ctx.request_repaint();
        }
    }
}

impl Observer for Watch {
    fn progress(&self, progress: Progress) {
        self.change(|live| live.progress = Some(progress));
    }

    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }
}

impl TrainingObserver for Watch {
    fn checkpoint(&self, state: &TrainingState) {
        if let Some(keeper) = &self.keeper {
            keeper.checkpoint(state);
        }
        let chart = Arc::new(Chart::of(state));
        self.change(|live| {
            // A search retrains for every solution: how fast the first ones came says nothing about it.
            if live.fewer == chart.solved.last().is_some_and(|dot| dot.searched) {
                if live.pace.len() == PACE {
                    live.pace.pop_front();
                }
                live.pace.push_back((Instant::now(), chart.solved.len()));
            }
            live.chart = chart;
        });
    }
}

fn work(task: Task, watch: Watch, abandon: Arc<AtomicBool>) -> Outcome {
    match task {
        Task::Look(path) => Outcome::Found(look(path)),
        Task::Train(state, file) => Outcome::Trained(Box::new(train(*state, file, watch, abandon))),
        Task::Compare(former, made, spec) => {
            let models = [former, made];
            let compared = guarded(|| {
                compare_models(&models, &spec.range, spec.lubricant, COMPARED_POINTS, COMPARED_SEED, &watch)
            });
            Outcome::Compared(compared.and_then(|result| result.map_err(|error| error.to_string())))
        }
    }
}

fn look(path: PathBuf) -> Result<Option<Box<TrainingState>>, String> {
    if !path.exists() {
        return Ok(None);
    }
    training_file::read(&path).map(|state| Some(Box::new(state))).map_err(|error| error.to_string())
}

fn train(mut state: TrainingState, file: Option<PathBuf>, mut watch: Watch, abandon: Arc<AtomicBool>) -> Trained {
    watch.keeper = file.map(TrainingKeeper::new);
    let result = guarded(|| train_resumable(&mut state, &watch));
    let keeper = watch.keeper.take();
    let (ended, made) = match result {
        Ok(Ok(model)) => (Ended::Complete, file_of(model)),
        Ok(Err(TrainingError::Cancelled)) => (Ended::Stopped, rest(&state, watch, abandon)),
        Ok(Err(error)) => (Ended::Failed(error.to_string()), rest(&state, watch, abandon)),
        // Whatever broke there would break here too.
        Err(message) => (Ended::Failed(message.clone()), Err(message)),
    };
    let kept = match (keeper, &ended) {
        (Some(keeper), Ended::Complete) => keeper.discard(),
        (Some(keeper), _) if state.solutions() > 0 => keeper.keep(&state),
        _ => Ok(()),
    };
    Trained { state, ended, made, unkept: kept.err().map(|error| error.to_string()) }
}

/// The model of what there is, unless that is not wanted either.
fn rest(state: &TrainingState, watch: Watch, abandon: Arc<AtomicBool>) -> Result<Made, String> {
    let watch = Watch { cancel: abandon, ..watch };
    guarded(|| state.model(&watch)).and_then(|result| match result {
        Ok(model) => file_of(model),
        Err(TrainingError::Cancelled) => Err("no model was made of them".to_owned()),
        Err(error) => Err(error.to_string()),
    })
}

fn file_of(model: ReducedModel) -> Result<Made, String> {
    let bytes = model_file::to_bytes(&model).map_err(|error| error.to_string())?;
    Ok(Made { model: Arc::new(model), bytes: Arc::new(bytes) })
}
