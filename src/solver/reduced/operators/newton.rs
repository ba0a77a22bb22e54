//! Newton's method of the reduced model for the pressure coefficients p̃ and the rigid-body separation H₀. The cost of
//! an iteration does not depend on the number of nodes of the grid, and it allocates nothing. Extensions of the
//! equations, such as heat or a moving cavitation boundary, are parts ([`Part`]) that contribute to each stage.

use super::assembled::Operators;
use super::case::{Case, State};
use super::part::{Moved, Part, Step};
use super::sampled_system::SampledSystem;
use crate::solver::discrete::reynolds::film_integrals::LAST_STEP;
use faer::MatRef;

/// Number of steps after which derivatives are computed for the current cavitation boundary and not for a nearby one,
/// because this approximation may be the reason for slow convergence. Most solves take two to five steps.
const SLOW_AFTER: usize = 12;

/// Relative step below which derivatives are reused.
const NEAR: f64 = 1e-2;
/// Largest ratio of successive steps for which this continues.
const SHRINKS: f64 = 0.3;

/// Step at which the iteration for the film at a shear-thinning node ends, over the squared tolerance of Newton's
/// method. The errors of both iterations are proportional to the square of their last step. At a tolerance of 1e-3 both
/// errors are equal; at 1e-5 the films are exact to rounding.
const FILM_STEP: f64 = 1e3;

/// Purpose of an evaluation of the sampled equations.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Wanted {
    /// A step with new derivatives. With `exact`, the deformation K V of the modes V is that of the current cavitation
    /// boundary, instead of that of a nearby one that is stored.
    Step { exact: bool },
    /// A step with the previous derivatives. The quantities that the cavitation boundary checks are evaluated too.
    StepAgain,
    /// The residual at the end of the iteration.
    Rest,
}

/// Result of an online Newton iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnlineOutcome {
    pub converged: bool,
    /// Number of Newton steps.
    pub iterations: usize,
    /// Relative size of the last step.
    pub step: f64,
    /// Residual norm e_f^I of (3.15), with equations weighted by √w; w are the quadrature weights.
    pub residual: f64,
}

/// Iterate of the reduced model and its step, for the training.
pub(crate) struct Iterate<'a> {
    /// f_I: values of the sampled equations.
    pub residual: &'a [f64],
    /// Product J V Δz̃ of the Jacobian with the step, at the sampled equations.
    pub jacobian_step: &'a [f64],
    /// Reduced Jacobian including the load equation.
    pub jacobian: MatRef<'a, f64>,
    /// Step (Δp̃, ΔH₀).
    pub step: &'a [f64],
    /// Coefficients p̃ before the step.
    pub coefficients: &'a [f64],
    /// Film thickness at X = 0 per unit of each coefficient.
    pub lift: &'a [f64],
    /// Reference of relative errors of H_c: H_c before the step, for rough surfaces at least σ/2.
    pub h_c: f64,
}

/// Observer of all iterates.
pub(crate) type RowObserver<'a> = &'a mut dyn FnMut(&Iterate<'_>);

impl Operators {
    /// Runs Newton's method on (p̃, H₀) for one case, after [`Self::begin`]. Steps are shortened so that no
    /// pressure changes too much.
    pub fn newton(
        &mut self,
        case: &Case<'_>,
        (coefficients, h_0): (&mut [f64], &mut f64),
        mut observer: Option<RowObserver<'_>>,
    ) -> OnlineOutcome {
        let mut outcome = OnlineOutcome { converged: false, iterations: 0, step: f64::NAN, residual: f64::NAN };
        spread(&mut self.system, &mut self.parts, coefficients);
        // Films of another contact are not suitable initial guesses.
        self.system.nodes.forget();
        let (stop, tolerance) = (self.system.stop, case.stop.tolerance);
        self.system.film_step = (FILM_STEP * tolerance * tolerance).min(tolerance).max(LAST_STEP);
        // True if the factors of the last derivatives can be used again.
        let mut near = false;
        for iteration in 1..=stop.max_newton {
            let wanted = if near { Wanted::StepAgain } else { Wanted::Step { exact: iteration > SLOW_AFTER } };
            outcome.residual = self.evaluate(case, State { coefficients, h_0: *h_0 }, wanted);
            let Self { system, parts, equations, .. } = self;
            let solved = if near {
                equations.step_again(system, parts, case, coefficients)
            } else {
                equations.step(system, parts, case, coefficients, observer.is_some())
            };
            if !solved {
                return outcome;
            }
            outcome.iterations = iteration;
            if let Some(observer) = observer.as_mut() {
                self.report(case, (coefficients, *h_0), observer);
            }
            let Self { system, parts, equations, .. } = self;
            spread_step(system, parts);
            let by_part = parts.iter().find_map(|part| part.longest_step(system, case));
            let omega = by_part.unwrap_or_else(|| system.damping(case.scale));
            let previous = outcome.step;
            outcome.step = system.take_step(omega, coefficients, h_0);
            if !outcome.step.is_finite() {
                return outcome;
            }
            let step = Step { omega, size: outcome.step };
            let moved = parts.iter_mut().map(|part| part.settle(system, case, step, (&mut *coefficients, &mut *h_0)));
            let moved = moved.max().unwrap_or(Moved::Still);
            match moved {
                Moved::Lost => return outcome,
                Moved::State => spread(system, parts, coefficients),
                Moved::Still | Moved::BetweenRows | Moved::PastRows => {}
            }
            // Derivatives are not reused with a penalty, because its derivative jumps where a pressure changes sign.
            // They are not reused with an observer either, because it needs the equations of each step.
            near = moved < Moved::PastRows
                && omega == 1.0
                && outcome.step < if near { SHRINKS * previous } else { NEAR }
                && case.penalty == 0.0
                && observer.is_none()
                && equations.have_factors();
            if omega == 1.0 && outcome.step < stop.tolerance && moved == Moved::Still {
                outcome.converged = true;
                break;
            }
        }
        if !stop.at_step {
            outcome.residual = self.evaluate(case, State { coefficients, h_0: *h_0 }, Wanted::Rest);
        }
        // An iteration that ends with a very large residual has not converged.
        outcome.converged &= outcome.residual.is_finite() && outcome.residual < 1e3;
        outcome
    }

    /// Passes an iterate and its step to the observer.
    fn report(&mut self, case: &Case<'_>, (coefficients, h_0): (&[f64], f64), observer: &mut RowObserver<'_>) {
        self.system.times_step();
        let s = &self.system;
        let h_c = h_0 - 0.5 * case.scale.ln() + self.lifted(coefficients);
        observer(&Iterate {
            residual: &s.values,
            jacobian_step: &s.product,
            jacobian: s.jacobian.as_ref(),
            step: &s.step.rhs,
            coefficients,
            lift: &s.lift,
            h_c: case.problem.rough.map_or(h_c, |_| h_c.abs().max(case.problem.least_film())),
        });
    }

    /// Evaluates the sampled equations at the current state; returns e_f^I.
    pub(super) fn evaluate(&mut self, case: &Case<'_>, state: State<'_>, wanted: Wanted) -> f64 {
        let Self { system, parts, deformation, .. } = self;
        let scale = case.scale;
        system.lay_films(case, state.h_0);
        if !parts.iter_mut().any(|part| part.nodes(system, case, state)) {
            system.evaluate_nodes(case, wanted == Wanted::Rest);
        }
        let with_slopes = matches!(wanted, Wanted::Step { .. });
        let mut sum = system.evaluate_rows(case, with_slopes);
        sum += parts.iter_mut().map(|part| part.rows(system, case, with_slopes)).sum::<f64>();
        if let Wanted::Step { exact } = wanted {
            parts.iter_mut().for_each(|part| part.slopes(system));
            system.evaluate_jacobian(scale);
            parts.iter_mut().for_each(|part| part.jacobian(system, scale, exact));
        }
        sum += scale * deformation.missed(state.coefficients);
        if !case.prescribed {
            sum += (scale * system.carried(state.coefficients) - case.problem.load).powi(2);
        }
        sum.sqrt()
    }
}

/// Computes P, K P and their gradients for given coefficients at the nodes that the sampled equations need.
pub(super) fn spread(system: &mut SampledSystem, parts: &mut [Box<dyn Part>], coefficients: &[f64]) {
    let mut fields = std::mem::take(&mut system.fields);
    system.basis.spread(system.support.own, coefficients, &mut fields);
    parts.iter_mut().for_each(|part| part.spread(system, coefficients, &mut fields));
    system.fields = fields;
}

/// Computes the same quantities as [`spread`] for the coefficients of the Newton step.
fn spread_step(system: &mut SampledSystem, parts: &mut [Box<dyn Part>]) {
    let mut fields = std::mem::take(&mut system.step_fields);
    let step = &system.step.rhs[..system.modes];
    system.basis.spread(system.support.own, step, &mut fields);
    parts.iter_mut().for_each(|part| part.spread(system, step, &mut fields));
    system.step_fields = fields;
}
