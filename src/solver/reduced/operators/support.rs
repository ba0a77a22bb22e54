//! The nodes on which the rows of some operators depend, and their modes there.

use crate::solver::discrete::grid::{ContactGrid, stretched};
use crate::solver::reduced::model::Window;
use crate::solver::reduced::sums::{add_columns, rows_times};
use faer::Mat;

/// Where a node lies.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub node: usize,
    pub xi: f64,
    /// Y²/2: what the undeformed gap has across.
    pub across: f64,
}

impl Place {
    /// The gap of the undeformed bodies there, with H₀ = 0.
    pub fn gap(&self, scale: f64, curvature: f64) -> f64 {
        let x = stretched(self.xi, scale);
        0.5 * curvature * x * x + self.across
    }
}

/// Nodes that a support has in addition to those of the sampled rows.
#[derive(Default)]
pub(super) struct Needed {
    /// Those at which every state is evaluated.
    pub always: Vec<usize>,
    /// Those at which states are evaluated only while a part says so.
    pub at_times: Vec<usize>,
}

/// Nodes, each once.
pub(super) struct Support {
    /// First those that the sampled rows depend on, in the order of the grid, then those that the cavitation boundary alone
    /// asks for, line after line along X.
    pub places: Vec<Place>,
    /// How many the sampled rows depend on.
    pub own: usize,
    /// Nodes across.
    pub across: usize,
}

impl Support {
    /// Of the nodes that sampled rows depend on, and of those that the boundary asks for.
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

    /// The place of one of its nodes.
    pub fn place(&self, node: usize) -> usize {
        let (own, asked) = self.places.split_at(self.own);
        own.binary_search_by_key(&node, |place| place.node).unwrap_or_else(|_| {
            self.own + asked.partition_point(|place| along(self.across, place.node) < along(self.across, node))
        })
    }

    /// The nodes of all places.
    pub fn nodes(&self) -> Vec<usize> {
        self.places.iter().map(|place| place.node).collect()
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        self.places.len()
    }
}

/// Line and column of a node.
fn along(across: usize, node: usize) -> (usize, usize) {
    (node % across, node / across)
}

/// What modes are on a support, row-major, support × modes.
pub(super) struct StateRows {
    pub modes: usize,
    /// V_p.
    pub values: Vec<f64>,
    /// K V_p; of a cavitation boundary that of a place of it nearby.
    pub deformations: Vec<f64>,
    /// Of a shear-thinning model the gradients by ξ and, of a point contact, then those by Y.
    pub gradients: Vec<f64>,
}

impl StateRows {
    /// Those of a window's modes at these nodes, whose deformation is given, with gradients along so many axes.
    pub fn of(window: &Window, nodes: &[usize], (modes, axes): (usize, usize), deformation: &Mat<f64>) -> Self {
        let rows_of =
            |values: &Mat<f64>| -> Vec<f64> { values.row_iter().flat_map(|row| row.iter().copied()).collect() };
        let values = rows_of(&window.pressure.at(nodes, modes));
        let mut gradients = Vec::new();
        if axes > 0 {
            // Modes are made where gradients ask for them only: over all nodes that takes longer than some solves.
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

    /// P, K P and the gradients of coefficients, one behind the other, at the `own` places of a support.
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

    /// The gradients, axis by axis.
    pub fn gradient_rows(&self) -> impl Iterator<Item = &[f64]> {
        self.gradients.chunks_exact(self.values.len())
    }
}
