//! The march of every method in every frame on a thread of its own, told step by step.

use super::linearised::{Linearised, OtherRule};
use super::method::{Method, run_name};
use super::{ModelSize, Setup};
use crate::app::answers::jobs::wake;
use crate::engine::job::{Ending, Job, Reporter};
use crate::engine::train_linearised;
use crate::scene::{LinearisedTransient, ReducedTransient, TransientStudy, sampled};
use crate::solver::discrete::grid::ReferenceGrid;
use crate::solver::full::Mesh;
use crate::solver::full::transient::{
    Ended, Frame, FullMarch, Keep, Marching, Moment, State, TimeStep, Trajectory, Transient, TransientObserver, march,
};
use crate::solver::observer::Observer;
use crate::solver::reduced::tpwl::{TpwlError, TpwlMarch, TpwlRecord};
use crate::solver::reduced::transient::{ReducedMarch, TrajectoryModel};
use crate::solver::training::{TrainingError, TrajectoryTraining, on_one_thread, train_trajectories};
use egui::Context;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
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
    /// The linearised model that comes next.
    Linearised(Arc<Linearised>),
    /// What each step of the linearised run drew on.
    Record(Box<TpwlRecord>),
    /// A model could not be had, for this reason.
    Refused(String),
    /// The run has ended, with this number of discarded steps.
    Ended(Ended, usize),
}

/// Starts all runs, one after the other.
pub fn start(ctx: &Context, setup: Arc<Setup>) -> Job<News> {
    Job::start("Contact in time", wake(ctx), move |reporter| work(&setup, reporter))
}

fn work(setup: &Setup, reporter: &Reporter<News>) -> Ending {
    let mut study = setup.study.clone();
    if let Some(path) = &setup.sampled {
        sampled::read_into(&mut study.inputs, path).map_err(said)?;
    }
    let grid = setup.grid.build().map_err(said)?;
    for &frame in &study.frames {
        let transient = study.own_march(setup.point, setup.lubricant, frame);
        let mut model = FullMarch::new(Arc::clone(&grid), &transient).map_err(said)?;
        let full = Arc::new(vec![run(Method::Full, None, &mut model, &transient, reporter)?]);
        if full.iter().all(Trajectory::finished) {
            // A model that cannot be had leaves the runs that can.
            if let Err(why) = models(&study, transient, &grid, full, reporter) {
                reporter.send(News::Refused(why));
            }
        }
        if reporter.cancelled() {
            break;
        }
    }
    Ok(())
}

/// The reduced and the linearised model of a frame, each trained and marched, after its full run.
fn models(
    study: &TransientStudy,
    own: Transient,
    grid: &Arc<ReferenceGrid>,
    full: Arc<Vec<Trajectory>>,
    reporter: &Reporter<News>,
) -> Ending {
    let linearised = study.linearised.as_ref().filter(|_| own.frame == Frame::Fixed);
    if study.reduced.is_none() && linearised.is_none() {
        return Ok(());
    }
    let clock = Instant::now();
    let Some(trained) = trainings(study, &own, grid, full, reporter)? else { return Ok(()) };
    let training_s = clock.elapsed().as_secs_f64();
    let transient = Transient { keep: Keep::Scalars, ..own };
    if let Some(reduced) = &study.reduced {
        let clock = Instant::now();
        if let Some(model) = train(reduced, grid, &trained, reporter)? {
            let modes = model.window.pressure.modes.ncols();
            let (chosen, training_s) = (model.window.sampled_rows.len(), training_s + clock.elapsed().as_secs_f64());
            let size = ModelSize { modes, chosen, what: "rows", training_s };
            run(Method::Reduced, Some(size), &mut ReducedMarch::new(&model).map_err(said)?, &transient, reporter)?;
        }
    }
    let Some(linearised) = linearised.filter(|_| !reporter.cancelled()) else { return Ok(()) };
    let clock = Instant::now();
    reporter.stage("Linearised model from the trajectories", 0, 0);
    let Some(shown) = linearise(linearised, study.trains_on_itself(), trained, reporter)? else { return Ok(()) };
    let model = Arc::clone(&shown.model);
    reporter.send(News::Linearised(Arc::new(shown)));
    let training_s = training_s + clock.elapsed().as_secs_f64();
    let (modes, chosen) = (model.space.modes(), model.points.len());
    let size = ModelSize { modes, chosen, what: "operating points", training_s };
    for &weighting in &linearised.weightings {
        let mut march = TpwlMarch::new(&model, &transient, weighting).map_err(said)?;
        run(Method::Linearised(weighting), Some(size), &mut march, &transient, reporter)?;
        reporter.send(News::Record(Box::new(march.record().clone())));
    }
    Ok(())
}

/// The linearised model of trajectories, with what the other rule would choose; `None` when it was stopped.
fn linearise(
    linearised: &LinearisedTransient,
    own: bool,
    trained: Arc<Vec<Trajectory>>,
    reporter: &Reporter<News>,
) -> Result<Option<Linearised>, String> {
    let settings = linearised.clone();
    let made = on_one_thread(reporter, move || {
        let model = train_linearised(&settings, &trained.iter().collect::<Vec<_>>())?;
        let other = OtherRule::of(&model);
        let trainings = trained.iter().map(|trajectory| trajectory.moments.clone()).collect();
        Ok(Linearised { model: Arc::new(model), trainings, own, other })
    });
    // What cannot be interrupted is left to itself when the work is stopped.
    made.map_or(Ok(None), |made| made.map(Some).map_err(|error: TpwlError| said(error)))
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
    let watch = Watch::new(run_name(method, transient.frame), transient, reporter, true);
    let trajectory = march(model, transient, &watch).map_err(said)?;
    reporter.send(News::Ended(trajectory.ended.clone(), trajectory.rejected_steps));
    Ok(trajectory)
}

/// The trajectories that models of a frame are trained by: those along given inputs, else the full run itself; `None` when it was stopped.
fn trainings(
    study: &TransientStudy,
    own: &Transient,
    grid: &Arc<ReferenceGrid>,
    full: Arc<Vec<Trajectory>>,
    reporter: &Reporter<News>,
) -> Result<Option<Arc<Vec<Trajectory>>>, String> {
    let transients = study.training_marches(own);
    if transients.is_empty() {
        return Ok(Some(full));
    }
    let mut marched = Vec::with_capacity(transients.len());
    for (k, transient) in transients.iter().enumerate() {
        let stage = format!("Training {} of {}", k + 1, transients.len());
        let watch = Watch::new(stage.clone(), transient, reporter, false);
        let mut model = FullMarch::new(Arc::clone(grid), transient).map_err(said)?;
        let trajectory = march(&mut model, transient, &watch).map_err(said)?;
        if reporter.cancelled() {
            return Ok(None);
        }
        if !trajectory.finished() {
            return Err(format!("{stage} {}", trajectory.ended.describe()));
        }
        marched.push(trajectory);
    }
    Ok(Some(Arc::new(marched)))
}

/// The reduced model of a frame; `None` when it was stopped.
fn train(
    reduced: &ReducedTransient,
    grid: &Arc<ReferenceGrid>,
    trained: &[Trajectory],
    reporter: &Reporter<News>,
) -> Result<Option<TrajectoryModel>, String> {
    reporter.stage("Reduced model from the trajectories", 0, 0);
    let settings = TrajectoryTraining { loss: reduced.loss, rows_per_mode: reduced.rows_per_mode, seed: reduced.seed };
    match train_trajectories(grid, trained, &settings, reporter) {
        Ok(model) => Ok(Some(model)),
        Err(TrainingError::Cancelled) => Ok(None),
        Err(error) => Err(said(error)),
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
    progress: Mutex<MarchProgress>,
}

/// How far the march that is watched is.
struct MarchProgress {
    steps: usize,
    time: f64,
    next_picture: f64,
    since: Instant,
}

impl<'a> Watch<'a> {
    fn new(stage: String, transient: &Transient, reporter: &'a Reporter<News>, shown: bool) -> Self {
        reporter.stage(&stage, 0, 0);
        let (duration, time_step) = (transient.duration, transient.time_step);
        let progress = Mutex::new(MarchProgress { steps: 0, time: 0.0, next_picture: 0.0, since: Instant::now() });
        Self { reporter, stage, duration, time_step, shown, progress }
    }

    fn progress(&self) -> MutexGuard<'_, MarchProgress> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Observer for Watch<'_> {
    fn cancelled(&self) -> bool {
        self.reporter.cancelled()
    }
}

impl TransientObserver for Watch<'_> {
    fn moment(&self, moment: &Moment) {
        let mut progress = self.progress();
        let seconds = progress.since.elapsed().as_secs_f64();
        progress.since = Instant::now();
        progress.time = moment.time;
        if self.shown {
            self.reporter.send(News::Moment(*moment, seconds));
        }
        let (done, total) = match self.time_step {
            TimeStep::Fixed(step) => (progress.steps, (self.duration / step).round() as usize),
            TimeStep::Adaptive { .. } => ((100.0 * moment.time / self.duration) as usize, 100),
        };
        progress.steps += 1;
        self.reporter.stage(&self.stage, done.min(total), total);
    }

    fn wants_state(&self) -> bool {
        // Rounding must not leave out every second step of as many as there are pictures.
        let MarchProgress { time, next_picture, .. } = *self.progress();
        let due = time >= next_picture - 1e-9 * self.duration || time >= self.duration;
        self.shown && due
    }

    fn state(&self, state: &State) {
        let interval = self.duration / PICTURES;
        self.progress().next_picture = interval * ((state.time / interval + 1e-6).floor() + 1.0);
        self.reporter.send(News::State(state.clone()));
    }
}
