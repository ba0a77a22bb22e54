//! Progress reports and cancellation of long computations.
//!
//! All long computations use one trait, [`Observer`]. A computation that reports more has a trait that extends it: a
//! transient march reports its time steps, a training its state, a study its rows.

use crate::solver::limits::digits;
use crate::solver::physics::contact::Moes;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, Ordering};

/// Watches a computation from all of its threads. Every method has a default, so `()` is an observer that does nothing.
pub trait Observer: Sync {
    /// Called after every Newton step of a full solve.
    fn newton_step(&self, _step: &NewtonStep) {}

    /// Called with the pressure P (one value per node) after every Newton step of a full solve.
    fn iterate(&self, _pressure: &[f64]) {}

    /// Called after every Krylov iteration of the linear solve of a point contact. `count` is the number of
    /// iterations within the current Newton step.
    fn krylov_iteration(&self, _count: usize) {}

    /// Called before every step of a walk to a contact that no cold start reaches.
    fn walk_step(&self, _step: &WalkStep) {}

    /// Called when a part of a long computation is done.
    fn progress(&self, _progress: Progress) {}

    /// Returns `true` to stop the computation, which then returns what it has. Called between steps, and every few
    /// milliseconds within long steps.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Report of one Newton step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NewtonStep {
    /// Number of the step, from 1, counted over all attempts of the solve.
    pub iteration: usize,
    /// 2-norm of the scaled residual before the step.
    pub residual: f64,
    /// Relative step length ‖Δz‖/‖z‖, with z the vector of unknowns.
    pub step: f64,
}

/// Where a walk is: the solver's continuation from an easier contact to the wanted one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WalkStep {
    /// The wanted contact.
    pub wanted: Moes,
    /// The last contact that converged.
    pub reached: Moes,
}

impl std::fmt::Display for WalkStep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { wanted, reached } = self;
        let [m, l, at_m, at_l] = [wanted.m, wanted.l, reached.m, reached.l].map(digits);
        write!(f, "walking to M {m}, L {l}: at M {at_m}, L {at_l}")
    }
}

/// Progress of a long computation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Description of the current stage, for display.
    pub stage: String,
    /// Parts done.
    pub done: usize,
    /// Parts in this stage.
    pub total: usize,
}

impl Observer for () {}

/// Stops a computation when another thread sets it to `true`.
impl Observer for AtomicBool {
    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}
