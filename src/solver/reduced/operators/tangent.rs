//! Reduced solutions next to a known one, from the linearised sampled equations.
//!
//! The cavitation boundary keeps its place. Its motion between nodes changes the solution in small jumps, which are not
//! part of a derivative.

use super::assembled::Operators;
use super::case::{Case, Start, State};
use super::newton::{Wanted, spread};
use crate::solver::discrete::reynolds::film_integrals::LAST_STEP;

/// Largest number of Newton steps from the converged state to the state that is exact to rounding.
const REFINEMENTS: usize = 8;
/// Relative step at which a state is exact enough to be linearised, and at which rounding dominates.
const REFINED: f64 = 1e-8;
const ROUNDED: f64 = 1e-14;

/// Largest number of linear solves for one direction. One is enough with exact derivatives; others correct the
/// deformation by nodes near the cavitation boundary.
const CORRECTIONS: usize = 12;
/// Correction at which the direction is exact enough, relative to it.
const CORRECTED: f64 = 1e-7;
/// Corrections of the size of rounding, and largest ones that need not shrink further, relative to the state.
const NEGLIGIBLE: (f64, f64) = (1e-12, 2e-11);

/// Pressure coefficients and rigid-body separation H₀, one after the other.
type Unknowns = Vec<f64>;

impl Operators {
    /// Moves a converged state of the first case to the exact solution for a fixed cavitation boundary, and returns half
    /// the difference of the solutions of the other two cases, to first order. These lie on both sides of the first
    /// one, at equal small distances, and have its ellipse.
    ///
    /// `None` if the equations have no factors (residual minimisation), if temperatures are part of the state, or if an
    /// iteration fails.
    pub fn tangent(
        &mut self,
        [at, before, after]: [&Case<'_>; 3],
        start: &Start<'_>,
        state: &mut Unknowns,
    ) -> Option<Unknowns> {
        if !self.equations.have_factors() || at.problem.heat.is_some() {
            return None;
        }
        self.begin(at, start);
        self.system.nodes.forget();
        self.system.film_step = LAST_STEP;
        self.refine(at, state)?;
        let mut direction = vec![0.0; state.len()];
        let mut former = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let mut step = |case: &Case<'_>, sign: f64| {
                let moved: Unknowns = state.iter().zip(&direction).map(|(own, by)| own + sign * by).collect();
                self.step_at(case, &moved)
            };
            let (to_before, to_after) = (step(before, -1.0)?, step(after, 1.0)?);
            let correction: Unknowns = to_after.iter().zip(&to_before).map(|(a, b)| 0.5 * (a - b)).collect();
            direction.iter_mut().zip(&correction).for_each(|(own, by)| *own += by);
            let (size, whole) = (norm(&correction), norm(state));
            if size <= (CORRECTED * norm(&direction)).max(NEGLIGIBLE.0 * whole) {
                return Some(direction);
            }
            if size.is_nan() || size >= former {
                return (size <= NEGLIGIBLE.1 * whole).then_some(direction);
            }
            former = size;
        }
        None
    }

    /// Evaluates the residual e_f^I of a state, (3.15), with the cavitation boundary of [`Self::tangent`].
    pub fn residual(&mut self, case: &Case<'_>, state: &Unknowns) -> f64 {
        let (h_0, coefficients) = parts_of(state);
        spread(&mut self.system, &mut self.parts, coefficients);
        self.evaluate(case, State { coefficients, h_0 }, Wanted::Rest)
    }

    /// Runs Newton's method without damping and with a fixed cavitation boundary until rounding dominates. The factors
    /// are then those of the solution.
    fn refine(&mut self, case: &Case<'_>, state: &mut Unknowns) -> Option<()> {
        let mut former = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let (h_0, coefficients) = parts_of(state);
            spread(&mut self.system, &mut self.parts, coefficients);
            self.evaluate(case, State { coefficients, h_0 }, Wanted::Step { exact: true });
            let Self { system, parts, equations, .. } = self;
            if !equations.step(system, parts, case, coefficients, false) {
                return None;
            }
            let size = norm(&system.step.rhs) / norm(state);
            if size.is_nan() || size > 0.5 * former {
                break;
            }
            state.iter_mut().zip(&system.step.rhs).for_each(|(own, by)| *own += by);
            former = size;
            if size <= ROUNDED {
                break;
            }
        }
        (former <= REFINED).then_some(())
    }

    /// Returns the Newton step of a state with the factors of the last one.
    fn step_at(&mut self, case: &Case<'_>, state: &Unknowns) -> Option<Unknowns> {
        let (h_0, coefficients) = parts_of(state);
        spread(&mut self.system, &mut self.parts, coefficients);
        self.evaluate(case, State { coefficients, h_0 }, Wanted::StepAgain);
        let Self { system, parts, equations, .. } = self;
        equations.step_again(system, parts, case, coefficients).then(|| system.step.rhs.clone())
    }
}

/// Returns H₀ and the pressure coefficients.
fn parts_of(state: &Unknowns) -> (f64, &[f64]) {
    state.split_last().map_or((f64::NAN, &[]), |(h_0, coefficients)| (*h_0, coefficients))
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}
