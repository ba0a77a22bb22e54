//! Search of the operating points of a state and their weights.

use super::grid::SpaceGrid;
use super::model::{TpwlModel, TrainedPoint};
use super::weights::{
    Barycentre, NEAREST, NEAREST_EACH, NEAREST_OF_PLANES, Weight, Weighting, exponential, square_distance,
};

/// Work space of the search.
pub struct Search {
    weighting: Weighting,
    /// Parameter sets in use and their shares, (4.27).
    shares: Vec<(usize, f64)>,
    /// Shifts from a state of this contact to each of these sets, see [`carried`].
    shifts: Vec<Vec<f64>>,
    query: Vec<f64>,
    distances: Vec<(usize, f64)>,
    near: Vec<Weight>,
    barycentre: Barycentre,
}

impl Search {
    /// Allocates the work space for the points of the given sets.
    pub fn new(model: &TpwlModel, weighting: Weighting, shares: Vec<(usize, f64)>) -> Self {
        let sets = shares.iter().map(|&(set, _)| &model.sets[set]);
        let points = sets.clone().map(|set| set.points.len()).max().unwrap_or(0);
        let near =
            sets.map(|set| set.trajectories.len() * NEAREST_EACH).max().unwrap_or(0).max(of_one_trajectory(model));
        Self {
            weighting,
            shifts: carried(model, weighting, &shares),
            query: vec![0.0; model.space.len()],
            shares,
            distances: Vec::with_capacity(points),
            near: Vec::with_capacity(points.max(near)),
            barycentre: Barycentre::new(near),
        }
    }

    /// Maximum number of weights of a search.
    pub fn most_weights(&self) -> usize {
        self.shares.len() * self.near.capacity()
    }

    /// Returns the sets in use and their shares.
    pub fn shares(&self) -> &[(usize, f64)] {
        &self.shares
    }

    /// Computes the weights for a state, for all sets in use together; their sum is 1.
    pub fn weights(&mut self, model: &TpwlModel, state: &[f64], out: &mut Vec<Weight>) {
        out.clear();
        for (&(set, share), shift) in self.shares.iter().zip(&self.shifts) {
            let set = &model.sets[set];
            let query = &mut self.query;
            query.iter_mut().zip(state).zip(shift).for_each(|((query, y), shift)| *query = y + shift);
            let distance = |&point: &usize| (point, square_distance(query, &model.points[point].moment.state));
            self.distances.clear();
            self.distances.extend(set.points.iter().map(distance));
            match self.weighting {
                Weighting::Dissertation => {
                    self.distances.iter_mut().for_each(|(_, d)| *d = d.sqrt());
                    exponential(&self.distances, &mut self.near);
                }
                Weighting::DualTaylor => {
                    self.near.clear();
                    if set.trajectories.len() == 1 {
                        nearest(&mut self.distances, of_one_trajectory(model), &mut self.near);
                    } else {
                        // The points of a trajectory are adjacent in the list.
                        let same =
                            |a: &(usize, f64), b: &(usize, f64)| of(model, a).trajectory == of(model, b).trajectory;
                        for own in self.distances.chunk_by_mut(same) {
                            nearest(own, NEAREST_EACH, &mut self.near);
                        }
                    }
                    self.barycentre.weights(query, |point| &model.points[point].moment.state, &mut self.near);
                }
            }
            out.extend(self.near.iter().map(|w| Weight { weight: share * w.weight, ..*w }));
        }
    }
}

/// Returns the number of nearest points of a set with one trajectory.
fn of_one_trajectory(model: &TpwlModel) -> usize {
    match model.space.grid {
        SpaceGrid::Line(_) => NEAREST,
        SpaceGrid::Plane(_) => NEAREST_OF_PLANES,
    }
}

fn of<'a>(model: &'a TpwlModel, entry: &(usize, f64)) -> &'a TrainedPoint {
    &model.points[entry.0]
}

/// Appends the `count` nearest points; changes the order of `distances`.
fn nearest(distances: &mut [(usize, f64)], count: usize, out: &mut Vec<Weight>) {
    let count = count.min(distances.len());
    if count < distances.len() {
        distances.select_nth_unstable_by(count, |a, b| a.1.total_cmp(&b.1));
    }
    out.extend(distances[..count].iter().map(|&(point, _)| Weight { point, weight: 0.0 }));
}

/// Returns the difference between each set's mean state and the mean of the sets in use. A contact between two
/// trained ones differs from both. Its state plus this difference approximates the corresponding state in the set,
/// whose near points are those of the same phase. The dissertation's weights have no such shift.
fn carried(model: &TpwlModel, weighting: Weighting, shares: &[(usize, f64)]) -> Vec<Vec<f64>> {
    let len = model.space.len();
    if weighting == Weighting::Dissertation {
        return vec![vec![0.0; len]; shares.len()];
    }
    let means: Vec<Vec<f64>> = shares.iter().map(|&(set, _)| mean_state(model, set)).collect();
    let common = |k: usize| -> f64 { means.iter().zip(shares).map(|(mean, (_, share))| share * mean[k]).sum() };
    means.iter().map(|mean| (0..len).map(|k| mean[k] - common(k)).collect()).collect()
}

/// Returns the mean of all moments of a set's training trajectories.
fn mean_state(model: &TpwlModel, set: usize) -> Vec<f64> {
    let moments = || model.sets[set].trajectories.iter().flat_map(|&trajectory| &model.trajectories[trajectory]);
    let share = 1.0 / moments().count() as f64;
    let mut mean = vec![0.0; model.space.len()];
    for moment in moments() {
        mean.iter_mut().zip(&moment.state).for_each(|(sum, y)| *sum += share * y);
    }
    mean
}
