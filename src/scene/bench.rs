//! Services that a study uses: solving contacts, loading and training models. The caller of a study provides them, and
//! stores results that are expensive to compute again.

use super::answer::{Answer, Request};
use super::error::RunError;
use super::grid::Grid;
use super::method::{Method, ModelSource};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::Solution;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::ReducedModel;
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::training::{TrainingObserver, TrainingSpec};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Services that a study uses.
pub trait Bench {
    /// Solves a contact. `start` is a nearby solution, used as initial guess.
    ///
    /// # Errors
    /// If the request is refused or cancelled. A solve that does not converge is not an error.
    fn answer(
        &mut self,
        request: &Request,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, RunError>;

    /// Returns the reduced model of a source for this contact kind and lubricant. It is read or trained only once.
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

    /// Returns the transient reduced model of a source for a kind of contact. It is read or trained only once.
    ///
    /// # Errors
    /// If it cannot be read or trained, or if it is a model of steady contacts.
    fn trajectory_model(
        &mut self,
        source: &ModelSource,
        kind: ContactKind,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<TrajectoryModel>, RunError>;

    /// Returns the grid for a full solution of a request.
    ///
    /// # Errors
    /// If the grid is refused, or if the model that defines it is not available.
    fn grid(&mut self, request: &Request, observer: &dyn TrainingObserver) -> Result<ContactGrid, RunError>;

    /// Returns the training that another scene describes.
    ///
    /// # Errors
    /// If the scene cannot be read or describes no training.
    fn training(&self, scene: &Path) -> Result<TrainingSpec, RunError>;

    /// Returns the reduced model that a training produces. It is trained only once.
    ///
    /// # Errors
    /// If the training fails or the observer cancels it.
    fn trained(&self, spec: &TrainingSpec, observer: &dyn TrainingObserver) -> Result<Arc<ReducedModel>, RunError>;

    /// Drops stored starting values: the next solve starts as the first one would.
    fn forget(&mut self);

    /// Resolves a path of the scene relative to the scene's folder.
    fn resolve(&self, path: &Path) -> PathBuf;
}

/// Solves a contact, with the full solver as fallback: if a reduced solve does not converge, the contact is solved in
/// full on the model's grid, and a warning is added.
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
