//! The march of every method in every frame on a thread of its own, told step by step.

use super::method::{Method, run_name};
use super::{ModelSize, Setup};
use crate::app::task::{Ending, Reporter, Task};
use crate::harness::training_states;
use crate::scene::{ReducedTransient, sampled};
use crate::solver::full::Mesh;
use crate::solver::full::transient::{
    Ended, FullMarch, Keep, Marching, Moment, State, TimeStep, Trajectory, Transient, TransientObserver, march,
};
use crate::solver::grid::ReferenceGrid;
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::training::{TrainingError, TrainingObserver, TrajectoryTraining, train_trajectories};
use egui::Context;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Fields that are kept of a run, evenly over its duration: what the player shows.
const PICTURES: f64 = 400.0;

/// What a march tells.
pub enum News {
    /// A run begins.
    Begun {
        /// How its steps are solved.
        method: Method,
        /// It, with nothing in it yet.
        trajectory: Box<Trajectory>,
        /// What the reduced model is made of, if it is one.
        model: Option<ModelSize>,
    },
    /// A moment, and the seconds since the one before.
    Moment(Moment, f64),
    /// Fields of the moment told last.
    State(State),
    /// The run has ended, with this number of discarded steps.
    Ended(Ended, usize),
}

/// Starts all runs, one after the other.
pub fn start(ctx: &Context, setup: Arc<Setup>) -> Task<News> {
    Task::start(ctx, "Contact in time", move |reporter| work(&setup, reporter))
}

fn work(setup: &Setup, reporter: &Reporter<News>) -> Ending {
    let study = &setup.study;
    let mut inputs = study.inputs.clone();
    if let Some(path) = &setup.sampled {
        sampled::read_into(&mut inputs, path).map_err(said)?;
    }
    let grid = setup.grid.build().map_err(said)?;
    for &frame in &study.frames {
        let keep = match &study.reduced {
            Some(reduced) if reduced.trainings.is_empty() => training_states(study.duration, study.time_step),
            _ => Keep::Scalars,
        };
        let transient = Transient { inputs: inputs.clone(), keep, ..setup.march(frame) };
        let mut model = FullMarch::new(Arc::clone(&grid), &transient).map_err(said)?;
        let full = run(Method::Full, None, &mut model, &transient, reporter)?;
        let trained = match &study.reduced {
            Some(reduced) if full.finished() => train(setup, reduced, &grid, &full, reporter)?,
            _ => None,
        };
        if let Some((model, size)) = trained {
            let transient = Transient { keep: Keep::Scalars, ..transient };
            run(Method::Reduced, Some(size), &mut ReducedMarch::new(&model).map_err(said)?, &transient, reporter)?;
        }
        if reporter.cancelled() {
            break;
        }
    }
    Ok(())
}

fn said(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// One run, told step by step.
fn run(
    method: Method,
    size: Option<ModelSize>,
    model: &mut dyn Marching,
    transient: &Transient,
    reporter: &Reporter<News>,
) -> Result<Trajectory, String> {
    let grid = model.grid();
    let trajectory = Trajectory {
        problem: transient.problem().map_err(said)?,
        transient: transient.clone(),
        mesh: Mesh::Line { spec: grid.reference.spec, scale: grid.scale },
        x: grid.x.clone(),
        moments: Vec::new(),
        states: Vec::new(),
        rejected_steps: 0,
        ended: Ended::Finished,
    };
    reporter.send(News::Begun { method, trajectory: Box::new(trajectory), model: size });
    let mut watch = Watch::new(run_name(method, transient.frame), transient, reporter, true);
    let trajectory = march(model, transient, &mut watch).map_err(said)?;
    reporter.send(News::Ended(trajectory.ended.clone(), trajectory.rejected_steps));
    Ok(trajectory)
}

/// The reduced model of a frame, from trainings of its own or from the full trajectory that it shall reproduce; `None` when it was stopped.
fn train(
    setup: &Setup,
    reduced: &ReducedTransient,
    grid: &Arc<ReferenceGrid>,
    own: &Trajectory,
    reporter: &Reporter<News>,
) -> Result<Option<(TrajectoryModel, ModelSize)>, String> {
    let clock = Instant::now();
    let mut trainings = Vec::new();
    for (k, training) in reduced.trainings.iter().enumerate() {
        let point = match training.at {
            Some(at) => at.with_alpha_of(&setup.lubricant).point(setup.point.kind).map_err(said)?,
            None => setup.point,
        };
        let transient = Transient {
            point,
            inputs: training.inputs.clone(),
            duration: training.duration,
            keep: training_states(training.duration, setup.study.time_step),
            ..own.transient.clone()
        };
        let stage = format!("Training {} of {}", k + 1, reduced.trainings.len());
        let mut watch = Watch::new(stage, &transient, reporter, false);
        let mut model = FullMarch::new(Arc::clone(grid), &transient).map_err(said)?;
        trainings.push(march(&mut model, &transient, &mut watch).map_err(said)?);
        if reporter.cancelled() {
            return Ok(None);
        }
    }
    reporter.stage("Reduced model from the trajectories", 0, 0);
    let settings = TrajectoryTraining { loss: reduced.loss, rows_per_mode: reduced.rows_per_mode, seed: reduced.seed };
    let all = if trainings.is_empty() { std::slice::from_ref(own) } else { &trainings[..] };
    match train_trajectories(grid, all, &settings, &Stop(reporter.observer())) {
        Ok(model) => {
            let modes = model.window.pressure.modes.ncols();
            let rows = model.window.sampled_rows.len();
            let size = ModelSize { modes, rows, training_s: clock.elapsed().as_secs_f64() };
            Ok(Some((model, size)))
        }
        Err(TrainingError::Cancelled) => Ok(None),
        Err(error) => Err(said(error)),
    }
}

/// Stops a training along with the work.
struct Stop<'a>(&'a AtomicBool);

impl TrainingObserver for Stop<'_> {
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Tells of every moment, and of some with their fields.
struct Watch<'a> {
    reporter: &'a Reporter<News>,
    stage: String,
    duration: f64,
    time_step: TimeStep,
    /// Whether its moments are shown.
    shown: bool,
    steps: usize,
    time: f64,
    next_picture: f64,
    since: Instant,
}

impl<'a> Watch<'a> {
    fn new(stage: String, transient: &Transient, reporter: &'a Reporter<News>, shown: bool) -> Self {
        reporter.stage(&stage, 0, 0);
        let (duration, time_step) = (transient.duration, transient.time_step);
        Self {
            reporter,
            stage,
            duration,
            time_step,
            shown,
            steps: 0,
            time: 0.0,
            next_picture: 0.0,
            since: Instant::now(),
        }
    }
}

impl TransientObserver for Watch<'_> {
    fn moment(&mut self, moment: &Moment) {
        let seconds = self.since.elapsed().as_secs_f64();
        self.since = Instant::now();
        self.time = moment.time;
        if self.shown {
            self.reporter.send(News::Moment(*moment, seconds));
        }
        let (done, total) = match self.time_step {
            TimeStep::Fixed(step) => (self.steps, (self.duration / step).round() as usize),
            TimeStep::Adaptive { .. } => ((100.0 * moment.time / self.duration) as usize, 100),
        };
        self.steps += 1;
        self.reporter.stage(&self.stage, done.min(total), total);
    }

    fn wants_state(&self) -> bool {
        // Rounding must not leave out every second step of as many as there are pictures.
        let due = self.time >= self.next_picture - 1e-9 * self.duration || self.time >= self.duration;
        self.shown && due
    }

    fn state(&mut self, state: &State) {
        let interval = self.duration / PICTURES;
        self.next_picture = interval * ((state.time / interval + 1e-6).floor() + 1.0);
        self.reporter.send(News::State(state.clone()));
    }

    fn cancelled(&self) -> bool {
        self.reporter.cancelled()
    }
}
