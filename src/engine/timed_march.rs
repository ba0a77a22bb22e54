//! A march with the seconds of each of its steps.

use super::error::EngineError;
use super::statistics::median;
use crate::solver::full::transient::{Marching, Moment, Trajectory, Transient, TransientObserver, march};
use crate::solver::observer::{Observer, Progress};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

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

/// Marches and times each step; `stage` is what the observer is told.
pub(super) fn timed_march(
    model: &mut dyn Marching,
    transient: &Transient,
    stage: String,
    observer: &dyn Observer,
) -> Result<Timed, EngineError> {
    let clock = StepClock { observer, stage, duration: transient.duration, steps: Mutex::default() };
    let trajectory = march(model, transient, &clock)?;
    if observer.cancelled() {
        return Err(EngineError::Cancelled);
    }
    let steps = clock.steps.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Timed { trajectory, seconds: steps.seconds })
}

/// Measures every step, and tells how far the march is in thousandths of its duration.
struct StepClock<'a> {
    observer: &'a dyn Observer,
    stage: String,
    duration: f64,
    steps: Mutex<Steps>,
}

/// When the step under way began, and the seconds of those before.
#[derive(Default)]
struct Steps {
    begun: Option<Instant>,
    seconds: Vec<f64>,
}

impl Observer for StepClock<'_> {
    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl TransientObserver for StepClock<'_> {
    fn moment(&self, moment: &Moment) {
        let mut steps = self.steps.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(begun) = steps.begun {
            steps.seconds.push(begun.elapsed().as_secs_f64());
        }
        let done = (1000.0 * moment.time / self.duration) as usize;
        self.observer.progress(Progress { stage: self.stage.clone(), done, total: 1000 });
        steps.begun = Some(Instant::now());
    }
}
