//! The worker's full solvers, kept between solves: their grids and kernels cost more than a solve.

use super::jobs::GridChoice;
use crate::solver::discrete::grid::{ContactGridError, ContactGridSpec};
use crate::solver::full::ContactSolver;
use crate::solver::physics::contact::ContactKind;

/// Solvers of line contacts kept.
const KEPT_LINES: usize = 4;
/// Solvers of point contacts kept: a quick grid, the chosen one and a second one. Each may hold some hundred megabytes.
const KEPT_POINTS: usize = 3;

/// Full solvers by their grids, the least recently used first.
#[derive(Default)]
pub struct Solvers {
    lines: Vec<ContactSolver>,
    points: Vec<ContactSolver>,
}

impl Solvers {
    /// The solver of a grid.
    ///
    /// # Errors
    /// When the grid is refused.
    pub fn of(&mut self, grid: &GridChoice) -> Result<&mut ContactSolver, ContactGridError> {
        let spec = match grid {
            GridChoice::Existing(grid) => grid.spec(),
            GridChoice::Spec(spec) => *spec,
        };
        let (kept, most) = match spec.kind() {
            ContactKind::Line => (&mut self.lines, KEPT_LINES),
            ContactKind::Point => (&mut self.points, KEPT_POINTS),
        };
        let solver = match kept.iter().position(|solver| solver.grid_spec() == spec) {
            Some(at) => kept.remove(at),
            None => built(grid, spec)?,
        };
        if kept.len() >= most {
            kept.remove(0);
        }
        kept.push(solver);
        let end = kept.len() - 1;
        Ok(&mut kept[end])
    }
}

fn built(grid: &GridChoice, spec: ContactGridSpec) -> Result<ContactSolver, ContactGridError> {
    Ok(match grid {
        GridChoice::Existing(grid) => ContactSolver::on(grid),
        GridChoice::Spec(_) => ContactSolver::on(&spec.build()?),
    })
}
