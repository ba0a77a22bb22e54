//! Option `--animate` of the command `run`: runs a scene and writes an animated PNG. The animation shows the first full
//! march of a transient study, or the contacts of a sweep over one quantity.

use super::failure::Failure;
use super::output::ProgressLine;
use crate::engine::{EngineError, SceneOutcome, Workbench, run_scene};
use crate::scene::animation::{full_march, of_march, of_sweep};
use crate::scene::{Scene, Study, StudyObserver, StudyRow, atomic_file};
use crate::solver::observer::{Observer, Progress};
use crate::solver::training::TrainingObserver;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Refuses several scenes, and studies that cannot be animated.
pub(super) fn check(scenes: &[Scene]) -> Result<(), Failure> {
    match scenes {
        [Scene { study: Study::Transient(_), .. }] => Ok(()),
        [Scene { study: Study::Sweep(sweep), .. }] if sweep.over.len() == 1 => Ok(()),
        [_] => {
            let needed = "--animate needs a scene with the study Transient, or Sweep over one quantity";
            Err(Failure::Request(needed.to_owned()))
        }
        _ => Err(Failure::Request(format!("--animate takes one scene, not {}", scenes.len()))),
    }
}

/// Runs a scene, writes its animation to `file` and returns the outcome of the scene. A march is full if the full
/// solver computes it.
pub(super) fn run(scene: &Scene, bench: &mut Workbench, file: &Path) -> Result<SceneOutcome, Failure> {
    let observer = Watcher { progress: ProgressLine::new(false), rows: Mutex::default() };
    let outcome = run_scene(scene, bench, &observer);
    let rows = std::mem::take(&mut *observer.rows.lock().unwrap_or_else(PoisonError::into_inner));
    let drawn = outcome.and_then(|outcome| {
        if matches!(scene.study, Study::Sweep(_)) {
            let animation = of_sweep(scene, bench, false, &observer)?;
            return Ok((outcome, animation));
        }
        let march = full_march(&rows).ok_or_else(|| EngineError::Study("the run has no fields to draw".to_owned()))?;
        let animation = of_march(&march, false, &observer.progress);
        Ok((outcome, animation.map_err(|why| EngineError::Study(why.to_string()))?))
    });
    observer.progress.finish();
    let (outcome, animation) = drawn?;
    atomic_file::replace(file, &animation)?;
    Ok(outcome)
}

/// Observer that shows the progress and collects the rows of the study, including the fields of transient contacts.
struct Watcher {
    progress: ProgressLine,
    rows: Mutex<Vec<StudyRow>>,
}

impl Observer for Watcher {
    fn progress(&self, progress: Progress) {
        self.progress.progress(progress);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled()
    }
}

impl TrainingObserver for Watcher {}

impl StudyObserver for Watcher {
    fn row(&self, row: StudyRow) {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner).push(row);
    }

    fn wants_states(&self) -> bool {
        true
    }
}
