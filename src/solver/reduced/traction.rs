//! Traction (3.41) without large-scale work: the shear stress at mid-film of few nodes, with non-negative weights.
//!
//! The nodes are among those that the sampled rows depend on and some more: rows crowd where the equations differ, and leave
//! much of a contact whose stress is cut unseen. The weights are fitted by non-negative least squares to ∫τ dX/∫τ dX = 1
//! over many reduced solutions under sliding: each contact counts the same, however large its traction is.
//!
//! A line without heat has so few nodes that all of them are asked, by the trapezoidal rule: where a limit begins to cut the
//! stress, few nodes missed tractions by a hundred times what the reduced pressures do, and bounds had to allow for it
//! everywhere. One with heat is less exact than its rule, and a film with temperatures takes longer.

use super::cubature::GoalEquations;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};

/// Nodes of a rule. With half as many those of circles with heat err by 2e-3 and more in five of a hundred contacts, half of
/// which slide slowly, instead of by 4e-4: more than reduced fields do. The fit itself ends at some 400.
const NODES: usize = 360;
/// Those of a line with heat: they miss tractions by 2e-5 in five of a hundred contacts, a thirtieth of what the fields do. All
/// of its nodes would make contacts take a tenth longer.
const NODES_OF_LINE: usize = 180;
/// Along X every so many nodes may be taken that no sampled row depends on, and across.
const BETWEEN: usize = 5;
const BESIDE: usize = 3;

/// Weights of the mid-film stress at few nodes; without nodes of its own it is the trapezoidal rule over all of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TractionRule {
    /// Nodes of the window's grid, ascending.
    pub nodes: Vec<usize>,
    /// Weight of each in ξ and Y: lengths of a line contact, areas of both halves of a point contact.
    pub weights: Vec<f64>,
}

impl TractionRule {
    /// The trapezoidal rule over all nodes.
    pub fn whole() -> Self {
        Self { nodes: Vec::new(), weights: Vec::new() }
    }

    /// Nodes of a window's grid, ascending, and their weights in ξ and Y.
    pub fn over(&self, grid: &ContactGrid) -> (Vec<usize>, Vec<f64>) {
        if self.nodes.is_empty() {
            return quadrature(grid).into_iter().enumerate().filter(|(_, weight)| *weight > 0.0).unzip();
        }
        (self.nodes.clone(), self.weights.clone())
    }

    /// The rule that reproduces ∫τ for the stresses of many solutions, each given at every node of a grid, from nodes of the sampled equations and some of the grid. `None`
    /// when there are too few solutions, or the fit fails.
    pub fn fit(grid: &ContactGrid, sampled_rows: &[usize], stresses: &[Vec<f64>]) -> Option<Self> {
        let most = match grid.kind() {
            ContactKind::Line => NODES_OF_LINE,
            ContactKind::Point => NODES,
        };
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

    /// Whether it belongs to a grid, as when it was read from a file.
    pub fn sound(&self, grid: &ContactGrid) -> bool {
        self.nodes.len() == self.weights.len()
            && self.nodes.windows(2).all(|pair| pair[0] < pair[1])
            && self.nodes.last().is_none_or(|&last| last < grid.len())
            && self.weights.iter().all(|weight| weight.is_finite() && *weight >= 0.0)
    }
}

/// The trapezoidal rule over a whole grid in ξ and Y, both halves of a point contact's.
fn quadrature(grid: &ContactGrid) -> Vec<f64> {
    let (xi, y) = grid.abscissae();
    // The node array of a line contact has one node outside the inlet.
    let first = xi.len() - grid.nodes().0;
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
    use crate::solver::physics::contact::{MoesRequest, OperatingPoint, Sliding, si_from_moes};
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
