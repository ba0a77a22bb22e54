//! Who watches a training.

use super::error::TrainingError;
use super::state::{Solved, TrainingState};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use std::sync::atomic::AtomicBool;

/// Watches a training.
pub trait TrainingObserver: Observer {
    /// Shown the state whenever full solutions were finished: what a crash must not lose can be written here.
    fn checkpoint(&self, _state: &TrainingState) {}

    /// Full solutions that somebody else has computed, or is to compute: of each contact that is asked for, by its place
    /// in the order, the solution, why there is none, or [`TrainingError::Awaited`]. None computes them here.
    fn solved_elsewhere(&self, _asked: &[(usize, OperatingPoint)]) -> Option<Vec<Result<Solved, TrainingError>>> {
        None
    }
}

impl TrainingObserver for () {}

/// Stops a training from another thread.
impl TrainingObserver for AtomicBool {}
