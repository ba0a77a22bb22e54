//! The traction (3.41) of an isothermal film by a window's rule, over nodes of its own: it is asked for once, when Newton's
//! steps have ended, so that they know nothing of its nodes.

use super::deformed_at;
use super::support::{StateRows, Support};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::full::{Problem, mid_film_stress};
use crate::solver::reduced::model::Window;
use faer::Mat;

/// A rule with the modes at its nodes.
pub(super) struct Rule {
    /// Of each node in ξ and Y.
    weights: Vec<f64>,
    support: Support,
    state: StateRows,
    /// Work space: P, K P and the gradients.
    fields: Vec<f64>,
}

impl Rule {
    /// That of a window with one, of so many modes, where gradients along so many axes are known, with what a basis of
    /// deformations represents of K V_p where there is one; `None` without a rule, and of windows of ellipses, which know
    /// traction with heat only.
    pub fn of(window: &Window, (modes, axes): (usize, usize), projected: Option<&Mat<f64>>) -> Option<Self> {
        let rule = window.traction.as_ref().filter(|_| axes > 0 && window.shapes.is_none())?;
        let (nodes, weights) = rule.over(&window.grid);
        let support = Support::new(&window.grid, nodes.clone(), Vec::new());
        let deformation = deformed_at(window, projected, &nodes, modes);
        let state = StateRows::of(window, &nodes, (modes, axes), &deformation);
        Some(Self { fields: vec![0.0; (2 + axes) * nodes.len()], weights, support, state })
    }

    /// The traction coefficient of a state.
    pub fn traction(
        &mut self,
        problem: &Problem,
        (scale, curvature): (f64, f64),
        (coefficients, h_0): (&[f64], f64),
    ) -> f64 {
        let Self { weights, support, state, fields } = self;
        let count = support.len();
        state.spread(count, None, coefficients, fields);
        let (pressure, rest) = fields.split_at(count);
        let (deformation, gradients) = rest.split_at(count);
        let offset = h_0 - 0.5 * scale.ln();
        let stress = |k: usize| {
            let gradient = [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
            let film = offset + support.places[k].gap(scale, curvature) + scale * deformation[k];
            mid_film_stress(problem, NodeState { pressure: pressure[k], gradient, film })
        };
        let force: f64 = weights.iter().enumerate().map(|(k, weight)| weight * stress(k)).sum();
        scale * force * problem.point.area_per_load()
    }
}
