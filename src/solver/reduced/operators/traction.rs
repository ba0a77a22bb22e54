//! The traction (3.41) by a window's rule, over nodes of its own: it is asked for once, when Newton's steps have ended, so
//! that they know nothing of its nodes.

use super::heat::{Heated, Interpolation, carried};
use super::shaped::Shaped;
use super::support::{StateRows, Support, deformed_at};
use crate::solver::discrete::grid::stretched;
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::full::heat::mid_stress_pa;
use crate::solver::full::{Problem, mid_film_stresses};
use crate::solver::physics::contact::Ellipse;
use crate::solver::reduced::model::Window;
use crate::solver::reduced::shapes::Shapes;
use faer::Mat;

/// The traction of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleTraction {
    /// Its coefficient.
    pub coefficient: f64,
    /// The share that the limiting stress takes of what it were without one, 0…1; none with heat, whose temperatures are
    /// those under the limit.
    pub cut: Option<f64>,
}

/// A rule with the modes at its nodes.
pub(super) struct Rule {
    /// Of each node in ξ and Y.
    weights: Vec<f64>,
    support: Support,
    state: StateRows,
    /// What follows the shape of an ellipse; none of a window that knows circles or lines.
    shaped: Option<Shaped>,
    /// How the nodes have their temperatures; not asked without heat.
    interpolation: Interpolation,
    /// Work space: P, K P and the gradients.
    fields: Vec<f64>,
}

impl Rule {
    /// That of a window with one, of so many modes, where gradients along so many axes are known, with what a basis of
    /// deformations represents of K V_p where there is one; `None` without a rule.
    pub fn of(window: &Window, (modes, axes): (usize, usize), projected: Option<&Mat<f64>>) -> Option<Self> {
        let rule = window.traction.as_ref().filter(|_| axes > 0)?;
        let (nodes, weights) = rule.over(&window.grid);
        let support = Support::new(&window.grid, nodes.clone(), Vec::new());
        let deformation = deformed_at(window, projected, &nodes, modes);
        let state = StateRows::of(window, &nodes, (modes, axes), &deformation);
        let shaped = Shaped::of(window, (&nodes, modes), (&[], &support.places, &state));
        let interpolation = Interpolation::new(nodes.iter().map(|&node| window.grid.place(node)));
        Some(Self { fields: vec![0.0; (2 + axes) * nodes.len()], weights, support, state, shaped, interpolation })
    }

    /// Turns to the shape of a contact; nothing where the window knows one only.
    pub fn take_shape(&mut self, shapes: &Shapes, ellipse: &Ellipse) {
        if let Some(shaped) = &mut self.shaped {
            shaped.turn_to(shapes, ellipse, &mut self.state, &mut [], &mut self.support.places);
        }
    }

    /// The traction of a state, with the temperatures of the last turns where there are some.
    pub fn traction(
        &mut self,
        problem: &Problem,
        (scale, curvature): (f64, f64),
        (coefficients, h_0): (&[f64], f64),
        heated: Option<&Heated>,
    ) -> RuleTraction {
        let Self { weights, support, state, interpolation, fields, .. } = self;
        let count = support.len();
        state.spread(count, None, coefficients, fields);
        let (pressure, rest) = fields.split_at(count);
        let (deformation, gradients) = rest.split_at(count);
        let offset = h_0 - 0.5 * scale.ln();
        let state = |k: usize| {
            let gradient = [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
            let film = offset + support.places[k].gap(scale, curvature) + scale * deformation[k];
            NodeState { pressure: pressure[k], gradient, film }
        };
        let (force, unlimited) = match (heated, problem.warm_laws()) {
            (Some(heated), Some(laws)) => {
                let stress = |k: usize, theta| {
                    let x = stretched(support.places[k].xi, scale);
                    let carried = carried(problem.point.kind, x, pressure[k]);
                    mid_stress_pa(problem, laws.heat, laws.mid_stress(state(k), &theta), carried)
                };
                let across = heated.theta_at(interpolation, scale).enumerate();
                (across.zip(&*weights).map(|((k, theta), weight)| weight * stress(k, theta)).sum::<f64>(), None)
            }
            _ => {
                let (mut force, mut unlimited) = (0.0, 0.0);
                for (k, weight) in weights.iter().enumerate() {
                    let (own, without) = mid_film_stresses(problem, state(k));
                    force += weight * own;
                    unlimited += weight * without;
                }
                (force, Some(unlimited))
            }
        };
        let cut = |unlimited: f64| if unlimited == 0.0 { 0.0 } else { (1.0 - force / unlimited).clamp(0.0, 1.0) };
        RuleTraction { coefficient: scale * force * problem.point.area_per_load(), cut: unlimited.map(cut) }
    }
}
