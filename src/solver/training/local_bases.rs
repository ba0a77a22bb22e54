//! Local bases of a transient model: the states along its training trajectories are divided into clusters by the k-means
//! method in the coordinates of the whole basis, and each cluster gets its own modes.
//!
//! The modes of a cluster are combinations of the whole basis, so that a file stores only their coefficients. A
//! cluster's basis includes the states around it, up to the distance at which the reduced model changes to another basis.

use super::trajectories::boundaries;
use crate::solver::discrete::grid::dot;
use crate::solver::full::transient::{State, Trajectory};
use crate::solver::reduced::transient::{HYSTERESIS, LocalBasis, TrajectoryModel};
use crate::solver::reduced::{Combined, PodBasis, SharedBasis, TestSpace, Window, all_rows, dense};
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Settings of the local bases of a training.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LocalBases {
    /// Number of clusters.
    pub clusters: usize,
    /// Maximum number of pressure modes of each.
    pub modes: usize,
}

/// Maximum number of clustered states. If there are more, only every n-th is used.
const MOST_STATES: usize = 3000;
/// Maximum number of states for one basis.
const MOST_MEMBERS: usize = 300;
/// Number of rounds in which centres move to the mean of their clusters.
const ROUNDS: usize = 30;
/// Largest distance of a state from a centre, relative to its nearest centre, for which the basis includes it: the
/// factor of the hysteresis of the reduced model's choice, applied twice.
const OVERLAP: f64 = 1.0 / (HYSTERESIS * HYSTERESIS);

/// Computes the local bases of a model that has its whole basis, with all equations of the grid. `emphasis` weights the
/// nodes, `loss` is the accepted loss of information. `test` returns the test space of a
/// basis. `None` if a decomposition fails.
pub(super) fn local_bases(
    model: &TrajectoryModel,
    trajectories: &[Trajectory],
    (emphasis, loss): (&[f64], f64),
    wanted: LocalBases,
    test: impl Fn(&PodBasis) -> TestSpace,
) -> Option<Vec<LocalBasis>> {
    let (window, basis) = (&model.window, model.window.pressure.basis());
    let (grid, weights) = (&window.grid, window.grid.weights());
    let every = trajectories.iter().map(|t| t.states.len()).sum::<usize>().div_ceil(MOST_STATES).max(1);
    let states: Vec<(&Trajectory, &State)> =
        trajectories.iter().flat_map(|t| t.states.iter().step_by(every).map(move |state| (t, state))).collect();
    let weighted = Mat::from_fn(grid.len(), states.len(), |i, j| weights[i] * states[j].1.pressure[i]);
    let coordinates = dense::product(basis.modes.transpose(), weighted.as_ref());
    let coordinates: Vec<Vec<f64>> = coordinates.col_iter().map(|column| column.iter().copied().collect()).collect();
    let centres = centres(&coordinates, wanted.clusters);
    let nearest: Vec<f64> =
        coordinates.iter().map(|at| squared_distance(at, &centres[nearest(&centres, at)])).collect();
    let shared = Arc::new(SharedBasis::new(basis.clone(), grid));
    let local = |centre: Vec<f64>| {
        let near = |k: &usize| squared_distance(&coordinates[*k], &centre) <= OVERLAP * OVERLAP * nearest[*k];
        let members: Vec<usize> = (0..coordinates.len()).filter(near).collect();
        let stride = members.len().div_ceil(MOST_MEMBERS).max(1);
        let subset: Vec<usize> = members.iter().copied().step_by(stride).collect();
        let coefficients = Mat::from_fn(basis.modes.ncols(), subset.len(), |mode, j| coordinates[subset[j]][mode]);
        let pressures = dense::product(basis.modes.as_ref(), coefficients.as_ref());
        let own = PodBasis::emphasised(pressures.as_ref(), weights, emphasis, (loss, wanted.modes))?;
        let weighted = Mat::from_fn(grid.len(), own.modes.ncols(), |i, k| weights[i] * own.modes[(i, k)]);
        let factors = dense::product(basis.modes.transpose(), weighted.as_ref());
        let pressure = Combined { shared: Arc::clone(&shared), factors }.into_modes(own.singular_values);
        let rows = all_rows(&test(pressure.basis()));
        let fronts = if window.snapshots.is_empty() {
            Vec::new()
        } else {
            boundaries(members.iter().map(|k| states[*k]), grid, pressure.basis())
        };
        let deformation = Arc::clone(&window.deformation);
        let mut made = Window::new(window.m, grid.clone(), pressure, deformation, fronts, window.sampling, rows);
        (made.penalty, made.cavitation) = (window.penalty, window.cavitation);
        Some(LocalBasis { window: made, centre })
    };
    centres.iter().cloned().map(local).collect()
}

/// Returns the centres of at most `count` clusters. The initial centres are far from each other.
fn centres(coordinates: &[Vec<f64>], count: usize) -> Vec<Vec<f64>> {
    let mut centres: Vec<Vec<f64>> = coordinates.first().cloned().into_iter().collect();
    while centres.len() < count.min(coordinates.len()) {
        let far = |at: &&Vec<f64>| squared_distance(at, &centres[nearest(&centres, at)]);
        let farthest = coordinates.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
        centres.extend(farthest.cloned());
    }
    for _ in 0..ROUNDS {
        let mut sums: Vec<(f64, Vec<f64>)> = centres.iter().map(|centre| (0.0, vec![0.0; centre.len()])).collect();
        for place in coordinates {
            let (count, sum) = &mut sums[nearest(&centres, place)];
            *count += 1.0;
            sum.iter_mut().zip(place).for_each(|(sum, own)| *sum += own);
        }
        for (centre, (count, sum)) in centres.iter_mut().zip(sums).filter(|(_, (count, _))| *count > 0.0) {
            centre.iter_mut().zip(sum).for_each(|(own, sum)| *own = sum / count);
        }
    }
    centres
}

fn nearest(centres: &[Vec<f64>], place: &[f64]) -> usize {
    let far = |k: &usize| squared_distance(&centres[*k], place);
    (0..centres.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
}

/// Returns the squared distance.
fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    dot(&difference, &difference)
}
