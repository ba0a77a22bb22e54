//! One training or comparison at a time, on threads of its own, so that the live picture keeps answering.

use crate::app::refusal::Refusal;
use crate::app::tabs::training::chart::Chart;
use crate::app::wake::wake;
use crate::engine::job::{Ending, Job, Reporter, Task, guarded};
use crate::engine::training_file::{self, TrainingKeeper};
use crate::engine::{Store, model_file};
use crate::host::clock::Stopwatch;
use crate::host::pool::on_spare_cores;
use crate::scene::atomic_file;
use crate::solver::reduced::ReducedModel;
use crate::solver::training::{
    Observer, Plan, Progress, TrainingError, TrainingObserver, TrainingSpec, TrainingState, Windows, train_resumable,
};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Checkpoints by which the pace is judged.
const PACE: usize = 12;

/// How a training ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Ended {
    /// By its plan.
    Complete,
    /// By the user.
    Stopped,
    /// By what the sentence says.
    Failed(String),
}

/// What a training leaves.
#[derive(Serialize, Deserialize)]
pub struct Trained {
    /// Everything that was solved.
    #[serde(with = "training_file::whole")]
    pub state: TrainingState,
    /// How it ended.
    pub ended: Ended,
    /// The model, also of a training that was stopped or failed; or a sentence why there is none.
    pub made: Result<Made, Refusal>,
    /// Why it could not be kept on disk.
    pub unkept: Option<String>,
}

/// A model with the content of its file.
#[derive(Clone, Serialize, Deserialize)]
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
#[derive(Clone, Debug, Serialize, Deserialize)]
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

/// News of a training.
#[derive(Serialize, Deserialize)]
pub enum News {
    /// Full solutions so far, and the seconds from its beginning until then.
    Chart(Arc<Chart>, f64),
    /// Why it is not kept on disk.
    Unkept(String),
    /// It has ended.
    Trained(Box<Trained>),
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

/// A training that begins or goes on, for a thread or another instance of the program.
#[derive(Serialize, Deserialize)]
pub struct TrainingTask {
    #[serde(with = "training_file::whole")]
    state: TrainingState,
    files: Option<Files>,
}

impl Task for TrainingTask {
    const KIND: &'static str = "training";
    const LANE: usize = 1;
    type Message = News;

    fn run(self, _store: &Store, reporter: &Reporter<News>) -> Ending {
        let watched = Watched { reporter, begun: Stopwatch::start(), keeper: None };
        let trained = on_spare_cores(|| train(self.state, self.files, watched));
        reporter.send(News::Trained(Box::new(trained)));
        Ok(())
    }
}

/// A training that runs.
pub struct Running {
    /// Most full solutions there will be.
    pub most: usize,
    /// Whether there may be fewer.
    pub fewer: bool,
    /// Full solutions so far.
    pub chart: Arc<Chart>,
    /// Why it is not kept on disk, until that is told.
    pub unkept: Option<String>,
    /// Seconds and numbers of full solutions at the last checkpoints of the slowest part: the search, where there is one.
    pace: VecDeque<(f64, usize)>,
    /// When the last of them came.
    last: Stopwatch,
    trained: Option<Trained>,
    /// How far it is.
    pub job: Job<News>,
}

impl Running {
    /// Trains on from a state; it is kept in the file meanwhile.
    pub fn start(ctx: &egui::Context, state: TrainingState, files: Option<Files>) -> Self {
        let (most, fewer) = (most_solutions(&state.spec), state.spec.plan.searches());
        let chart = Arc::new(Chart::of(&state));
        let job = Job::of("Training", wake(ctx), &Store::default(), TrainingTask { state, files });
        let (pace, last) = (VecDeque::new(), job.since());
        Self { most, fewer, chart, unkept: None, pace, last, trained: None, job }
    }

    /// Takes in the news; how it ended and what came of it, once it has ended.
    pub fn receive(&mut self) -> Option<(Ending, Option<Trained>)> {
        let Self { fewer, chart, unkept, pace, last, trained, job, .. } = self;
        let ending = job.poll(|news| match news {
            News::Chart(latest, seconds) => {
                // A search retrains for every solution: how fast the first ones came says nothing about it.
                if *fewer == latest.solved.last().is_some_and(|dot| dot.searched) {
                    if pace.len() == PACE {
                        pace.pop_front();
                    }
                    pace.push_back((seconds, latest.solved.len()));
                    *last = Stopwatch::start();
                }
                *chart = latest;
            }
            News::Unkept(why) => *unkept = Some(why),
            News::Trained(came) => *trained = Some(*came),
        })?;
        Some((ending, self.trained.take()))
    }

    /// Seconds left at the present pace, when all full solutions are taken that the plan allows.
    pub fn time_left(&self) -> Option<f64> {
        let ((begin, from), (end, to)) = (self.pace.front()?, self.pace.back()?);
        let done = to.checked_sub(*from).filter(|done| *done > 0)?;
        let per_solution = (end - begin) / done as f64;
        let left = per_solution * self.most.saturating_sub(*to) as f64 - self.last.seconds();
        Some(left.max(0.0))
    }
}

/// Shows the work in the window and keeps it on disk.
struct Watched<'a> {
    reporter: &'a Reporter<News>,
    begun: Stopwatch,
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
            self.reporter.send(News::Unkept(reason.to_string()));
        }
        self.reporter.send(News::Chart(Arc::new(Chart::of(state)), self.begun.seconds()));
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
        Err(reason) => {
            watch.reporter.send(News::Unkept(format!("{reason}. This training is not kept on disk")));
        }
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
fn rest(state: &TrainingState, reporter: &Reporter<News>) -> Result<Made, Refusal> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::job::{Event, Performer, perform};
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::training::small::moes;
    use std::sync::mpsc::channel;

    #[test]
    fn another_instance_of_the_program_trains_the_same_model() {
        let grid = GridSpec::Uniform { dx: 0.05, domain: (-4.0, 2.0) };
        let plan = Plan::FarthestPoint { snapshots: 8 };
        let spec = TrainingSpec::new(moes((10.0, 14.0), (2.0, 3.0), 3e9), (10.0, 14.0), grid, plan);
        let task = TrainingTask { state: TrainingState::new(spec), files: None };
        let bytes = rmp_serde::to_vec_named(&task).unwrap();
        let (sender, events) = channel();
        let send = Box::new(move |event| sender.send(event).unwrap());
        perform::<TrainingTask>(&bytes, &Store::default(), Performer { send, stops: Box::new(|| 0) });
        let (mut solutions, mut trained) = (0, None);
        for event in events {
            match rmp_serde::from_slice::<Event<News>>(&event).unwrap() {
                Event::Message(News::Chart(chart, _)) => solutions = chart.solved.len(),
                Event::Message(News::Unkept(why)) => panic!("{why}"),
                Event::Message(News::Trained(came)) => trained = Some(*came),
                Event::Stage(_) => {}
                Event::Ended(ending) => assert_eq!(ending, Ok(())),
            }
        }
        let Trained { state, ended, made, unkept } = trained.unwrap();
        assert_eq!((ended, unkept, solutions), (Ended::Complete, None, 8));
        let mut own = TrainingState::new(task.state.spec);
        let model = train_resumable(&mut own, &()).unwrap();
        assert_eq!(state, own);
        assert_eq!(*made.unwrap().bytes, model_file::to_bytes(&model).unwrap());
    }
}
