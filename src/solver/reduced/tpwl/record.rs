//! Record of a march: for each step the operating points used, their weights, and the distance from them.

use super::weights::Weight;
use serde::{Deserialize, Serialize};

/// One step of a trajectory-piecewise-linear model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TpwlStep {
    /// T at the end of the step.
    pub time: f64,
    /// Distance of the extrapolated state, for which the weights hold, from the barycentre of its operating points.
    pub distance: f64,
    /// Weighted mean of the distances between these points and their neighbours on their trajectories.
    pub spacing: f64,
}

/// All steps of a march with their weights and reduced states; entry 0 is the steady start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TpwlRecord {
    steps: Vec<TpwlStep>,
    weights: Vec<Weight>,
    /// End of each step's weights.
    ends: Vec<usize>,
    states: Vec<f64>,
}

impl TpwlStep {
    /// Returns the distance of the step from the trained trajectories, in units of the distance between its operating
    /// points. A linearised model is accurate up to about one such unit.
    pub fn reach(&self) -> f64 {
        self.distance / self.spacing
    }
}

/// Reach beyond which the operating points do not support a step.
const FAR_REACH: f64 = 2.0;

impl TpwlRecord {
    /// Returns true if more than half of the steps have a reach above 2: the inputs are too steep or too different
    /// from the training.
    pub fn too_steep(&self) -> bool {
        let far = self.steps.iter().filter(|step| step.reach() > FAR_REACH).count();
        2 * far > self.steps.len()
    }

    /// Creates an empty record with capacity for `steps` steps of `entries` weights and a state of `len` entries each.
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

    /// Removes all steps.
    pub fn clear(&mut self) {
        self.steps.clear();
        self.weights.clear();
        self.ends.clear();
        self.states.clear();
    }

    /// Returns the steps in the order of time.
    pub fn steps(&self) -> &[TpwlStep] {
        &self.steps
    }

    /// Returns the operating points of a step and their weights; empty beyond the end.
    pub fn weights(&self, step: usize) -> &[Weight] {
        let from = step.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or(0);
        self.ends.get(step).map_or(&[], |&to| &self.weights[from..to])
    }

    /// Returns the reduced state at the end of a step; empty beyond the end.
    pub fn state(&self, step: usize) -> &[f64] {
        let len = self.states.len() / self.steps.len().max(1);
        self.states.get(step * len..(step + 1) * len).unwrap_or(&[])
    }
}
