//! Cavitation as a complementarity condition: P ≥ 0, λ ≥ 0 and P λ = 0, with the Reynolds equations f + λ = 0
//! (appendix D). P is the pressure, f the residual of a Reynolds equation and λ its multiplier.
//!
//! A primal–dual active set solves the condition. Inside the cavitated set, P = 0 is prescribed and λ = −f. Elsewhere
//! λ = 0 and the equations are solved. After each Newton step, nodes with negative pressure join the set, and other
//! nodes leave it by the union rule of [`ActiveSet::release`]. This rule moves the cavitation boundary to its
//! position in few steps at any spacing.

use super::thinning::Thinning;
use crate::solver::discrete::reynolds::{CENTER, Row, STENCIL};
use crate::solver::discrete::space::Grid;

/// Cavitated set of a state, and the multiplier there. Both are empty for cavitation by the penalty.
#[derive(Clone, Debug, Default)]
pub struct ActiveSet {
    /// True in the cavitated region, per unknown.
    pub ruptured: Vec<bool>,
    /// λ, per unknown; zero in the full film.
    pub multiplier: Vec<f64>,
    /// Film fraction θ per unknown, for mass-conserving cavitation; empty otherwise. θ = 1 in the full film.
    pub fraction: Vec<f64>,
    /// Flow ρ̄θH that the surfaces carry to the inlet; `None` for a flooded inlet.
    pub supply: Option<f64>,
    /// The set as a node array, for mass-conserving cavitation.
    pub(super) at_node: Vec<bool>,
    /// Number of adjacent nodes that left the set against the flow in the last step, per line.
    pub(super) strides: Vec<usize>,
    /// The sets before the last step and before the second last step.
    former: [Vec<bool>; 2],
    /// Number of consecutive steps after which the set was the same as two steps before.
    returns: usize,
    /// True after the set was seen to cycle. From then on, one node at a time leaves it along each line; with film
    /// fractions, each node leaves it a few times only.
    pub cautious: bool,
    /// Number of Newton steps since [`Self::begin`].
    steps: usize,
    /// Number of times that each node left the set since the cavitation boundary was seen to cycle.
    pub(super) returns_of: Vec<u8>,
    /// Work space: nodes that leave the set.
    leaving: Vec<usize>,
}

/// Number of consecutive returns that counts as a cycle. Single returns end without intervention.
const CYCLE: usize = 3;

/// Number of steps after which a set with film fractions that still changes counts as cycling. Such a cycle passes
/// through more than two sets.
const LATE: usize = 25;

impl ActiveSet {
    /// True if a set, and not the penalty, keeps the pressures from falling below zero.
    pub fn holds(&self) -> bool {
        !self.ruptured.is_empty()
    }

    /// Sets λ from the equations of the cavitated set and replaces these equations by ΔP = 0.
    pub(super) fn hold(&mut self, rows: &mut [Row], thinning: Option<&mut Thinning>) {
        const HELD: Row = {
            let mut d_p = [0.0; STENCIL];
            d_p[CENTER] = 1.0;
            Row { value: 0.0, d_p, d_h: [0.0; STENCIL] }
        };
        let ruptured = &self.ruptured;
        for ((row, multiplier), &ruptured) in rows.iter_mut().zip(&mut self.multiplier).zip(ruptured) {
            *multiplier = if ruptured { -row.value } else { 0.0 };
            if ruptured {
                *row = HELD;
            }
        }
        for slopes in thinning.into_iter().flat_map(|thinning| &mut thinning.slopes) {
            for (slopes, &ruptured) in slopes.iter_mut().zip(ruptured) {
                if ruptured {
                    *slopes = [0.0; STENCIL];
                }
            }
        }
    }

    /// Returns λ as a node array; empty without a multiplier.
    pub(super) fn field(&self, grid: &impl Grid) -> Vec<f64> {
        if !self.holds() || self.fills() {
            return Vec::new();
        }
        node_array(grid, &self.multiplier, 0.0)
    }

    /// Returns the set as a node array.
    pub(super) fn nodes(&self, grid: &impl Grid) -> Vec<bool> {
        let mut nodes = vec![false; grid.weights().len()];
        for (k, _) in self.ruptured.iter().enumerate().filter(|(_, ruptured)| **ruptured) {
            nodes[grid.node(k)] = true;
        }
        nodes
    }

    /// Starts with the given set; with an empty one for the penalty.
    pub(super) fn begin(&mut self, ruptured: impl Iterator<Item = bool>) {
        self.ruptured.clear();
        self.ruptured.extend(ruptured);
        self.multiplier.clear();
        self.multiplier.resize(self.ruptured.len(), 0.0);
        self.fraction.clear();
        self.supply = None;
        self.strides.clear();
        self.returns_of.clear();
        self.former.iter_mut().for_each(Vec::clear);
        (self.returns, self.cautious, self.steps) = (0, false, 0);
    }

    /// Stores the set before a step.
    pub(super) fn remember(&mut self) {
        self.steps += 1;
        self.former.swap(0, 1);
        self.former[0].clone_from(&self.ruptured);
    }

    /// Returns true if the set is the same as before the step. Counts how often it returns to a previous one.
    pub(super) fn is_still(&mut self) -> bool {
        let still = self.ruptured == self.former[0];
        self.returns = if !still && self.ruptured == self.former[1] { self.returns + 1 } else { 0 };
        self.cautious |= self.returns >= CYCLE || self.fills() && self.steps > LATE;
        still
    }

    /// Removes nodes from the set by the union rule and returns true if there were any. All nodes with λ < 0 leave.
    /// Along each line in X, the outer nodes of a block also leave, from either end, as long as the sum of λ over
    /// them is negative. Then more lubricant flows in than the gap can take, so the liquid fills all of them.
    ///
    /// Unknowns lie on `lines` lines along X, in cells of the given widths. Unknowns at the same abscissa are
    /// adjacent in memory.
    pub(super) fn release(&mut self, widths: &[f64], lines: usize) -> bool {
        let Self { ruptured, multiplier, cautious, leaving, .. } = self;
        leaving.clear();
        for line in 0..lines {
            let at = |column: usize| column * lines + line;
            let mut first = 0;
            while first < widths.len() {
                // A block of cavitated nodes along the line.
                let length = (first..widths.len()).take_while(|&column| ruptured[at(column)]).count();
                let block = first..first + length;
                let below = block.clone().map(at).filter(|&k| multiplier[k] < 0.0);
                if *cautious {
                    leaving.extend(below.take(1));
                } else {
                    leaving.extend(below);
                    let filled = |inflow: &mut f64, column: usize| {
                        *inflow += widths[column] * multiplier[at(column)];
                        (*inflow < 0.0).then_some(at(column))
                    };
                    leaving.extend(block.clone().scan(0.0, filled));
                    leaving.extend(block.rev().scan(0.0, filled));
                }
                first += length + 1;
            }
        }
        leaving.iter().for_each(|&k| ruptured[k] = false);
        !leaving.is_empty()
    }
}

/// Expands an array of unknowns to a node array, with the value `elsewhere` at all other nodes.
pub(super) fn node_array(grid: &impl Grid, unknowns: &[f64], elsewhere: f64) -> Vec<f64> {
    let mut array = vec![elsewhere; grid.weights().len()];
    for (k, value) in unknowns.iter().enumerate() {
        array[grid.node(k)] = *value;
    }
    array
}

#[cfg(test)]
mod tests;
