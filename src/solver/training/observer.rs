//! Observer of a training.

use super::error::TrainingError;
use super::state::{Solved, TrainingState};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use std::sync::atomic::AtomicBool;

/// Observer of a training.
pub trait TrainingObserver: Observer {
    /// Called with the state whenever full solutions are finished, so that it can be saved.
    fn checkpoint(&self, _state: &TrainingState) {}

    /// Returns full solutions that are computed elsewhere. `asked` lists the contacts with their places in the order.
    /// For each it returns the solution, the error, or [`TrainingError::Awaited`]. `None` if the training is to
    /// compute them itself.
    fn solved_elsewhere(&self, _asked: &[(usize, OperatingPoint)]) -> Option<Vec<Result<Solved, TrainingError>>> {
        None
    }
}

impl TrainingObserver for () {}

/// Stops a training from another thread.
impl TrainingObserver for AtomicBool {}
