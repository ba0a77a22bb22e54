//! The march of every method in every frame on a thread of its own, told step by step.

use super::Setup;
use super::method::{Method, run_name};
use crate::app::task::{Ending, Reporter, Task};
use crate::scene::sampled;
use crate::solver::full::Mesh;
use crate::solver::full::transient::{
    Ended, FullMarch, Marching, Moment, State, TimeStep, Trajectory, Transient, TransientObserver, march,
};
use egui::Context;
use std::sync::Arc;
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
        sampled::read_into(&mut inputs, path).map_err(|error| error.to_string())?;
    }
    let reference = setup.grid.build().map_err(|error| error.to_string())?;
    let runs = study.frames.iter().flat_map(|&frame| Method::ALL.map(|method| (method, frame)));
    for (method, frame) in runs {
        let transient = Transient { inputs: inputs.clone(), ..setup.march(frame) };
        let mut model = match method {
            Method::Full => FullMarch::new(Arc::clone(&reference), &transient),
        }
        .map_err(|error| error.to_string())?;
        let name = run_name(method, frame);
        reporter.stage(&name, 0, 0);
        let grid = model.grid();
        let trajectory = Trajectory {
            problem: transient.problem().map_err(|error| error.to_string())?,
            transient: transient.clone(),
            mesh: Mesh::Line { spec: grid.reference.spec, scale: grid.scale },
            x: grid.x.clone(),
            moments: Vec::new(),
            states: Vec::new(),
            rejected_steps: 0,
            ended: Ended::Finished,
        };
        reporter.send(News::Begun { method, trajectory: Box::new(trajectory) });
        let mut watch = Watch {
            reporter,
            stage: name,
            duration: study.duration,
            time_step: study.time_step,
            steps: 0,
            time: 0.0,
            next_picture: 0.0,
            since: Instant::now(),
        };
        let trajectory = march(&mut model, &transient, &mut watch).map_err(|error| error.to_string())?;
        let cancelled = matches!(trajectory.ended, Ended::Cancelled { .. });
        reporter.send(News::Ended(trajectory.ended, trajectory.rejected_steps));
        if cancelled {
            break;
        }
    }
    Ok(())
}

/// Tells of every moment, and of some with their fields.
struct Watch<'a> {
    reporter: &'a Reporter<News>,
    stage: String,
    duration: f64,
    time_step: TimeStep,
    steps: usize,
    time: f64,
    next_picture: f64,
    since: Instant,
}

impl TransientObserver for Watch<'_> {
    fn moment(&mut self, moment: &Moment) {
        let seconds = self.since.elapsed().as_secs_f64();
        self.since = Instant::now();
        self.time = moment.time;
        self.reporter.send(News::Moment(*moment, seconds));
        let (done, total) = match self.time_step {
            TimeStep::Fixed(step) => (self.steps, (self.duration / step).round() as usize),
            TimeStep::Adaptive { .. } => ((100.0 * moment.time / self.duration) as usize, 100),
        };
        self.steps += 1;
        self.reporter.stage(&self.stage, done.min(total), total);
    }

    fn wants_state(&self) -> bool {
        // Rounding must not leave out every second step of as many as there are pictures.
        self.time >= self.next_picture - 1e-9 * self.duration || self.time >= self.duration
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
