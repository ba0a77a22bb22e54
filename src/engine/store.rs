//! Shared storage of expensive objects: grids with their kernels, full solvers, reduced models, and their operators.

use super::job::{Job, Wake};
use super::rom::{ModelFileError, SavedModel};
use super::{EngineError, embedded, model_file};
use crate::host::clock::FileTime;
use crate::host::pool::on_spare_cores;
use crate::host::{models, worker};
use crate::scene::Scene;
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec};
use crate::solver::full::ContactSolver;
use crate::solver::observer::Observer;
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions};
use crate::solver::training::{TrainingObserver, TrainingSpec, train};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maximum number of stored grids and idle full solvers of line contacts. The least recently used one is freed first.
const KEPT_LINES: usize = 6;
/// Maximum number of stored grids and idle full solvers of point contacts: a quick grid, the chosen one and a second
/// one. Each solver may use several hundred megabytes, and the memory of a web page never shrinks.
const KEPT_POINTS: usize = if worker::THREADS { 3 } else { 1 };
/// Maximum number of stored reduced models in addition to those in the program. A model of several local models uses
/// about ten megabytes.
const KEPT_MODELS: usize = 12;
/// Maximum number of idle reduced solvers. The operators of one take some ten megabytes.
const KEPT_ONLINE: usize = if worker::THREADS { 8 } else { 3 };

/// Grids, solvers and models, made at their first use and stored. Clones share everything, and any thread may use
/// them.
#[derive(Clone, Default)]
pub struct Store(Arc<Shelves>);

#[derive(Default)]
struct Shelves {
    grids: Mutex<Vec<ContactGrid>>,
    full: Mutex<Vec<ContactSolver>>,
    models: Mutex<Vec<(Origin, Arc<ReducedModel>)>>,
    in_time: Mutex<Vec<(Origin, Arc<TrajectoryModel>)>>,
    online: Mutex<Vec<Online>>,
}

/// Locks on all shared objects.
pub struct Held<'a> {
    _program: MutexGuard<'static, embedded::Read>,
    _grids: MutexGuard<'a, Vec<ContactGrid>>,
    _full: MutexGuard<'a, Vec<ContactSolver>>,
    _models: MutexGuard<'a, Vec<(Origin, Arc<ReducedModel>)>>,
    _in_time: MutexGuard<'a, Vec<(Origin, Arc<TrajectoryModel>)>>,
    _online: MutexGuard<'a, Vec<Online>>,
}

/// Origin of a reduced model, by which it is found again.
#[derive(Clone, PartialEq)]
enum Origin {
    /// File, with its modification time and its size.
    File(PathBuf, Option<FileTime>, u64),
    /// Training.
    Training(Box<TrainingSpec>),
    /// Transient training by a scene.
    Scene(Box<Scene>),
}

impl Store {
    /// Returns a grid with its kernel.
    ///
    /// # Errors
    /// If the specification is refused.
    pub fn grid(&self, spec: GridSpec) -> Result<ContactGrid, GridError> {
        let grid = match take(&self.0.grids, |grid| grid.spec() == spec) {
            Some(grid) => grid,
            None => {
                make_room(&self.0.grids, |grid| grid.kind() == spec.kind(), kept_of(spec.kind()));
                spec.build()?
            }
        };
        keep(&self.0.grids, grid.clone(), |other| other.kind() == spec.kind(), kept_of(spec.kind()));
        Ok(grid)
    }

    /// Runs `work` with a full solver on a grid. Its previous solves do not affect the result.
    pub fn with_full_solver<T>(&self, grid: &ContactGrid, work: impl FnOnce(&mut ContactSolver) -> T) -> T {
        let kind = grid.kind();
        let of_the_kind = |other: &ContactSolver| other.grid_spec().kind() == kind;
        let idle = take(&self.0.full, |solver| solver.grid_spec() == grid.spec());
        let mut solver = idle.unwrap_or_else(|| {
            make_room(&self.0.full, of_the_kind, kept_of(kind));
            ContactSolver::on(grid)
        });
        // If `work` panics, the solver may be in an invalid state and is not stored again.
        let done = work(&mut solver);
        keep(&self.0.full, solver, of_the_kind, kept_of(kind));
        done
    }

    /// Returns a reduced solver without stored solutions. Its operators may be those of a previous one.
    pub fn online(&self, model: &Arc<ReducedModel>, options: ReducedOptions) -> Online {
        let idle = take(&self.0.online, |idle| Arc::ptr_eq(&idle.model, model) && *idle.options() == options);
        idle.unwrap_or_else(|| {
            if worker::is_crowded() {
                self.forget_unused_models();
            }
            Online::new(Arc::clone(model), options)
        })
    }

    /// Stores the operators of a reduced solver that is no longer needed.
    pub fn give_back(&self, mut online: Online) {
        online.forget();
        keep(&self.0.online, online, |_| true, KEPT_ONLINE);
    }

    /// Returns a reduced model of the program by its name.
    ///
    /// # Errors
    /// If the name is unknown, or the model in the program is damaged.
    pub fn embedded(&self, name: &str) -> Result<Arc<ReducedModel>, ModelFileError> {
        self.embedded_watched(name, &())
    }

    /// Returns a reduced model of the program as the screen shows it: complete if this instance of the program solves
    /// with it. A web page solves in workers and reads only the outline, because reading the bases takes half a second
    /// and much memory.
    ///
    /// # Errors
    /// As [`Self::embedded`].
    pub fn shown(&self, name: &str) -> Result<Arc<ReducedModel>, ModelFileError> {
        if worker::THREADS { self.embedded(name) } else { embedded::outline(name) }
    }

    /// Returns the complete model of an outline, or the model itself.
    ///
    /// # Errors
    /// As [`Self::embedded`].
    pub fn whole(&self, model: &Arc<ReducedModel>) -> Result<Arc<ReducedModel>, ModelFileError> {
        match embedded::name_of(model).filter(|_| model.is_outline()) {
            Some(name) => self.embedded(&name),
            None => Ok(Arc::clone(model)),
        }
    }

    /// Frees the operators of idle reduced solvers, and the models of the program that are not in use.
    pub fn forget_unused_models(&self) {
        lock(&self.0.online).clear();
        embedded::forget_unused();
    }

    /// Starts a job that reads a reduced model of the program for [`Self::shown`], once its file is available.
    pub fn read(&self, name: &'static str, wake: Wake) -> Job<Arc<ReducedModel>> {
        let store = self.clone();
        Job::once(
            "Reading a reduced model",
            wake,
            |begin| models::then(name, begin),
            move |reporter| {
                reporter.send(on_spare_cores(|| store.shown(name)).map_err(|error| error.to_string())?);
                Ok(())
            },
        )
    }

    /// As [`Self::embedded`], with an observer, because reading takes a tenth of a second or more. All stores share
    /// these models.
    pub(super) fn embedded_watched(
        &self,
        name: &str,
        observer: &dyn Observer,
    ) -> Result<Arc<ReducedModel>, ModelFileError> {
        if worker::is_crowded() && !embedded::is_loaded(name) {
            self.forget_unused_models();
        }
        embedded::embedded_watched(name, observer)
    }

    /// Returns the reduced model of a file, which is read again after a change of the file. If there is no such file, a
    /// name of an embedded model is accepted in its place.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn model_of_file(&self, path: &Path) -> Result<Arc<ReducedModel>, EngineError> {
        self.model_of_file_watched(path, &())
    }

    /// As [`Self::model_of_file`], with an observer.
    pub(super) fn model_of_file_watched(
        &self,
        path: &Path,
        observer: &dyn Observer,
    ) -> Result<Arc<ReducedModel>, EngineError> {
        if let Some(name) = embedded::named_by(path) {
            return self.embedded_watched(name, observer).map_err(|reason| unreadable(path, reason));
        }
        let read = || model_file::read_watched(path, observer);
        made_once(&self.0.models, Origin::of_file(path), read).map_err(|reason| unreadable(path, reason))
    }

    /// Returns the transient reduced model of a file, which is read again after a change of the file.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn trajectory_model_of_file(&self, path: &Path) -> Result<Arc<TrajectoryModel>, EngineError> {
        let read = || SavedModel::read(path)?.in_time();
        made_once(&self.0.in_time, Origin::of_file(path), read).map_err(|reason| unreadable(path, reason))
    }

    /// Returns the transient reduced model of a scene, which is trained once.
    ///
    /// # Errors
    /// If the training fails.
    pub fn trained_in_time(
        &self,
        scene: &Scene,
        train: impl FnOnce() -> Result<TrajectoryModel, EngineError>,
    ) -> Result<Arc<TrajectoryModel>, EngineError> {
        made_once(&self.0.in_time, Origin::Scene(Box::new(scene.clone())), || train().map(Arc::new))
    }

    /// Returns the reduced model of a training, which is trained once.
    ///
    /// # Errors
    /// If the training fails or the observer cancels it.
    pub fn trained(
        &self,
        spec: &TrainingSpec,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<ReducedModel>, EngineError> {
        let origin = Origin::Training(Box::new(spec.clone()));
        Ok(made_once(&self.0.models, origin, || train(spec, observer).map(Arc::new))?)
    }

    /// Locks all shared objects. If the process is forked meanwhile, the child process finds them complete, because
    /// no other thread is changing them. They are unlocked when the child drops its copy of the locks.
    pub fn hold(&self) -> Held<'_> {
        let Shelves { grids, full, models, in_time, online } = &*self.0;
        Held {
            _program: embedded::hold(),
            _grids: lock(grids),
            _full: lock(full),
            _models: lock(models),
            _in_time: lock(in_time),
            _online: lock(online),
        }
    }

    /// Returns the model of a training if it has been trained and is still stored.
    pub fn already_trained(&self, spec: &TrainingSpec) -> Option<Arc<ReducedModel>> {
        kept(&self.0.models, &Origin::Training(Box::new(spec.clone())))
    }
}

impl Origin {
    /// Returns the origin for the current state of a file.
    fn of_file(path: &Path) -> Self {
        let (changed, size) =
            std::fs::metadata(path).map_or((None, 0), |metadata| (metadata.modified().ok(), metadata.len()));
        Self::File(path.to_owned(), changed, size)
    }
}

fn unreadable(path: &Path, reason: ModelFileError) -> EngineError {
    match reason {
        ModelFileError::Cancelled => EngineError::Cancelled,
        reason => EngineError::Model { path: path.to_owned(), reason: reason.into() },
    }
}

/// Returns the stored model of an origin, or `None`.
fn kept<M>(shelf: &Mutex<Vec<(Origin, Arc<M>)>>, origin: &Origin) -> Option<Arc<M>> {
    lock(shelf).iter().find(|(kept, _)| kept == origin).map(|(_, model)| Arc::clone(model))
}

/// Returns the stored model of an origin; makes it if there is none.
fn made_once<M, E>(
    shelf: &Mutex<Vec<(Origin, Arc<M>)>>,
    origin: Origin,
    make: impl FnOnce() -> Result<Arc<M>, E>,
) -> Result<Arc<M>, E> {
    if let Some(model) = kept(shelf, &origin) {
        return Ok(model);
    }
    let made = make()?;
    if let Some(first) = kept(shelf, &origin) {
        // Another thread has made it meanwhile: all callers receive the first one.
        return Ok(first);
    }
    keep(shelf, (origin, Arc::clone(&made)), |_| true, KEPT_MODELS);
    Ok(made)
}

fn lock<T>(shelf: &Mutex<T>) -> MutexGuard<'_, T> {
    // Every change is complete even after a panic of a thread.
    shelf.lock().unwrap_or_else(PoisonError::into_inner)
}

fn kept_of(kind: ContactKind) -> usize {
    if kind.is_line() { KEPT_LINES } else { KEPT_POINTS }
}

/// Removes and returns the most recently used matching object.
fn take<T>(shelf: &Mutex<Vec<T>>, wanted: impl Fn(&T) -> bool) -> Option<T> {
    let mut shelf = lock(shelf);
    shelf.iter().rposition(wanted).map(|place| shelf.remove(place))
}

/// Stores an object. If there are too many of its sort, the oldest one is freed.
fn keep<T>(shelf: &Mutex<Vec<T>>, thing: T, same_sort: impl Fn(&T) -> bool, most: usize) {
    make_room(shelf, same_sort, most);
    lock(shelf).push(thing);
}

/// Frees the oldest object of a sort if the maximum number of them is stored.
fn make_room<T>(shelf: &Mutex<Vec<T>>, same_sort: impl Fn(&T) -> bool, most: usize) {
    let mut shelf = lock(shelf);
    let full = shelf.iter().filter(|other| same_sort(other)).count() >= most;
    let oldest = shelf.iter().position(same_sort).filter(|_| full).map(|place| shelf.remove(place));
    // Freeing takes long, so the lock is released first. Other threads can then use the storage, and a forked process
    // finds it unlocked.
    drop((shelf, oldest));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;

    fn line(nodes: usize) -> GridSpec {
        GridSpec::Uniform { dx: 6.0 / nodes as f64, domain: (-4.0, 2.0) }
    }

    fn same(a: &ContactGrid, b: &ContactGrid) -> bool {
        matches!((a.line(), b.line()), (Some(a), Some(b)) if Arc::ptr_eq(a, b))
    }

    #[test]
    fn grids_are_shared_and_the_least_recently_used_goes() {
        let store = Store::default();
        let first = store.grid(line(100)).unwrap();
        assert!(same(&store.clone().grid(line(100)).unwrap(), &first));
        for nodes in 101..101 + KEPT_LINES - 1 {
            store.grid(line(nodes)).unwrap();
        }
        assert!(same(&store.grid(line(100)).unwrap(), &first), "it was used, and is still there");
        for nodes in 201..201 + KEPT_LINES {
            store.grid(line(nodes)).unwrap();
        }
        assert!(!same(&store.grid(line(100)).unwrap(), &first));
        assert!(store.grid(line(0)).is_err());
    }

    #[test]
    fn solvers_are_returned_unless_they_panicked_up_to_a_limit() {
        let store = Store::default();
        for nodes in 100..100 + 2 * KEPT_LINES {
            let grid = store.grid(line(nodes)).unwrap();
            store.with_full_solver(&grid, |solver| assert_eq!(solver.grid_spec(), grid.spec()));
        }
        assert_eq!(lock(&store.0.full).len(), KEPT_LINES);
        let grid = store.grid(line(99 + 2 * KEPT_LINES)).unwrap();
        let broken = super::super::job::guarded(|| store.with_full_solver(&grid, |_| panic!("broken")));
        assert!(broken.is_err() && lock(&store.0.full).len() == KEPT_LINES - 1);
    }

    #[test]
    fn a_model_is_read_once_and_its_operators_are_handed_on() {
        let store = Store::default();
        let model = store.embedded("line").unwrap();
        assert!(Arc::ptr_eq(&store.embedded("line").unwrap(), &model));
        let options = ReducedOptions::default();
        let online = store.online(&model, options);
        store.give_back(online);
        assert_eq!(lock(&store.0.online).len(), 1);
        let fewer = ReducedOptions { pressure_modes: Some(5), ..options };
        let _other = store.online(&model, fewer);
        assert_eq!(lock(&store.0.online).len(), 1, "other settings have other operators");
        let _same = store.online(&model, options);
        assert!(lock(&store.0.online).is_empty());
    }
}
