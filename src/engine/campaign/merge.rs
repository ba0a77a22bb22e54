//! Merges the shards of a campaign, which either opens the next round or gives the result.

use super::CampaignError;
use super::folder::{Folder, ROUNDS};
use super::round::{Pieces, Round};
use super::shard::{Content, Shard};
use crate::engine::{EngineError, SceneOutcome, Store, Workbench, model_file, training_file};
use crate::scene::atomic_file::{self, WriteError};
use crate::scene::study::training::Row;
use crate::scene::{NamedValue, Scene, StudyRow};
use crate::solver::observer::{NewtonStep, Observer, Progress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::{Solved, TrainingError, TrainingObserver, TrainingSpec, TrainingState, train_resumable};
use std::collections::{BTreeSet, HashMap};
use std::path::Path;
use std::sync::Arc;

/// Outcome of a merge.
#[derive(Clone, Debug)]
pub enum Merged {
    /// The next round is open, with these shards to compute.
    Round(std::ops::Range<usize>),
    /// The campaign is complete.
    Result(Box<Whole>),
}

/// Result of a campaign.
#[derive(Clone, Debug)]
pub struct Whole {
    /// Outcome of the scene, including the measured times of the shards.
    pub outcome: SceneOutcome,
    /// Total time of all shards \[s\].
    pub seconds: f64,
    /// Types of processors that computed shards.
    pub processors: BTreeSet<String>,
}

/// Merges a campaign. The files written depend only on program, scene and models, byte for byte. They contain no
/// measured times.
///
/// # Errors
/// If shards are missing, damaged or of another campaign, if a training fails, or if a file cannot be written.
pub fn merge(folder: &Folder, observer: &dyn Observer) -> Result<Merged, CampaignError> {
    folder.check_program()?;
    let done = folder.done();
    let mut missing = (0..folder.shards()).filter(|shard| !done.contains(shard));
    if let Some(first) = missing.next() {
        return Err(CampaignError::Gaps { missing: 1 + missing.count(), shards: folder.shards(), first });
    }
    let (mut rows, mut solved) = (Vec::new(), HashMap::new());
    let (mut seconds, mut processors) = (0.0, BTreeSet::new());
    let last = folder.rounds.last().map_or(0, |(round, _)| round.first);
    for number in 0..folder.shards() {
        let shard = folder.shard(number)?;
        seconds += shard.seconds;
        processors.insert(shard.processor.clone());
        match shard.content {
            Content::Rows(_) => rows.extend(Shard::rows(shard)),
            // For a training, earlier rounds are part of its state.
            Content::Contacts(contacts) if number >= last => {
                solved.extend(contacts.into_iter().map(|(place, point, solved)| (place, (point, solved))));
            }
            Content::Contacts(_) => {}
        }
    }
    let number = folder.rounds.len();
    if folder.scene.training().is_some() {
        let mut state = training_file::read(&folder.state_path(number - 1)).map_err(EngineError::from)?;
        let watch = Elsewhere { solved, observer };
        return match train_resumable(&mut state, &watch) {
            Err(TrainingError::Awaited) => open_round(folder, contacts(&folder.state_path(number), &state)?),
            Err(reason) => Err(EngineError::from(reason).into()),
            Ok(model) => {
                let row = |wall_s| vec![StudyRow::Training(Row { model: Arc::new(model.clone()), wall_s })];
                let keep = |beside: &Path| {
                    let path = beside.join(folder.model_name());
                    // Writing fails if the model does not solve its own training points.
                    let written = model_file::write(&model, &path);
                    written.map_err(|reason| EngineError::Model { path, reason: reason.into() })
                };
                finish(folder, (row(seconds), row(f64::NAN)), keep, seconds, processors)
            }
        };
    }
    let mut bench = Workbench::on(&Store::default(), &folder.path);
    let next = folder.scene.study.pieces(&folder.scene.experiment(), &mut bench, number, &rows)?;
    if !next.is_empty() {
        return open_round(folder, Pieces::of_study(next));
    }
    let untimed = rows.iter().cloned().map(without_seconds).collect();
    finish(folder, (rows, untimed), |_| Ok(()), seconds, processors)
}

/// Removes the measured times from a row.
fn without_seconds(mut row: StudyRow) -> StudyRow {
    row.seconds().into_iter().for_each(|seconds| *seconds = f64::NAN);
    row
}

fn open_round(folder: &Folder, pieces: Pieces) -> Result<Merged, CampaignError> {
    let number = folder.rounds.len();
    let round = Round { first: folder.shards(), per_shard: folder.plan.per_shard, pieces };
    let path = folder.path.join(ROUNDS).join(format!("{number:03}.ron"));
    atomic_file::replace(&path, round.to_text(&path)?.as_bytes())?;
    // The state of this round includes that of the previous one.
    let _gone = std::fs::remove_file(folder.state_path(number - 1));
    Ok(Merged::Round(round.first..round.first + round.shards()))
}

/// Writes the result of a campaign and the additional files of `keep`. The result folder appears only when it is
/// complete.
fn finish(
    folder: &Folder,
    (rows, untimed): (Vec<StudyRow>, Vec<StudyRow>),
    keep: impl FnOnce(&Path) -> Result<(), EngineError>,
    seconds: f64,
    processors: BTreeSet<String>,
) -> Result<Merged, CampaignError> {
    let outcome = folder.scene.outcome(&rows, seconds);
    let clockless = clockless(&outcome, folder.scene.outcome(&untimed, f64::NAN));
    let (path, beside) = (folder.result_path(), folder.path.join(format!(".result.{}.part", std::process::id())));
    let refused = |reason| WriteError { path: path.clone(), reason };
    let _former = std::fs::remove_dir_all(&beside);
    std::fs::create_dir_all(&beside).map_err(refused)?;
    clockless.write(&beside, &folder.plan.name)?;
    keep(&beside)?;
    if path.is_dir() {
        std::fs::remove_dir_all(&path).map_err(refused)?;
    }
    std::fs::rename(&beside, &path).map_err(refused)?;
    Ok(Merged::Result(Box::new(Whole { outcome, seconds, processors })))
}

/// Removes values that depend on measured times from an outcome, and the expectations about them.
fn clockless(timed: &SceneOutcome, mut untimed: SceneOutcome) -> SceneOutcome {
    let of_clock = |value: &NamedValue| {
        value.value.is_nan() && timed.found.value(&value.name, value.method.as_ref()).is_some_and(f64::is_finite)
    };
    let values = std::mem::take(&mut untimed.found.values);
    let (gone, stay): (Vec<_>, Vec<_>) = values.into_iter().partition(of_clock);
    untimed.found.values = stay;
    untimed.verdicts.retain(|verdict| gone.iter().all(|value| value.name != verdict.expected.name));
    untimed
}

/// Runs a training up to its first full solutions, and stores its state for the merge.
pub(super) fn first_contacts(folder: &Path, scene: &Scene, spec: TrainingSpec) -> Result<Pieces, CampaignError> {
    let mut state = TrainingState::new(spec);
    let watch = Elsewhere { solved: HashMap::new(), observer: &() };
    match train_resumable(&mut state, &watch) {
        Err(TrainingError::Awaited) => contacts(&folder.join(ROUNDS).join("000.training"), &state),
        Err(reason) => Err(EngineError::from(reason).into()),
        Ok(_) => Err(EngineError::Study(format!("the training “{}” requires no full solutions", scene.title)).into()),
    }
}

/// Stores the state of a training that waits for full solutions, and returns their contacts.
fn contacts(path: &Path, state: &TrainingState) -> Result<Pieces, CampaignError> {
    let Some((grid, points)) = state.awaited() else {
        return Err(EngineError::Study("the training waits for no full solutions".to_owned()).into());
    };
    training_file::write(state, path).map_err(EngineError::from)?;
    Ok(Pieces::Contacts { grid, points: points.to_vec() })
}

/// Observer that supplies a training with full solutions from shards. The training stops at the first missing ones.
struct Elsewhere<'a> {
    solved: HashMap<usize, (OperatingPoint, Option<Solved>)>,
    observer: &'a dyn Observer,
}

impl Observer for Elsewhere<'_> {
    fn newton_step(&self, step: &NewtonStep) {
        self.observer.newton_step(step);
    }

    fn progress(&self, progress: Progress) {
        self.observer.progress(progress);
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl TrainingObserver for Elsewhere<'_> {
    fn solved_elsewhere(&self, asked: &[(usize, OperatingPoint)]) -> Option<Vec<Result<Solved, TrainingError>>> {
        let give = |(place, point): &(usize, OperatingPoint)| match self.solved.get(place) {
            Some((own, solved)) if own == point => solved.clone().ok_or_else(|| {
                let moes = point.moes();
                TrainingError::NotConverged { m: moes.m, l: moes.l }
            }),
            _ => Err(TrainingError::Awaited),
        };
        Some(asked.iter().map(give).collect())
    }
}
