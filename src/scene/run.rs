//! A scene in, its outcome out.

use super::bench::Bench;
use super::error::RunError;
use super::expectation::Expectation;
use super::notice::Notice;
use super::outcome::SceneOutcome;
use super::{Scene, StudyObserver, StudyRow};
use crate::host::clock::Stopwatch;
use crate::solver::observer::{NewtonStep, Observer, Progress};
use crate::solver::training::{TrainingObserver, TrainingState};
use std::sync::{Mutex, PoisonError};

/// Answers a scene's question and holds its expectations against the answer.
///
/// # Errors
/// When the scene is refused, a model cannot be had, or the observer cancels. Solves that do not converge and
/// expectations that fall short are part of the outcome.
pub fn run_scene(scene: &Scene, bench: &mut dyn Bench, observer: &dyn StudyObserver) -> Result<SceneOutcome, RunError> {
    scene.check()?;
    let (clock, experiment) = (Stopwatch::start(), scene.experiment());
    let kept = Kept { observer, rows: Mutex::default() };
    scene.study.run(&experiment, bench, &kept)?;
    let rows = kept.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(scene.outcome(&rows, clock.seconds()))
}

impl Scene {
    /// What rows of its study say so far, held against its expectations.
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

/// Keeps the rows that it passes on.
struct Kept<'a> {
    observer: &'a dyn StudyObserver,
    rows: Mutex<Vec<StudyRow>>,
}

impl Observer for Kept<'_> {
    fn newton_step(&self, step: &NewtonStep) {
        self.observer.newton_step(step);
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

impl TrainingObserver for Kept<'_> {
    fn checkpoint(&self, state: &TrainingState) {
        self.observer.checkpoint(state);
    }
}

impl StudyObserver for Kept<'_> {
    fn row(&self, row: StudyRow) {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner).push(row.clone());
        self.observer.row(row);
    }

    fn wants_states(&self) -> bool {
        self.observer.wants_states()
    }
}
