//! Mass balance of a part of the film: inflow minus outflow must equal the change of the stored mass.

use super::frame::Conditions;
use super::trajectory::{State, Trajectory};
use crate::solver::discrete::grid::{FIRST_UNKNOWN, cubic};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::discrete::rough::RoughNodes;

/// Mass balance between two fixed places over the kept states of a trajectory, in units of ρ₀ (a³/R)_ref.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassBalance {
    /// Mass at the end minus mass at the beginning.
    pub stored: f64,
    /// ∫(inflow − outflow) dT.
    pub carried: f64,
    /// ∫|inflow − outflow| dT, the reference of a defect.
    pub exchanged: f64,
}

impl MassBalance {
    /// Returns |stored − carried| relative to the exchanged mass.
    pub fn defect(&self) -> f64 {
        (self.stored - self.carried).abs() / self.exchanged
    }
}

/// Number of cells of Simpson's rule between the two places.
const CELLS: usize = 2000;

impl Trajectory {
    /// Computes the balance between `from` and `to`, in units of a_ref. It uses quadrature of the kept fields and the
    /// fluxes through both ends, but not the discrete equations. The film must be full between the two places. `None`
    /// with fewer than two states, or if a place leaves the domain.
    pub fn mass_balance(&self, (from, to): (f64, f64)) -> Option<MassBalance> {
        let mut balance = MassBalance::default();
        let mut former: Option<(f64, f64, f64)> = None;
        let mut first = None;
        for state in &self.states {
            let input = self.transient.inputs.at(state.time);
            let at = self.transient.frame.conditions(&self.problem, state.time, input).ok()?;
            let film = Film::new(&self.x, state, &at);
            let mass = film.mass(from, to)?;
            let net = film.flux(from)? - film.flux(to)?;
            if let Some((time, former_net, _)) = former {
                let length = state.time - time;
                balance.carried += 0.5 * length * (former_net + net);
                balance.exchanged += 0.5 * length * (former_net.abs() + net.abs());
            }
            former = Some((state.time, net, mass));
            first.get_or_insert(mass);
        }
        balance.stored = former?.2 - first?;
        (self.states.len() > 1).then_some(balance)
    }
}

/// Nodal flow and mobility of one state.
struct Film<'a> {
    x: &'a [f64],
    nodes: Nodes,
    /// Stored mass, node array.
    stored: Vec<f64>,
    at: &'a Conditions,
}

impl<'a> Film<'a> {
    fn new(x: &'a [f64], state: &'a State, at: &'a Conditions) -> Self {
        let Some(laws) = at.problem.rough_laws() else {
            let gradient = PlaneGradient::along_line(x);
            let nodes = Nodes::of(at.problem.laws(), &gradient, &state.pressure, &state.film);
            return Self { x, stored: nodes.iter().map(|node| node.flow).collect(), nodes, at };
        };
        let (mut nodes, mut rough) = (Nodes::new(x.len(), false), RoughNodes::new(laws.rough, x.len()));
        rough.evaluate(laws, (&state.pressure, &state.film), &vec![1.0; x.len()], &mut nodes, false);
        Self { x, nodes, stored: rough.stored().collect(), at }
    }

    /// Returns a nodal quantity at a place given in units of a_ref; `None` outside the domain.
    fn value(&self, place: f64, of: impl Fn(usize) -> f64) -> Option<f64> {
        let x = place / self.at.scales.half_width;
        let inside = x > self.x[FIRST_UNKNOWN] && x < self.x[self.x.len() - 2];
        let (first, weights) = cubic(self.x, x);
        inside.then(|| weights.iter().enumerate().map(|(m, w)| w * of(first + m)).sum())
    }

    /// Returns ∫ρ̄H dX between two places (density ρ̄, film thickness H).
    fn mass(&self, from: f64, to: f64) -> Option<f64> {
        let h = (to - from) / CELLS as f64;
        let mut sum = 0.0;
        for k in 0..=CELLS {
            let weight = match k {
                0 | CELLS => 1.0,
                k if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            sum += weight * self.value(from + k as f64 * h, |i| self.stored[i])?;
        }
        Some(sum * h / 3.0 * self.at.scales.film)
    }

    /// Returns the flux U ρ̄H − ξ ∂P/∂X at a place (speed U, mobility ξ, film pressure P).
    fn flux(&self, place: f64) -> Option<f64> {
        let pressure = |i: usize| self.nodes[i].pressure;
        let slope = |i: usize| (pressure(i + 1) - pressure(i - 1)) / (self.x[i + 1] - self.x[i - 1]);
        let flux = self.value(place, |i| self.at.speed * self.nodes[i].flow - self.nodes[i].mobility * slope(i))?;
        Some(flux * self.at.scales.film * self.at.scales.half_width)
    }
}
