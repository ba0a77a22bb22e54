//! Solution of single contacts by any method, with everything that can be kept between solves.

use super::answer::{Solver, answer, window_of};
use super::rom::ModelFileError;
use super::store::Store;
use super::{Answer, EngineError, Request, catalogue, in_time, registry};
use crate::scene::{Bench, Grid, Method, ModelSource, Scene, Study};
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::full::{Problem, Solution, SolveError, Start};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Online, ReducedError, ReducedModel};
use crate::solver::training::{TrainingObserver, TrainingSpec};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Use of the store by one job: the folder to which its paths refer, and reduced solvers with the solutions of this
/// job only.
#[derive(Default)]
pub struct Workbench {
    store: Store,
    base: PathBuf,
    /// Model used instead of the embedded model of its kind of contact.
    in_use: Option<Arc<ReducedModel>>,
    /// True if that model replaces the embedded models of all kinds of contact.
    for_all: bool,
    online: Vec<Online>,
}

impl Workbench {
    /// Creates a workbench with a new store. Relative paths refer to the folder `base`.
    pub fn new(base: impl Into<PathBuf>) -> Self {
        Self::on(&Store::default(), base)
    }

    /// Creates a workbench on a shared store.
    pub fn on(store: &Store, base: impl Into<PathBuf>) -> Self {
        Self { store: store.clone(), base: base.into(), in_use: None, for_all: false, online: Vec::new() }
    }

    /// Replaces the embedded model of the same kind of contact by this model.
    pub fn using(mut self, model: &Arc<ReducedModel>) -> Self {
        self.in_use = Some(Arc::clone(model));
        self
    }

    /// Replaces all embedded models by this model. Contacts of the other kind are then refused.
    pub fn with_model(mut self, model: &Arc<ReducedModel>) -> Self {
        self.for_all = true;
        self.using(model)
    }
}

impl Workbench {
    /// Returns its store.
    pub fn store(&self) -> &Store {
        &self.store
    }

    /// Returns the model used instead of embedded ones, and whether it replaces all of them.
    pub fn in_use(&self) -> Option<(&Arc<ReducedModel>, bool)> {
        self.in_use.as_ref().map(|model| (model, self.for_all))
    }
}

impl Bench for Workbench {
    fn answer(
        &mut self,
        request: &Request,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let point = Problem::new(&request.point, request.lubricant)?.point;
        let fitted = request.lubricant.grid_contact(&point);
        let grid = request.grid.for_contact(&fitted).map_err(SolveError::from)?;
        let request = &Request { grid, ..request.clone() };
        if observer.cancelled() {
            return Err(EngineError::Cancelled);
        }
        let Method::Reduced { model, .. } = &request.method else {
            let (grid, start) = (self.grid(request, observer)?, start.map_or(Start::Cold, Start::From));
            let answer =
                self.store.with_full_solver(&grid, |solver| answer(request, Solver::Full(solver, start), observer));
            return if observer.cancelled() { Err(EngineError::Cancelled) } else { answer };
        };
        let model = self.model_for(model, &point, &request.lubricant, observer)?;
        let options = request.method.options(window_of(&model, &point)?.1);
        let same = |online: &Online| Arc::ptr_eq(&online.model, &model) && *online.options() == options;
        let known = self.online.iter().position(same).map(|place| self.online.swap_remove(place));
        let online = known.unwrap_or_else(|| self.store.online(&model, options));
        answer(request, Solver::Reduced(self.online.push_mut(online)), observer)
    }

    fn model_for(
        &mut self,
        source: &ModelSource,
        point: &OperatingPoint,
        lubricant: &Lubricant,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<ReducedModel>, EngineError> {
        let serves = |model: &&Arc<ReducedModel>| self.for_all || model.is_of(point);
        let in_use = self.in_use.as_ref().filter(|_| *source == ModelSource::Embedded).filter(serves);
        if let Some(model) = in_use {
            return Ok(Arc::clone(model));
        }
        match source {
            ModelSource::Embedded => {
                let models = catalogue().iter().map(|entry| (entry.name, &entry.domain));
                let name = registry::best(models, point, lubricant).unwrap_or_default();
                self.store.embedded_watched(name, observer).map_err(|reason| match reason {
                    ModelFileError::Cancelled => EngineError::Cancelled,
                    reason => EngineError::Embedded(reason.into()),
                })
            }
            ModelSource::File(path) => self.store.model_of_file_watched(&self.base.join(path), observer),
            ModelSource::Trained(path) => self.store.trained(&self.training(path)?, observer),
        }
    }

    fn trajectory_model(
        &mut self,
        source: &ModelSource,
        kind: ContactKind,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<TrajectoryModel>, EngineError> {
        match source {
            ModelSource::Embedded => in_time(kind).map_err(|reason| EngineError::Embedded(reason.into())),
            ModelSource::File(path) => self.store.trajectory_model_of_file(&self.base.join(path)),
            ModelSource::Trained(path) => {
                let path = self.base.join(path);
                let (scene, folder) = (Scene::read(&path)?, path.parent().unwrap_or(Path::new("")).to_owned());
                if !scene.trains_in_time() {
                    return Err(EngineError::NoTraining { path });
                }
                let mut bench = Self::on(&self.store, folder);
                self.store.trained_in_time(&scene, || Ok(scene.train_in_time(&mut bench, observer)?.0))
            }
        }
    }

    fn grid(&mut self, request: &Request, observer: &dyn TrainingObserver) -> Result<ContactGrid, EngineError> {
        let kind = request.point.kind;
        let fitted = request.lubricant.grid_contact(&request.point);
        let grid = request.grid.for_contact(&fitted).map_err(SolveError::from)?;
        let spec = match grid {
            Grid::Graded => Some(GridSpec::explorer_for(&fitted).map_err(SolveError::from)?),
            _ => grid.spec_for(kind),
        };
        match spec {
            Some(spec) => Ok(self.store.grid(spec).map_err(SolveError::from)?),
            None if kind.is_point() && request.grid != Grid::Model => {
                Err(EngineError::Study("a point contact needs a Plane `grid`, Model, or none".to_owned()))
            }
            None => {
                let model = self.model_for(&request.grid_model, &request.point, &request.lubricant, observer)?;
                let grid = &window_of(&model, &request.point)?.1.grid;
                if grid.kind() == kind { Ok(grid.clone()) } else { Err(other_contact(&model, kind)) }
            }
        }
    }

    fn training(&self, scene: &Path) -> Result<TrainingSpec, EngineError> {
        let path = self.base.join(scene);
        Scene::read(&path)?.training().ok_or(EngineError::NoTraining { path })
    }

    fn trained(&self, spec: &TrainingSpec, observer: &dyn TrainingObserver) -> Result<Arc<ReducedModel>, EngineError> {
        self.store.trained(spec, observer)
    }

    fn forget(&mut self) {
        self.online.iter_mut().for_each(Online::forget);
    }

    fn resolve(&self, path: &Path) -> PathBuf {
        self.base.join(path)
    }
}

impl Drop for Workbench {
    fn drop(&mut self) {
        for online in self.online.drain(..) {
            self.store.give_back(online);
        }
    }
}

impl Workbench {
    /// Checks that the models of a scene are available.
    ///
    /// # Errors
    /// If a model cannot be read, or a scene that should contain a training does not.
    pub fn check_models(&self, scene: &Scene) -> Result<(), EngineError> {
        if let Study::Transient(study) = &scene.study
            && let Some(ModelSource::File(path)) = study.reduced.as_ref().and_then(|reduced| reduced.model.as_ref())
        {
            self.store.trajectory_model_of_file(&self.base.join(path))?;
        }
        scene.study.methods().iter().filter_map(Method::model).try_for_each(|source| match source {
            ModelSource::Embedded => Ok(()),
            ModelSource::File(path) => self.store.model_of_file(&self.base.join(path)).map(drop),
            ModelSource::Trained(path) => self.training(path).map(drop),
        })
    }
}

/// Creates the error of a model that was requested for the other kind of contact.
fn other_contact(model: &ReducedModel, given: ContactKind) -> EngineError {
    ReducedError::OtherContact { model: model.contact(), given }.into()
}
