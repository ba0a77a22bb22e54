//! Quadrature for the traction (3.41) of a reduced model: the mid-film shear stress τ at few nodes, with non-negative
//! weights.
//!
//! The nodes are selected among those of the sampled equations and a regular subset of the grid, because the sampled equations cover
//! little of the region where the limiting stress acts. The weights reproduce the integral of τ over all nodes
//! for many sliding reduced solutions, by non-negative least squares. Each solution is divided by its integral, so that
//! all have the same influence.
//!
//! An isothermal line contact has so few nodes that all of them are used, by the trapezoidal rule. There the error of
//! a quadrature with few nodes would dominate where the limiting stress begins to act. Thermal line contacts use
//! few nodes: the error of their quadrature is below that of their reduced fields, and evaluating a film with temperatures
//! takes longer.

use super::cubature::GoalEquations;
use crate::solver::discrete::grid::ContactGrid;
use serde::{Deserialize, Serialize};

/// Number of nodes of a quadrature for point contacts. The error is 4e-4 (95th percentile) for thermal circular contacts, below
/// that of the reduced fields. Without this limit the fit would choose about 400 nodes.
const NODES: usize = 360;
/// Number of nodes for thermal line contacts. The error is 2e-5 (95th percentile), a thirtieth of that of the fields.
const NODES_OF_LINE: usize = 180;
/// Every so many nodes along X, and across, are candidates in addition to those of the sampled equations.
const BETWEEN: usize = 5;
const BESIDE: usize = 3;

/// Traction quadrature: weights of the mid-film stress at few nodes. Without nodes it is the trapezoidal rule over
/// the grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TractionRule {
    /// Nodes of the local model's grid, ascending.
    pub nodes: Vec<usize>,
    /// Weight of each node in ξ and Y: lengths for a line contact, areas of both halves for a point contact.
    pub weights: Vec<f64>,
}

impl TractionRule {
    /// Returns the trapezoidal rule over all nodes.
    pub fn whole() -> Self {
        Self { nodes: Vec::new(), weights: Vec::new() }
    }

    /// Returns the nodes on a local model's grid, ascending, and their weights in ξ and Y.
    pub fn over(&self, grid: &ContactGrid) -> (Vec<usize>, Vec<f64>) {
        if self.nodes.is_empty() {
            return quadrature(grid).into_iter().enumerate().filter(|(_, weight)| *weight > 0.0).unzip();
        }
        (self.nodes.clone(), self.weights.clone())
    }

    /// Fits the quadrature to the mid-film stresses of many solutions, each given at every node of a grid. The nodes
    /// are selected among those of the sampled equations and some of the grid. `None` if there are too few solutions,
    /// or if the fit fails.
    pub fn fit(grid: &ContactGrid, sampled_rows: &[usize], stresses: &[Vec<f64>]) -> Option<Self> {
        let most = if grid.kind().is_line() { NODES_OF_LINE } else { NODES };
        let quadrature = quadrature(grid);
        let (_, across) = grid.nodes();
        let between = |node: &usize| (node / across).is_multiple_of(BETWEEN) && (node % across).is_multiple_of(BESIDE);
        let of_rows = sampled_rows.iter().flat_map(|&row| grid.row(row).0);
        let of_grid = (0..quadrature.len()).filter(between);
        let mut candidates: Vec<usize> = of_rows.chain(of_grid).filter(|&node| quadrature[node] > 0.0).collect();
        candidates.sort_unstable();
        candidates.dedup();
        let mut equations = GoalEquations::new(candidates);
        for stress in stresses {
            let force: f64 = quadrature.iter().zip(stress).map(|(weight, stress)| weight * stress).sum();
            if force.is_finite() && force != 0.0 {
                equations.add(|node| quadrature[node] * stress[node] / force, quadrature.len());
            }
        }
        if equations.count() < most {
            return None;
        }
        let (nodes, relative) = equations.fit(most)?;
        let weights = nodes.iter().zip(relative).map(|(&node, relative)| relative * quadrature[node]).collect();
        Some(Self { nodes, weights })
    }

    /// Returns true if the quadrature is valid for a grid, for example after reading from a file.
    pub fn sound(&self, grid: &ContactGrid) -> bool {
        self.nodes.len() == self.weights.len()
            && self.nodes.windows(2).all(|pair| pair[0] < pair[1])
            && self.nodes.last().is_none_or(|&last| last < grid.len())
            && self.weights.iter().all(|weight| weight.is_finite() && *weight >= 0.0)
    }
}

/// Returns the trapezoidal rule over a grid in ξ and Y, over both halves of a point contact.
fn quadrature(grid: &ContactGrid) -> Vec<f64> {
    let (xi, y) = grid.abscissae();
    let first = grid.first_column();
    let cell = |at: &[f64], i: usize, first: usize| {
        let west = if i > first { at[i] - at[i - 1] } else { 0.0 };
        let east = at.get(i + 1).map_or(0.0, |next| next - at[i]);
        0.5 * (west + east)
    };
    let across: Vec<f64> = if y.len() == 1 { vec![1.0] } else { (0..y.len()).map(|j| 2.0 * cell(y, j, 0)).collect() };
    let along = (0..xi.len()).map(|i| if i < first { 0.0 } else { cell(xi, i, first) });
    along.flat_map(|along| across.iter().map(move |across| along * across)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
    use crate::solver::full::{ContactSolver, Start};
    use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn the_whole_grids_rule_is_the_traction_of_a_solution() {
        let plane = PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.4));
        for (kind, spec) in [
            (ContactKind::Line, GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) }),
            (ContactKind::Point, GridSpec::Plane(plane)),
        ] {
            let grid = spec.build().unwrap();
            let point = si_from_moes(&MoesRequest::new(kind, 30.0, 5.0)).unwrap();
            let sliding = Sliding { slide_to_roll_ratio: 0.4, newtonian_plateau_ratio: None };
            let point = OperatingPoint { sliding, ..point };
            let solution = ContactSolver::on(&grid).solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
            let stress = solution.mid_film_stress();
            let force: f64 = quadrature(&grid).iter().zip(&stress).map(|(weight, stress)| weight * stress).sum();
            let wanted = solution.traction_coefficient();
            assert!((force * solution.problem.point.area_per_load() / wanted - 1.0).abs() < 1e-12, "{kind:?}");
        }
    }
}
