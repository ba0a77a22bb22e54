//! What a march drew on, step by step: which operating points, how much of each, and how far from them it went.

use super::weights::Weight;
use serde::{Deserialize, Serialize};

/// A step of a trajectory-piecewise-linear model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TpwlStep {
    /// T at its end.
    pub time: f64,
    /// Distance of the extrapolated state, at which the weights hold, from the barycentre of the points they belong to.
    pub distance: f64,
    /// Weighted mean of those points' distances to their neighbours on their trajectories.
    pub spacing: f64,
}

/// All steps of a march with their weights and reduced states; entry 0 is the stationary start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TpwlRecord {
    steps: Vec<TpwlStep>,
    weights: Vec<Weight>,
    /// End of each step's weights.
    ends: Vec<usize>,
    states: Vec<f64>,
}

impl TpwlStep {
    /// How far the step lies from what was trained, in units of the distance between the points it draws on. A
    /// linearised model knows nothing of what lies farther than about one such distance aside.
    pub fn reach(&self) -> f64 {
        self.distance / self.spacing
    }
}

/// Reach beyond which a step is no longer carried by its points.
const FAR_REACH: f64 = 2.0;

impl TpwlRecord {
    /// Whether more than half of the steps lie farther from the trained trajectories than two distances between
    /// operating points: the inputs are too steep or too different.
    pub fn too_steep(&self) -> bool {
        let far = self.steps.iter().filter(|step| step.reach() > FAR_REACH).count();
        2 * far > self.steps.len()
    }

    /// An empty record with room for `steps` steps of `entries` weights and a state of `len` entries each.
    pub fn with_room(steps: usize, entries: usize, len: usize) -> Self {
        Self {
            steps: Vec::with_capacity(steps),
            weights: Vec::with_capacity(steps * entries),
            ends: Vec::with_capacity(steps),
            states: Vec::with_capacity(steps * len),
        }
    }

    /// Adds a step.
    pub fn push(&mut self, step: TpwlStep, weights: &[Weight], state: &[f64]) {
        self.steps.push(step);
        self.weights.extend_from_slice(weights);
        self.ends.push(self.weights.len());
        self.states.extend_from_slice(state);
    }

    /// Forgets all steps.
    pub fn clear(&mut self) {
        self.steps.clear();
        self.weights.clear();
        self.ends.clear();
        self.states.clear();
    }

    /// The steps in the order of time.
    pub fn steps(&self) -> &[TpwlStep] {
        &self.steps
    }

    /// The operating points of a step and their weights; empty beyond the end.
    pub fn weights(&self, step: usize) -> &[Weight] {
        let from = step.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or(0);
        self.ends.get(step).map_or(&[], |&to| &self.weights[from..to])
    }

    /// The reduced state at the end of a step; empty beyond the end.
    pub fn state(&self, step: usize) -> &[f64] {
        let len = self.states.len() / self.steps.len().max(1);
        self.states.get(step * len..(step + 1) * len).unwrap_or(&[])
    }
}
