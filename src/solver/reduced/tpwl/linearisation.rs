//! Reduced system functions of d/dT g = f at one state, (4.16) under (4.19), and their derivatives, from which (4.21)
//! to (4.26) are built.

use super::space::{INPUTS, ReducedSpace, input_vector};
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::full::Problem;
use crate::solver::full::transient::Input;
use crate::solver::reduced::matrix_values;
use faer::{Mat, MatRef};
use serde::{Deserialize, Serialize};

/// g and f at (ỹ, u), with the reduced state ỹ = (p̃, H₀) (pressure coefficients, rigid-body separation) and the inputs
/// u, tested with weighted rows of Vᵀ, and their derivatives. The last equation is the load balance w̄ π/2 − ∫P, which
/// has no g.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Linearisation {
    /// g: ρ̄H, with the density ρ̄ and the film thickness H.
    pub storage: LinearFunction,
    /// f: diffusion, convection, penalty; load balance.
    pub flux: LinearFunction,
}

/// System function with its derivatives. Those of g are the dissertation's B and C, those of f its E and F. A and D
/// follow from the values, see [`Linearisation::intercepts`].
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct LinearFunction {
    /// Value.
    pub value: Vec<f64>,
    /// Derivative by ỹ, (4.22) and (4.25).
    #[serde(with = "matrix_values")]
    pub by_state: Mat<f64>,
    /// Derivative by u, one column per input, (4.23) and (4.26).
    #[serde(with = "matrix_values")]
    pub by_input: Mat<f64>,
}

/// Values of g and f.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SystemFunctions {
    /// g.
    pub storage: Vec<f64>,
    /// f.
    pub flux: Vec<f64>,
}

/// Slope of the penalty Λ = −γ̄ min(P, 0) in the linearised systems of line contacts. The value of the penalty is that of the full
/// system, with γ̄ = 10⁶. With that slope, however, each system would force the pressures on its side of the moving
/// cavitation boundary to zero, even where its neighbours have none. The errors of the modes in the cavitated region
/// would then dominate all other rows. There the film only needs a restraint.
pub const PENALTY_SLOPE: f64 = 1e3;

/// Fields of a contact at all nodes.
#[derive(Clone, Copy)]
pub struct Fields<'a> {
    /// Pressure P.
    pub pressure: &'a [f64],
    /// Film thickness H.
    pub film: &'a [f64],
    /// Inputs.
    pub input: Input,
}

impl Fields<'_> {
    fn nodes(&self, space: &ReducedSpace, problem: &Problem) -> Nodes {
        // Newtonian contacts do not use the gradient.
        Nodes::of(problem.laws(), &PlaneGradient::along_line(space.grid.abscissae().0), self.pressure, self.film)
    }

    /// Returns the load-balance residual w̄ π/2 − ∫P.
    fn load_defect(&self, space: &ReducedSpace, problem: &Problem) -> f64 {
        problem.load * self.input.load - dot(space.grid.weights(), self.pressure)
    }
}

/// Tests rows and appends the load balance. `rows` belong to the unknowns, one column per right-hand
/// side.
fn tested(space: &ReducedSpace, rows: MatRef<'_, f64>) -> Mat<f64> {
    let modes = space.modes();
    let mut out = Mat::zeros(modes + 1, rows.ncols());
    out.subrows_mut(0, modes).copy_from(space.test.transpose() * rows);
    out
}

impl SystemFunctions {
    /// Evaluates the reduced system functions with a penalty factor γ̄.
    pub fn at(space: &ReducedSpace, problem: &Problem, fields: Fields<'_>, penalty: f64) -> Self {
        let nodes = fields.nodes(space, problem);
        let unknowns = space.grid.unknowns();
        let mut rows = Mat::zeros(unknowns, 2);
        for k in 0..unknowns {
            let (stencil, geometry) = space.grid.row(k);
            rows[(k, 0)] = nodes[stencil[CENTER]].flow;
            rows[(k, 1)] = nodes.row(&geometry.in_time(fields.input.speed, 0.0, 0.0), penalty, stencil).value;
        }
        let mut tested = tested(space, rows.as_ref());
        let modes = space.modes();
        tested[(modes, 1)] = fields.load_defect(space, problem);
        let column = |j: usize| tested.col(j).iter().copied().collect();
        Self { storage: column(0), flux: column(1) }
    }
}

impl Linearisation {
    /// Evaluates the reduced system functions of the full system and differentiates them with the penalty slope of the space. The
    /// fields are those of the full system and need not lie in the reduced space, so that the values have no
    /// projection error.
    pub fn at(space: &ReducedSpace, problem: &Problem, fields: Fields<'_>) -> Self {
        let nodes = fields.nodes(space, problem);
        let (grid, modes, unknowns) = (&space.grid, space.modes(), space.grid.unknowns());
        let curvature_slope = |node: usize| 0.5 * grid.place(node).0.powi(2);
        // Columns: those of the state, those of the inputs, the value.
        let columns = modes + 1 + INPUTS + 1;
        let (first_input, value) = (modes + 1, columns - 1);
        let (mut storage, mut flux) = (Mat::zeros(unknowns, columns), Mat::zeros(unknowns, columns));
        for k in 0..unknowns {
            let (stencil, geometry) = grid.row(k);
            let row = nodes.row(&geometry.in_time(fields.input.speed, 0.0, 0.0), space.penalty_slope, stencil);
            let own = stencil[CENTER];
            let (flow, flow_p, flow_h) = (nodes[own].flow, nodes[own].flow_p, nodes[own].flow_h);
            let parts = || stencil.into_iter().zip(row.d_p.into_iter().zip(row.d_h));
            for j in 0..modes {
                storage[(k, j)] = flow_p * space.pressure[(own, j)] + flow_h * space.deformation[(own, j)];
                flux[(k, j)] = parts()
                    .map(|(node, (d_p, d_h))| d_p * space.pressure[(node, j)] + d_h * space.deformation[(node, j)])
                    .sum();
            }
            storage[(k, modes)] = flow_h;
            flux[(k, modes)] = row.d_h.iter().sum();
            storage[(k, first_input)] = flow_h * curvature_slope(own);
            flux[(k, first_input)] = parts().map(|(node, (_, d_h))| d_h * curvature_slope(node)).sum();
            // f is linear in ū.
            flux[(k, first_input + 1)] =
                -geometry.upwind.iter().zip(stencil).map(|(w, node)| w * nodes[node].flow).sum::<f64>();
            storage[(k, value)] = flow;
            // Replaces the penalty of the slope by that of the value.
            flux[(k, value)] = row.value - (space.penalty - space.penalty_slope) * fields.pressure[own].min(0.0);
        }
        let (storage, mut flux) = (tested(space, storage.as_ref()), tested(space, flux.as_ref()));
        for (j, l) in space.load.iter().enumerate() {
            flux[(modes, j)] = -l;
        }
        flux[(modes, first_input + 2)] = problem.load;
        flux[(modes, value)] = fields.load_defect(space, problem);
        let function = |of: &Mat<f64>| LinearFunction {
            value: of.col(value).iter().copied().collect(),
            by_state: of.subcols(0, modes + 1).to_owned(),
            by_input: of.subcols(first_input, INPUTS).to_owned(),
        };
        Self { storage: function(&storage), flux: function(&flux) }
    }

    /// Returns the terms that are subtracted from the values to give A and D, (4.21) and (4.24): B ỹ + C u and E ỹ +
    /// F u.
    pub fn intercepts(&self, state: &[f64], input: Input) -> SystemFunctions {
        let input = input_vector(input);
        let product = |LinearFunction { by_state, by_input, .. }: &LinearFunction| {
            let row = |i: usize| -> f64 {
                let own: f64 = state.iter().enumerate().map(|(j, y)| by_state[(i, j)] * y).sum();
                own + input.iter().enumerate().map(|(j, u)| by_input[(i, j)] * u).sum::<f64>()
            };
            (0..by_state.nrows()).map(row).collect()
        };
        SystemFunctions { storage: product(&self.storage), flux: product(&self.flux) }
    }
}
