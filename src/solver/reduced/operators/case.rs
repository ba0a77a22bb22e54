//! One contact for the reduced operators: its problem, the initial guess and the stopping criterion of its iteration.

use crate::solver::discrete::heat::Profile;
use crate::solver::full::Problem;
use crate::solver::reduced::model::Window;

/// One contact for the reduced operators.
#[derive(Clone, Copy)]
pub(crate) struct Case<'a> {
    pub problem: &'a Problem,
    /// Registration scale s.
    pub scale: f64,
    /// 1/R̄ of (2.24); 1 if the radius is constant.
    pub curvature: f64,
    /// Penalty factor γ̄. With an active cavitation boundary it acts only on pressures in front of the centre.
    pub penalty: f64,
    /// True if the rigid-body separation H₀ is given. The load is then a result.
    pub prescribed: bool,
    /// Stopping criterion; parts may modify it.
    pub stop: Stop,
}

/// Stopping criterion of an online iteration.
#[derive(Clone, Copy, Default)]
pub(crate) struct Stop {
    pub tolerance: f64,
    pub max_newton: usize,
    /// True to report the residual of the last step instead of evaluating it once more.
    pub at_step: bool,
}

impl Stop {
    /// Stops after `max_newton` steps, or at a relative step below `tolerance`.
    pub fn new(tolerance: f64, max_newton: usize) -> Self {
        Self { tolerance, max_newton, at_step: false }
    }
}

/// Initial guess of an iteration, except for the pressure coefficients p̃ and the rigid-body separation H₀.
#[derive(Clone, Copy)]
pub(crate) struct Start<'a> {
    pub window: &'a Window,
    /// Number of modes whose coefficients the steps change; the coefficients of the others must be zero.
    pub modes: usize,
    /// First cavitated column of each line along X. `None` deactivates the cavitation boundary: the penalty then acts
    /// on all pressures.
    pub fronts: Option<&'a [usize]>,
    /// True if the cavitation boundary stays there.
    pub held: bool,
    /// Temperature rise θ at the stations of a thermal contact; empty for a cold start.
    pub theta: &'a [Profile],
}

/// State (p̃, H₀): pressure coefficients and rigid-body separation.
#[derive(Clone, Copy)]
pub(super) struct State<'a> {
    pub coefficients: &'a [f64],
    pub h_0: f64,
}
