//! One shard: its work, and its file. A shard that is there is not computed again; two processes that compute the same
//! one write the same.

use super::folder::Folder;
use super::plan::{Plan, trains};
use super::program::processor;
use super::round::Part;
use super::{CampaignError, VERSION};
use crate::engine::checked_file::{Flaw, Format, Unreadable};
use crate::engine::{EngineError, Store, Workbench};
use crate::scene::atomic_file;
use crate::scene::study::PieceRow;
use crate::scene::{Scene, StudyObserver, StudyRow};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{ContactSolver, SolveError, Start};
use crate::solver::observer::{NewtonStep, Observer, Progress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::training::{Solved, TrainingError, TrainingObserver, TrainingSpec};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Full solutions of the finest grids, as many as a day gives.
const FORMAT: Format = Format { magic: b"EHLSHD\r\n", version: VERSION, max_payload: 2 << 30 };

/// What came of a shard.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Content {
    /// Rows of a study, in the order of their pieces; seconds in them are kept aside.
    Rows(Vec<PieceRow>),
    /// Contacts of a training with their full solutions, none where the solver did not converge.
    Contacts(Vec<(usize, OperatingPoint, Option<Solved>)>),
}

/// A finished shard.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shard {
    /// Hash of the program that computed it.
    program: String,
    /// Hashes of the campaign's files.
    files: Vec<String>,
    /// What its round is known by.
    round: String,
    /// Its number.
    number: usize,
    /// Pieces in it.
    pieces: usize,
    /// What came of it: the same bytes wherever it is computed.
    pub content: Content,
    /// The seconds of its rows, in their order.
    pub times: Vec<f64>,
    /// Seconds that all of it took.
    pub seconds: f64,
    /// The kind of processor that computed it.
    pub processor: String,
}

/// What became of a shard that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// It was computed.
    Computed,
    /// It was there.
    There,
}

impl Content {
    /// Takes the seconds out of the rows, so that what is left depends on no clock.
    fn take_seconds(&mut self) -> Vec<f64> {
        let Self::Rows(rows) = self else { return Vec::new() };
        let seconds = rows.iter_mut().flat_map(PieceRow::seconds);
        seconds.map(|seconds| std::mem::replace(seconds, f64::NAN)).collect()
    }

    /// Whether its contacts make sense and its solutions are numbers: what a right hash cannot promise.
    fn is_sound(&self) -> bool {
        match self {
            Self::Rows(rows) => rows.iter().all(PieceRow::is_sound),
            Self::Contacts(contacts) => contacts.iter().all(|(_, point, solved)| {
                let numbers = solved.iter().flat_map(|s| s.pressure.iter().chain([&s.h_0, &s.h_c]));
                point.check().is_ok() && numbers.into_iter().all(|number| number.is_finite())
            }),
        }
    }
}

impl Shard {
    /// Its rows as they were told, with their seconds.
    pub fn rows(mut self) -> Vec<StudyRow> {
        let Content::Rows(rows) = &mut self.content else { return Vec::new() };
        let seconds = rows.iter_mut().flat_map(PieceRow::seconds);
        seconds.zip(&self.times).for_each(|(seconds, taken)| *seconds = *taken);
        std::mem::take(rows).into_iter().map(StudyRow::from).collect()
    }

    /// Reads a shard's file.
    pub(super) fn read(
        path: &Path,
        number: usize,
        (plan, round): (&Plan, &str),
        pieces: usize,
    ) -> Result<Self, CampaignError> {
        let refused = |reason: &str| CampaignError::Shard { path: path.to_owned(), reason: reason.to_owned() };
        let flawed = |flaw: Flaw| match flaw {
            Flaw::Foreign => refused("it is another kind of file"),
            Flaw::OtherVersion { .. } => refused("its format has another version"),
            Flaw::Truncated { .. } => refused("it is cut off"),
            Flaw::TooLarge { .. } => refused("it announces more bytes than any shard has"),
            Flaw::Changed => refused("its content does not match its hash"),
        };
        let bytes = FORMAT.read(path).map_err(|reason| match reason {
            Unreadable::Io(error) => CampaignError::Read { path: path.to_owned(), reason: error.to_string() },
            Unreadable::Flaw(flaw) => flawed(flaw),
        })?;
        let payload = FORMAT.open(&bytes).map_err(flawed)?;
        let shard: Self = postcard::from_bytes(payload).map_err(|_| refused("its content cannot be decoded"))?;
        let files = plan.files.iter().map(|(_, hash)| hash);
        if shard.program != plan.program_hash {
            Err(refused("it was computed by another build of the program"))
        } else if !shard.files.iter().eq(files) {
            Err(refused("it was computed for another scene or with another model"))
        } else if shard.round != round || shard.number != number {
            Err(refused("it belongs to another campaign or place"))
        } else if shard.pieces != pieces || !shard.content.is_sound() {
            Err(refused("its content contradicts itself"))
        } else {
            Ok(shard)
        }
    }
}

/// Keeps the rows of a shard.
struct Rows<'a> {
    observer: &'a dyn Observer,
    rows: Mutex<Vec<PieceRow>>,
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
        self.rows.lock().unwrap_or_else(PoisonError::into_inner).extend(PieceRow::of(row));
    }
}

/// Works out the pieces of a shard.
///
/// # Errors
/// When something is refused or the observer cancels. What does not converge is part of what came of it.
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
            rows.sort_by_key(PieceRow::place);
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

/// Full solutions of a training's contacts, as it computes them itself, `judged` by what the grid costs them or not.
fn solve_all(
    grid: GridSpec,
    (lubricant, judged): (impl Fn(&OperatingPoint) -> Lubricant + Sync, bool),
    points: &[(usize, OperatingPoint)],
    observer: &dyn Observer,
) -> Result<Vec<(usize, OperatingPoint, Option<Solved>)>, EngineError> {
    let grid = grid.build().map_err(SolveError::from)?;
    let solve = |solver: &mut ContactSolver, (place, point): &(usize, OperatingPoint)| {
        let solution = solver.solve(point, lubricant(point), Start::Cold, observer)?;
        if observer.cancelled() {
            return Err(EngineError::from(TrainingError::Cancelled));
        }
        let solution = if judged { solver.judged(solution) } else { solution };
        let solved = if solution.converged() { Some(Solved::new(*place, solution)) } else { None };
        Ok((*place, *point, solved))
    };
    points.par_iter().map_init(|| ContactSolver::on(&grid), solve).collect()
}

/// Computes a shard on so many threads, unless it is there already. Where another process computes it, waits for that.
///
/// # Errors
/// When the program or a file is not what was planned, the work is refused, or the shard cannot be written. The reason
/// is kept beside the shards as well.
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
        let clock = Instant::now();
        let mut bench = Workbench::on(&Store::default(), &folder.path);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let mut go = || work(&folder.scene, round, &part, &mut bench, observer);
        let mut content = match pool {
            Ok(pool) => pool.install(go)?,
            // Without threads of its own it takes those that there are.
            Err(_) => go()?,
        };
        let times = content.take_seconds();
        let shard = Shard {
            program: folder.plan.program_hash.clone(),
            files: folder.plan.files.iter().map(|(_, hash)| hash.clone()).collect(),
            round: hash.to_owned(),
            number,
            pieces: part.len(),
            content,
            times,
            seconds: clock.elapsed().as_secs_f64(),
            processor: processor(),
        };
        let path = folder.shard_path(number);
        let reason = || "its content cannot be encoded".to_owned();
        let payload =
            postcard::to_allocvec(&shard).map_err(|_| CampaignError::Shard { path: path.clone(), reason: reason() })?;
        Ok(atomic_file::replace(&path, &FORMAT.seal(&payload))?)
    };
    let done = computed();
    // What is told of a failure is worth nothing else: where it cannot be written, nothing is lost.
    let _told = match &done {
        Ok(()) => std::fs::remove_file(folder.failure_path(number)),
        Err(reason) => std::fs::write(folder.failure_path(number), reason.to_string()),
    };
    drop(lock);
    done.map(|()| Done::Computed)
}

/// Keeps two processes from computing the same shard at the same time; without harm where the system knows no locks.
struct Lock {
    path: PathBuf,
    // The system gives it back when the process ends, however it does.
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
        // One that is left behind is taken over by the next process.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Whether the shards of a campaign hold rows of a study.
pub fn holds_rows(folder: &Folder) -> bool {
    !trains(&folder.scene)
}
