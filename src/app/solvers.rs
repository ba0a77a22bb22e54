//! The worker's full solvers, kept between solves: their grids and kernels cost more than a solve.

use super::jobs::GridChoice;
use crate::solver::contact::OperatingPoint;
use crate::solver::full::{FullSolver, PointSolver, Solution, SolveError, Start};
use crate::solver::grid::{GridSpec, PointGridSpec, ReferenceGrid};
use crate::solver::lubricant::Lubricant;
use crate::solver::observer::Observer;
use std::sync::Arc;

/// Solvers of line contacts kept.
const KEPT_LINES: usize = 4;
/// Solvers of point contacts kept: a quick grid, the chosen one and a second one. Each may hold some hundred megabytes.
const KEPT_PLANES: usize = 3;

/// Full solvers by their grids, the least recently used first.
#[derive(Default)]
pub struct Solvers {
    lines: Vec<FullSolver>,
    planes: Vec<PointSolver>,
}

/// A solver for the kind of contact that its grid is of.
pub enum Solver<'a> {
    /// Of line contacts.
    Line(&'a mut FullSolver),
    /// Of point contacts.
    Plane(&'a mut PointSolver),
}

impl Solver<'_> {
    /// Solves one contact.
    ///
    /// # Errors
    /// When the contact is refused.
    pub fn solve(
        self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &mut dyn Observer,
    ) -> Result<Solution, SolveError> {
        match self {
            Self::Line(solver) => solver.solve(point, lubricant, start, observer),
            Self::Plane(solver) => solver.solve(point, lubricant, start, observer),
        }
    }
}

impl Solvers {
    /// The solver of a grid.
    ///
    /// # Errors
    /// When the grid is refused.
    pub fn of(&mut self, grid: &GridChoice) -> Result<Solver<'_>, SolveError> {
        match grid {
            GridChoice::Existing(reference) => self.line(reference.spec, Some(reference)),
            GridChoice::Spec(spec) => self.line(*spec, None),
            GridChoice::Plane(spec) => self.plane(*spec),
        }
    }

    fn line(&mut self, spec: GridSpec, ready: Option<&Arc<ReferenceGrid>>) -> Result<Solver<'_>, SolveError> {
        let kept = self.lines.iter().position(|solver| solver.reference().spec == spec);
        let solver = match (kept, ready) {
            (Some(at), _) => self.lines.remove(at),
            (None, Some(reference)) => FullSolver::on(Arc::clone(reference)),
            (None, None) => FullSolver::new(spec)?,
        };
        Ok(Solver::Line(last(&mut self.lines, solver, KEPT_LINES)))
    }

    fn plane(&mut self, spec: PointGridSpec) -> Result<Solver<'_>, SolveError> {
        let kept = self.planes.iter().position(|solver| solver.grid().spec == spec);
        let solver = match kept {
            Some(at) => self.planes.remove(at),
            None => PointSolver::new(spec)?,
        };
        Ok(Solver::Plane(last(&mut self.planes, solver, KEPT_PLANES)))
    }
}

/// Puts a solver last, dropping the first where there are too many, and hands it out.
fn last<T>(all: &mut Vec<T>, solver: T, most: usize) -> &mut T {
    if all.len() >= most {
        all.remove(0);
    }
    all.push(solver);
    let end = all.len() - 1;
    &mut all[end]
}
