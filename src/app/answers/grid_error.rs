//! What the grid costs a point contact's film, and what the estimate belongs to.

use super::picture::Picture;
use crate::app::document::Key;
use crate::engine::GridAccuracy;
use crate::solver::full::{Mesh, Solution};

/// An estimate from a second grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridError {
    /// The contact.
    pub key: Key,
    /// The grid whose error it is.
    pub mesh: Mesh,
    /// The errors.
    pub accuracy: GridAccuracy,
}

impl GridError {
    /// Compares a full solution with one on a second grid; `None` where they do not belong together.
    pub fn of(full: &Picture, second: &Solution) -> Option<Self> {
        let accuracy = GridAccuracy::of(&full.solution, second)?;
        Some(Self { key: full.key, mesh: full.solution.mesh, accuracy })
    }
}
