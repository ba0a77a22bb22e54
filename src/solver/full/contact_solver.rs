//! Full solves of either kind of contact.

use super::point::PointSolver;
use super::solution::{Solution, SolveError};
use super::start::{FullSolver, Start};
use crate::solver::discrete::grid::{ContactGrid, ContactGridSpec};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use std::sync::Arc;

/// The full solver of whichever kind of contact a grid is of; keeps the work space between solves.
pub enum ContactSolver {
    /// Of line contacts.
    Line(FullSolver),
    /// Of point contacts.
    Point(PointSolver),
}

impl ContactSolver {
    /// A solver on a grid that exists already.
    pub fn on(grid: &ContactGrid) -> Self {
        match grid {
            ContactGrid::Line(grid) => Self::Line(FullSolver::on(Arc::clone(grid))),
            ContactGrid::Point(grid) => Self::Point(PointSolver::on(Arc::clone(grid))),
        }
    }

    /// What its grid was built from.
    pub fn grid_spec(&self) -> ContactGridSpec {
        match self {
            Self::Line(solver) => ContactGridSpec::Line(solver.reference().spec),
            Self::Point(solver) => ContactGridSpec::Point(solver.grid().spec),
        }
    }

    /// Solves one contact, as [`FullSolver::solve`] and [`PointSolver::solve`] do.
    ///
    /// # Errors
    /// When the operating point or the lubricant is refused, or it is of the other kind.
    pub fn solve(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        match self {
            Self::Line(solver) => solver.solve(point, lubricant, start, observer),
            Self::Point(solver) => solver.solve(point, lubricant, start, observer),
        }
    }
}
