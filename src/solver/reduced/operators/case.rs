//! One contact as the reduced operators see it: its problem, where its iteration begins and when it stops.

use crate::solver::discrete::heat::Profile;
use crate::solver::full::Problem;
use crate::solver::reduced::model::Window;

/// One contact as the reduced operators see it.
#[derive(Clone, Copy)]
pub(crate) struct Case<'a> {
    pub problem: &'a Problem,
    /// Registration scale s.
    pub scale: f64,
    /// 1/R̄ of (2.24); 1 where the radius does not vary.
    pub curvature: f64,
    /// Penalty factor γ̄; beside a cavitation boundary in force it holds only the pressures before the centre.
    pub penalty: f64,
    /// When its iteration stops; parts may want other limits.
    pub stop: Stop,
}

/// When an online iteration stops.
#[derive(Clone, Copy, Default)]
pub(crate) struct Stop {
    pub tolerance: f64,
    pub max_newton: usize,
    /// Whether the residual is that of the last step, and not evaluated once more behind it.
    pub at_step: bool,
}

impl Stop {
    /// After so many steps, or a relative step below a tolerance.
    pub fn new(tolerance: f64, max_newton: usize) -> Self {
        Self { tolerance, max_newton, at_step: false }
    }
}

/// Where an iteration begins, except for p̃ and H₀.
#[derive(Clone, Copy)]
pub(crate) struct Start<'a> {
    pub window: &'a Window,
    /// Number of modes whose coefficients steps change; the coefficients of the others must be zero.
    pub modes: usize,
    /// The first cavitated column of each line along X. `None` puts the cavitation boundary out of force, and the penalty
    /// holds all pressures.
    pub fronts: Option<&'a [usize]>,
    /// θ at the stations of a thermal contact; empty for a cold start.
    pub theta: &'a [Profile],
}

/// A state (p̃, H₀).
#[derive(Clone, Copy)]
pub(super) struct State<'a> {
    pub coefficients: &'a [f64],
    pub h_0: f64,
}
