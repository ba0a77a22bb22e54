//! What each row of the full system counts in the reduced one.

use super::linearisation::PENALTY_SLOPE;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid};
use crate::solver::full::transient::Trajectory;
use crate::solver::reduced::mean_diagonals;

/// One weight per unknown: cell sizes over the root of the rows' mean diagonals in a time step of the training
/// trajectories. The root is halfway to rows of equal diagonals, with which the reduced system is no longer stable in
/// time.
pub fn row_weights(grid: &LineGrid, trajectories: &[&Trajectory]) -> Vec<f64> {
    let diagonals = mean_diagonals(grid, trajectories, PENALTY_SLOPE);
    let weights = grid.weights[FIRST_UNKNOWN..].iter().zip(diagonals);
    weights.map(|(weight, diagonal)| weight / diagonal.sqrt()).collect()
}
