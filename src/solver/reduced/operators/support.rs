//! Nodes that the rows of the operators depend on, and the modes at these nodes.

use crate::solver::discrete::grid::{ContactGrid, stretched};
use crate::solver::reduced::model::Window;
use crate::solver::reduced::sums::{add_columns, rows_times};
use faer::Mat;

/// Position of a node.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub node: usize,
    pub xi: f64,
    /// Y²/2: contribution of Y to the undeformed gap.
    pub across: f64,
}

impl Place {
    /// Returns the gap of the undeformed bodies with H₀ = 0.
    pub fn gap(&self, scale: f64, curvature: f64) -> f64 {
        let x = stretched(self.xi, scale);
        0.5 * curvature * x * x + self.across
    }
}

/// Nodes of a support in addition to those of the sampled equations.
#[derive(Default)]
pub(super) struct Needed {
    /// Nodes at which every state is evaluated.
    pub always: Vec<usize>,
    /// Nodes at which states are evaluated only on request of a part.
    pub at_times: Vec<usize>,
}

/// Nodes, each once.
pub(super) struct Support {
    /// First the nodes of the sampled equations, in the order of the grid. Then those of the cavitation boundary
    /// alone, line by line along X.
    pub places: Vec<Place>,
    /// Number of nodes of the sampled equations.
    pub own: usize,
    /// Number of nodes across.
    pub across: usize,
}

impl Support {
    /// Creates the support from the nodes of the sampled equations and those of the boundary.
    pub fn new(grid: &ContactGrid, mut own: Vec<usize>, mut asked: Vec<usize>) -> Self {
        let across = grid.nodes().1;
        own.sort_unstable();
        own.dedup();
        asked.retain(|node| own.binary_search(node).is_err());
        asked.sort_unstable_by_key(|node| along(across, *node));
        asked.dedup();
        let place = |node: &usize| {
            let (xi, y) = grid.place(*node);
            Place { node: *node, xi, across: 0.5 * y * y }
        };
        Self { places: own.iter().chain(&asked).map(place).collect(), own: own.len(), across }
    }

    /// Returns the place of one of the nodes.
    pub fn place(&self, node: usize) -> usize {
        let (own, asked) = self.places.split_at(self.own);
        own.binary_search_by_key(&node, |place| place.node).unwrap_or_else(|_| {
            self.own + asked.partition_point(|place| along(self.across, place.node) < along(self.across, node))
        })
    }

    /// Returns the first of the boundary's places on a line of nodes that is not in front of a column.
    pub fn asked(&self, line: usize, column: usize) -> usize {
        let asked = &self.places[self.own..];
        self.own + asked.partition_point(|place| along(self.across, place.node) < (line, column))
    }

    /// Returns the nodes of all places.
    pub fn nodes(&self) -> Vec<usize> {
        self.places.iter().map(|place| place.node).collect()
    }

    /// Returns the number of places.
    pub fn len(&self) -> usize {
        self.places.len()
    }
}

/// Returns line and column of a node.
fn along(across: usize, node: usize) -> (usize, usize) {
    (node % across, node / across)
}

/// Modes V_p and their deformations on a support, row-major, support × modes.
pub(super) struct StateRows {
    pub modes: usize,
    /// V_p.
    pub values: Vec<f64>,
    /// K V_p; with a cavitation boundary that of a nearby position of it.
    pub deformations: Vec<f64>,
    /// Gradients by ξ and, for a point contact, then by Y; empty for a Newtonian model.
    pub gradients: Vec<f64>,
}

impl StateRows {
    /// Computes the rows of a local model's modes at these nodes. The deformation is given; gradients are along
    /// `axes` axes.
    pub fn of(window: &Window, nodes: &[usize], (modes, axes): (usize, usize), deformation: &Mat<f64>) -> Self {
        let rows_of =
            |values: &Mat<f64>| -> Vec<f64> { values.row_iter().flat_map(|row| row.iter().copied()).collect() };
        let values = rows_of(&window.pressure.at(nodes, modes));
        let mut gradients = Vec::new();
        if axes > 0 {
            // Modes are computed only where gradients need them: over all nodes this takes longer than some solves.
            let gradient = window.grid.gradient();
            let parts: Vec<_> = nodes.iter().map(|node| gradient.parts(*node)).collect();
            let mut asked: Vec<usize> = parts.iter().flatten().flatten().map(|(node, _)| *node).collect();
            asked.sort_unstable();
            asked.dedup();
            let around = rows_of(&window.pressure.at(&asked, modes));
            let row = |node: usize| &around[asked.partition_point(|asked| *asked < node) * modes..][..modes];
            for axis in 0..axes {
                for parts in &parts {
                    let start = gradients.len();
                    gradients.resize(start + modes, 0.0);
                    add_columns(parts[axis].map(|(node, weight)| (weight, row(node))), &mut gradients[start..]);
                }
            }
        }
        Self { modes, values, deformations: rows_of(deformation), gradients }
    }

    /// Computes P, K P and the gradients of coefficients, one after the other, at the `own` places of a support.
    pub fn spread(&self, own: usize, coefficients: &[f64], out: &mut [f64]) {
        let count = self.values.len() / self.modes;
        let (state, gradients) = out.split_at_mut(2 * count);
        let (pressure, deformation) = state.split_at_mut(count);
        rows_times(&self.values, coefficients, &mut pressure[..own]);
        rows_times(&self.deformations, coefficients, &mut deformation[..own]);
        for (gradient, rows) in gradients.chunks_exact_mut(count).zip(self.gradient_rows()) {
            rows_times(rows, coefficients, &mut gradient[..own]);
        }
    }

    /// Returns the gradients, axis by axis.
    pub fn gradient_rows(&self) -> impl Iterator<Item = &[f64]> {
        self.gradients.chunks_exact(self.values.len())
    }
}
