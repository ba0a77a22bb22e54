//! Sensitivity of the rows of the full system to their own pressures along trajectories.

use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::full::transient::Trajectory;

/// Approximate number of states for the mean.
const STATES: usize = 100;

/// Returns the mean of |∂r/∂P| of each row r by its own pressure P, including the deformation of the film. It is
/// taken over time steps of trajectories with stored fields. One value per unknown, in the scales of the
/// trajectories' frame. `penalty` is the slope of Λ = −γ̄ min(P, 0) in the cavitated region.
///
/// In the far inlet the mean is 10⁸ times as large as in the contact. If every row counted by its cell size, small
/// projection errors there would dominate the film thickness. The flow is assumed to come from the inlet; the other
/// direction hardly changes a size.
pub(crate) fn mean_diagonals(grid: &LineGrid, trajectories: &[&Trajectory], penalty: f64) -> Vec<f64> {
    let mut sums = vec![0.0; grid.unknowns()];
    let (mut count, gradient) = (0.0, PlaneGradient::along_line(&grid.x));
    let states: usize = trajectories.iter().map(|t| t.states.len()).sum();
    let stride = states.div_ceil(STATES).max(1);
    for trajectory in trajectories {
        let steps = trajectory.moments.len().saturating_sub(1).max(1);
        let storage = 1.5 * steps as f64 / trajectory.transient.duration;
        let (frame, inputs) = (trajectory.transient.frame, &trajectory.transient.inputs);
        for state in trajectory.states.iter().step_by(stride) {
            // Conditions along a computed march were accepted before.
            let Ok(at) = frame.conditions(&trajectory.problem, state.time, inputs.at(state.time)) else { continue };
            let nodes = Nodes::of(at.problem.laws(), &gradient, &state.pressure, &state.film);
            for (k, sum) in sums.iter_mut().enumerate() {
                let geometry = grid.rows[k].in_time(at.speed.abs(), storage, 0.0);
                let stencil = Upstream::Inlet.stencil(k);
                let row = nodes.row(&geometry, penalty, stencil);
                let by_film = row.d_h.iter().zip(stencil).map(|(d, node)| d * grid.kernel_entry(node, k + CENTER));
                *sum += (row.d_p[CENTER] + by_film.sum::<f64>()).abs();
            }
            count += 1.0;
        }
    }
    sums.iter().map(|sum| sum / count).collect()
}

/// Returns the weight of each row of the full system in a linearised model: the cell size divided by the square root
/// of the row's mean diagonal. This is halfway to rows of equal diagonals, for which the reduced system is unstable
/// in time.
pub(crate) fn row_weights(grid: &LineGrid, trajectories: &[&Trajectory], penalty: f64) -> Vec<f64> {
    let weights = grid.weights[FIRST_UNKNOWN..].iter().zip(mean_diagonals(grid, trajectories, penalty));
    weights.map(|(weight, diagonal)| weight / diagonal.sqrt()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::elasticity::Scratch;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::transient::{self, Inputs, Keep, Signal, Transient};
    use crate::solver::physics::contact::OperatingPoint;

    #[test]
    fn row_sizes_are_difference_quotients() {
        let spec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
        let step = 0.01;
        let load = Signal::Harmonic { amplitude: 0.1, period: 0.2 };
        let asked = Transient::new(OperatingPoint::TABLE_2_1, Inputs::load(load), 0.1, step);
        let asked = Transient { keep: Keep::Every(5), ..asked };
        let trajectory = transient::solve(spec, &asked, &()).unwrap();
        let grid = spec.line().unwrap().scaled(1.0);
        let penalty = 1e4;
        let sizes = mean_diagonals(&grid, &[&trajectory], penalty);
        let problem = &trajectory.problem;
        // The row with one changed pressure and the resulting deformation.
        let value = |state: &transient::State, k: usize, by: f64| {
            let (mut pressure, mut bent) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
            pressure[k + FIRST_UNKNOWN] = by;
            grid.deform(&pressure, &mut bent, &mut Scratch::default());
            pressure.iter_mut().zip(&state.pressure).for_each(|(p, own)| *p += own);
            bent.iter_mut().zip(&state.film).for_each(|(h, own)| *h += own);
            let nodes = Nodes::of(problem.laws(), &PlaneGradient::along_line(&grid.x), &pressure, &bent);
            let geometry = grid.rows[k].in_time(1.0, 1.5 / step, 0.0);
            nodes.row(&geometry, penalty, Upstream::Inlet.stencil(k)).value
        };
        assert_eq!(trajectory.states.len(), 3);
        for k in (0..grid.unknowns()).step_by(13) {
            let quotient = |state| (value(state, k, 1e-7) - value(state, k, -1e-7)) / 2e-7;
            let mean = trajectory.states.iter().map(|state| f64::abs(quotient(state))).sum::<f64>() / 3.0;
            assert!((sizes[k] / mean - 1.0).abs() < 1e-4, "row {k}: {:e} against {mean:e}", sizes[k]);
        }
        let at = |x: f64| sizes[grid.x.partition_point(|&own| own < x) - FIRST_UNKNOWN];
        assert!(at(-3.5) > 1e5 * at(0.0), "{:e} and {:e}", at(-3.5), at(0.0));
    }
}
