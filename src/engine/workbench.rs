//! Solving single contacts by any method, with everything that can be kept between solves.

use super::answer::{Answer, ReducedFacts, Request};
use super::error::EngineError;
use super::model_file;
use crate::scene::{Grid, Method, ModelSource, Scene, Study};
use crate::solver::discrete::grid::{ContactGrid, GridSpec, PointGrid, PointGridSpec, ReferenceGrid};
use crate::solver::full::point::resolution_warning;
use crate::solver::full::{FullSolver, PointSolver, Problem, Solution, Start};
use crate::solver::physics::contact::{ContactKind, Moes, PLAUSIBLE_HERTZ_PRESSURE_PA};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::{Online, ReducedError, ReducedModel, ReducedOptions, Trust, Window};
use crate::solver::training::{TrainingObserver, TrainingSpec, train};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Newtonian traction coefficients beyond this are no physics: real oils yield or thin long before.
const PLAUSIBLE_TRACTION: f64 = 0.2;

/// Grids, solvers and models, made when first needed and kept.
pub struct Workbench {
    base: PathBuf,
    solvers: Vec<FullSolver>,
    point_solvers: Vec<PointSolver>,
    models: Vec<(Wanted, Arc<ReducedModel>)>,
    online: Vec<(Wanted, Online)>,
}

/// Where a model comes from, of which kind of contact it should be, and whether its lubricant thins under shear: the program holds one of each.
type Wanted = (ModelSource, ContactKind, bool);

/// Full solvers of line contacts kept at a time; the oldest goes first.
const KEPT_SOLVERS: usize = 6;
/// Full solvers of point contacts kept at a time: each holds some hundred megabytes on a fine grid.
const KEPT_POINT_SOLVERS: usize = 2;

impl Workbench {
    /// An empty workbench; relative paths of models refer to the folder `base`.
    pub fn new(base: impl Into<PathBuf>) -> Self {
        Self {
            base: base.into(),
            solvers: Vec::new(),
            point_solvers: Vec::new(),
            models: Vec::new(),
            online: Vec::new(),
        }
    }

    /// A path of the scene's, relative to its folder.
    pub(super) fn resolve(&self, path: &Path) -> PathBuf {
        self.base.join(path)
    }

    /// Puts a model in place of what its source would give.
    pub fn insert_model(&mut self, source: ModelSource, model: Arc<ReducedModel>) {
        let wanted = (source, model.contact(), model.domain.sliding.is_some());
        self.models.retain(|(kept, _)| *kept != wanted);
        self.online.retain(|(kept, _)| *kept != wanted);
        self.models.push((wanted, model));
    }

    /// The reduced model of a source, for one kind of contact and a Newtonian lubricant: read, or trained, once.
    ///
    /// # Errors
    /// When it cannot be read or trained.
    pub fn model(
        &mut self,
        source: &ModelSource,
        contact: ContactKind,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<ReducedModel>, EngineError> {
        self.model_for(source, contact, &Lubricant::default(), observer)
    }

    /// The same for any lubricant.
    ///
    /// # Errors
    /// When it cannot be read or trained.
    pub fn model_for(
        &mut self,
        source: &ModelSource,
        contact: ContactKind,
        lubricant: &Lubricant,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<ReducedModel>, EngineError> {
        let wanted = wanted(source, contact, lubricant);
        if let Some((_, model)) = self.models.iter().find(|(kept, _)| *kept == wanted) {
            return Ok(Arc::clone(model));
        }
        let model = match source {
            ModelSource::Embedded if wanted.2 => super::embedded_shear_model(contact).map_err(EngineError::Embedded)?,
            ModelSource::Embedded => super::embedded_model(contact).map_err(EngineError::Embedded)?,
            ModelSource::File(path) => {
                let path = self.base.join(path);
                Arc::new(model_file::read(&path).map_err(|reason| EngineError::Model { path, reason })?)
            }
            ModelSource::Trained(path) => Arc::new(train(&self.training(path)?, observer)?),
        };
        self.models.push((wanted, Arc::clone(&model)));
        Ok(model)
    }

    /// The training that a scene describes.
    ///
    /// # Errors
    /// When the scene cannot be read or describes none.
    pub fn training(&self, scene: &Path) -> Result<TrainingSpec, EngineError> {
        let path = self.base.join(scene);
        match Scene::read(&path)?.study {
            Study::Training(spec) => Ok(spec),
            _ => Err(EngineError::NoTraining { path }),
        }
    }

    /// Solves a contact; `start` is a solution nearby, where there is one.
    ///
    /// # Errors
    /// When the request is refused or cancelled. Not converging is an answer.
    pub fn answer(
        &mut self,
        request: &Request,
        method: &Method,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let problem = Problem::new(&request.point, request.lubricant)?;
        if observer.cancelled() {
            return Err(EngineError::Cancelled);
        }
        let mut answer = match method {
            Method::Full => self.full(request, &problem, start, observer)?,
            Method::Reduced { model } => self.reduced(request, &problem, model, observer)?,
        };
        let p_h = request.point.hertz().pressure_pa;
        if p_h > PLAUSIBLE_HERTZ_PRESSURE_PA {
            answer
                .warnings
                .push(format!("the Hertzian pressure of {:.3} GPa exceeds 3.2 GPa: no real contact", p_h / 1e9));
        }
        let warning = answer.result().and_then(Solution::traction_warning);
        let traction = answer.traction().filter(|_| warning.is_none() && problem.shear.is_none()).unwrap_or(0.0).abs();
        answer.warnings.extend(warning);
        if traction > PLAUSIBLE_TRACTION {
            answer.warnings.push(format!(
                "a Newtonian traction coefficient of {traction:.3e} is unphysical at this pressure: the fluid would shear-thin or yield"
            ));
        }
        Ok(answer)
    }

    /// The full solver of point contacts for a request's grid.
    ///
    /// # Errors
    /// When the grid is refused or its model cannot be had.
    pub fn point_solver(
        &mut self,
        request: &Request,
        observer: &dyn TrainingObserver,
    ) -> Result<&mut PointSolver, EngineError> {
        let (spec, ready): (PointGridSpec, Option<Arc<PointGrid>>) = match (request.grid, request.grid.point_spec()) {
            (_, Some(spec)) => (spec, None),
            (Grid::Model, None) => {
                let model = self.model_for(&request.grid_model, ContactKind::Point, &request.lubricant, observer)?;
                match &window_of(&model, request.point.moes())?.grid {
                    ContactGrid::Point(grid) => (grid.spec, Some(Arc::clone(grid))),
                    ContactGrid::Line(_) => return Err(other_contact(&model, ContactKind::Point)),
                }
            }
            _ => return Err(EngineError::Study("a point contact needs a Plane `grid`, Model, or none".to_owned())),
        };
        let place = match self.point_solvers.iter().position(|solver| solver.grid().spec == spec) {
            Some(place) => place,
            None => {
                if self.point_solvers.len() == KEPT_POINT_SOLVERS {
                    self.point_solvers.remove(0);
                }
                self.point_solvers.push(match ready {
                    Some(grid) => PointSolver::on(grid),
                    None => PointSolver::new(spec)?,
                });
                self.point_solvers.len() - 1
            }
        };
        Ok(&mut self.point_solvers[place])
    }

    /// The full solver of line contacts for a request's grid.
    ///
    /// # Errors
    /// When the grid is refused or its model cannot be had.
    pub fn full_solver(
        &mut self,
        request: &Request,
        observer: &dyn TrainingObserver,
    ) -> Result<&mut FullSolver, EngineError> {
        let moes = request.point.moes();
        let (spec, ready): (GridSpec, Option<Arc<ReferenceGrid>>) = match request.grid.spec() {
            Some(spec) => (spec, None),
            None => {
                let model = self.model_for(&request.grid_model, ContactKind::Line, &request.lubricant, observer)?;
                match &window_of(&model, moes)?.grid {
                    ContactGrid::Line(grid) => (grid.spec, Some(Arc::clone(grid))),
                    ContactGrid::Point(_) => return Err(other_contact(&model, ContactKind::Line)),
                }
            }
        };
        let place = match self.solvers.iter().position(|solver| solver.reference().spec == spec) {
            Some(place) => place,
            None => {
                let solver = match ready {
                    Some(grid) => FullSolver::on(grid),
                    None => FullSolver::new(spec)?,
                };
                if self.solvers.len() == KEPT_SOLVERS {
                    self.solvers.remove(0);
                }
                self.solvers.push(solver);
                self.solvers.len() - 1
            }
        };
        Ok(&mut self.solvers[place])
    }

    fn full(
        &mut self,
        request: &Request,
        problem: &Problem,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let start = start.map_or(Start::Cold, Start::From);
        let (solution, wall_s) = match problem.point.kind {
            ContactKind::Line => {
                let solver = self.full_solver(request, observer)?;
                let clock = Instant::now();
                (solver.solve_problem(*problem, start, observer), clock.elapsed().as_secs_f64())
            }
            ContactKind::Point => {
                let solver = self.point_solver(request, observer)?;
                let clock = Instant::now();
                (solver.solve_problem(*problem, start, observer)?, clock.elapsed().as_secs_f64())
            }
        };
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
        source: &ModelSource,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, EngineError> {
        let wanted = wanted(source, problem.point.kind, &request.lubricant);
        let model = self.model_for(source, problem.point.kind, &request.lubricant, observer)?;
        let place = match self.online.iter().position(|(kept, _)| *kept == wanted) {
            Some(place) => place,
            None => {
                self.online.push((wanted, Online::new(Arc::clone(&model), ReducedOptions::default())));
                self.online.len() - 1
            }
        };
        let online = &mut self.online[place].1;
        // Operators belong to the model: wall_s is the solve alone.
        online.prepare(problem.moes);
        let clock = Instant::now();
        let solved = online.solve(&problem.point, request.lubricant);
        let wall_s = clock.elapsed().as_secs_f64();
        let window = window_of(&model, problem.moes)?;
        let (nodes, nodes_across) = window.grid.nodes();
        let trust = model.trust(problem);
        let mut warnings = Vec::new();
        if let Trust::Outside(reason) = &trust {
            warnings.push(reason.clone());
        }
        let mut facts = ReducedFacts {
            basis_p: window.pressure.modes.ncols(),
            basis_delta: window.deformation.modes.ncols(),
            sampled_rows: window.sampled_rows.len(),
            trained: trust == Trust::Trained,
            residual_estimate: None,
            error: None,
            traction: None,
        };
        let (solution, newton_iterations) = match solved {
            Ok(solved) => {
                facts.residual_estimate = Some(solved.residual_estimate);
                facts.error = solved.error;
                facts.traction = solved.traction;
                facts.basis_p = solved.coefficients.len();
                let mut solution = online.reconstruct(&solved)?;
                warnings.extend(resolution_warning(&solution));
                // A Newtonian film does not feel the sliding, but its traction does.
                solution.problem = *problem;
                (Some(solution), solved.iterations)
            }
            Err(error @ ReducedError::NotConverged { iterations, .. }) => {
                warnings.push(error.to_string());
                (None, iterations)
            }
            Err(refused) => return Err(refused.into()),
        };
        Ok(Answer {
            request: request.clone(),
            method: Method::Reduced { model: source.clone() },
            converged: solution.is_some(),
            warnings,
            nodes,
            nodes_across,
            dofs: facts.basis_p + 1,
            newton_iterations,
            linear_iterations: None,
            wall_s,
            reduced: Some(facts),
            solution,
        })
    }
}

fn wanted(source: &ModelSource, contact: ContactKind, lubricant: &Lubricant) -> Wanted {
    (source.clone(), contact, lubricant.shear != ShearLaw::Newtonian)
}

/// The window of a model that serves a contact.
fn window_of(model: &ReducedModel, moes: Moes) -> Result<&Window, EngineError> {
    let none = || EngineError::Study(format!("the reduced model `{}` holds no window", model.title));
    model.windows.get(model.window_for(moes)).ok_or_else(none)
}

/// A model asked about the other kind of contact.
fn other_contact(model: &ReducedModel, given: ContactKind) -> EngineError {
    ReducedError::OtherContact { model: model.contact(), given }.into()
}
