//! Newton steps of a reduced model with heat: marches of the temperatures and steps of pressure and film, in turns.

use super::assembled::Operators;
use super::heat::Heated;
use super::newton::{Case, OnlineOutcome, RowObserver, Slopes, Stop, Wanted};
use crate::solver::discrete::heat::Profile;
use crate::solver::full::Problem;
use crate::solver::reduced::warmth::Warmth;

/// What ends turns over what ends Newton's steps alone: a relative step of pressure and film, and a change of θ. A kelvin
/// is 3e-3.
const TOLERANCES: (f64, f64) = (10.0, 10.0);

/// A step of pressure and film and a change of θ below which states are mixed.
const NEAR: f64 = 0.1;

/// Least share of a change of temperatures that is taken.
const LEAST_SHARE: f64 = 0.06;

impl Operators {
    /// The temperatures of the last turns; none of a model that knows no heat.
    pub fn warmth(&self, problem: &Problem) -> Option<Warmth> {
        Some(self.heated.as_ref()?.warmth(problem.heat.as_ref()?.heat.inlet_temperature))
    }

    /// Takes turns of one march and one Newton step on (p̃, H₀) each until neither changes anything, from temperatures at
    /// the stations, or cold.
    pub fn turns(
        &mut self,
        case: &Case<'_>,
        (coefficients, h_0): (&mut [f64], &mut f64),
        theta: &[Profile],
        stop: Stop,
        mut observer: Option<RowObserver<'_>>,
    ) -> OnlineOutcome {
        let mut outcome = OnlineOutcome { converged: false, iterations: 0, step: f64::NAN, residual: f64::NAN };
        let Some(heated) = self.heated.as_mut() else { return outcome };
        heated.begin(&self.support.places, case.scale, theta);
        self.state.spread(self.support.own, None, coefficients, &mut self.scratch.fields);
        self.scratch.nodes.forget();
        let (mut changed, mut share, mut before) = (1e-3f64, 1.0f64, f64::INFINITY);
        for turn in 1..=stop.max_newton {
            outcome.iterations = turn;
            self.lay_films(case, *h_0);
            let Some(heated) = self.heated.as_mut() else { return outcome };
            heated.look(&self.scratch.fields, &self.scratch.films, case.scale);
            Heated::state(&heated.lines, (coefficients, *h_0), &mut heated.from);
            changed = heated.march(case.problem, share, (1e-2 * changed).clamp(stop.tolerance, 1e-3));
            outcome.residual = self.evaluate(case, coefficients, *h_0, Wanted::Step(Slopes::Usual));
            if !self.linear_step(case.problem, case.scale, coefficients, observer.is_some()) {
                return outcome;
            }
            if let Some(observer) = observer.as_mut() {
                self.show(case, (coefficients, *h_0), observer);
            }
            let omega = self.damping(case.scale);
            outcome.step = self.take_step(omega, coefficients, h_0);
            if !(outcome.step.is_finite() && changed.is_finite()) {
                return outcome;
            }
            if omega == 1.0 && outcome.step < TOLERANCES.0 * stop.tolerance && changed < TOLERANCES.1 * stop.tolerance {
                outcome.converged = true;
                break;
            }
            let Some(heated) = self.heated.as_mut() else { return outcome };
            let now = outcome.step.max(changed);
            if now < NEAR && omega == 1.0 && changed > outcome.step {
                // Newton's steps need no help; where these are small it is the temperatures that take their time.
                heated.mix(coefficients, h_0);
                self.state.spread(self.support.own, None, coefficients, &mut self.scratch.fields);
            } else {
                // Temperatures that swing with the pressure come to rest when they follow it by less.
                let swings = changed > 0.8 * before;
                share = if swings { (0.75 * share).max(LEAST_SHARE) } else { (1.5 * share).min(1.0) };
                heated.mixing.forget();
            }
            before = changed;
        }
        outcome.unless_absurd()
    }
}
