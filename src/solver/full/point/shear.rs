//! What a shear-thinning lubricant adds to the point system: nodes with film integrals, and the derivatives by nodal gradients.

use super::SHARE;
use crate::solver::discrete::grid::PointGrid;
use crate::solver::discrete::reynolds::generalized::{
    FilmTreatment, NodeState, PlaneGradient, ShearNode, gradient_slopes,
};
use crate::solver::discrete::reynolds::{Node, STENCIL};
use crate::solver::full::solution::Problem;
use crate::solver::physics::lubricant::ScaledShear;
use rayon::prelude::*;

/// State of the generalized rows: ∂f/∂P = `d_p` + `slopes` · (G_X, G_Y).
pub(super) struct PointShear {
    gradient: PlaneGradient,
    nodes: Vec<ShearNode>,
    /// ∂f/∂P_X and ∂f/∂P_Y per row, at the row's six nodes.
    slopes: Vec<[[f64; STENCIL]; 2]>,
    /// (P_X, P_Y) of the direction that the Jacobian is applied to.
    direction: Vec<[f64; 2]>,
}

impl PointShear {
    pub fn new(grid: &PointGrid) -> Self {
        Self {
            gradient: PlaneGradient::new(&grid.x, &grid.y),
            nodes: vec![ShearNode::default(); grid.len()],
            slopes: vec![[[0.0; STENCIL]; 2]; grid.unknowns()],
            direction: vec![[0.0; 2]; grid.len()],
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
        let gradient = &self.gradient;
        let ny = gradient.across();
        let columns = self.nodes.par_chunks_exact_mut(ny).zip(nodes.par_chunks_exact_mut(ny));
        columns.enumerate().for_each(|(i, (own, nodes))| {
            for (j, (own, node)) in own.iter_mut().zip(nodes).enumerate() {
                let k = i * ny + j;
                let state = NodeState { pressure: pressure[k], gradient: gradient.at(pressure, i, j), film: film[k] };
                *own = ShearNode::near(&own.known, &problem.fluid, law, problem.inverse_lambda, state, treatment);
                *node = own.node;
            }
        });
    }

    /// The derivatives by nodal gradients, of the nodes evaluated last.
    pub fn differentiate(&mut self, grid: &PointGrid) {
        let nodes = &self.nodes;
        self.slopes.par_iter_mut().enumerate().with_min_len(SHARE).for_each(|(k, slopes)| {
            let (stencil, geometry) = grid.row(k);
            let nodes = stencil.map(|node| &nodes[node]);
            *slopes = [0, 1].map(|axis| gradient_slopes(&geometry, nodes, axis));
        });
    }

    /// Adds `slopes` · (G_X, G_Y) v, rows scaled, for the node array v.
    pub fn add_product(&mut self, grid: &PointGrid, v: &[f64], scaling: &[f64], out: &mut [f64]) {
        let (m, ny) = (grid.column_unknowns(), grid.ny());
        let gradient = &self.gradient;
        let columns = self.direction.par_chunks_exact_mut(ny).enumerate().with_min_len(SHARE.div_ceil(ny));
        columns.for_each(|(i, column)| {
            for (j, direction) in column.iter_mut().enumerate() {
                *direction = gradient.at(v, i, j);
            }
        });
        let (direction, slopes) = (&self.direction, &self.slopes);
        out.par_chunks_mut(m).enumerate().with_min_len(SHARE.div_ceil(m)).for_each(|(column, out)| {
            for (j, out) in out.iter_mut().enumerate() {
                let k = column * m + j;
                let (stencil, _) = grid.row(k);
                let [along, across] = &slopes[k];
                let mut sum = 0.0;
                for (e, node) in stencil.into_iter().enumerate() {
                    sum += along[e] * direction[node][0] + across[e] * direction[node][1];
                }
                *out += sum * scaling[k];
            }
        });
    }
}
