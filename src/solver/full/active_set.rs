//! Rupture as a complementarity condition: P ≥ 0, λ ≥ 0 and P λ = 0, with Reynolds' rows f + λ = 0 (appendix D).
//!
//! A primal–dual active set: on the ruptured set P = 0 is held and λ = −f read off; elsewhere λ = 0 and the rows are
//! solved. After each Newton step nodes whose pressure fell below zero join the set, and nodes leave it by the union
//! rule of [`ActiveSet::release`], by which the front comes to its place in few steps whatever the spacing.

use super::thinning::Thinning;
use crate::solver::discrete::reynolds::{CENTER, Row, STENCIL};
use crate::solver::discrete::space::Grid;

/// The ruptured set of a state, and the multiplier there; both empty where a penalty holds the pressures.
#[derive(Clone, Debug, Default)]
pub struct ActiveSet {
    /// Whether the film is ruptured, per unknown.
    pub ruptured: Vec<bool>,
    /// λ, per unknown; zero where the film is whole.
    pub multiplier: Vec<f64>,
    /// θ, per unknown, where the film ruptures so that mass is conserved, empty elsewhere; 1 where the film is whole.
    pub fraction: Vec<f64>,
    /// The flow ρ̄θH that the surfaces bring to the inlet; none where it is flooded.
    pub supply: Option<f64>,
    /// The set as a node array, where there are fractions.
    pub(super) at_node: Vec<bool>,
    /// How many nodes at once left the set against the flow in the last step, per line.
    pub(super) strides: Vec<usize>,
    /// The sets before the last step, and before the one before.
    former: [Vec<bool>; 2],
    /// How often in a row the set was again what it was two steps before.
    returns: usize,
    /// Whether the set was seen to cycle: from then on one node leaves it at a time along each line, or, where it
    /// carries fractions, each node a few times only.
    pub cautious: bool,
    /// Newton steps since the set began.
    steps: usize,
    /// How often each node left the set since the front was seen to cycle.
    pub(super) returns_of: Vec<u8>,
    /// Work space: who leaves.
    leaving: Vec<usize>,
}

/// So many returns in a row are a cycle: single ones end by themselves.
const CYCLE: usize = 3;

/// A set with fractions that still moves after so many steps cycles too, through more sets than two.
const LATE: usize = 25;

impl ActiveSet {
    /// Whether pressures are held by a set at all.
    pub fn holds(&self) -> bool {
        !self.ruptured.is_empty()
    }

    /// Reads λ off the ruptured set's rows and holds P there: their rows ask for no change.
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

    /// λ as a node array, empty where there is none.
    pub(super) fn field(&self, grid: &impl Grid) -> Vec<f64> {
        if !self.holds() || self.fills() {
            return Vec::new();
        }
        node_array(grid, &self.multiplier, 0.0)
    }

    /// The set as a node array.
    pub(super) fn nodes(&self, grid: &impl Grid) -> Vec<bool> {
        let mut nodes = vec![false; grid.weights().len()];
        for (k, _) in self.ruptured.iter().enumerate().filter(|(_, ruptured)| **ruptured) {
            nodes[grid.node(k)] = true;
        }
        nodes
    }

    /// Begins with a set; with none where a penalty holds the pressures.
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

    /// Keeps the set as it is before a step.
    pub(super) fn remember(&mut self) {
        self.steps += 1;
        self.former.swap(0, 1);
        self.former[0].clone_from(&self.ruptured);
    }

    /// Whether the set is what it was before the step; counts how often it returns.
    pub(super) fn is_still(&mut self) -> bool {
        let still = self.ruptured == self.former[0];
        self.returns = if !still && self.ruptured == self.former[1] { self.returns + 1 } else { 0 };
        self.cautious |= self.returns >= CYCLE || self.fills() && self.steps > LATE;
        still
    }

    /// Takes nodes out of the set by the union rule; whether there were any: all with λ < 0, and along each line in X the
    /// outer nodes of a block, from either end, while the sum of λ over them is below zero. More flows in there than the
    /// gap takes, so that the liquid fills them all. Unknowns lie in `lines` lines along X, in cells of these widths, the
    /// lines' unknowns of one abscissa side by side.
    pub(super) fn release(&mut self, widths: &[f64], lines: usize) -> bool {
        let Self { ruptured, multiplier, cautious, leaving, .. } = self;
        leaving.clear();
        for line in 0..lines {
            let at = |column: usize| column * lines + line;
            let mut first = 0;
            while first < widths.len() {
                // A block of ruptured nodes along the line.
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

/// Unknowns as a node array, with another value elsewhere.
pub(super) fn node_array(grid: &impl Grid, unknowns: &[f64], elsewhere: f64) -> Vec<f64> {
    let mut array = vec![elsewhere; grid.weights().len()];
    for (k, value) in unknowns.iter().enumerate() {
        array[grid.node(k)] = *value;
    }
    array
}

#[cfg(test)]
mod tests;
