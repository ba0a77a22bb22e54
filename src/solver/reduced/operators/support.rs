//! The nodes on which the rows of some operators depend, and their modes there.

use super::front::Front;
use crate::solver::discrete::grid::{ContactGrid, dot};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, MatRef, Par};
use std::ops::Range;

/// Where a node lies.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub node: usize,
    pub xi: f64,
    /// Y²/2: what the undeformed gap has across.
    pub across: f64,
}

/// Nodes, each once.
pub(super) struct Support {
    /// First those that the sampled rows depend on, in the order of the grid, then those that the rupture boundary alone
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

/// The parts of a support at which there is something to see: what rows depend on, and what lies near the boundary.
pub(super) fn seen(own: usize, front: Option<&Front>) -> impl Iterator<Item = Range<usize>> {
    std::iter::once(0..own).chain(front.into_iter().flat_map(Front::near))
}

/// What modes are on a support, row-major, support × modes.
pub(super) struct StateRows {
    pub modes: usize,
    /// V_p.
    pub values: Vec<f64>,
    /// K V_p; empty where there is a rupture boundary, which has its own.
    pub deformations: Vec<f64>,
    /// Of a shear-thinning model the gradients by ξ and, of a point contact, then those by Y.
    pub gradients: Vec<f64>,
}

impl StateRows {
    /// K V_p.
    pub fn deformations<'a>(&'a self, front: Option<&'a Front>) -> &'a [f64] {
        front.map_or(&self.deformations, Front::deformations)
    }

    /// P, K P and the gradients of coefficients at the parts of the support that are seen.
    pub fn spread(&self, support: &Support, front: Option<&mut Front>, coefficients: &[f64], out: &mut [f64]) {
        let (count, own) = (support.len(), support.own);
        let (pressure, rest) = out.split_at_mut(count);
        let (deformation, gradients) = rest.split_at_mut(count);
        let first = ..own * self.modes;
        product(&self.values[first], coefficients, &mut pressure[..own]);
        product(&self.deformations(front.as_deref())[first], coefficients, &mut deformation[..own]);
        if !gradients.is_empty() {
            product(&self.gradients, coefficients, gradients);
        }
        if let Some(front) = front {
            front.spread(&self.values, coefficients, (pressure, deformation));
        }
    }
}

/// out = A x for a row-major A.
fn product(rows: &[f64], x: &[f64], out: &mut [f64]) {
    matmul(
        ColMut::from_slice_mut(out).as_mat_mut(),
        Accum::Replace,
        MatRef::from_row_major_slice(rows, rows.len() / x.len(), x.len()),
        ColRef::from_slice(x).as_mat(),
        1.0,
        Par::Seq,
    );
}

/// Row `place` of a row-major matrix times x.
pub(super) fn row_times(rows: &[f64], place: usize, x: &[f64]) -> f64 {
    let row = &rows[place * x.len()..][..x.len()];
    // Sums beside each other are formed at once.
    let (mut sums, by) = ([0.0; 8], row.chunks_exact(8).zip(x.chunks_exact(8)));
    for (row, x) in by {
        for ((sum, row), x) in sums.iter_mut().zip(row).zip(x) {
            *sum += row * x;
        }
    }
    let rest = row.len() - row.len() % 8;
    sums.iter().sum::<f64>() + dot(&row[rest..], &x[rest..])
}
