//! What the grid costs a point contact's film, estimated from a second grid.

use super::jobs::Key;
use super::picture::Picture;
use crate::solver::full::point::{Accuracy, resolution_warning};
use crate::solver::full::{Mesh, Solution};

/// An estimate and what it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridError {
    /// The contact.
    pub key: Key,
    /// The grid whose error it is.
    pub mesh: Mesh,
    /// Nodes along X and across of the second grid.
    pub second: (usize, usize),
    /// Relative errors of H_c and H_min.
    pub errors: (f64, f64),
    /// H_c and H_min in the limit of fine grids.
    pub limits: (f64, f64),
    /// Whether both grids resolve the side lobes: else the error of H_min is larger than it is estimated.
    pub resolved: bool,
}

impl GridError {
    /// Compares a full solution with one on a second grid; `None` where they do not belong together.
    pub fn of(full: &Picture, second: &Solution) -> Option<Self> {
        let accuracy = Accuracy::of_either(&full.solution, second)?;
        let solutions = [&*full.solution, second];
        Some(Self {
            key: full.key,
            mesh: full.solution.mesh,
            second: (second.x.len(), second.y.len()),
            errors: accuracy.errors_of(&full.solution),
            limits: (accuracy.h_c.limit, accuracy.h_min.limit),
            resolved: solutions.iter().all(|solution| resolution_warning(solution).is_none()),
        })
    }
}
