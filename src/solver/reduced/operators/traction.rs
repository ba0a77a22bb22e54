//! Traction (3.41) by the traction quadrature of a local model, at separate nodes. It is evaluated once at the end of
//! the iteration, so that Newton's steps do not depend on its nodes.

use super::case::{Case, Start, State};
use super::deformation::Deformation;
use super::part::{Flow, Kind, Part, Setting};
use super::readings::{Readings, RuleTraction};
use super::sampled_system::SampledSystem;
use super::shaped::Shaped;
use super::support::{Place, StateRows, Support};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::full::mid_film_stresses;
use crate::solver::reduced::model::Window;

/// Part of the operators of sliding isothermal contacts. Those of thermal contacts compute the traction with their
/// temperatures.
pub(super) const KIND: Kind = Kind {
    nodes: |_, _, _| {},
    make: |Setting { window, flow, deformation }, system| {
        if flow == Flow::Thermal {
            return None;
        }
        Some(Box::new(Rule::of(window, (system.modes, system.axes), deformation)?))
    },
};

/// Quadrature with the modes at its nodes.
pub(super) struct Rule {
    /// Weight of each node in the reference coordinates ξ and Y.
    weights: Vec<f64>,
    support: Support,
    basis: StateRows,
    /// Dependence on the shape of an ellipse; `None` for circular and line contacts.
    shaped: Option<Shaped>,
    /// Work space: pressure P, deformation K P and gradients.
    fields: Vec<f64>,
}

/// Node of the quadrature at a state.
pub(super) struct RuleNode {
    pub xi: f64,
    pub weight: f64,
    pub state: NodeState,
}

impl Rule {
    /// Creates the quadrature of a local model with `modes` modes and gradients along `axes` axes; `None` without
    /// gradients or without a quadrature.
    pub fn of(window: &Window, (modes, axes): (usize, usize), deformation: &Deformation) -> Option<Self> {
        let rule = window.traction.as_ref().filter(|_| axes > 0)?;
        let (nodes, weights) = rule.over(&window.grid);
        let support = Support::new(&window.grid, nodes.clone(), Vec::new());
        let basis = StateRows::of(window, &nodes, (modes, axes), &deformation.at(window, &nodes, modes));
        let shaped = Shaped::of(window, (&nodes, modes), (&[], &support.places, &basis));
        Some(Self { fields: vec![0.0; (2 + axes) * nodes.len()], weights, support, basis, shaped })
    }

    /// Returns the places of the nodes.
    pub fn places(&self) -> &[Place] {
        &self.support.places
    }

    /// Returns the nodes at a state.
    pub fn states(&mut self, case: &Case<'_>, state: State<'_>) -> impl Iterator<Item = RuleNode> {
        let Case { scale, curvature, .. } = *case;
        let Self { weights, support, basis, fields, .. } = self;
        let count = support.len();
        basis.spread(count, state.coefficients, fields);
        let (pressure, rest) = fields.split_at(count);
        let (deformation, gradients) = rest.split_at(count);
        let offset = state.h_0 - 0.5 * scale.ln();
        let nodes = weights.iter().zip(&support.places).enumerate();
        nodes.map(move |(k, (&weight, place))| {
            let gradient = [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
            let film = offset + place.gap(scale, curvature) + scale * deformation[k];
            RuleNode { xi: place.xi, weight, state: NodeState { pressure: pressure[k], gradient, film } }
        })
    }
}

impl Part for Rule {
    fn begin(&mut self, _: &mut SampledSystem, case: &Case<'_>, start: &Start<'_>) {
        let Self { shaped, basis, support, .. } = self;
        if let (Some(shaped), Some(shapes)) = (shaped, &start.window.shapes) {
            shaped.turn_to(shapes, &case.problem.point.ellipse(), basis, &mut [], &mut support.places);
        }
    }

    fn read(&mut self, _: &SampledSystem, case: &Case<'_>, state: State<'_>, readings: &mut Readings) {
        let Case { problem, scale, .. } = *case;
        let (mut force, mut unlimited) = (0.0, 0.0);
        for RuleNode { weight, state, .. } in self.states(case, state) {
            let (own, without) = mid_film_stresses(problem, state);
            force += weight * own;
            unlimited += weight * without;
        }
        let cut = if unlimited == 0.0 { 0.0 } else { (1.0 - force / unlimited).clamp(0.0, 1.0) };
        let coefficient = scale * force * problem.point.area_per_load();
        readings.traction = Some(RuleTraction { coefficient, cut: Some(cut) });
    }
}
