//! What a shear-thinning lubricant adds to the line system: nodes with film integrals, and the derivatives by nodal gradients.

use super::solution::Problem;
use crate::solver::discrete::grid::LineGrid;
use crate::solver::discrete::reynolds::generalized::{
    FilmTreatment, NodalGradient, NodeState, ShearNode, gradient_slopes,
};
use crate::solver::discrete::reynolds::{CENTER, Node};
use crate::solver::physics::lubricant::ScaledShear;

/// State of the generalized rows: ∂f/∂P = `d_p` + `slopes` G.
pub(super) struct ShearState {
    /// The operator G.
    pub gradient: NodalGradient,
    nodes: Vec<ShearNode>,
    /// ∂f/∂P_X per row, at the row's four nodes.
    pub slopes: Vec<[f64; 4]>,
}

impl ShearState {
    pub fn new(grid: &LineGrid) -> Self {
        Self {
            gradient: NodalGradient::new(&grid.x),
            nodes: vec![ShearNode::default(); grid.len()],
            slopes: vec![[0.0; 4]; grid.unknowns()],
        }
    }

    /// Forgets the films of former iterates: those of another problem are no start.
    pub fn forget(&mut self) {
        self.nodes.fill(ShearNode::default());
    }

    /// Evaluates all nodes, each beside its film of the former iterate, and hands the row's part of them over.
    pub fn evaluate(
        &mut self,
        problem: &Problem,
        law: &ScaledShear,
        (pressure, film): (&[f64], &[f64]),
        treatment: FilmTreatment,
        nodes: &mut [Node],
    ) {
        for (i, (own, node)) in self.nodes.iter_mut().zip(nodes).enumerate() {
            let gradient = [self.gradient.at(pressure, i), 0.0];
            let state = NodeState { pressure: pressure[i], gradient, film: film[i] };
            *own = ShearNode::near(&own.known, &problem.fluid, law, problem.inverse_lambda, state, treatment);
            *node = own.node;
        }
    }

    /// The derivatives by nodal gradients, of the nodes evaluated last.
    pub fn differentiate(&mut self, grid: &LineGrid) {
        for ((slopes, geometry), nodes) in self.slopes.iter_mut().zip(&grid.rows).zip(self.nodes.windows(4)) {
            let here = &nodes[CENTER];
            let s = gradient_slopes(geometry, [&nodes[0], &nodes[1], here, &nodes[3], here, here], 0);
            *slopes = [s[0], s[1], s[2], s[3]];
        }
    }

    /// `slopes` G v of row k.
    #[inline]
    pub fn product(&self, k: usize, v: &[f64]) -> f64 {
        self.slopes[k].iter().enumerate().map(|(m, slope)| slope * self.gradient.at(v, k + m)).sum()
    }
}
