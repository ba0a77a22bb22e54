//! Rupture that conserves mass (Elrod and Adams): P ≥ 0, 0 ≤ θ ≤ 1 and P (1 − θ) = 0 at every node.
//!
//! On the ruptured set the unknown is θ, the share of the gap that is filled, at P = 0; its rows are Reynolds' own, in
//! which θ ρ̄H is carried along. A node joins the set when its pressure falls below zero, and leaves it when θ rises
//! above one. At the inlet the surfaces bring a film of their own, where it is thinner than the gap.

use super::active_set::{ActiveSet, node_array};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::{CENTER, Row, RowGeometry, STENCIL};
use crate::solver::discrete::space::Grid;

/// So often a node may leave the set again once the front was seen to cycle.
const MOST_RETURNS: u8 = 2;

/// On a plane the inlet is taken for filled in part where the gap is wider than so many supplied films.
const WIDE: f64 = 3.0;

/// Guesses how far a supplied film fills the inlet under (P, H), both node arrays: 1 where it fills it. On a line the
/// meniscus lies where a flow that just carries the supply has raised the reduced pressure, from there to the contact,
/// by what Grubin's analysis of the inlet asks for: `rise` is that, times 1/λ̄.
pub fn guess(grid: &impl Grid, (pressure, film): (&[f64], &[f64]), supply: f64, rise: f64) -> Vec<f64> {
    let (x, y) = grid.abscissae();
    let mut fraction = vec![1.0; film.len()];
    for line in 0..y.len() {
        let at = |column: usize| column * y.len() + line;
        // The contact begins where the pressure does.
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

/// The nodes at both ends of a line along X, where P vanishes.
struct Ends {
    /// At the inlet.
    inlet: usize,
    /// Before it, where there is one.
    ghost: Option<usize>,
    /// At the outlet.
    behind: usize,
    /// The last unknown before that.
    last: usize,
}

/// The ends of all lines along X that have unknowns.
fn ends(grid: &impl Grid) -> impl Iterator<Item = Ends> {
    let (column, lines) = (grid.abscissae().1.len(), grid.column_unknowns());
    (0..lines).map(move |line| {
        let (inlet, last) = (grid.node(line) - column, grid.unknowns() - lines + line);
        Ends { inlet, ghost: inlet.checked_sub(column), behind: grid.node(last) + column, last }
    })
}

impl ActiveSet {
    /// Whether the ruptured set carries fractions.
    pub fn fills(&self) -> bool {
        !self.fraction.is_empty()
    }

    /// The unknowns that are fractions; empty where none are.
    pub(super) fn fractions(&self) -> &[bool] {
        if self.fills() { &self.ruptured } else { &[] }
    }

    /// Begins with a set of nodes filled to θ each; `supply` is the flow that the surfaces bring.
    pub(super) fn begin_filled(&mut self, supply: Option<f64>, filled: impl Iterator<Item = Option<f64>> + Clone) {
        self.begin(filled.clone().map(|fraction| fraction.is_some()));
        self.supply = supply;
        self.fraction.extend(filled.map(|fraction| fraction.unwrap_or(1.0)));
    }

    /// Makes the nodes of the set those of a film that is filled to θ, and those of the inlet such that carry the supply
    /// where it is thinner than the gap.
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
            // What the gap behind the domain carries, for a flow that comes from there.
            nodes.supply(behind, self.fraction[last] * nodes[behind].flow);
            if let Some(supply) = self.supply.filter(|supply| *supply < nodes[inlet].flow) {
                nodes.supply(inlet, supply);
                // Nothing is extrapolated to the node before it.
                ghost.into_iter().for_each(|ghost| nodes.supply(ghost, supply));
            }
        }
    }

    /// Makes a row's derivatives by the pressures of ruptured nodes those by their fractions.
    #[inline]
    pub(super) fn by_fraction(&self, row: &mut Row, geometry: &RowGeometry, nodes: &Nodes, stencil: [usize; STENCIL]) {
        for (e, &node) in stencil.iter().enumerate() {
            if self.at_node[node] {
                row.d_p[e] = if e <= CENTER { -geometry.upwind[e] * nodes[node].flow_p } else { 0.0 };
            }
        }
    }

    /// Takes the fractions out of a node array of pressures and fractions.
    pub(super) fn without_fractions(&self, values: &mut [f64]) {
        for (value, &ruptured) in values.iter_mut().zip(&self.at_node) {
            if ruptured {
                *value = 0.0;
            }
        }
    }

    /// Puts the fractions of an array of unknowns into a node array.
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

    /// Square of the size of the fractions' step.
    pub(super) fn square_of_fractions(&self, step: &[f64]) -> f64 {
        let steps = self.fractions().iter().zip(step).filter(|(ruptured, _)| **ruptured);
        steps.map(|(_, step)| step * step).sum()
    }

    /// Takes nodes out of the set that are more than filled; whether there were any. Unknowns lie in `lines` lines along
    /// X, side by side.
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
                // Where a front finds no node to rest at, it stays on the side that sucks nothing.
                if fraction[k] <= 1.0 || returns_of[k] >= MOST_RETURNS {
                    continue;
                }
                returns_of[k] += u8::from(*cautious);
                (ruptured[k], fraction[k], released) = (false, 1.0, true);
                if column + 1 < columns && !ruptured[at(column + 1)] && !backwards && !*cautious {
                    // Liquid that is pressed back out of the contact fills the nodes before it one by one.
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

    /// θ as a node array, empty where there is none: at the ends of the domain what is brought there, and what leaves.
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
