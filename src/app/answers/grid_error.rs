//! Discretisation error of a point contact's film thickness, with the contact and the grid that it belongs to.

use super::picture::Picture;
use crate::app::document::Key;
use crate::engine::GridAccuracy;
use crate::solver::full::{Mesh, Solution};

/// Estimate of the discretisation error from a second grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridError {
    /// Contact.
    pub key: Key,
    /// Grid whose error is estimated.
    pub mesh: Mesh,
    /// Errors.
    pub accuracy: GridAccuracy,
}

impl GridError {
    /// Compares a full solution with one on a second grid. `None` if they do not belong together.
    pub fn of(full: &Picture, second: &Solution) -> Option<Self> {
        let accuracy = GridAccuracy::of(&full.solution, second)?;
        Some(Self { key: full.key, mesh: full.solution.mesh, accuracy })
    }
}
