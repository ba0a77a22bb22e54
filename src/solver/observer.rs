//! How a solve tells its caller how far it got, and learns that it is no longer wanted.

use std::sync::atomic::{AtomicBool, Ordering};

/// Watches a computation. Every method has a default, so `()` watches nothing.
pub trait Observer {
    /// Called after every Newton step of a full solve.
    fn newton_step(&mut self, _step: &NewtonStep) {}

    /// Called after every Krylov iteration of a point contact's linear solve, with their count within the present Newton step.
    fn krylov_iteration(&mut self, _count: usize) {}

    /// Asked between steps, and within the long ones; `true` stops the computation with what it has.
    fn cancelled(&self) -> bool {
        false
    }
}

/// What one Newton step did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonStep {
    /// Count from 1, over all attempts of the solve.
    pub iteration: usize,
    /// 2-norm of the scaled residual before the step.
    pub residual: f64,
    /// ‖Δz‖/‖z‖ of the step taken.
    pub step: f64,
}

impl Observer for () {}

/// Stops a computation from another thread.
impl Observer for &AtomicBool {
    fn cancelled(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}
