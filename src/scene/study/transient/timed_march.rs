//! A march with the seconds of each of its steps, told moment by moment.

use super::Row;
use crate::scene::error::RunError;
use crate::scene::statistics::median;
use crate::scene::study::question::{Setting, Tell};
use crate::solver::full::transient::{Marching, Moment, State, Trajectory, Transient, TransientObserver, march};
use crate::solver::observer::{Observer, Progress};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Moments whose fields are told, of each march, where that is wanted.
const PICTURES: f64 = 400.0;

/// A march that was timed.
pub(super) struct Timed {
    pub trajectory: Trajectory,
    /// Of each step, without the start.
    pub seconds: Vec<f64>,
}

impl Timed {
    /// The median of its steps \[s\].
    pub fn step_s(&self) -> f64 {
        median(&self.seconds)
    }
}

/// Marches and times each step; `stage` is what the observer is told, and `tell` hears of moments and fields under the name given with it.
pub(super) fn timed_march(
    model: &mut dyn Marching,
    transient: &Transient,
    stage: String,
    setting: &Setting<'_>,
    tell: Option<(&str, &Tell<'_, Row>)>,
) -> Result<Timed, RunError> {
    let tell = tell.map(|(name, tell)| (Arc::from(name), tell));
    if let Some((march, tell)) = &tell {
        tell(Row::Begun { march: Arc::clone(march), transient: Box::new(transient.clone()) });
    }
    let progress = Mutex::new(Steps { begun: None, seconds: Vec::new(), time: 0.0, next_picture: 0.0 });
    let states = setting.wants_states && tell.is_some();
    let clock = StepClock { observer: setting.observer, stage, duration: transient.duration, tell, states, progress };
    let trajectory = march(model, transient, &clock)?;
    if setting.observer.cancelled() {
        return Err(RunError::Cancelled);
    }
    let steps = clock.progress.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Timed { trajectory, seconds: steps.seconds })
}

/// Measures every step, and tells how far the march is in thousandths of its duration.
struct StepClock<'a> {
    observer: &'a dyn Observer,
    stage: String,
    duration: f64,
    tell: Option<(Arc<str>, &'a Tell<'a, Row>)>,
    states: bool,
    progress: Mutex<Steps>,
}

/// When the step under way began, the seconds of those before, the last time reached, and from when on fields are due.
struct Steps {
    begun: Option<Instant>,
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
        let seconds = steps.begun.map_or(0.0, |begun| begun.elapsed().as_secs_f64());
        if steps.begun.is_some() {
            steps.seconds.push(seconds);
        }
        steps.time = moment.time;
        let done = (1000.0 * moment.time / self.duration) as usize;
        self.observer.progress(Progress { stage: self.stage.clone(), done, total: 1000 });
        if let Some((march, tell)) = &self.tell {
            tell(Row::Moment { march: Arc::clone(march), moment: *moment, seconds });
        }
        steps.begun = Some(Instant::now());
    }

    fn wants_state(&self) -> bool {
        let Steps { time, next_picture, .. } = *self.steps();
        // Rounding must not leave out every second step of as many as there are pictures.
        self.states && (time >= next_picture - 1e-9 * self.duration || time >= self.duration)
    }

    fn state(&self, state: &State) {
        let interval = self.duration / PICTURES;
        let mut steps = self.steps();
        steps.next_picture = interval * ((state.time / interval + 1e-6).floor() + 1.0);
        if let Some((march, tell)) = &self.tell {
            tell(Row::State { march: Arc::clone(march), state: Arc::new(state.clone()) });
        }
        // The picture is no part of the step.
        steps.begun = Some(Instant::now());
    }
}
