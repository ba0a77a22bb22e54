//! Observer of a training. In addition to an [`Observer`] it can save the state, and provide full solutions that were
//! computed elsewhere.

use super::error::TrainingError;
use super::state::{Solved, TrainingState};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use std::sync::atomic::AtomicBool;

/// Observer of a training.
pub trait TrainingObserver: Observer {
    /// Called whenever full solutions are finished, so that the state can be saved.
    fn checkpoint(&self, _state: &TrainingState) {}

    /// Returns full solutions that are computed elsewhere. `asked` lists the contacts with their places in the order of
    /// planning. The result for each contact is its solution, an error, or [`TrainingError::Awaited`] if it is not
    /// available yet. `None` if the training must compute them itself.
    fn solved_elsewhere(&self, _asked: &[(usize, OperatingPoint)]) -> Option<Vec<Result<Solved, TrainingError>>> {
        None
    }
}

impl TrainingObserver for () {}

/// Stops a training from another thread.
impl TrainingObserver for AtomicBool {}
