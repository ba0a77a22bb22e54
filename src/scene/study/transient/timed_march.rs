//! March with the time of each step, reported moment by moment.

use super::{MarchedBy, Row};
use crate::host::clock::Stopwatch;
use crate::scene::error::RunError;
use crate::scene::study::question::Tell;
use crate::solver::full::transient::{Marching, Moment, State, Trajectory, Transient, TransientObserver, march};
use crate::solver::observer::{Observer, Progress};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Number of moments per march whose fields are reported, if requested.
const PICTURES: f64 = 400.0;

/// March with times.
pub(crate) struct Timed {
    /// Result of the march.
    pub trajectory: Trajectory,
    /// Time of each step, without the start \[s\].
    pub seconds: Vec<f64>,
}

/// Receiver of a march's moments, and of its fields if requested.
pub(crate) struct Listener<'a> {
    /// Name of the march.
    pub march: Arc<str>,
    /// Solution method.
    pub by: MarchedBy,
    /// Function that receives the rows.
    pub tell: &'a Tell<'a, Row>,
    /// True if fields are requested.
    pub wants_states: bool,
}

/// Runs a march and times each step. `stage` is the description for progress reports.
pub(crate) fn timed_march(
    model: &mut dyn Marching,
    transient: &Transient,
    stage: String,
    observer: &dyn Observer,
    told: Option<Listener<'_>>,
) -> Result<Timed, RunError> {
    if let Some(Listener { march, by, tell, .. }) = &told {
        let trajectory = Box::new(Trajectory::begun(transient, model.mesh(), model.abscissae())?);
        tell(Row::Begun { march: Arc::clone(march), by: *by, trajectory });
    }
    let progress = Mutex::new(Steps { begun: None, seconds: Vec::new(), time: 0.0, next_picture: 0.0 });
    let clock = StepClock { observer, stage, duration: transient.duration, told, progress };
    let trajectory = march(model, transient, &clock)?;
    if observer.cancelled() {
        return Err(RunError::Cancelled);
    }
    let steps = clock.progress.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Timed { trajectory, seconds: steps.seconds })
}

/// Times every step, and reports progress in thousandths of the duration.
struct StepClock<'a> {
    observer: &'a dyn Observer,
    stage: String,
    duration: f64,
    told: Option<Listener<'a>>,
    progress: Mutex<Steps>,
}

/// Start of the current step, times of the completed steps, last time T, and the T from which the next fields are due.
struct Steps {
    begun: Option<Stopwatch>,
    seconds: Vec<f64>,
    time: f64,
    next_picture: f64,
}

impl StepClock<'_> {
    fn steps(&self) -> MutexGuard<'_, Steps> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Observer for StepClock<'_> {
    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl TransientObserver for StepClock<'_> {
    fn moment(&self, moment: &Moment) {
        let mut steps = self.steps();
        let seconds = steps.begun.map_or(0.0, |begun| begun.seconds());
        if steps.begun.is_some() {
            steps.seconds.push(seconds);
        }
        steps.time = moment.time;
        let done = (1000.0 * moment.time / self.duration) as usize;
        self.observer.progress(Progress { stage: self.stage.clone(), done, total: 1000 });
        if let Some(Listener { march, tell, .. }) = &self.told {
            tell(Row::Moment { march: Arc::clone(march), moment: *moment, seconds });
        }
        steps.begun = Some(Stopwatch::start());
    }

    fn wants_state(&self) -> bool {
        let Steps { time, next_picture, .. } = *self.steps();
        // The tolerance prevents rounding errors from skipping fields if the number of steps equals the number of
        // pictures.
        let wanted = self.told.as_ref().is_some_and(|told| told.wants_states);
        wanted && (time >= next_picture - 1e-9 * self.duration || time >= self.duration)
    }

    fn state(&self, state: &State) {
        let interval = self.duration / PICTURES;
        let mut steps = self.steps();
        steps.next_picture = interval * ((state.time / interval + 1e-6).floor() + 1.0);
        if let Some(Listener { march, tell, .. }) = &self.told {
            tell(Row::State { march: Arc::clone(march), state: Arc::new(state.clone()) });
        }
        // The time for reporting fields is not part of the step.
        steps.begun = Some(Stopwatch::start());
    }
}
