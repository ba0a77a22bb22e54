//! Mass-conserving cavitation (Elrod and Adams): P ≥ 0, 0 ≤ θ ≤ 1 and P (1 − θ) = 0 at every node. P is the pressure,
//! and θ is the film fraction, the filled share of the gap.
//!
//! In the cavitated set P = 0 and the unknown is θ. Its equations are the Reynolds equations with the transported
//! flow θ ρ̄H. A node joins the set when its pressure falls below zero, and leaves it when θ exceeds one. At the
//! inlet the surfaces carry the inlet film thickness, if it is smaller than the gap.

use super::active_set::{ActiveSet, node_array};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::{CENTER, Row, RowGeometry, STENCIL};
use crate::solver::discrete::space::Grid;

/// Number of times that a node may leave the set after the cavitation boundary was seen to cycle.
const MOST_RETURNS: u8 = 2;

/// Ratio of the gap to the inlet film thickness above which the inlet of a point contact is initialised as partly
/// filled.
const WIDE: f64 = 3.0;

/// Estimates how far an inlet film thickness fills the inlet under (P, H), both node arrays. Returns θ, which is 1 in
/// the full film.
///
/// In a line contact, the meniscus follows from Grubin's analysis of the inlet. A flow equal to the supply raises the
/// reduced pressure between the meniscus and the contact by a known amount. `rise` is that amount times 1/λ̄.
pub fn guess(grid: &impl Grid, (pressure, film): (&[f64], &[f64]), supply: f64, rise: f64) -> Vec<f64> {
    let (x, y) = grid.abscissae();
    let mut fraction = vec![1.0; film.len()];
    for line in 0..y.len() {
        let at = |column: usize| column * y.len() + line;
        // The contact begins at the first node with pressure.
        let edge = (0..x.len()).find(|&column| pressure[at(column)] > 0.0);
        let edge = edge.unwrap_or_else(|| x.partition_point(|x| *x < 0.0)).min(x.len() - 1);
        let mut risen = 0.0;
        for column in (1..edge).rev() {
            let h = film[at(column)];
            risen += (x[column + 1] - x[column]) * (h - supply).max(0.0) / h.powi(3);
            let starved = if y.len() == 1 { risen > rise } else { h > WIDE * supply };
            if starved {
                fraction[at(column)] = (supply / h).min(1.0);
            }
        }
    }
    fraction
}

/// Nodes at both ends of a line along X, where P vanishes.
struct Ends {
    /// Node at the inlet.
    inlet: usize,
    /// Node before the inlet node, if there is one.
    ghost: Option<usize>,
    /// Node at the outlet.
    behind: usize,
    /// Last unknown before the outlet node.
    last: usize,
}

/// Returns the ends of all lines along X that have unknowns.
fn ends(grid: &impl Grid) -> impl Iterator<Item = Ends> {
    let (column, lines) = (grid.abscissae().1.len(), grid.column_unknowns());
    (0..lines).map(move |line| {
        let (inlet, last) = (grid.node(line) - column, grid.unknowns() - lines + line);
        Ends { inlet, ghost: inlet.checked_sub(column), behind: grid.node(last) + column, last }
    })
}

impl ActiveSet {
    /// True if the cavitated set has film fractions.
    pub fn fills(&self) -> bool {
        !self.fraction.is_empty()
    }

    /// Marks the unknowns that are fractions; empty without fractions.
    pub(super) fn fractions(&self) -> &[bool] {
        if self.fills() { &self.ruptured } else { &[] }
    }

    /// Starts with a set of nodes and the fraction θ of each. `supply` is the flow that the surfaces carry.
    pub(super) fn begin_filled(&mut self, supply: Option<f64>, filled: impl Iterator<Item = Option<f64>> + Clone) {
        self.begin(filled.clone().map(|fraction| fraction.is_some()));
        self.supply = supply;
        self.fraction.extend(filled.map(|fraction| fraction.unwrap_or(1.0)));
    }

    /// Applies the fractions to the nodes of the set, and the supply to the inlet nodes if it is smaller than their
    /// flow.
    pub(super) fn fill(&mut self, grid: &impl Grid, nodes: &mut Nodes) {
        self.at_node.clear();
        self.at_node.resize(nodes.len(), false);
        for (k, (&fraction, &ruptured)) in self.fraction.iter().zip(&self.ruptured).enumerate() {
            if ruptured {
                let node = grid.node(k);
                nodes.fill(node, fraction);
                self.at_node[node] = true;
            }
        }
        for Ends { inlet, ghost, behind, last } in ends(grid) {
            // Flow behind the domain, for a flow that enters from there.
            nodes.supply(behind, self.fraction[last] * nodes[behind].flow);
            if let Some(supply) = self.supply.filter(|supply| *supply < nodes[inlet].flow) {
                nodes.supply(inlet, supply);
                // No extrapolation to the node before the inlet.
                ghost.into_iter().for_each(|ghost| nodes.supply(ghost, supply));
            }
        }
    }

    /// Replaces an equation's derivatives with respect to the pressures of cavitated nodes by those with respect to
    /// their fractions.
    #[inline]
    pub(super) fn by_fraction(&self, row: &mut Row, geometry: &RowGeometry, nodes: &Nodes, stencil: [usize; STENCIL]) {
        for (e, &node) in stencil.iter().enumerate() {
            if self.at_node[node] {
                row.d_p[e] = if e <= CENTER { -geometry.upwind[e] * nodes[node].flow_p } else { 0.0 };
            }
        }
    }

    /// Sets the entries of fractions in a node array of pressures and fractions to zero.
    pub(super) fn without_fractions(&self, values: &mut [f64]) {
        for (value, &ruptured) in values.iter_mut().zip(&self.at_node) {
            if ruptured {
                *value = 0.0;
            }
        }
    }

    /// Copies the fractions of an array of unknowns into a node array.
    pub(super) fn with_fractions(&self, grid: &impl Grid, unknowns: &[f64], values: &mut [f64]) {
        for (k, (unknown, _)) in unknowns.iter().zip(&self.ruptured).enumerate().filter(|(_, (_, ruptured))| **ruptured)
        {
            values[grid.node(k)] = *unknown;
        }
    }

    /// Adds a share of a step to the fractions.
    pub(super) fn add_fractions(&mut self, share: f64, step: &[f64]) {
        for ((fraction, step), &ruptured) in self.fraction.iter_mut().zip(step).zip(&self.ruptured) {
            if ruptured {
                *fraction += share * step;
            }
        }
    }

    /// Returns the sum of squares of the fractions' step.
    pub(super) fn square_of_fractions(&self, step: &[f64]) -> f64 {
        let steps = self.fractions().iter().zip(step).filter(|(ruptured, _)| **ruptured);
        steps.map(|(_, step)| step * step).sum()
    }

    /// Removes nodes with θ > 1 from the set and returns true if there were any. Unknowns lie on `lines` lines along
    /// X, with those of one abscissa adjacent.
    pub(super) fn release_filled(&mut self, lines: usize) -> bool {
        let Self { ruptured, fraction, strides, cautious, returns_of, .. } = self;
        returns_of.resize(ruptured.len(), 0);
        strides.resize(lines, 0);
        let mut released = false;
        for (line, stride) in strides.iter_mut().enumerate() {
            let columns = ruptured.len() / lines;
            let at = |column: usize| column * lines + line;
            let mut backwards = false;
            for column in 0..columns {
                let k = at(column);
                if !ruptured[k] {
                    fraction[k] = 1.0;
                    continue;
                }
                // If no node balances the cavitation boundary, the boundary stays on the side without negative
                // pressure.
                if fraction[k] <= 1.0 || returns_of[k] >= MOST_RETURNS {
                    continue;
                }
                returns_of[k] += u8::from(*cautious);
                (ruptured[k], fraction[k], released) = (false, 1.0, true);
                if column + 1 < columns && !ruptured[at(column + 1)] && !backwards && !*cautious {
                    // Liquid pressed back out of the contact fills the preceding nodes one by one.
                    backwards = true;
                    *stride = (2 * *stride).max(1);
                    for before in (column.saturating_sub(*stride - 1)..column).rev().map(at) {
                        if !ruptured[before] {
                            break;
                        }
                        (ruptured[before], fraction[before]) = (false, 1.0);
                    }
                }
            }
            if !backwards {
                *stride = 0;
            }
        }
        released
    }

    /// Returns θ as a node array, including the ends of the domain: the supply at the inlet, and the last unknown's
    /// value at the outlet. Empty without fractions.
    pub(super) fn fraction_field(&self, grid: &impl Grid, film: &[f64]) -> Vec<f64> {
        if !self.fills() {
            return Vec::new();
        }
        let mut field = node_array(grid, &self.fraction, 1.0);
        for Ends { inlet, ghost, behind, last } in ends(grid) {
            field[behind] = self.fraction[last];
            for node in [Some(inlet), ghost].into_iter().flatten() {
                field[node] = self.supply.map_or(1.0, |supply| (supply / film[node]).min(1.0));
            }
        }
        field
    }
}
