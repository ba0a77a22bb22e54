//! What a shear-thinning lubricant adds to the Jacobian: the derivatives by nodal gradients, ∂f/∂P += (∂f/∂P_X) G_X +
//! (∂f/∂P_Y) G_Y.

use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::STENCIL;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::discrete::space::{Grid, Space};

/// The operators G and what they are multiplied with.
pub struct Thinning {
    /// G.
    pub gradient: PlaneGradient,
    /// ∂f/∂P_X and ∂f/∂P_Y per row, at the row's nodes; the latter is empty on a line.
    pub slopes: [Vec<[f64; STENCIL]>; 2],
    /// (P_X, P_Y) of the direction that the Jacobian is applied to.
    direction: Vec<[f64; 2]>,
}

impl Thinning {
    /// Of a space.
    pub fn new<S: Space>(space: &S) -> Self {
        let grid = space.grid();
        let (x, y) = (grid.abscissae().0, grid.across());
        Self {
            gradient: PlaneGradient::new(x, y),
            slopes: [0, 1].map(|axis| vec![[0.0; STENCIL]; if axis < S::AXES { grid.unknowns() } else { 0 }]),
            direction: vec![[0.0; 2]; grid.weights().len()],
        }
    }

    /// The derivatives at the nodes evaluated last.
    pub fn differentiate<S: Space>(&mut self, space: &S, nodes: &Nodes) {
        for (axis, slopes) in self.slopes.iter_mut().enumerate().take(S::AXES) {
            space.each_row(slopes, |k, _, slopes| {
                let (stencil, geometry) = space.row(k);
                *slopes = nodes.slopes(&geometry, stencil, axis);
            });
        }
    }

    /// Turns to a node array v of pressures.
    pub fn turn<S: Space>(&mut self, v: &[f64]) {
        self.gradient.field(v, &mut self.direction, S::PARALLEL);
    }

    /// Adds their product with the node array turned to, rows scaled.
    pub fn add_product<S: Space>(&self, space: &S, scaling: &[f64], out: &mut [f64]) {
        let (direction, [along, across]) = (&self.direction, &self.slopes);
        space.each_row(out, |k, stencil, out| {
            let mut sum = 0.0;
            match S::AXES {
                1 => {
                    for (a, &node) in along[k][..S::NODES].iter().zip(&stencil) {
                        sum += a * direction[node][0];
                    }
                }
                _ => {
                    for ((a, b), &node) in along[k].iter().zip(&across[k]).zip(&stencil) {
                        sum += a * direction[node][0] + b * direction[node][1];
                    }
                }
            }
            *out += sum * scaling[k];
        });
    }
}
