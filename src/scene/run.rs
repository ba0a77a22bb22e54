//! Runs a scene and returns its outcome.

use super::bench::Bench;
use super::error::RunError;
use super::expectation::Expectation;
use super::notice::Notice;
use super::outcome::SceneOutcome;
use super::{Scene, StudyObserver, StudyRow};
use crate::host::clock::Stopwatch;
use crate::solver::observer::{NewtonStep, Observer, Progress, WalkStep};
use crate::solver::training::{TrainingObserver, TrainingState};
use std::sync::{Mutex, PoisonError};

/// Runs the study of a scene and checks its expectations.
///
/// # Errors
/// If the scene is refused, a model is not available, or the observer cancels. Solves that do not converge and
/// expectations that are not met are part of the outcome.
pub fn run_scene(scene: &Scene, bench: &mut dyn Bench, observer: &dyn StudyObserver) -> Result<SceneOutcome, RunError> {
    scene.check()?;
    let (clock, experiment) = (Stopwatch::start(), scene.experiment());
    let kept = RowCollector { observer, rows: Mutex::default() };
    scene.study.run(&experiment, bench, &kept)?;
    let rows = kept.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(scene.outcome(&rows, clock.seconds()))
}

impl Scene {
    /// Evaluates rows of the scene's study, complete or not, and checks the expectations.
    pub fn outcome(&self, rows: &[StudyRow], wall_s: f64) -> SceneOutcome {
        let mut found = self.study.findings(&self.experiment(), rows);
        found.warnings.splice(0..0, self.unused_alpha().map(Notice::from));
        SceneOutcome {
            title: self.title.clone(),
            source: self.source.clone(),
            wall_s,
            failures_expected: self.failures_expected || self.expect.iter().any(Expectation::admits_failures),
            verdicts: found.verdicts(&self.expect),
            tables: self.study.tables(rows),
            found,
        }
    }
}

/// Observer that stores the rows and forwards all calls.
struct RowCollector<'a> {
    observer: &'a dyn StudyObserver,
    rows: Mutex<Vec<StudyRow>>,
}

impl Observer for RowCollector<'_> {
    fn newton_step(&self, step: &NewtonStep) {
        self.observer.newton_step(step);
    }

    fn walk_step(&self, step: &WalkStep) {
        self.observer.walk_step(step);
    }

    fn krylov_iteration(&self, count: usize) {
        self.observer.krylov_iteration(count);
    }

    fn progress(&self, progress: Progress) {
        self.observer.progress(progress);
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl TrainingObserver for RowCollector<'_> {
    fn checkpoint(&self, state: &TrainingState) {
        self.observer.checkpoint(state);
    }
}

impl StudyObserver for RowCollector<'_> {
    fn row(&self, row: StudyRow) {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner).push(row.clone());
        self.observer.row(row);
    }

    fn wants_states(&self) -> bool {
        self.observer.wants_states()
    }
}
