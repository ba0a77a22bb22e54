//! Error indicators for the selection of training points: they estimate the error of a reduced solution without an
//! existing full solution (Section 3.1.2).
//!
//! The residual ranks solutions by the error of the pressure, not of the film thickness. The change by Newton steps of
//! the full system ranks them by the error of the central film thickness H_c. These steps are undamped. Damping by the
//! residual would hide the error, because the penalty makes the residual jump even for a good step. Three steps give
//! the minimum film thickness H_min accurately enough for a calibrated bound.
//!
//! For shear-thinning, thermal, rough and lubricant-parameterised models no fixed number of steps is sufficient
//! everywhere. Their full system is solved until convergence, starting from the reduced solution.

use super::error::TrainingError;
use super::observer::TrainingObserver;
use super::spec::{Indicator, TrainingSpec};
use crate::host::pool;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::{ContactSolver, Problem, Solution, Start};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{ErrorMeasures, Measured, Norm, Online, ReducedOptions, ReducedSolution, Window};
use rayon::prelude::*;
use std::sync::Arc;

/// Number of full Newton steps of [`Indicator::Correction`].
const CORRECTIONS: usize = 3;

/// Reduced solvers of a model in training, one per thread.
pub(super) struct Judges<'a> {
    indicator: Indicator,
    lubricant: Lubricant,
    measures: Option<ErrorMeasures>,
    solvers: Vec<(Online, Corrector)>,
    observer: &'a dyn TrainingObserver,
}

impl<'a> Judges<'a> {
    /// Creates the solvers for an indicator and a local model.
    pub fn new(indicator: Indicator, spec: &TrainingSpec, window: &Window, observer: &'a dyn TrainingObserver) -> Self {
        let model = Arc::new(spec.model_of(window));
        let (options, measures) = match indicator {
            Indicator::Dissertation => {
                let options = ReducedOptions::dissertation();
                (options, Some(ErrorMeasures::new(window, &options, Norm::Euclidean)))
            }
            Indicator::Residual | Indicator::Correction => (ReducedOptions::default(), None),
        };
        let solver = |_| (Online::new(Arc::clone(&model), options), Corrector::of(window));
        let solvers = (0..pool::threads()).map(solver).collect();
        Self { indicator, lubricant: spec.lubricant, measures, solvers, observer }
    }

    /// Returns the indicator at each point; infinite if the reduced model fails. Every solve starts without previous
    /// solutions, so that the result depends neither on the order of the points nor on the number of threads.
    ///
    /// # Errors
    /// If the observer cancels.
    pub fn judge(&mut self, points: &[OperatingPoint]) -> Result<Vec<f64>, TrainingError> {
        let Self { indicator, lubricant, measures, solvers, observer } = self;
        let measures = measures.as_ref();
        let threads = solvers.len();
        let share = |(t, solvers): (usize, &mut (Online, Corrector))| {
            let judge = |point: &OperatingPoint| {
                if observer.cancelled() {
                    return Err(TrainingError::Cancelled);
                }
                let error = error_at(*indicator, measures, solvers, point, *lubricant);
                Ok(error.unwrap_or(f64::INFINITY))
            };
            points.iter().skip(t).step_by(threads).map(judge).collect()
        };
        let parts: Vec<Vec<f64>> =
            pool::on_all_cores(|| solvers.par_iter_mut().enumerate().map(share).collect::<Result<_, TrainingError>>())?;
        Ok((0..points.len()).map(|i| parts[i % threads][i / threads]).collect())
    }
}

/// Returns the indicator of one reduced solve; `None` if it fails.
fn error_at(
    indicator: Indicator,
    measures: Option<&ErrorMeasures>,
    (online, corrector): &mut (Online, Corrector),
    point: &OperatingPoint,
    lubricant: Lubricant,
) -> Option<f64> {
    online.forget();
    let solved = online.solve(point, lubricant).ok()?;
    let error = match indicator {
        Indicator::Residual => solved.residual_estimate,
        Indicator::Dissertation => {
            let fields = online.reconstruct(&solved).ok()?;
            measures?.residuals(&solved.coefficients, &fields).sampled_rows
        }
        Indicator::Correction => {
            let Measured { h_c, h_min, state, .. } = corrector.errors(online, &solved)?;
            h_c.max(0.5 * h_min).max(state)
        }
    };
    error.is_finite().then_some(error)
}

/// Measures errors of the reduced solutions of a local model by Newton steps of the full system.
pub(super) struct Corrector {
    grid: ContactGrid,
    /// Full solver, created at first use and then kept.
    full: Option<ContactSolver>,
}

impl Corrector {
    /// Creates the corrector for a local model.
    pub fn of(window: &Window) -> Self {
        Self { grid: window.grid.clone(), full: None }
    }

    /// Returns the errors of a reduced solution: always of H_c, H_min and the state (e_z of (3.10)), and of further
    /// quantities if they exist. The errors are estimated by a few Newton steps of the full system: nearly exact for a
    /// good model, and large for a bad one. For shear-thinning, thermal, rough and lubricant-parameterised models they
    /// are measured against the full solution. `None` if a solve fails.
    pub fn errors(&mut self, online: &Online, solved: &ReducedSolution) -> Option<Measured> {
        let before = online.reconstruct(solved).ok()?;
        let sliding = online.model.slides();
        let in_full = online.model.domain.measured_in_full();
        let full = self.full.get_or_insert_with(|| ContactSolver::on(&self.grid));
        let after = if in_full { full_solution(full, &before)? } else { full.corrected(&before, CORRECTIONS).ok()? };
        let relative = |from: f64, to: f64| (from / to - 1.0).abs();
        let change = |from: f64, to: f64| before.problem.film_difference(from, to).abs();
        let (from, to) = (&before.scalars, &after.scalars);
        let (mut difference, mut size) = ((from.h_0 - to.h_0).powi(2), to.h_0.powi(2));
        for (node, was) in before.deformation().into_iter().enumerate() {
            // Both solutions have the same gap of the undeformed bodies.
            let is = was + (after.film[node] - before.film[node]) - (to.h_0 - from.h_0);
            difference += (before.pressure[node] - after.pressure[node]).powi(2) + (was - is).powi(2);
            size += after.pressure[node].powi(2) + is * is;
        }
        let (h_c, h_min) = (change(from.h_c, to.h_c), change(from.h_min, to.h_min));
        let state = (difference / size).sqrt();
        let finite = [h_c, h_min, state].iter().all(|error| error.is_finite());
        let slides = solved.point.sliding.slide_to_roll_ratio != 0.0;
        let physical = slides && before.problem.traction_warning().is_none();
        let mixed = before.mixed().zip(after.mixed());
        let pair = match mixed {
            // The boundary friction follows from the asperity load share, so only the friction of the film counts here.
            Some((reduced, exact)) => physical.then_some((reduced.fluid_traction, exact.fluid_traction)),
            None => {
                solved.traction.filter(|_| sliding && physical).map(|reduced| (reduced, after.traction_coefficient()))
            }
        };
        let load_share = mixed.map(|(reduced, exact)| (reduced.asperity_load_share - exact.asperity_load_share).abs());
        let traction = pair.map(|(reduced, exact)| relative(reduced, exact)).filter(|error| error.is_finite());
        let rises = before.heat.as_ref().zip(after.heat.as_ref());
        let rise = rises.map(|(reduced, exact)| reduced.central.difference(&exact.central));
        finite.then_some(Measured { h_c, h_min, state, traction, rise, load_share })
    }
}

/// Computes the full solution from a reduced one; `None` if it does not converge.
fn full_solution(full: &mut ContactSolver, before: &Solution) -> Option<Solution> {
    let Problem { point, lubricant, .. } = &before.problem;
    full.solve(point, *lubricant, Start::From(before), &()).ok().filter(Solution::converged)
}
