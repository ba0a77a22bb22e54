//! A march with the seconds of each of its steps.

use super::error::EngineError;
use super::statistics::median;
use crate::solver::full::transient::{Marching, Moment, Trajectory, Transient, TransientObserver, march};
use crate::solver::training::{Progress, TrainingObserver};
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
    observer: &dyn TrainingObserver,
) -> Result<Timed, EngineError> {
    let mut clock = StepClock { observer, stage, duration: transient.duration, begun: None, seconds: Vec::new() };
    let trajectory = march(model, transient, &mut clock)?;
    if observer.cancelled() {
        return Err(EngineError::Cancelled);
    }
    Ok(Timed { trajectory, seconds: clock.seconds })
}

/// Measures every step, and tells how far the march is in thousandths of its duration.
struct StepClock<'a> {
    observer: &'a dyn TrainingObserver,
    stage: String,
    duration: f64,
    begun: Option<Instant>,
    seconds: Vec<f64>,
}

impl TransientObserver for StepClock<'_> {
    fn moment(&mut self, moment: &Moment) {
        if let Some(begun) = self.begun {
            self.seconds.push(begun.elapsed().as_secs_f64());
        }
        let done = (1000.0 * moment.time / self.duration) as usize;
        self.observer.progress(Progress { stage: self.stage.clone(), done, total: 1000 });
        self.begun = Some(Instant::now());
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}
