//! Solving single contacts by any method, with everything that can be kept between solves.

use super::rom::ModelFileError;
use super::store::Store;
use super::{Answer, Embedded, EngineError, ReducedFacts, Request, line_in_time};
use crate::scene::{Bench, Grid, Method, ModelSource, Scene, Study};
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::full::heat::Temperatures;
use crate::solver::full::point::resolution_warning;
use crate::solver::full::{Problem, Solution, SolveError, Start};
use crate::solver::physics::contact::{ContactKind, OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA};
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{Online, ReducedError, ReducedModel, STANDS_IN, Trust, Window};
use crate::solver::training::{TrainingObserver, TrainingSpec};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// What an answer says whose rupture front cycled.
const CAUTIOUS: &str = "the rupture front went to and fro between two sets of nodes; from then on it was moved node by \
    node";

/// What is said where a model was trained by the penalty and another law is asked for. Complementarity is what both of the
/// others amount to, as the penalty grows and where nothing starves: who was trained by it answers for them.
fn by_the_penalty(own: Cavitation, asked: Cavitation) -> Option<String> {
    (own == Cavitation::Penalty && asked != Cavitation::Penalty).then(|| {
        format!(
            "the reduced model ruptures the film by the penalty that it was trained with, not by {}; that moves H_c by \
             some 1e-7",
            asked.name()
        )
    })
}

/// The store as one job uses it: with the folder that its paths refer to, and reduced solvers that remember only what
/// this job has solved.
#[derive(Default)]
pub struct Workbench {
    store: Store,
    base: PathBuf,
    /// What stands in place of the embedded model of its kind of contact.
    in_use: Option<Arc<ReducedModel>>,
    /// Whether it does so for every kind of contact.
    for_all: bool,
    online: Vec<Online>,
}

impl Workbench {
    /// A workbench with a store of its own; relative paths refer to the folder `base`.
    pub fn new(base: impl Into<PathBuf>) -> Self {
        Self::on(&Store::default(), base)
    }

    /// A workbench on what others keep as well.
    pub fn on(store: &Store, base: impl Into<PathBuf>) -> Self {
        Self { store: store.clone(), base: base.into(), in_use: None, for_all: false, online: Vec::new() }
    }

    /// The same with a model in place of the embedded one of its kind of contact.
    pub fn using(mut self, model: &Arc<ReducedModel>) -> Self {
        self.in_use = Some(Arc::clone(model));
        self
    }

    /// The same with a model in place of all embedded ones: what it is not of, it refuses.
    pub fn with_model(mut self, model: &Arc<ReducedModel>) -> Self {
        self.for_all = true;
        self.using(model)
    }

    fn full(
        &mut self,
        request: &Request,
        problem: &Problem,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let start = start.map_or(Start::Cold, Start::From);
        let grid = self.grid(request, observer)?;
        let (solution, wall_s) = self.store.with_full_solver(&grid, |solver| {
            let clock = Instant::now();
            let solution = solver.solve(&request.point, request.lubricant, start, observer);
            let wall_s = clock.elapsed().as_secs_f64();
            (solution.map(|solution| solver.judged(solution)), wall_s)
        });
        let solution = solution?;
        if observer.cancelled() {
            return Err(EngineError::Cancelled);
        }
        let report = &solution.report;
        let mut warnings = Vec::new();
        if !solution.converged() {
            warnings.push(format!(
                "the full solver {} ({} Newton steps in {} attempts, residual {:.1e})",
                report.termination.describe(),
                report.newton_iterations,
                report.attempts,
                report.residual_norm
            ));
        }
        if report.cautious_front {
            warnings.push(CAUTIOUS.to_owned());
        }
        warnings.extend(solution.grid_warning());
        warnings.extend(problem.heat.as_ref().and_then(|heat| heat.warning(&problem.point)));
        warnings.extend(solution.heat.iter().flat_map(|heat| heat.warnings()));
        warnings.extend(resolution_warning(&solution).filter(|_| solution.converged()));
        let (nx, ny) = (solution.x.len(), solution.y.len());
        let (nodes, dofs) = match problem.point.kind {
            // Its node arrays have one node outside the inlet.
            ContactKind::Line => (nx - 1, nx - 2),
            ContactKind::Point => (nx, (nx - 2) * (ny - 1) + 1),
        };
        Ok(Answer {
            request: request.clone(),
            method: Method::Full,
            converged: solution.converged(),
            warnings,
            nodes,
            nodes_across: ny,
            dofs,
            newton_iterations: report.newton_iterations,
            linear_iterations: Some(report.linear_iterations),
            wall_s,
            reduced: None,
            solution: Some(solution),
        })
    }

    fn reduced(
        &mut self,
        request: &Request,
        problem: &Problem,
        (method, source): (&Method, &ModelSource),
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let model = self.model_for(source, &problem.point, &request.lubricant, observer)?;
        let options = method.options(window_of(&model, &problem.point)?);
        let same = |online: &Online| Arc::ptr_eq(&online.model, &model) && *online.options() == options;
        let known = self.online.iter().position(same).map(|place| self.online.swap_remove(place));
        let online = known.unwrap_or_else(|| self.store.online(&model, options));
        let online = self.online.push_mut(online);
        // Operators belong to the model: wall_s is the solve alone.
        online.prepare(&problem.point);
        let clock = Instant::now();
        let solved = online.solve(&problem.point, request.lubricant);
        let wall_s = clock.elapsed().as_secs_f64();
        let window = window_of(&model, &problem.point)?;
        let (nodes, nodes_across) = window.grid.nodes();
        let trust = model.trust(problem);
        let mut warnings = Vec::new();
        if let Trust::Outside(reason) = &trust {
            warnings.push(reason.clone());
        }
        let (own, asked) = (model.domain.lubricant.cavitation, request.lubricant.cavitation);
        if problem.supply.is_none() {
            warnings.extend(by_the_penalty(own, asked));
        }
        let mut facts = ReducedFacts {
            size: window.size(),
            trained: trust == Trust::Trained,
            cavitation: own,
            residual_estimate: None,
            error: None,
            traction: None,
        };
        let (solution, newton_iterations) = match solved {
            Ok(solved) => {
                facts.residual_estimate = Some(solved.residual_estimate);
                facts.error = solved.error;
                facts.traction = solved.traction;
                facts.size.pressure = solved.coefficients.len();
                warnings.extend(solved.stands_in.then(|| STANDS_IN.to_owned()));
                // A Newtonian film does not feel the sliding, but its traction does.
                let solution = online.reconstruct(&solved)?.of_problem(*problem);
                warnings.extend(resolution_warning(&solution));
                warnings.extend(problem.heat.as_ref().and_then(|heat| heat.warning(&problem.point)));
                warnings.extend(solution.heat.as_deref().and_then(Temperatures::too_hot));
                (Some(solution), solved.iterations)
            }
            Err(error) => match error.without_solution() {
                Some(iterations) => {
                    warnings.push(error.to_string());
                    (None, iterations)
                }
                None => return Err(error.into()),
            },
        };
        Ok(Answer {
            request: request.clone(),
            method: method.clone(),
            converged: solution.is_some(),
            warnings,
            nodes,
            nodes_across,
            dofs: facts.size.pressure + 1,
            newton_iterations,
            linear_iterations: None,
            wall_s,
            reduced: Some(facts),
            solution,
        })
    }
}

impl Bench for Workbench {
    fn answer(
        &mut self,
        request: &Request,
        method: &Method,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let problem = Problem::new(&request.point, request.lubricant)?;
        let grid = request.grid.for_contact(&problem.point).map_err(SolveError::from)?;
        let request = &Request { grid, ..request.clone() };
        if observer.cancelled() {
            return Err(EngineError::Cancelled);
        }
        let mut answer = match method {
            Method::Full => self.full(request, &problem, start, observer)?,
            Method::Reduced { model, .. } => self.reduced(request, &problem, (method, model), observer)?,
        };
        let p_h = request.point.hertz().pressure_pa;
        if p_h > PLAUSIBLE_HERTZ_PRESSURE_PA {
            answer
                .warnings
                .push(format!("the Hertzian pressure of {:.3} GPa exceeds 3.2 GPa: no real contact", p_h / 1e9));
        }
        let scalars = answer.result().map(|solution| solution.scalars);
        let doubt = answer.traction().zip(scalars).and_then(|(mu, scalars)| problem.doubts_traction(mu, &scalars));
        answer.warnings.extend(doubt.map(|doubt| doubt.to_string()));
        Ok(answer)
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
                self.store.embedded_watched(Embedded::of(point, lubricant), observer).map_err(|reason| match reason {
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
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<TrajectoryModel>, EngineError> {
        match source {
            ModelSource::Embedded => line_in_time().map_err(|reason| EngineError::Embedded(reason.into())),
            ModelSource::File(path) => self.store.trajectory_model_of_file(&self.base.join(path)),
            ModelSource::Trained(path) => {
                let path = self.base.join(path);
                let (scene, folder) = (Scene::read(&path)?, path.parent().unwrap_or(Path::new("")).to_owned());
                if !scene.trains_in_time() {
                    return Err(EngineError::NoTraining { path });
                }
                let mut bench = Self::on(&self.store, folder);
                self.store.trained_in_time(&scene, || scene.train_in_time(&mut bench, observer))
            }
        }
    }

    fn grid(&mut self, request: &Request, observer: &dyn TrainingObserver) -> Result<ContactGrid, EngineError> {
        let kind = request.point.kind;
        let grid = request.grid.for_contact(&request.point).map_err(SolveError::from)?;
        let spec = match kind {
            _ if grid == Grid::Graded => Some(GridSpec::explorer_for(&request.point).map_err(SolveError::from)?),
            ContactKind::Line => grid.spec(),
            ContactKind::Point => grid.point_spec().map(GridSpec::Plane),
        };
        match spec {
            Some(spec) => Ok(self.store.grid(spec).map_err(SolveError::from)?),
            None if kind == ContactKind::Point && request.grid != Grid::Model => {
                Err(EngineError::Study("a point contact needs a Plane `grid`, Model, or none".to_owned()))
            }
            None => {
                let model = self.model_for(&request.grid_model, &request.point, &request.lubricant, observer)?;
                let grid = &window_of(&model, &request.point)?.grid;
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
    /// Whether the models of a scene can be had.
    ///
    /// # Errors
    /// When one cannot be read, or no training is where one should be.
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

/// The window of a model that serves a contact.
fn window_of<'a>(model: &'a ReducedModel, point: &OperatingPoint) -> Result<&'a Window, EngineError> {
    let none = || EngineError::Study(format!("the reduced model `{}` holds no window", model.title));
    model.windows.get(model.window_for(point)).ok_or_else(none)
}

/// A model asked about the other kind of contact.
fn other_contact(model: &ReducedModel, given: ContactKind) -> EngineError {
    ReducedError::OtherContact { model: model.contact(), given }.into()
}
