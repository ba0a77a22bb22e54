//! The Newton iteration on reduced operators. Nothing here is of large scale, and nothing is allocated inside an
//! iteration.

use super::assembled::Operators;
use super::case::{Case, State};
use super::part::{Moved, Part, Step};
use super::sampled_system::SampledSystem;
use crate::solver::discrete::reynolds::film_integrals::LAST_STEP;
use faer::MatRef;

/// Steps after which an iteration is slow: most take two to five.
const SWIFT: usize = 12;

/// The relative step behind which derivatives serve again, and the share of it that the next one may have so that they
/// go on doing so.
const NEAR: f64 = 1e-2;
const SHRINKS: f64 = 0.3;

/// The step that ends the iteration of a thinning node's film, over the square of the one that ends the whole iteration.
/// Either leaves the square of its own step: at 1e-3 both are alike, at 1e-5 films are exact to rounding.
const FILM_STEP: f64 = 1e3;

/// What rows are evaluated for.
#[derive(Clone, Copy, PartialEq)]
enum Wanted {
    /// A step, by their derivatives. `exact` takes K V at the cavitation boundary's own place even where there are many
    /// lines, not at a place nearby.
    Step { exact: bool },
    /// A step by former derivatives, and what the cavitation boundary looks at.
    StepAgain,
    /// What is left of them where the iteration ended.
    Rest,
}

/// How an online Newton iteration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnlineOutcome {
    pub converged: bool,
    pub iterations: usize,
    pub step: f64,
    /// e_f^I, (3.15), with rows weighted by √w.
    pub residual: f64,
}

/// One online iterate, as the training sees it.
pub(crate) struct Iterate<'a> {
    /// f_I on the sampled rows.
    pub residual: &'a [f64],
    /// J V Δz̃ on the sampled rows.
    pub jacobian_step: &'a [f64],
    /// The reduced Jacobian, load row included.
    pub jacobian: MatRef<'a, f64>,
    /// (Δp̃, ΔH₀).
    pub step: &'a [f64],
    /// p̃ before the step.
    pub coefficients: &'a [f64],
    /// What the film at X = 0 gains per unit of each coefficient.
    pub lift: &'a [f64],
    /// H_c before the step.
    pub h_c: f64,
}

/// Sees each iterate.
pub(crate) type RowObserver<'a> = &'a mut dyn FnMut(&Iterate<'_>);

impl Operators {
    /// Newton's method on (p̃, H₀) for one case, after [`Self::begin`], damped by the largest pressure change.
    pub fn newton(
        &mut self,
        case: &Case<'_>,
        (coefficients, h_0): (&mut [f64], &mut f64),
        mut observer: Option<RowObserver<'_>>,
    ) -> OnlineOutcome {
        let mut outcome = OnlineOutcome { converged: false, iterations: 0, step: f64::NAN, residual: f64::NAN };
        spread(&mut self.system, &mut self.parts, coefficients);
        // The films of another contact are no start.
        self.system.nodes.forget();
        let (stop, tolerance) = (self.system.stop, case.stop.tolerance);
        self.system.film_step = (FILM_STEP * tolerance * tolerance).min(tolerance).max(LAST_STEP);
        // Whether the last derivatives are those of a place so near that their factors serve again.
        let mut near = false;
        for iteration in 1..=stop.max_newton {
            let wanted = if near { Wanted::StepAgain } else { Wanted::Step { exact: iteration > SWIFT } };
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
                self.show(case, (coefficients, *h_0), observer);
            }
            let Self { system, parts, equations, .. } = self;
            spread_step(system, parts);
            let omega = system.damping(case.scale);
            let former = outcome.step;
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
            // A penalty's derivatives jump where pressures change sign. Observers are shown what was solved.
            near = moved < Moved::PastRows
                && omega == 1.0
                && outcome.step < if near { SHRINKS * former } else { NEAR }
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
        // What came to rest at an absurd residual has found garbage.
        outcome.converged &= outcome.residual.is_finite() && outcome.residual < 1e3;
        outcome
    }

    /// Shows an iterate and the step that was solved for there.
    fn show(&mut self, case: &Case<'_>, (coefficients, h_0): (&[f64], f64), observer: &mut RowObserver<'_>) {
        self.system.times_step();
        let s = &self.system;
        observer(&Iterate {
            residual: &s.values,
            jacobian_step: &s.product,
            jacobian: s.jacobian.as_ref(),
            step: &s.step.rhs,
            coefficients,
            lift: &s.lift,
            h_c: h_0 - 0.5 * case.scale.ln() + self.lifted(coefficients),
        });
    }

    /// Evaluates the sampled rows at the fields; returns e_f^I.
    fn evaluate(&mut self, case: &Case<'_>, state: State<'_>, wanted: Wanted) -> f64 {
        let Self { system, parts, deformation, .. } = self;
        let scale = case.scale;
        system.lay_films(case, state.h_0);
        if !parts.iter_mut().any(|part| part.nodes(system, case, state)) {
            system.evaluate_nodes(case, wanted == Wanted::Rest);
        }
        let mut sum = system.evaluate_rows(case, matches!(wanted, Wanted::Step { .. }));
        if let Wanted::Step { exact } = wanted {
            parts.iter_mut().for_each(|part| part.slopes(system));
            system.evaluate_jacobian(scale);
            parts.iter_mut().for_each(|part| part.jacobian(system, scale, exact));
        }
        sum += scale * deformation.missed(state.coefficients);
        let carried: f64 = system.load_row.iter().zip(state.coefficients).map(|(l, c)| l * c).sum();
        sum += (scale * carried - case.problem.load).powi(2);
        sum.sqrt()
    }
}

/// P, K P and the gradients of coefficients, one behind the other at the support.
fn spread(system: &mut SampledSystem, parts: &mut [Box<dyn Part>], coefficients: &[f64]) {
    let mut fields = std::mem::take(&mut system.fields);
    system.basis.spread(system.support.own, coefficients, &mut fields);
    parts.iter_mut().for_each(|part| part.spread(system, coefficients, &mut fields));
    system.fields = fields;
}

/// The same of the step that was solved for.
fn spread_step(system: &mut SampledSystem, parts: &mut [Box<dyn Part>]) {
    let mut fields = std::mem::take(&mut system.step_fields);
    let step = &system.step.rhs[..system.modes];
    system.basis.spread(system.support.own, step, &mut fields);
    parts.iter_mut().for_each(|part| part.spread(system, step, &mut fields));
    system.step_fields = fields;
}
