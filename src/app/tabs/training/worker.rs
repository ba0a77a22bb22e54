//! Background execution of one training or comparison at a time, in separate threads, so that the live picture
//! stays responsive.

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

/// Number of checkpoints for the estimate of the pace.
const PACE: usize = 12;

/// End of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Ended {
    /// The plan was completed.
    Complete,
    /// The user stopped it.
    Stopped,
    /// It failed. With the reason as a sentence.
    Failed(String),
}

/// Result of a training.
#[derive(Serialize, Deserialize)]
pub struct Trained {
    /// All full solutions.
    #[serde(with = "training_file::whole")]
    pub state: TrainingState,
    /// End of the training.
    pub ended: Ended,
    /// The model, also after a stop or a failure, or the reason why there is none.
    pub made: Result<Made, Refusal>,
    /// Reason why it could not be stored on disk.
    pub unkept: Option<String>,
}

/// Model with the content of its file.
#[derive(Clone, Serialize, Deserialize)]
pub struct Made {
    pub model: Arc<ReducedModel>,
    /// Content of the file.
    pub bytes: Arc<Vec<u8>>,
    /// True if the session's folder stores it until it is saved or discarded.
    pub kept: bool,
    /// True if it was saved.
    pub saved: bool,
}

/// Files of the session for trainings.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Files {
    /// File of an unfinished training.
    pub training: PathBuf,
    /// File of the last model until it is saved or discarded.
    pub model: PathBuf,
}

/// Item that a previous session left.
pub enum Found {
    /// An unfinished training.
    Training(Box<TrainingState>),
    /// A model that was not saved.
    Model(Made),
}

/// Message of a running training.
#[derive(Serialize, Deserialize)]
pub enum News {
    /// Full solutions so far, and the seconds since its start.
    Chart(Arc<Chart>, f64),
    /// Reason why it is not stored on disk.
    Unkept(String),
    /// It has ended.
    Trained(Box<Trained>),
}

/// Returns the maximum number of full solutions of a plan.
fn most_solutions(spec: &TrainingSpec) -> usize {
    let per_window = match &spec.plan {
        Plan::FarthestPoint { snapshots } => *snapshots,
        Plan::Adaptive { limit, .. } | Plan::WorstOfPool { limit, .. } => *limit,
        Plan::Grid { nodes } => return nodes.iter().product(),
    };
    match &spec.windows {
        Windows::Given(windows) => per_window * windows.len(),
        Windows::Anchored { count, .. } => per_window * count,
        // The number of local models is not known in advance. It is at least one.
        Windows::Automatic { .. } => per_window,
    }
}

/// Training to start or resume, for a thread or another instance of the program.
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

/// Running training.
pub struct Running {
    /// Maximum number of full solutions.
    pub most: usize,
    /// True if there may be fewer.
    pub fewer: bool,
    /// Full solutions so far.
    pub chart: Arc<Chart>,
    /// Reason why it is not stored on disk, until it has been shown.
    pub unkept: Option<String>,
    /// Seconds and numbers of full solutions at the last checkpoints of the slowest part, which is the search if
    /// the plan has one.
    pace: VecDeque<(f64, usize)>,
    /// Time since the last of them.
    last: Stopwatch,
    trained: Option<Trained>,
    /// Job with its progress.
    pub job: Job<News>,
}

impl Running {
    /// Starts a training from a state. The state is stored in the file meanwhile.
    pub fn start(ctx: &egui::Context, state: TrainingState, files: Option<Files>) -> Self {
        let (most, fewer) = (most_solutions(&state.spec), state.spec.plan.searches());
        let chart = Arc::new(Chart::of(&state));
        let job = Job::of("Training", wake(ctx), &Store::default(), TrainingTask { state, files });
        let (pace, last) = (VecDeque::new(), job.since());
        Self { most, fewer, chart, unkept: None, pace, last, trained: None, job }
    }

    /// Receives the messages. Returns the ending and the result once the training has ended.
    pub fn receive(&mut self) -> Option<(Ending, Option<Trained>)> {
        let Self { fewer, chart, unkept, pace, last, trained, job, .. } = self;
        let ending = job.poll(|news| match news {
            News::Chart(latest, seconds) => {
                // A search trains again after every solution. The pace of the planned solutions therefore gives no
                // estimate for it.
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

    /// Returns the remaining seconds at the present pace if the plan takes its maximum number of full solutions.
    pub fn time_left(&self) -> Option<f64> {
        let ((begin, from), (end, to)) = (self.pace.front()?, self.pace.back()?);
        let done = to.checked_sub(*from).filter(|done| *done > 0)?;
        let per_solution = (end - begin) / done as f64;
        let left = per_solution * self.most.saturating_sub(*to) as f64 - self.last.seconds();
        Some(left.max(0.0))
    }
}

/// Observer that shows a training in the window and stores it on disk.
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

/// Starts the search for files of a previous session. The job sends nothing if there are none.
pub fn look(ctx: &egui::Context, files: Files) -> Job<Found> {
    Job::start("Searching for unfinished trainings", wake(ctx), move |reporter| {
        // Read the model first, because an unreadable model must not hide a training.
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
        // The same failure would occur here.
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

/// Returns the model of the present full solutions, unless that is also cancelled.
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
