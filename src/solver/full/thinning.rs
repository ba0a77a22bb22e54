//! Contribution of a shear-thinning lubricant to the Jacobian: derivatives through the nodal pressure gradients,
//! ∂f/∂P += (∂f/∂P_X) G_X + (∂f/∂P_Y) G_Y. Here f is the residual of a Reynolds equation, and G_X and G_Y are the
//! gradient operators.

use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::STENCIL;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::discrete::rough::RoughNodes;
use crate::solver::discrete::space::{Grid, Space};

/// Gradient operators G and the derivatives by which they are multiplied.
pub struct Thinning {
    /// Gradient operators G_X and G_Y.
    pub gradient: PlaneGradient,
    /// ∂f/∂P_X and ∂f/∂P_Y of each equation, at the nodes of its stencil. The second array is empty for a line
    /// contact.
    pub slopes: [Vec<[f64; STENCIL]>; 2],
    /// (P_X, P_Y) of the direction to which the Jacobian is applied.
    direction: Vec<[f64; 2]>,
    /// Change of the film pressure between rough surfaces, node array.
    film_pressure: Vec<f64>,
}

impl Thinning {
    /// Creates the operators of a space, with zero derivatives.
    pub fn new<S: Space>(space: &S) -> Self {
        let grid = space.grid();
        let (x, y) = (grid.abscissae().0, grid.across());
        Self {
            gradient: PlaneGradient::new(x, y),
            slopes: [0, 1].map(|axis| vec![[0.0; STENCIL]; if axis < S::AXES { grid.unknowns() } else { 0 }]),
            direction: vec![[0.0; 2]; grid.weights().len()],
            film_pressure: Vec::new(),
        }
    }

    /// Sets the derivatives from the nodes evaluated last.
    pub fn differentiate<S: Space>(&mut self, space: &S, nodes: &Nodes) {
        for (axis, slopes) in self.slopes.iter_mut().enumerate().take(S::AXES) {
            space.each_row(slopes, |k, _, slopes| {
                let (stencil, geometry) = space.row(k);
                *slopes = nodes.slopes(&geometry, stencil, axis);
            });
        }
    }

    /// Computes the gradient field of the node array v, a direction of pressures, for [`Self::add_product`].
    pub fn turn<S: Space>(&mut self, v: &[f64]) {
        self.gradient.field(v, &mut self.direction, S::PARALLEL);
    }

    /// Does the same for rough surfaces, whose film pressure changes by that of P minus that of the asperity pressure.
    /// The film thickness changes by a deformation and a shift ΔH₀.
    pub fn turn_rough<S: Space>(&mut self, v: &[f64], (deformation, shift): (&[f64], f64), rough: &RoughNodes) {
        self.film_pressure.clear();
        let change = |(node, (p, d)): (usize, (&f64, &f64))| {
            // Negative film pressures count as zero.
            let rises = if rough.film_pressure(node) < 0.0 { 0.0 } else { 1.0 };
            rises * (p - rough.asperities(node).slope * (d + shift))
        };
        self.film_pressure.extend(v.iter().zip(deformation).enumerate().map(change));
        self.gradient.field(&self.film_pressure, &mut self.direction, S::PARALLEL);
    }

    /// Adds the product with the direction last given to [`Self::turn`]. Each equation is multiplied by its scaling.
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
