//! How a computation tells its caller how far it got, and learns that it is no longer wanted.
//!
//! There is one [`Observer`] for everything that takes long. What tells more than this has a trait of its own on top of
//! it: a march its moments, a training its state, a study its rows.

use crate::solver::limits::digits;
use crate::solver::physics::contact::Moes;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, Ordering};

/// Watches a computation, from all of its threads. Every method has a default, so `()` watches nothing.
pub trait Observer: Sync {
    /// Called after every Newton step of a full solve.
    fn newton_step(&self, _step: &NewtonStep) {}

    /// Called with P (node array) after every Newton step of a full solve.
    fn iterate(&self, _pressure: &[f64]) {}

    /// Called after every Krylov iteration of a point contact's linear solve, with their count within the present
    /// Newton step.
    fn krylov_iteration(&self, _count: usize) {}

    /// Called before every step of a walk to a contact that no cold start reaches.
    fn walk_step(&self, _step: &WalkStep) {}

    /// Called as long work of many parts proceeds.
    fn progress(&self, _progress: Progress) {}

    /// Asked between steps, and every few milliseconds within long ones; `true` stops the computation with what it has.
    fn cancelled(&self) -> bool {
        false
    }
}

/// What one Newton step did.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NewtonStep {
    /// Count from 1, over all attempts of the solve.
    pub iteration: usize,
    /// 2-norm of the scaled residual before the step.
    pub residual: f64,
    /// ‖Δz‖/‖z‖ of the step taken.
    pub step: f64,
}

/// Where a walk is: the solver's continuation from an easier contact to the wanted one.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// How far long work is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// What is being done, for people.
    pub stage: String,
    /// Work done.
    pub done: usize,
    /// Work in all of this stage.
    pub total: usize,
}

impl Observer for () {}

/// Stops a computation from another thread.
impl Observer for AtomicBool {
    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}
