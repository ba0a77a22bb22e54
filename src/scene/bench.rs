//! What a study may use: whoever runs it solves its contacts and keeps what is expensive.

use super::error::RunError;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::reduced::{ErrorEstimate, ModelSize, ReducedModel};
use crate::solver::training::{TrainingObserver, TrainingSpec};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What a study may use.
pub trait Bench {
    /// Solves a contact; `start` is a solution nearby, where there is one.
    ///
    /// # Errors
    /// When the request is refused or cancelled. Not converging is an answer.
    fn answer(
        &mut self,
        request: &Request,
        method: &Method,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, RunError>;

    /// The reduced model of a source for one kind of contact and a lubricant: read, or trained, once.
    ///
    /// # Errors
    /// When it cannot be read or trained.
    fn model_for(
        &mut self,
        source: &ModelSource,
        point: &OperatingPoint,
        lubricant: &Lubricant,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<ReducedModel>, RunError>;

    /// The reduced model in time of a source: read, or trained, once.
    ///
    /// # Errors
    /// When it cannot be read or trained, or is one of stationary contacts.
    fn trajectory_model(
        &mut self,
        source: &ModelSource,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<TrajectoryModel>, RunError>;

    /// The grid on which a request is solved in full.
    ///
    /// # Errors
    /// When the grid is refused or its model cannot be had.
    fn grid(&mut self, request: &Request, observer: &dyn TrainingObserver) -> Result<ContactGrid, RunError>;

    /// The training that another scene describes.
    ///
    /// # Errors
    /// When the scene cannot be read or describes none.
    fn training(&self, scene: &Path) -> Result<TrainingSpec, RunError>;

    /// The reduced model that a training gives, trained once.
    ///
    /// # Errors
    /// When it gives none or the observer cancels.
    fn trained(&self, spec: &TrainingSpec, observer: &dyn TrainingObserver) -> Result<Arc<ReducedModel>, RunError>;

    /// Forgets what has been solved: the next solution starts as the first one would.
    fn forget(&mut self);

    /// A path of the scene's, relative to its folder.
    fn resolve(&self, path: &Path) -> PathBuf;
}

/// Solves a contact for certain: where a reduced model has no solution, the full solver takes over on the model's grid
/// and says so.
///
/// # Errors
/// As [`Bench::answer`].
pub fn answer_or_full(
    bench: &mut dyn Bench,
    request: &Request,
    method: &Method,
    observer: &dyn TrainingObserver,
) -> Result<Answer, RunError> {
    let mut answer = bench.answer(request, method, None, observer)?;
    if !answer.converged && method.model().is_some() {
        let why = std::mem::take(&mut answer.warnings);
        let request = Request { grid: Grid::Model, ..request.clone() };
        answer = bench.answer(&request, &Method::Full, None, observer)?;
        answer.warnings.splice(0..0, why.into_iter().chain(["the full solver took over".to_owned()]));
    }
    Ok(answer)
}

/// What is to be solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The operating point.
    pub point: OperatingPoint,
    /// The lubricant's laws.
    pub lubricant: Lubricant,
    /// Grid of a full solution.
    pub grid: Grid,
    /// The model that [`Grid::Model`] means.
    pub grid_model: ModelSource,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Answer {
    /// What was asked.
    pub request: Request,
    /// How it was solved.
    pub method: Method,
    /// Fields and scalars; for a full solve that did not converge the last state, for such a reduced solve nothing.
    pub solution: Option<Solution>,
    /// Whether the solution is one.
    pub converged: bool,
    /// What a reader must know, one sentence each.
    pub warnings: Vec<String>,
    /// Nodes of the grid along X, both ends counted.
    pub nodes: usize,
    /// Nodes across, outer edge and axis counted; 1 for a line contact.
    pub nodes_across: usize,
    /// Unknowns that were iterated on.
    pub dofs: usize,
    /// Newton steps.
    pub newton_iterations: usize,
    /// Krylov iterations of a full solve.
    pub linear_iterations: Option<usize>,
    /// Seconds of the solve alone.
    pub wall_s: f64,
    /// What only a reduced solve has.
    pub reduced: Option<ReducedFacts>,
}

/// What a reduced solve adds to its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReducedFacts {
    /// Modes that were used, and sampled rows.
    pub size: ModelSize,
    /// Whether the model was trained for the point.
    pub trained: bool,
    /// How its films rupture.
    pub cavitation: Cavitation,
    /// e_f^I, (3.15); none without convergence.
    pub residual_estimate: Option<f64>,
    /// Calibrated errors, where the model has them.
    pub error: Option<ErrorEstimate>,
    /// Traction coefficient by the model's own rule, where it has one.
    pub traction: Option<f64>,
}

impl Answer {
    /// The solution, if it may be shown as a result.
    pub fn result(&self) -> Option<&Solution> {
        self.solution.as_ref().filter(|_| self.converged)
    }

    /// How the film ruptures in it; reduced models have the law that they were trained with.
    pub fn cavitation(&self) -> Cavitation {
        self.reduced.as_ref().map_or(self.request.lubricant.cavitation, |facts| facts.cavitation)
    }

    /// Traction coefficient (3.41) over the whole domain, at the request's slide-to-roll ratio; a reduced model's by
    /// its own rule, which its bound belongs to.
    pub fn traction(&self) -> Option<f64> {
        let by_rule = self.reduced.as_ref().and_then(|facts| facts.traction);
        self.result().map(|solution| by_rule.unwrap_or_else(|| solution.traction_coefficient()))
    }
}
