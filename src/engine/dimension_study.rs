//! How many modes the full solutions along a sweep need: Table 3.7.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::full_solutions;
use super::run::request_of;
use super::series::contacts_of;
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{Axis, Scene};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{PodBasis, deformation_weights};
use crate::solver::training::TrainingObserver;
use faer::Mat;

/// Values: `snapshots`, `full_failures`, `nodes_x`, `nodes_y`, `dofs` (2n + 1), and for every loss of information `basis_p[1e-5]` and
/// `basis_delta[1e-5]`, (2.92) and (2.93).
pub(super) fn run(
    scene: &Scene,
    (over, losses): (&[Axis], &[f64]),
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let request = request_of(scene)?;
    let grid = workbench.grid(&request, observer)?;
    let points: Vec<OperatingPoint> = contacts_of(scene, over)?.into_iter().map(|contact| contact.point).collect();
    let solutions = full_solutions(|_| grid.clone(), &points, scene.lubricant, observer)?;
    let solutions: Vec<Solution> = solutions.into_iter().flatten().collect();
    outcome.converged &= solutions.len() == points.len();
    outcome.push("snapshots", None, solutions.len() as f64);
    outcome.push("full_failures", None, (points.len() - solutions.len()) as f64);
    let (nx, ny) = grid.nodes();
    outcome.push("nodes_x", None, nx as f64);
    outcome.push("nodes_y", None, ny as f64);
    outcome.push("dofs", None, (2 * nx * ny + 1) as f64);
    let few = || EngineError::Study("no full solution converged; there is nothing to decompose".to_owned());
    let decompose = |fields: Vec<Vec<f64>>, weights: &[f64]| {
        let snapshots = Mat::from_fn(grid.len(), fields.len(), |i, j| fields[j][i]);
        PodBasis::new(snapshots.as_ref(), weights, 0.0)
            .filter(|basis| !basis.singular_values.is_empty())
            .ok_or_else(few)
    };
    let deformation = solutions.iter().map(Solution::deformation).collect();
    let deformation = decompose(deformation, &deformation_weights(&grid))?;
    let pressure = decompose(solutions.into_iter().map(|solution| solution.pressure).collect(), grid.weights())?;
    let mut table = Table::new("dimensions", &["loss", "basis_p", "basis_delta"]);
    for &loss in losses {
        let (p, delta) = (pressure.modes_for(loss), deformation.modes_for(loss));
        outcome.push(format!("basis_p[{loss:e}]"), None, p as f64);
        outcome.push(format!("basis_delta[{loss:e}]"), None, delta as f64);
        table.rows.push(vec![loss, p as f64, delta as f64]);
    }
    outcome.tables.push(table);
    Ok(())
}
