//! Computes a shard. It is computed only once, also if several processes try.

use super::error::CampaignError;
use super::folder::Folder;
use super::program::processor;
use super::round::Part;
use super::shard::{Content, FORMAT, Shard};
use crate::engine::{EngineError, Store, Workbench};
use crate::host::clock::Stopwatch;
use crate::host::pool::{map_with, on_threads};
use crate::scene::{Scene, StudyObserver, StudyRow, atomic_file};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{ContactSolver, SolveError, Start};
use crate::solver::observer::{NewtonStep, Observer, Progress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::training::{Solved, TrainingError, TrainingObserver, TrainingSpec};
use std::fs::{File, TryLockError};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// How a request for a shard ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// It was computed.
    Computed,
    /// It already existed.
    There,
}

/// Observer that stores the rows of a shard.
struct Rows<'a> {
    observer: &'a dyn Observer,
    rows: Mutex<Vec<StudyRow>>,
}

impl Observer for Rows<'_> {
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

impl TrainingObserver for Rows<'_> {}

impl StudyObserver for Rows<'_> {
    fn row(&self, row: StudyRow) {
        self.rows.lock().unwrap_or_else(PoisonError::into_inner).push(row);
    }
}

/// Computes the pieces of a shard.
///
/// # Errors
/// If something is refused or the observer cancels. A solve that does not converge is part of the result.
pub(super) fn work(
    scene: &Scene,
    round: usize,
    part: &Part,
    bench: &mut Workbench,
    observer: &dyn Observer,
) -> Result<Content, CampaignError> {
    match part {
        Part::Study(pieces) => {
            let kept = Rows { observer, rows: Mutex::default() };
            scene.study.work(&scene.experiment(), bench, (round, pieces), &kept)?;
            let mut rows = kept.rows.into_inner().unwrap_or_else(PoisonError::into_inner);
            rows.sort_by_key(StudyRow::place);
            Ok(Content::Rows(rows))
        }
        Part::Training(grid, points) => {
            let spec = scene.training();
            let judged = spec.as_ref().is_some_and(TrainingSpec::tells_grid_costs);
            let lubricant = |point: &OperatingPoint| match &spec {
                Some(spec) => spec.lubricant_of(point),
                None => Lubricant::default(),
            };
            Ok(Content::Contacts(solve_all(*grid, (lubricant, judged), points, observer)?))
        }
    }
}

/// Computes full solutions of training contacts in the same way as the training does, with estimated discretisation
/// errors if `judged` is true.
fn solve_all(
    grid: GridSpec,
    (lubricant, judged): (impl Fn(&OperatingPoint) -> Lubricant + Sync, bool),
    points: &[(usize, OperatingPoint)],
    observer: &dyn Observer,
) -> Result<Vec<(usize, OperatingPoint, Option<Solved>)>, EngineError> {
    let grid = grid.build().map_err(SolveError::from)?;
    let solve = |solver: &mut ContactSolver, _, (place, point): &(usize, OperatingPoint)| {
        let solution = solver.solve(point, lubricant(point), Start::Cold, observer)?;
        if observer.cancelled() {
            return Err(EngineError::from(TrainingError::Cancelled));
        }
        let solution = if judged { solver.judged(solution) } else { solution };
        let solved = if solution.converged() { Some(Solved::new(*place, solution, &grid)) } else { None };
        Ok((*place, *point, solved))
    };
    map_with(points, || ContactSolver::on(&grid), solve)
}

/// Computes a shard on this number of threads, unless it already exists. If another process is computing it, waits for
/// that process.
///
/// # Errors
/// If the program or a file has changed since planning, the work is refused, or the shard cannot be written. The reason
/// is also written to a file next to the shards.
pub fn compute(
    folder: &Folder,
    number: usize,
    threads: usize,
    observer: &dyn Observer,
    waiting: &dyn Fn(),
) -> Result<Done, CampaignError> {
    folder.check_program()?;
    let (round, content, hash) = folder.round_of(number)?;
    let part = content.part(number);
    if folder.shard(number).is_ok() {
        return Ok(Done::There);
    }
    let lock = Lock::take(folder.shard_path(number).with_extension("lock"), waiting);
    if folder.shard(number).is_ok() {
        return Ok(Done::There);
    }
    let computed = || -> Result<(), CampaignError> {
        let clock = Stopwatch::start();
        let mut bench = Workbench::on(&Store::default(), &folder.path);
        let mut content = on_threads(threads, || work(&folder.scene, round, &part, &mut bench, observer))?;
        let times = content.take_seconds();
        let shard = Shard {
            program: folder.plan.program_hash.clone(),
            files: folder.plan.files.iter().map(|(_, hash)| hash.clone()).collect(),
            round: hash.to_owned(),
            number,
            pieces: part.len(),
            content,
            times,
            seconds: clock.seconds(),
            processor: processor(),
        };
        let path = folder.shard_path(number);
        let reason = || "its content cannot be encoded".to_owned();
        let payload =
            postcard::to_allocvec(&shard).map_err(|_| CampaignError::Shard { path: path.clone(), reason: reason() })?;
        Ok(atomic_file::replace(&path, &FORMAT.seal(&payload))?)
    };
    let done = computed();
    // The failure file is for information only. Errors of writing it are ignored.
    let _told = match &done {
        Ok(()) => std::fs::remove_file(folder.failure_path(number)),
        Err(reason) => std::fs::write(folder.failure_path(number), reason.to_string()),
    };
    drop(lock);
    done.map(|()| Done::Computed)
}

/// Lock that prevents two processes from computing the same shard at the same time. Without effect on systems without
/// file locks.
struct Lock {
    path: PathBuf,
    // The system releases the lock when the process ends, also after a crash.
    _file: Option<File>,
}

impl Lock {
    fn take(path: PathBuf, waiting: &dyn Fn()) -> Self {
        let file = File::options().write(true).create(true).truncate(false).open(&path).ok();
        if let Some(file) = &file
            && matches!(file.try_lock(), Err(TryLockError::WouldBlock))
        {
            waiting();
            let _done = file.lock();
        }
        Self { path, _file: file }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // A remaining lock file is reused by the next process.
        let _ = std::fs::remove_file(&self.path);
    }
}
