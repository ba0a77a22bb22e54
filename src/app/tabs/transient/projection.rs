//! Pressure error of a reduced run, and the smallest error that its basis permits. The latter is the error of the
//! projection of the full pressure, which no reduced run can improve on.

use crate::app::tabs::transient::Run;
use crate::solver::discrete::grid::dot;
use crate::solver::reduced::transient::TrajectoryModel;

/// Tolerance for the comparison of times, because of rounding errors.
const ROUNDING: f64 = 1e-9;

/// Both errors over time, relative to the full pressure, in the norm in which the basis is orthonormal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldErrors {
    /// T and ‖P̃ − P‖/‖P‖.
    pub own: Vec<(f64, f64)>,
    /// T and the smallest error that the basis permits.
    pub least: Vec<(f64, f64)>,
}

impl FieldErrors {
    /// Compares a run with a full run at all times where both have stored fields.
    pub fn of(run: &Run, full: &Run, model: &TrajectoryModel) -> Self {
        let window = &model.window;
        let weights = window.grid.weights();
        let norm = |values: &dyn Fn(usize) -> f64| {
            weights.iter().enumerate().map(|(i, w)| w * values(i).powi(2)).sum::<f64>().sqrt()
        };
        let mut errors = Self::default();
        let mut own = run.trajectory.states.iter().peekable();
        for state in &full.trajectory.states {
            let nodes = weights.len();
            if state.pressure.len() != nodes {
                continue;
            }
            while own.next_if(|other| other.time < state.time - ROUNDING).is_some() {}
            let coefficients = window.pressure.basis().coefficients(weights, |i| state.pressure[i]);
            let whole = norm(&|i| state.pressure[i]);
            // The projection is orthogonal to its error.
            let missed = (whole * whole - dot(&coefficients, &coefficients)).max(0.0).sqrt();
            errors.least.push((state.time, missed / whole));
            let same = own.peek().filter(|other| other.time <= state.time + ROUNDING && other.pressure.len() == nodes);
            if let Some(other) = same {
                errors.own.push((state.time, norm(&|i| other.pressure[i] - state.pressure[i]) / whole));
            }
        }
        errors
    }
}
