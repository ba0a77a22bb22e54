//! What a study may use: whoever runs it solves its contacts and keeps what is expensive.

use super::answer::{Answer, Request};
use super::error::RunError;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::ReducedModel;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::training::{TrainingObserver, TrainingSpec};
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

/// Solves a contact for certain: if a reduced model has no solution, the full solver takes over on the model's grid, and
/// a warning says so.
///
/// # Errors
/// As [`Bench::answer`].
pub fn answer_or_full(
    bench: &mut dyn Bench,
    request: &Request,
    observer: &dyn TrainingObserver,
) -> Result<Answer, RunError> {
    let answer = bench.answer(request, None, observer)?;
    if answer.result.converged || request.method == Method::Full {
        return Ok(answer);
    }
    let request = Request { grid: Grid::Model, method: Method::Full, ..request.clone() };
    Ok(bench.answer(&request, None, observer)?.in_place_of(answer))
}
