//! What each row of the full system counts in the reduced one.

use super::linearisation::PENALTY_SLOPE;
use crate::solver::full::transient::Trajectory;
use crate::solver::grid::{FIRST_UNKNOWN, LineGrid};
use crate::solver::reynolds::line::Upstream;
use crate::solver::reynolds::{CENTER, Node};

/// States that the mean is taken over, about.
const STATES: usize = 100;

/// One weight per unknown: cell sizes over the root of the rows' mean diagonals |∂r/∂P| in a time step of the training trajectories. In the far inlet a row changes 10⁸
/// times as much with its pressure as under the contact; tested with Vᵀ W alone, the little that modes miss there decides over the film.
/// The root is halfway to rows of equal diagonals, with which the reduced system is no longer stable in time.
pub fn row_weights(grid: &LineGrid, trajectories: &[&Trajectory]) -> Vec<f64> {
    let mut diagonals = vec![0.0; grid.unknowns()];
    let states: usize = trajectories.iter().map(|t| t.states.len()).sum();
    let stride = states.div_ceil(STATES);
    for trajectory in trajectories {
        let steps = trajectory.moments.len().saturating_sub(1).max(1);
        let storage = 1.5 * steps as f64 / trajectory.transient.duration;
        let problem = &trajectory.problem;
        for state in trajectory.states.iter().step_by(stride) {
            let speed = trajectory.transient.inputs.speed.at(state.time);
            let node = |(&p, &h): (&f64, &f64)| Node::new(&problem.fluid, problem.inverse_lambda, p, h);
            let nodes: Vec<Node> = state.pressure.iter().zip(&state.film).map(node).collect();
            for (k, sum) in diagonals.iter_mut().enumerate() {
                let row = Upstream::Inlet.row(&grid.rows[k].in_time(speed, storage, 0.0), PENALTY_SLOPE, &nodes, k);
                let by_film = row.d_h.iter().enumerate().map(|(m, d)| d * grid.kernel_entry(k + m, k + CENTER));
                *sum += (row.d_p[CENTER] + by_film.sum::<f64>()).abs();
            }
        }
    }
    let weights = grid.weights[FIRST_UNKNOWN..].iter().zip(diagonals);
    weights.map(|(weight, diagonal)| weight / diagonal.sqrt()).collect()
}
